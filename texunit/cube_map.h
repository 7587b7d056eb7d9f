// How the faces of a cube map hang together: D3D and Vulkan face order and orientation (Vulkan "Cube Map Face Selection").
#pragma once

#include <array>
#include <cstdint>

namespace rawtexel::texunit {

/// Axes of a face in the space of directions: where its columns, its rows and it itself point.
struct CubeFace {
    std::array<int, 3> right, down, outward;
};
inline constexpr std::array<CubeFace, 6> kCubeFaces = {{{{0, 0, -1}, {0, -1, 0}, {1, 0, 0}},
                                                        {{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}},
                                                        {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                                        {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                                        {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
                                                        {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}}};

/// What lies beyond an edge of a face: the other face, and which way round. A texel `depth` texels beyond the edge (0 touches it), at
/// `along` counted along the edge, has there the column x_is_depth ? depth : along and the row x_is_depth ? along : depth, each counted
/// from the far side where it is flipped.
struct CubeEdge {
    int face;
    bool x_is_depth, flip_x, flip_y;

    static constexpr int kFaceBits = 7, kDepthBit = 8, kFlipXBit = 16, kFlipYBit = 32;
    constexpr int32_t packed() const { return face | (x_is_depth ? kDepthBit : 0) | (flip_x ? kFlipXBit : 0) | (flip_y ? kFlipYBit : 0); }
};

/// Edges of a face: 0 left, 1 right, 2 top, 3 bottom.
constexpr CubeEdge cube_edge(int face, int edge) {
    const auto dot = [](const std::array<int, 3>& a, const std::array<int, 3>& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    const CubeFace& here = kCubeFaces[size_t(face)];
    const std::array<int, 3>& across = edge < 2 ? here.right : here.down;
    const std::array<int, 3>& along = edge < 2 ? here.down : here.right;
    CubeEdge beyond{};
    while (dot(kCubeFaces[size_t(beyond.face)].outward, across) != (edge % 2 == 0 ? -1 : 1)) ++beyond.face;
    // Deeper into the other face is away from where this one looks.
    const CubeFace& there = kCubeFaces[size_t(beyond.face)];
    beyond.x_is_depth = dot(there.right, here.outward) != 0;
    beyond.flip_x = dot(there.right, here.outward) > 0 || dot(there.right, along) < 0;
    beyond.flip_y = dot(there.down, here.outward) > 0 || dot(there.down, along) < 0;
    return beyond;
}

/// cube_edge(face, edge).packed() at 4*face + edge.
inline constexpr std::array<int32_t, 24> kCubeEdges = [] {
    std::array<int32_t, 24> edges{};
    for (int face = 0; face < 6; ++face) {
        for (int edge = 0; edge < 4; ++edge) edges[size_t(4 * face + edge)] = cube_edge(face, edge).packed();
    }
    return edges;
}();

}  // namespace rawtexel::texunit
