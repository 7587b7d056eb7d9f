// Work that a frame leaves out where it cannot change a bit of the image, by name, so that every piece can be turned off.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace rawtexel::shading {

struct Skips {
    bool clusters = true;
    bool frustum = true;
    bool backface = true;
    bool occlusion = true;
    bool hiz = true;
    bool empty_tiles = true;
    bool lazy_files = true;
    bool lazy_levels = true;
    bool lazy_blocks = true;
    bool constant_texels = true;
    bool zero_weight_taps = true;
};

/// One switch: what --skip and --no-skip call it, and what it leaves out.
struct SkipInfo {
    std::string_view name;
    bool Skips::*on;
    std::string_view description;
};

inline constexpr std::array kSkips{
    SkipInfo{"clusters", &Skips::clusters, "groups of triangles, before their vertices are transformed"},
    SkipInfo{"frustum", &Skips::frustum, "triangles outside the view, before they are clipped"},
    SkipInfo{"backface", &Skips::backface, "triangles seen from behind, before they are set up"},
    SkipInfo{"occlusion", &Skips::occlusion, "clusters behind what large clusters cover"},
    SkipInfo{"hiz", &Skips::hiz, "triangles in 8x8 pixels behind what these hold"},
    SkipInfo{"empty-tiles", &Skips::empty_tiles, "visibility of tiles without a triangle"},
    SkipInfo{"lazy-files", &Skips::lazy_files, "pixels of textures that no sample reads"},
    SkipInfo{"lazy-levels", &Skips::lazy_levels, "generated levels that no sample reads"},
    SkipInfo{"lazy-blocks", &Skips::lazy_blocks, "stored blocks that no sample reads"},
    SkipInfo{"constant-texels", &Skips::constant_texels,
             "lookups by nearest, bilinear or trilinear filtering of small textures of one colour"},
    SkipInfo{"zero-weight-taps", &Skips::zero_weight_taps,
             "shadow tests outside the map, tests and reflections of light that does not arrive"},
};

}  // namespace rawtexel::shading
