// All the light of one frame, resolved from scene and options: what shading a surface reads.
#pragma once

#include "shading/environment.h"
#include "shading/scene.h"
#include "shading/shadow_map.h"
#include "shading/surface.h"

#include <memory>
#include <optional>

namespace rawtexel::shading {

struct Lighting {
    std::vector<Light> lights;
    float ambient = 0.0f;                            ///< adds ambient * base colour * occlusion
    std::shared_ptr<const Environment> environment;  ///< null: none
    EnvironmentReflections reflections = EnvironmentReflections::Prefiltered;
    /// Shadow of the first directional light, the only one that casts; null: none.
    std::shared_ptr<const ShadowMap> shadow;
};

/// Numbers in [0, 1) that draw one depth test of a shadow's filter for each lane.
struct ShadowNumbers {
    WaveFloat x, y;
};

/// Radiance towards the viewer of the lanes of `mask`: emission, punctual lights, environment, ambient.
/// `shadow_numbers` null: shadows weigh all depth tests.
/// glTF 2.0 appendix B: F0 = lerp(0.04, base, metallic); GGX D, height-correlated Smith V, Schlick F; diffuse (1-F)(1-metallic)base/pi.
/// Occlusion dims ambient and environment. The same bits on every instruction set, and a lane depends on nothing but itself.
/// The vector form shading/light-inl.h is what the renderer inlines; this door dispatches to it, for tests and tools.
void shade_surface(const Lighting& lighting, const SurfaceWave& surface, WaveMask mask, WaveVector& radiance,
                   const ShadowNumbers* shadow_numbers = nullptr);

}  // namespace rawtexel::shading
