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
};

}  // namespace rawtexel::shading
