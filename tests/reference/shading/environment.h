// Light from a lat-long image in double, by sampling it: slow and with no idea of prefiltering.
#pragma once

#include "shading/image.h"
#include "tests/reference/shading/brdf.h"

#include <glm/glm.hpp>

#include <vector>

namespace rawtexel::reference {

/// Radiance from unit `direction`: bilinear, columns wrap, rows hold. u = 0.5 + atan2(x, -z)/(2 pi), v = acos(y)/pi.
glm::dvec3 latlong_radiance(const shading::Image& image, const glm::dvec3& direction);
glm::dvec3 direction_of_latlong(double u, double v);

/// Point i of n of the Hammersley sequence in the unit square.
glm::dvec2 hammersley(uint32_t i, uint32_t n);
/// A unit vector across `normal`; with cross(normal, it) an orthonormal frame.
glm::dvec3 tangent_of(const glm::dvec3& normal);
/// Point k of n, spread evenly over the sphere (a spiral by the golden angle).
glm::dvec3 spiral_direction(int k, int n);

/// Mean radiance over the GGX lobe with n = v = r = `normal`, cosine weighted: `count` directions drawn from the lobe. Roughness 1:
/// irradiance / pi.
glm::dvec3 sampled_lobe(const shading::Image& image, const glm::dvec3& normal, double alpha, int count);

/// The same by visiting the whole image on a grid finer than its texels: small bright lights leave no noise. Good where the lobe
/// is wider than the grid's steps.
class ImageIntegral {
  public:
    ImageIntegral(const shading::Image& image, int points_per_texel);
    glm::dvec3 lobe(const glm::dvec3& normal, double alpha) const;
    /// Light that a surface reflects towards its view.
    glm::dvec3 reflected(const Surface& surface) const;

  private:
    struct Point {
        glm::dvec3 direction, light;  ///< radiance times solid angle
        double solid_angle;
    };
    std::vector<Point> points_;
};

/// Light of the image that a surface reflects towards its view: the specular part by `count` visible normals (Heitz 2018), the diffuse part
/// by as many cosine-weighted directions.
glm::dvec3 reflected_light(const shading::Image& image, const Surface& surface, int count);

}  // namespace rawtexel::reference
