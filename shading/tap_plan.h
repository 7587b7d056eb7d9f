// Which maps of a material are drawn together, and what of it is shaded.
#pragma once

#include "shading/filtering_options.h"
#include "shading/scene.h"
#include "texunit/draw.h"

#include <array>
#include <cstdint>

namespace rawtexel::shading {

/// Maps that share their draws. Those of equal extents, sampler and coordinates draw the same texels and form one lookup.
struct TapPlan {
    int lookups = 0;
    std::array<MapSlot, kMapSlots> first{};   ///< of each lookup, the first of its maps
    std::array<int8_t, kMapSlots> lookup_of;  ///< of each map, -1: not in the plan

    TapPlan() { lookup_of.fill(-1); }
    bool empty() const { return lookups == 0; }
    bool holds(int slot) const { return lookup_of[size_t(slot)] >= 0; }
};

/// How a material's maps are looked up. Those in neither plan are filtered before shading, every tap weighed.
struct TapPlans {
    TapPlan averaged;         ///< drawn, and the draws averaged before shading
    TapPlan shaded;           ///< raw texels are shaded
    bool enumerates = false;  ///< every tap of `shaded`, instead of draws
    int taps = 1;             ///< draws
    bool common_numbers = false;
    texunit::Noise noise = texunit::Noise::White;
    texunit::NumberRoles roles{false, false, false};  ///< of the draws of both, and of a level drawn for all maps
    texunit::Dither dither = texunit::Dither::None;   ///< whose numbers draw instead of the noise's

    bool draws() const { return !averaged.empty() || !shaded.empty(); }
};

}  // namespace rawtexel::shading
