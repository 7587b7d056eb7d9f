// A case as texunit's legal-interval verifier takes it: what is legal of hardware, and which known mistake explains what came.
#pragma once

#include "cli/vectors/suite.h"
#include "texunit/legal_interval.h"

namespace rawtexel::cli {

/// Refers to the suite, which must outlive it.
texunit::JudgedTexture judged_texture(const Suite& suite, const CaseRecord& record);
texunit::JudgedLookup judged_lookup(const CaseRecord& record);

std::array<double, 4> judged_colour(const std::array<float, 4>& value);

}  // namespace rawtexel::cli
