// The verdict on a lookup, by the rule or by a suspected departure from it.
#pragma once

#include "texunit/legal_footprint.h"
#include "texunit/legal_patches.h"

namespace rawtexel::texunit {

struct Suspicion {
    FootprintSuspicion footprint;
    AddressSuspicion address;
};

/// judge_lookup, as if the rule were what is suspected.
LegalVerdict judge_suspected(const JudgedTexture& texture, const SamplerState& sampler, const JudgedLookup& lookup, const Colour& colour,
                             const LegalPrecision& precision, const Suspicion& suspicion);

}  // namespace rawtexel::texunit
