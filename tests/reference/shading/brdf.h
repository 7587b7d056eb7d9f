// The glTF 2.0 surface model and KHR_lights_punctual in double, one point at a time, by the letter of the specifications.
#pragma once

#include "shading/scene.h"

#include <glm/glm.hpp>

namespace rawtexel::reference {

struct Surface {
    glm::dvec3 base{1.0};
    double metallic = 0.0, roughness = 1.0, occlusion = 1.0;
    glm::dvec3 emission{0.0};
    glm::dvec3 position{0.0}, normal{0, 0, 1}, view{0, 0, 1};
};

/// BRDF times max(n.l, 0) towards unit `light`.
glm::dvec3 brdf_cosine(const Surface& surface, const glm::dvec3& light);

/// Radiance that a light adds, nothing in its way.
glm::dvec3 punctual_radiance(const Surface& surface, const shading::Light& light);

/// Share of uniform light of radiance 1 that the surface reflects at the angle whose cosine is `n_dot_v`: the integral of brdf_cosine over
/// the hemisphere, by half vectors on a fine grid.
glm::dvec3 directional_albedo(Surface surface, double n_dot_v);

}  // namespace rawtexel::reference
