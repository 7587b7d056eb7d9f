#include "scenes/builtin.h"

#include "scenes/builtin_makers.h"

#include <array>

namespace rawtexel::scenes {

std::span<const BuiltinScene> builtin_scenes() {
    static constexpr std::array<BuiltinScene, 11> kScenes{{
        {"plane", "a checker with detail at every scale, to the horizon: minification", make_plane},
        {"spheres", "100 spheres of 20 000 triangles with colour, normal and metallic-roughness maps", make_spheres},
        {"magnify", "one quad enlarging a 64x64 texture about 30 times: the character of kernels", make_magnify},
        {"metal-edge", "metal next to dielectric, texel by texel, under a highlight", make_metal_edge},
        {"bumps", "a strongly normal-mapped glossy floor at a grazing angle: minified highlights", make_bumps},
        {"foliage", "a meadow and trees of alpha-masked leaves, smaller than a pixel in the distance", make_foliage},
        {"triplanar", "a ring of weathered standing stones without texture coordinates: planes to blend or to draw", make_triplanar},
        {"layers", "a path where cobbles, soil and meadow meet by a mask: layers to blend or to draw", make_layers},
        {"font", "glyphs of signed distances: a map that must be filtered before its test", make_font},
        {"shadow", "the shadow of an iron lattice from close by: the penumbra of the shadow's filter", make_shadow},
        {"courtyard", "arcades, cobbles, fountain and plants in the sun: a bit of everything", make_courtyard},
    }};
    return kScenes;
}

}  // namespace rawtexel::scenes
