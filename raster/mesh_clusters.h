// Triangles in small compact groups with bounds, so that whole groups can be left out before a vertex of them is transformed.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace rawtexel::raster {

/// Up to kClusterTriangles triangles and the vertices that they name, which are its own.
struct Cluster {
    uint32_t first_triangle = 0, first_vertex = 0;  ///< in the arrays of MeshClusters
    uint8_t triangle_count = 0, vertex_count = 0;
    uint8_t identical = 0;  ///< triangles with two corners in one place, which have no area under any transform
    bool finite = false;    ///< all vertices are; where not, nothing below holds
    glm::vec3 lower{0.0f}, upper{0.0f};
    /// The unit normals (counter-clockwise) of all triangles but the identical ones lie within the cone of this cosine about the axis.
    /// The cosine is 0 or less where no cone is worth a test.
    glm::vec3 cone_axis{0.0f};
    float cone_cosine = -1.0f;
    /// Least of 2*area/perimeter, the radius of the inscribed circle, over those triangles; object space, rounded down.
    float least_inradius = 0.0f;
};

inline constexpr uint32_t kClusterTriangles = 64;
inline constexpr uint32_t kVertexAlignment = 16;  ///< vertices of a cluster take a multiple of this, the last one repeated

/// A triangle list cut into clusters: neighbours in space that face the same way, whatever the order of the list.
struct MeshClusters {
    std::vector<Cluster> clusters;
    std::vector<uint32_t> primitive;  ///< by triangle of the clusters: which triangle of the list it is
    std::vector<uint8_t> corner[3];   ///< likewise: its vertices, counted from its cluster's first
    std::vector<float> x, y, z;       ///< of the clusters' vertices
};

/// Every index is below positions.size() (asserted). The same input gives the same clusters.
MeshClusters make_clusters(std::span<const glm::vec3> positions, std::span<const uint32_t> indices);

}  // namespace rawtexel::raster
