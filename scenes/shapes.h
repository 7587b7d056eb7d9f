// Meshes of simple solids, with normals, tangents and texture coordinates from their formulas.
#pragma once

#include "shading/scene.h"

#include <glm/glm.hpp>

#include <functional>
#include <span>

namespace rawtexel::scenes {

/// A point of a parametric surface. The texture's x axis runs along `along_u`, its rows run downwards along +v.
struct ShapePoint {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f, 1.0f, 0.0f};   ///< any length but 0
    glm::vec3 along_u{1.0f, 0.0f, 0.0f};  ///< direction of growing u; made orthogonal to the normal and unit
    glm::vec2 uv{0.0f};
    bool mirrored = false;  ///< true where the texture reads mirrored
};

/// `v` made unit, such that normalising it once more in double precision gives the same bits: it survives a file.
glm::vec3 settled_unit(glm::vec3 v);

/// Appends a point to every attribute array of `mesh` (uv set 0) and returns its index.
uint32_t append_point(shading::Mesh& mesh, const ShapePoint& point);

/// Appends a grid of columns x rows quads over at(s, t), s and t in 0..1. Seen with s to the right and t upwards it faces the viewer.
void append_patch(shading::Mesh& mesh, int columns, int rows, const std::function<ShapePoint(float s, float t)>& at);

/// Appends a flat rectangle from its lower left corner; the texture covers uv0 (lower left) to uv1 (upper right).
void append_rectangle(shading::Mesh& mesh, glm::vec3 corner, glm::vec3 right, glm::vec3 up, glm::vec2 uv0, glm::vec2 uv1);

/// Appends the sphere about the origin: `around` x `rings` quads, whose two end rings are triangles: 2*around*(rings - 1) in all.
/// The texture goes `repeat` times around and from pole to pole.
void append_sphere(shading::Mesh& mesh, float radius, int around, int rings, glm::vec2 repeat);

/// Appends a box whose edges are rounded by `radius` (0 < radius < every half extent); uv in metres per `metres_per_uv`.
void append_rounded_box(shading::Mesh& mesh, glm::vec3 center, glm::vec3 half_extent, float radius, float metres_per_uv);

/// Appends a profile turned about the y axis. `profile`: (radius, y), walked so that the outside lies to its right when y is up
/// (upwards on an outer wall). Corners sharper than `crease` degrees stay sharp. u: `repeat` around; v: profile length per metres_per_uv.
void append_lathe(shading::Mesh& mesh, std::span<const glm::vec2> profile, int around, float repeat, float metres_per_uv,
                  float crease = 40.0f);

/// Appends a round bar along a path, its radius interpolated along the way. u runs `repeat` times around, v along the path.
void append_tube(shading::Mesh& mesh, std::span<const glm::vec3> path, float radius_begin, float radius_end, int around, float repeat,
                 float metres_per_uv);

/// Appends the torus about the y axis.
void append_torus(shading::Mesh& mesh, float major_radius, float minor_radius, int around, int across, glm::vec2 repeat);

/// Appends `part`, moved by `transform` (rotation, translation and scale; may mirror).
void append_mesh(shading::Mesh& mesh, const shading::Mesh& part, const glm::mat4& transform);

/// Removes points that no triangle uses, from every attribute array.
void drop_unused_points(shading::Mesh& mesh);

/// Sets the vertex colour of every point that has none yet.
void tint(shading::Mesh& mesh, const std::function<glm::vec3(glm::vec3 position, glm::vec3 normal)>& color);

}  // namespace rawtexel::scenes
