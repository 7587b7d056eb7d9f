// The light of a surface, taken apart. For tools that explain.
#pragma once

#include "shading/lighting.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace rawtexel::shading {

/// What one source adds to the radiance towards the viewer.
struct LightTerm {
    std::string source;  ///< "ambient", "emission", "environment", or the name of a light
    glm::vec3 radiance{0.0f};
};

/// Everything that shade_surface adds up for lane `lane`, in its order: added in float from the first to the last, the terms give its bits.
/// Ambient light and emission are always there; a light without a name is called "light N" by its place in `lighting.lights`.
std::vector<LightTerm> light_terms(const Lighting& lighting, const SurfaceWave& surface, int lane);

}  // namespace rawtexel::shading
