// A wave's 32 lanes, some at a time: their sample points, and masks of them.
#if defined(RAWTEXEL_RASTER_SAMPLE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_RASTER_SAMPLE_LANES_INL_H
#undef RAWTEXEL_RASTER_SAMPLE_LANES_INL_H
#else
#define RAWTEXEL_RASTER_SAMPLE_LANES_INL_H
#endif

#include "raster/interpolate.h"
#include "raster/lanes-inl.h"

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::raster {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using LaneIntTag = hn::CappedTag<int32_t, 32>;
using LaneFloatTag = hn::Rebind<float, LaneIntTag>;
using LaneInts = hn::Vec<LaneIntTag>;
using LaneFloats = hn::Vec<LaneFloatTag>;

/// The points of lanes [lane, lane + Lanes), 1/512 pixel, of the frame, or from (origin_x, origin_y), pixels.
HWY_INLINE void sample_points(const BlockPoints& points, size_t lane, LaneInts& x, LaneInts& y, int origin_x = 0, int origin_y = 0) {
    const LaneIntTag d;
    static_assert(sizeof(SampleOffset) == 2 * sizeof(int32_t) && kBlockWidth == 8 && kSampleOne == 512);
    LaneInts offset_x, offset_y;
    if (points.same_offset) {
        offset_x = hn::Set(d, points.offset[0].x);
        offset_y = hn::Set(d, points.offset[0].y);
    } else {
        hn::LoadInterleaved2(d, &points.offset[lane].x, offset_x, offset_y);
    }
    const LaneInts number = numbers_from(d, int32_t(lane));
    const LaneInts column = hn::And(number, hn::Set(d, kBlockWidth - 1)), row = hn::ShiftRight<3>(number);
    x = hn::Add(hn::ShiftLeft<kSampleBits>(hn::Add(column, hn::Set(d, points.x - origin_x))), offset_x);
    y = hn::Add(hn::ShiftLeft<kSampleBits>(hn::Add(row, hn::Set(d, points.y - origin_y))), offset_y);
}

/// Lanes whose triangle is `index`.
HWY_INLINE uint32_t lanes_of_triangle(const uint32_t* setup_index, uint32_t index) {
    const hn::RebindToUnsigned<LaneIntTag> d;
    uint32_t lanes = 0;
    for (size_t lane = 0; lane < 32; lane += hn::Lanes(d))
        lanes |= lane_bits(d, hn::Eq(hn::LoadU(d, setup_index + lane), hn::Set(d, index))) << lane;
    return lanes;
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::raster
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_RASTER_SAMPLE_LANES_INL_H
