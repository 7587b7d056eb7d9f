// Barycentrics of 32 lanes at once.
#if defined(RAWTEXEL_RASTER_INTERPOLATE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_RASTER_INTERPOLATE_INL_H
#undef RAWTEXEL_RASTER_INTERPOLATE_INL_H
#else
#define RAWTEXEL_RASTER_INTERPOLATE_INL_H
#endif

#include "raster/anchor-inl.h"
#include "raster/compact-inl.h"

#include <bit>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::raster {
namespace HWY_NAMESPACE {

/// Every lane of `mask` by its own triangle. What a lane gets depends on its triangle and its pixel alone.
HWY_INLINE void barycentrics_by_lane(const Frame& frame, const uint32_t* setup_index, const BlockPoints& points, uint32_t mask,
                                     LatestAnchors& latest, BarycentricWave& out) {
    CompactRecords records;
    // Lanes without a triangle repeat what another lane has, so that no lane computes with garbage.
    const uint32_t spare = setup_index[std::countr_zero(mask)];
    for (int lane = 0; lane < 32; ++lane) records.set(lane, frame.triangle(mask >> lane & 1u ? setup_index[lane] : spare));
    for (uint32_t others = mask & ~compact_wave(records, points, out); others != 0;) {
        const uint32_t index = setup_index[std::countr_zero(others)];
        anchored_wave(latest.of(index, points.x, points.y), points, setup_index, index, out);
        others &= ~lanes_of_triangle(setup_index, index);
    }
}

/// Zeroes the lanes outside the mask.
HWY_INLINE void clear_other_lanes(uint32_t mask, BarycentricWave& out) {
    for (uint32_t others = ~mask; others != 0; others &= others - 1) {
        const int lane = std::countr_zero(others);
        for (float* values : {out.b1, out.b2, out.db1_dx, out.db2_dx, out.db1_dy, out.db2_dy}) values[lane] = 0.0f;
    }
}

/// Barycentrics of the lanes of `mask` at the block's points, lane i in setup triangle setup_index[i]. Lanes outside the mask are left
/// zero. `latest`: of this frame.
HWY_ATTR inline void barycentric_wave(const Frame& frame, const uint32_t* setup_index, const BlockPoints& points, uint32_t mask,
                                      LatestAnchors& latest, BarycentricWave& out) {
    if (mask == 0) {
        out = {};
        return;
    }
    const uint32_t first = setup_index[std::countr_zero(mask)];
    if (!points.same_triangle && (~lanes_of_triangle(setup_index, first) & mask) != 0) {
        barycentrics_by_lane(frame, setup_index, points, mask, latest, out);
    } else if (frame.triangle(first).compact) {
        compact_wave(CompactTriangle(frame.triangle(first)), points, out);
    } else {
        anchored_wave(latest.of(first, points.x, points.y), points, out);
    }
    if (mask != 0xFFFFFFFFu) clear_other_lanes(mask, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::raster
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_RASTER_INTERPOLATE_INL_H
