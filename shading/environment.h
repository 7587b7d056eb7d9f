// Light from all around: a lat-long image, prefiltered once for diffuse and for GGX lobes of every roughness.
#pragma once

#include "shading/executor.h"
#include "shading/image.h"

#include <glm/glm.hpp>

#include <memory>
#include <string_view>
#include <vector>

namespace rawtexel::shading {

/// Lat-long convention: u = 0.5 + atan2(x, -z)/(2 pi), v = acos(y)/pi; the image's centre is -Z, its top +Y.
class Environment {
  public:
    /// `latlong`: 3 or 4 channels, linear radiance, width 2:1 height in spirit (any extents work); non-finite and negative values read
    /// as 0. The same bits for any number of threads and on every instruction set.
    Environment(const Image& latlong, Executor& executor);

    /// Radiance from `direction` (unit), bilinear in the image.
    glm::vec3 radiance(const glm::vec3& direction) const;
    /// Irradiance/pi over the hemisphere about `normal`: a white diffuse surface's radiance.
    glm::vec3 diffuse(const glm::vec3& normal) const;
    /// Mean radiance over the GGX lobe about `direction` (n = v = r), cosine weighted; `roughness` perceptual 0..1
    /// (up to 2: on to the lobe of kFlatRoughness, environment_tables.h).
    glm::vec3 specular(const glm::vec3& direction, float roughness) const;

    /// Tables for the vector code (shading/environment-inl.h).
    struct Tables;
    const Tables& tables() const { return *tables_; }

  private:
    std::shared_ptr<const Tables> tables_;
};

/// How glossy surfaces reflect an environment. Prefiltered: by several prefiltered lobes in the plane of incidence
/// (shading/reflection_probes.h), within 1 % of sampling. SplitSum: by one lobe and an albedo, some per cent off at an angle, and cheaper.
enum class EnvironmentReflections { Prefiltered, SplitSum };
std::string_view to_string(EnvironmentReflections reflections);  // prefiltered split-sum

/// Directional albedo of single-scattering GGX (height-correlated Smith): scale and bias of F0, by (n.v, perceptual roughness).
/// Karis 2013, "Real Shading in Unreal Engine 4", split sum; integrated in double at build of the table.
glm::vec2 ggx_albedo(float n_dot_v, float roughness);

/// The built-in sky: a clear gradient with a soft glow about the sun, without the sun's disc (a directional light stands for it).
Image sky_latlong(int width = 512, int height = 256);
/// The way the built-in sun's light travels (unit), and its colour and illuminance.
struct Sun {
    glm::vec3 direction, color;
    float intensity;
};
Sun sky_sun();

}  // namespace rawtexel::shading
