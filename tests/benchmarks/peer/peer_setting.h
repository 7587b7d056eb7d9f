// What both sides of a comparison draw with.
#pragma once

#include "shading/scene.h"

#include <string_view>

namespace rawtexel::peer {

/// Filters that both sides know, of every map. Cubics are B-splines on level 0.
enum class Filter { Bilinear, Trilinear, Anisotropic16, Cubic16Taps, CubicOneTap };
std::string_view to_string(Filter filter);  // bilinear trilinear anisotropic-16 cubic-16-taps cubic-one-tap

/// A frame as simple viewers draw it (`--peer-shading`): one directional light without shadow, and a little of the base colour.
struct Setting {
    shading::Camera camera;
    int width = 1920, height = 1080;
    shading::Light light;
    float ambient = 0.1f;
    Filter filter = Filter::Trilinear;
    int threads = 2;
};

}  // namespace rawtexel::peer
