// A chart on the ground, to the horizon: every level of the pyramid and every anisotropy in one picture.
#include "scenes/builtin_assembly.h"
#include "scenes/builtin_makers.h"
#include "scenes/procedural_chart.h"
#include "scenes/shapes.h"

namespace rawtexel::scenes {

shading::Scene make_plane(const texunit::TextureOptions& options) {
    SceneAssembly assembly("plane", options);
    const uint32_t chart = assembly.add_color_material("survey chart", survey_chart(), 1.0f);
    assembly.material(chart).unlit = true;

    constexpr float kHalfExtent = 2000.0f;    // metres: its far edge is less than a pixel below the true horizon
    constexpr float kMetresPerRepeat = 8.0f;  // one metre per square of the chart
    constexpr float kRepeats = kHalfExtent / kMetresPerRepeat;
    shading::Mesh ground;
    append_rectangle(ground, {-kHalfExtent, 0.0f, kHalfExtent}, {2.0f * kHalfExtent, 0.0f, 0.0f}, {0.0f, 0.0f, -2.0f * kHalfExtent},
                     {-kRepeats, kRepeats}, {kRepeats, -kRepeats});
    assembly.place(assembly.add_mesh("ground", chart, std::move(ground)));

    // Turned against the squares, so that the footprints' axes are not those of the texture.
    assembly.add_camera("horizon", {0.6f, 1.7f, 0.0f}, {3.35f, 0.75f, -5.2f}, 45.0f);
    assembly.set_environment(shading::EnvironmentRequest::Sky);
    return assembly.take();
}

}  // namespace rawtexel::scenes
