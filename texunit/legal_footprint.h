// What a lookup may make of its derivatives, within an implementation's precision: levels of detail, and probes along an axis.
#pragma once

#include "texunit/legal_place.h"

#include <vector>

namespace rawtexel::texunit {

/// One number of probes along one axis, at a range of levels.
struct LegalLine {
    Range lod;                              ///< after bias and bounds, not clamped to the levels there are
    const Kernel* magnified = nullptr;      ///< kernel for lod <= 0
    const Kernel* minified = nullptr;       ///< kernel above
    int probes = 1;                         ///< n
    bool normal = false;                    ///< normal weights and places (texunit/probe_table.h), else equal ones
    std::array<LegalCoordinate, 2> axis{};  ///< what places are measured in, in texture coordinates; nothing for one probe
};

/// What is suspected of an implementation: a departure from the rule, to be tried (likely_cause).
struct FootprintSuspicion {
    double probes = 1;            ///< factor of their number
    bool level_of_long = false;   ///< the level of the longer axis
    bool level_of_short = false;  ///< that of the shorter one, though probes are too few for the ratio
    bool other_axis = false;      ///< probes along the shorter axis
};

/// All there are; at least one. Of volumes and cube maps isotropic, with one probe.
std::vector<LegalLine> legal_lines(const Shape& shape, const SamplerState& sampler, const LegalPlace& place,
                                   const LegalPrecision& precision, const FootprintSuspicion& suspicion = {});

}  // namespace rawtexel::texunit
