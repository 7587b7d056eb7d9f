#include "raster/screen_vertex.h"

#include <algorithm>
#include <cmath>

namespace rawtexel::raster {

namespace {

constexpr double kSnappedLimit = double(kGuardBand) * kSubpixelOne;

int32_t snap_coordinate(double pixels) {
    // Clipping ends a hair's breadth beside the guard band; the clamp makes the integer budget of edge.h exact.
    return int32_t(std::clamp(std::nearbyint(pixels * kSubpixelOne), -kSnappedLimit, kSnappedLimit));
}

}  // namespace

SnappedPosition snap(const ScreenVertex& v) { return {snap_coordinate(v.x / v.w), snap_coordinate(v.y / v.w)}; }

VertexTransform::VertexTransform(const Draw& draw, const FrameOptions& options)
    : positions_(draw.positions), half_width_(0.5 * options.width), half_height_(0.5 * options.height) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) matrix_[column][row] = double(draw.clip_from_object[column][row]);
    }
}

ScreenVertex VertexTransform::operator()(uint32_t vertex) const {
    const glm::vec3& p = positions_[vertex];
    const double px = double(p.x), py = double(p.y), pz = double(p.z);
    const auto row = [&](int r) { return ((matrix_[0][r] * px + matrix_[1][r] * py) + matrix_[2][r] * pz) + matrix_[3][r]; };
    const double x = row(0), y = row(1), z = row(2), w = row(3);
    return {(w + x) * half_width_, (w - y) * half_height_, z, w};
}

VertexCache::VertexCache(const VertexTransform& transform) : transform_(transform) {
    // No vertex fits the slot that its own number does not select.
    for (uint32_t slot = 0; slot < kSlots; ++slot) vertex_[slot] = slot + 1;
}

const ScreenVertex& VertexCache::operator[](uint32_t vertex) {
    const uint32_t slot = vertex % kSlots;
    if (vertex_[slot] != vertex) {
        vertex_[slot] = vertex;
        value_[slot] = transform_(vertex);
    }
    return value_[slot];
}

}  // namespace rawtexel::raster
