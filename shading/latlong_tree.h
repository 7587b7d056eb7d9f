// A lat-long image as a tree of light sources: every node stands for a patch of sky, told by its flux and the mean direction of that flux.
#pragma once

#include "shading/executor.h"
#include "shading/image.h"

#include <glm/glm.hpp>

#include <vector>

namespace rawtexel::shading {

/// A symmetric 3x3 matrix.
struct Covariance {
    float xx, yy, zz, xy, yz, zx;
};

/// The light of one patch of the sphere. `direction` is the flux-weighted mean of unit vectors, not normalised: for a kernel f(n.l) that is
/// smooth over the patch, f(n . direction) * flux is right up to the variance of n.l within the patch, which is n^T spread n.
struct LightNode {
    glm::vec3 direction;
    float radius;       ///< chord from the patch's centre to its farthest corner, at most
    glm::vec3 flux;     ///< radiance times solid angle, summed
    float solid_angle;  ///< steradians
    Covariance spread;  ///< of the flux's directions about their mean
};

/// Nodes of one level, row by row; a node (x, y) has the children (2x, 2y) .. (2x+1, 2y+1) of the finer level, where they exist.
struct LightLevel {
    int width = 0, height = 0;
    std::vector<LightNode> nodes;
    const LightNode& at(int x, int y) const { return nodes[size_t(y) * size_t(width) + size_t(x)]; }
};

/// Levels from the finest to a single node. The finest level resolves the bilinear image: texels of small images are split, those of
/// large ones merged. `latlong`: 3 channels, finite and not negative.
std::vector<LightLevel> make_light_tree(const Image& latlong, Executor& executor);

/// Direction of (u, v) of a lat-long image: u = 0.5 + atan2(x, -z)/(2 pi), v = acos(y)/pi.
glm::dvec3 latlong_direction(double u, double v);

}  // namespace rawtexel::shading
