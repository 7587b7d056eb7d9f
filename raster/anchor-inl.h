// Barycentrics of one triangle about its anchor (raster/anchor.h), in single precision.
#if defined(RAWTEXEL_RASTER_ANCHOR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_RASTER_ANCHOR_INL_H
#undef RAWTEXEL_RASTER_ANCHOR_INL_H
#else
#define RAWTEXEL_RASTER_ANCHOR_INL_H
#endif

#include "raster/anchor.h"
#include "raster/sample_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::raster {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Samples as near to the horizon as that have no weights to speak of: what they get is finite.
inline constexpr float kLeastAnchoredW = 0x1p-22f;

/// Some lanes of a BarycentricWave.
struct BarycentricLanes {
    LaneFloats b1, b2, db1_dx, db2_dx, db1_dy, db2_dy;
};

/// Lanes [lane, lane + Lanes).
HWY_INLINE BarycentricLanes anchored_lanes(const Anchor& anchor, const BlockPoints& points, size_t lane) {
    const LaneFloatTag d;
    LaneInts point_x, point_y;
    sample_points(points, lane, point_x, point_y, anchor.x, anchor.y);
    const LaneFloats to_pixels = hn::Set(d, 1.0f / kSampleOne);
    const LaneFloats x = hn::Mul(hn::ConvertTo(d, point_x), to_pixels), y = hn::Mul(hn::ConvertTo(d, point_y), to_pixels);
    const auto along = [&](float dx, float dy) HWY_ATTR { return hn::Add(hn::Mul(hn::Set(d, dx), x), hn::Mul(hn::Set(d, dy), y)); };
    const LaneFloats one = hn::Set(d, 1.0f);
    const LaneFloats w = hn::Div(one, hn::Max(hn::Add(one, along(anchor.w_dx, anchor.w_dy)), hn::Set(d, kLeastAnchoredW)));
    const auto find = [&](float b, float b_dx, float b_dy, LaneFloats& of, LaneFloats& of_dx, LaneFloats& of_dy) HWY_ATTR {
        const LaneFloats step = hn::Mul(along(b_dx, b_dy), w);
        // Quotient rule.
        const auto slope = [&](float own, float of_w)
                               HWY_ATTR { return hn::Mul(hn::Sub(hn::Set(d, own), hn::Mul(step, hn::Set(d, of_w))), w); };
        of = hn::Add(hn::Set(d, b), step);
        of_dx = slope(b_dx, anchor.w_dx);
        of_dy = slope(b_dy, anchor.w_dy);
    };
    BarycentricLanes lanes;
    find(anchor.b1, anchor.b1_dx, anchor.b1_dy, lanes.b1, lanes.db1_dx, lanes.db1_dy);
    find(anchor.b2, anchor.b2_dx, anchor.b2_dy, lanes.b2, lanes.db2_dx, lanes.db2_dy);
    return lanes;
}

/// Hands each number to store(value, where it goes).
template <class Store>
HWY_INLINE void store_barycentrics(const BarycentricLanes& lanes, size_t lane, BarycentricWave& out, const Store& store) {
    store(lanes.b1, out.b1 + lane);
    store(lanes.b2, out.b2 + lane);
    store(lanes.db1_dx, out.db1_dx + lane);
    store(lanes.db2_dx, out.db2_dx + lane);
    store(lanes.db1_dy, out.db1_dy + lane);
    store(lanes.db2_dy, out.db2_dy + lane);
}

/// All lanes.
HWY_INLINE void anchored_wave(const Anchor anchor, const BlockPoints& points, BarycentricWave& out) {
    const LaneFloatTag d;
    for (size_t lane = 0; lane < 32; lane += hn::Lanes(d))
        store_barycentrics(anchored_lanes(anchor, points, lane), lane, out,
                           [&](LaneFloats value, float* to) HWY_ATTR { hn::Store(value, d, to); });
}

/// The lanes whose triangle is `index`.
HWY_INLINE void anchored_wave(const Anchor anchor, const BlockPoints& points, const uint32_t* setup_index, uint32_t index,
                              BarycentricWave& out) {
    const LaneFloatTag d;
    const hn::RebindToUnsigned<LaneFloatTag> du;
    for (size_t lane = 0; lane < 32; lane += hn::Lanes(d)) {
        const auto own = hn::RebindMask(d, hn::Eq(hn::LoadU(du, setup_index + lane), hn::Set(du, index)));
        store_barycentrics(anchored_lanes(anchor, points, lane), lane, out,
                           [&](LaneFloats value, float* to) HWY_ATTR { hn::BlendedStore(value, own, d, to); });
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::raster
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_RASTER_ANCHOR_INL_H
