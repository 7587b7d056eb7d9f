// Barycentrics of compact triangles, each lane its own: edge functions in 32 bits, exact, and single precision from there.
#if defined(RAWTEXEL_RASTER_COMPACT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_RASTER_COMPACT_INL_H
#undef RAWTEXEL_RASTER_COMPACT_INL_H
#else
#define RAWTEXEL_RASTER_COMPACT_INL_H
#endif

#include "raster/sample_lanes-inl.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::raster {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Some lanes' triangles: positions in the order of coverage, 1/256 pixel, and what stands at them.
struct CompactTriangles {
    LaneInts x[3], y[3];
    LaneFloats inverse_w[3];
    LaneInts kind;  ///< byte k: the primitive's corner at position k; byte 3: whether the triangle is compact
};

/// What a lane reads of its triangle, as records of four words.
class CompactRecords {
  public:
    HWY_INLINE void set(int lane, const SetupTriangle& triangle) {
        const auto* const bytes = reinterpret_cast<const uint8_t*>(&triangle);
        static_assert(offsetof(SetupTriangle, y) == offsetof(SetupTriangle, x) + 12);
        std::memcpy(positions_ + 4 * lane, bytes + offsetof(SetupTriangle, x), 16);
        std::memcpy(more_positions_ + 4 * lane, bytes + offsetof(SetupTriangle, x) + 8, 16);
        static_assert(offsetof(SetupTriangle, corner) == offsetof(SetupTriangle, rounded_inverse_w) + 12);
        static_assert(offsetof(SetupTriangle, compact) == offsetof(SetupTriangle, corner) + 3);
        std::memcpy(shapes_ + 4 * lane, bytes + offsetof(SetupTriangle, rounded_inverse_w), 16);
    }
    HWY_INLINE CompactTriangles at(size_t lane) const {
        const LaneIntTag di;
        const LaneFloatTag df;
        CompactTriangles t;
        LaneInts again_x, again_y, w[3];
        hn::LoadInterleaved4(di, positions_ + 4 * lane, t.x[0], t.x[1], t.x[2], t.y[0]);
        hn::LoadInterleaved4(di, more_positions_ + 4 * lane, again_x, again_y, t.y[1], t.y[2]);
        hn::LoadInterleaved4(di, shapes_ + 4 * lane, w[0], w[1], w[2], t.kind);
        for (int i = 0; i < 3; ++i) t.inverse_w[i] = hn::BitCast(df, w[i]);
        return t;
    }

  private:
    alignas(64) int32_t positions_[4 * 32], more_positions_[4 * 32], shapes_[4 * 32];
};

/// All lanes see the same triangle.
class CompactTriangle {
  public:
    explicit CompactTriangle(const SetupTriangle& triangle) : triangle_(triangle) {}
    HWY_INLINE CompactTriangles at(size_t) const {
        const LaneIntTag di;
        int32_t kind;
        std::memcpy(&kind, triangle_.corner, 4);
        CompactTriangles t;
        for (int i = 0; i < 3; ++i) {
            t.x[i] = hn::Set(di, triangle_.x[i]);
            t.y[i] = hn::Set(di, triangle_.y[i]);
            t.inverse_w[i] = hn::Set(LaneFloatTag(), triangle_.rounded_inverse_w[i]);
        }
        t.kind = hn::Set(di, kind);
        return t;
    }

  private:
    const SetupTriangle& triangle_;
};

/// Lanes [lane, lane + Lanes) at points in 1/512 pixel. Sums of three go by position, so that they do not depend on how the primitive
/// names its corners.
HWY_INLINE void compact_lanes(const CompactTriangles& triangle, LaneInts point_x, LaneInts point_y, size_t lane, BarycentricWave& out) {
    const LaneIntTag di;
    const LaneFloatTag df;
    static_assert(kSampleOne == 2 * kSubpixelOne);
    LaneInts from_x[3], from_y[3];  // from the corners to the points
    for (int i = 0; i < 3; ++i) {
        from_x[i] = hn::Sub(point_x, hn::ShiftLeft<1>(triangle.x[i]));
        from_y[i] = hn::Sub(point_y, hn::ShiftLeft<1>(triangle.y[i]));
    }
    LaneFloats over_w[3], slope_x[3], slope_y[3];  // of b/w, slopes per 1/512 pixel
    for (int i = 0; i < 3; ++i) {
        const int j = i == 2 ? 0 : i + 1, k = j == 2 ? 0 : j + 1;
        const LaneInts dx = hn::Sub(triangle.x[k], triangle.x[j]), dy = hn::Sub(triangle.y[j], triangle.y[k]);
        const LaneInts edge = hn::Add(hn::Mul(dx, from_y[j]), hn::Mul(dy, from_x[j]));
        over_w[i] = hn::Mul(hn::ConvertTo(df, edge), triangle.inverse_w[i]);
        slope_x[i] = hn::Mul(hn::ConvertTo(df, dy), triangle.inverse_w[i]);
        slope_y[i] = hn::Mul(hn::ConvertTo(df, dx), triangle.inverse_w[i]);
    }
    const auto sum = [](const LaneFloats(&v)[3]) HWY_ATTR { return hn::Add(hn::Add(v[0], v[1]), v[2]); };
    const LaneFloats w = hn::Div(hn::Set(df, 1.0f), sum(over_w)), w_per_pixel = hn::Mul(w, hn::Set(df, float(kSampleOne)));
    const LaneFloats sum_x = sum(slope_x), sum_y = sum(slope_y);
    const auto write = [&](int corner, float* b, float* b_dx, float* b_dy) HWY_ATTR {
        const auto is_at = [&](int position)
                               HWY_ATTR { return hn::RebindMask(df, hn::TestBit(triangle.kind, hn::Set(di, corner << 8 * position))); };
        const auto first = is_at(0), second = is_at(1);
        const auto pick = [&](const LaneFloats(&v)[3]) HWY_ATTR { return hn::IfThenElse(first, v[0], hn::IfThenElse(second, v[1], v[2])); };
        const LaneFloats weight = hn::Mul(pick(over_w), w);
        hn::Store(weight, df, b + lane);
        hn::Store(hn::Mul(hn::Sub(pick(slope_x), hn::Mul(weight, sum_x)), w_per_pixel), df, b_dx + lane);
        hn::Store(hn::Mul(hn::Sub(pick(slope_y), hn::Mul(weight, sum_y)), w_per_pixel), df, b_dy + lane);
    };
    write(1, out.b1, out.db1_dx, out.db1_dy);
    write(2, out.b2, out.db2_dx, out.db2_dy);
}

/// All lanes, whatever their triangles; those of other triangles than compact ones get numbers that mean nothing. Returns the lanes of
/// compact ones.
template <class Triangles>
HWY_INLINE uint32_t compact_wave(const Triangles& triangles, const BlockPoints& points, BarycentricWave& out) {
    uint32_t compact = 0;
    for (size_t lane = 0; lane < 32; lane += hn::Lanes(LaneIntTag())) {
        const CompactTriangles some = triangles.at(lane);
        LaneInts x, y;
        sample_points(points, lane, x, y);
        compact_lanes(some, x, y, lane, out);
        compact |= lane_bits(LaneIntTag(), hn::TestBit(some.kind, hn::Set(LaneIntTag(), 1 << 24))) << lane;
    }
    return compact;
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::raster
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_RASTER_COMPACT_INL_H
