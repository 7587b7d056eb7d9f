#include "raster/clip.h"

namespace rawtexel::raster {

namespace {

// Far below what a product of two floats reaches (2^-298), far above what divides into infinity.
constexpr double kSmallestW = 0x1p-320;

/// Where the plane cuts the edge. Both weights are positive and each is good to its last bits, so an end point at 1e30 pixels does not
/// drown the other one, as it would in p + t*(q - p). What the plane itself says of the point is taken from it: the sum of two huge
/// coordinates would miss the guard band by thousands of pixels, and what lies between two such points would cross the frame.
ScreenVertex cut(ClipPlane plane, const ScreenVertex& p, const ScreenVertex& q, double p_distance, double q_distance) {
    const double p_weight = q_distance / (q_distance - p_distance), q_weight = p_distance / (p_distance - q_distance);
    ScreenVertex v{p_weight * p.x + q_weight * q.x, p_weight * p.y + q_weight * q.y, p_weight * p.z + q_weight * q.z,
                   p_weight * p.w + q_weight * q.w};
    constexpr double guard = kGuardBand;
    switch (plane) {
        case ClipPlane::Near: v.z = v.w; break;
        case ClipPlane::Far: v.z = 0.0; break;
        case ClipPlane::PositiveW: v.w = kSmallestW; break;
        case ClipPlane::Left: v.x = -guard * v.w; break;
        case ClipPlane::Right: v.x = guard * v.w; break;
        case ClipPlane::Top: v.y = -guard * v.w; break;
        case ClipPlane::Bottom: v.y = guard * v.w; break;
    }
    return v;
}

}  // namespace

double distance(ClipPlane plane, const ScreenVertex& v) {
    constexpr double guard = kGuardBand;
    switch (plane) {
        case ClipPlane::Near: return v.w - v.z;
        case ClipPlane::Far: return v.z;
        case ClipPlane::PositiveW: return v.w - kSmallestW;
        case ClipPlane::Left: return guard * v.w + v.x;
        case ClipPlane::Right: return guard * v.w - v.x;
        case ClipPlane::Top: return guard * v.w + v.y;
        case ClipPlane::Bottom: return guard * v.w - v.y;
    }
    return 0.0;
}

uint32_t outside_planes(const ScreenVertex& v) {
    uint32_t planes = 0;
    for (int plane = 0; plane < kClipPlanes; ++plane) {
        planes |= uint32_t{distance(ClipPlane(plane), v) < 0.0} << plane;
    }
    return planes;
}

ClipPolygon::ClipPolygon(const std::array<ScreenVertex, 3>& triangle) {
    for (const ScreenVertex& v : triangle) push(v);
}

void ClipPolygon::clip(uint32_t planes) {
    for (int plane = 0; plane < kClipPlanes && count_ > 0; ++plane) {
        if (planes >> plane & 1u) clip_by(ClipPlane(plane));
    }
    if (count_ < 3) count_ = 0;
}

void ClipPolygon::clip_by(ClipPlane plane) {
    const std::array<ScreenVertex, kCapacity> vertex = vertex_;
    const int count = count_;
    count_ = 0;
    for (int i = 0; i < count; ++i) {
        const ScreenVertex& p = vertex[size_t(i)];
        const ScreenVertex& q = vertex[size_t(i + 1 == count ? 0 : i + 1)];
        const double p_distance = distance(plane, p), q_distance = distance(plane, q);
        if (p_distance >= 0.0) push(p);
        if ((p_distance >= 0.0) != (q_distance >= 0.0)) push(cut(plane, p, q, p_distance, q_distance));
    }
}

}  // namespace rawtexel::raster
