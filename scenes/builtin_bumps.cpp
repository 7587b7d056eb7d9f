// Wet-looking hammered tiles towards the sun: past a few metres a pixel holds many bumps, and what the highlight does depends on
// whether normals are averaged before shading or after.
#include "scenes/builtin_assembly.h"
#include "scenes/builtin_makers.h"
#include "scenes/procedural_matter.h"
#include "scenes/shapes.h"

#include "shading/environment.h"

namespace rawtexel::scenes {

shading::Scene make_bumps(const texunit::TextureOptions& options) {
    SceneAssembly assembly("bumps", options);
    const uint32_t tiles = assembly.add_surface_material("hammered ceramic", hammered_ceramic());

    constexpr float kHalfExtent = 400.0f;  // metres
    constexpr float kMetresPerRepeat = 2.0f;
    constexpr float kRepeats = kHalfExtent / kMetresPerRepeat;
    shading::Mesh floor;
    append_rectangle(floor, {-kHalfExtent, 0.0f, kHalfExtent}, {2.0f * kHalfExtent, 0.0f, 0.0f}, {0.0f, 0.0f, -2.0f * kHalfExtent},
                     {-kRepeats, kRepeats}, {kRepeats, -kRepeats});
    assembly.place(assembly.add_mesh("floor", tiles, std::move(floor)));

    assembly.add_sky_and_sun();
    // Towards the sun, a little beside it, so that its glitter runs down the picture.
    const glm::vec3 to_sun = -shading::sky_sun().direction;
    const glm::vec3 ahead = glm::normalize(glm::vec3(to_sun.x, 0.0f, to_sun.z));
    const glm::vec3 aside(-ahead.z, 0.0f, ahead.x);
    assembly.add_camera("towards the sun", {0.0f, 1.15f, 0.0f}, ahead * 4.0f - aside * 0.5f + glm::vec3(0.0f, 0.42f, 0.0f), 50.0f);
    return assembly.take();
}

}  // namespace rawtexel::scenes
