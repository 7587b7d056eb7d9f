// Coverage of triangles no larger than 32 pixels, in 32-bit integers throughout.
#if defined(RAWTEXEL_RASTER_SMALL_TRIANGLE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_RASTER_SMALL_TRIANGLE_INL_H
#undef RAWTEXEL_RASTER_SMALL_TRIANGLE_INL_H
#else
#define RAWTEXEL_RASTER_SMALL_TRIANGLE_INL_H
#endif

#include "raster/coverage-inl.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::raster {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Coverage of waves that hold a pixel with a sample point inside the triangle's box.
class SmallTriangle {
  public:
    /// |dx|, |dy| <= kExtent of every edge. A sample of such a wave lies no farther from a vertex than the triangle is wide, the wave is
    /// wide and two pixels' offsets reach: the difference of an edge function's two terms fits 32 bits.
    static constexpr int32_t kExtent = 32 * kSubpixelOne;
    static_assert(int64_t{kExtent} * (32 + kBlockWidth + 2 * kMostFilterRadius) * kSampleOne * 2 < int64_t{1} << 31);

    /// Whether the triangle covers a sample point as near to it, 1/512 pixel.
    static HWY_INLINE bool covers(const SetupTriangle& t, int32_t x, int32_t y) {
        const auto edge = [&](int i, int j) HWY_ATTR {
            const int32_t dx = t.x[j] - t.x[i], dy = t.y[j] - t.y[i];
            return dx * (y - 2 * t.y[i]) - dy * (x - 2 * t.x[i]) - int32_t{!is_top_left(dx, dy)};
        };
        return (edge(0, 1) | edge(1, 2) | edge(2, 0)) >= 0;
    }

    SmallTriangle(const SetupTriangle& t, const TilePass& pass) : pass_(pass) {
        for (int i = 0; i < 3; ++i) {
            const int j = i == 2 ? 0 : i + 1;
            dx_[i] = t.x[j] - t.x[i];
            dy_[i] = t.y[j] - t.y[i];
            x_[i] = 2 * t.x[i] - pass.x * kSampleOne;
            y_[i] = 2 * t.y[i] - pass.y * kSampleOne;
            bias_[i] = is_top_left(dx_[i], dy_[i]) ? 0 : 1;
        }
    }

    /// Calls visit(row, covered pixels) for the rows [first, last] of the tile; bit 0 is the pixel at `column`, eight of them.
    template <class Visit>
    HWY_INLINE void for_each_row(int column, int first, int last, Visit&& visit) const {
        const RowInts d;
        if (hn::Lanes(d) == kBlockWidth && pass_.samples.per_pixel == nullptr) {
            const int32_t x = column * kSampleOne + pass_.samples.frame.x, y = first * kSampleOne + pass_.samples.frame.y;
            auto e0 = edge_lanes(0, 0, x, y), e1 = edge_lanes(1, 0, x, y), e2 = edge_lanes(2, 0, x, y);
            const auto dx0 = hn::Set(d, dx_[0]), dx1 = hn::Set(d, dx_[1]), dx2 = hn::Set(d, dx_[2]);
            for (int row = first; row <= last; ++row) {
                visit(row, inside(hn::Or(hn::Or(e0, e1), e2)));
                e0 = hn::Add(e0, dx0);
                e1 = hn::Add(e1, dx1);
                e2 = hn::Add(e2, dx2);
            }
            return;
        }
        for (int row = first; row <= last; row += kBlockHeight) {
            const int count = std::min(last - row + 1, kBlockHeight);
            const uint32_t rows = wave(column, row, 0, count);
            for (int r = 0; r < count; ++r) visit(row + r, rows >> (r * kBlockWidth) & 0xFFu);
        }
    }

    /// Covered lanes of rows [begin, end) of the wave at (column, row) of the tile.
    HWY_INLINE uint32_t wave(int column, int row, int begin, int end) const {
        return pass_.samples.per_pixel == nullptr ? wave_of_frame_offset(column, row, begin, end)
                                                  : wave_of_pixel_offsets(column, row, begin, end);
    }

  private:
    /// Lanes that are not negative.
    static HWY_INLINE uint32_t inside(hn::Vec<RowInts> edges) {
        const RowInts d;
        return bits_of(d, hn::Lt(edges, hn::Zero(d))) ^ ((1u << hn::Lanes(d)) - 1);
    }

    /// As TriangleCoverage::wave_of_frame_offset: floor(e/512), which moves by dx and dy from pixel to pixel. Of the pixels `i` and on of a
    /// row whose first sample is (x, y).
    HWY_INLINE hn::Vec<RowInts> edge_lanes(int e, size_t i, int32_t x, int32_t y) const {
        const RowInts d;
        const int32_t first = (dx_[e] * (y - y_[e]) - dy_[e] * (x - x_[e]) - bias_[e]) >> kSampleBits;
        return hn::Sub(hn::Set(d, first), hn::Mul(numbers_from(d, int32_t(i)), hn::Set(d, dy_[e])));
    }

    HWY_INLINE uint32_t wave_of_frame_offset(int column, int row, int begin, int end) const {
        const RowInts d;
        const int32_t x = column * kSampleOne + pass_.samples.frame.x, y = (row + begin) * kSampleOne + pass_.samples.frame.y;
        uint32_t covered = 0;
        for (size_t i = 0; i < kBlockWidth; i += hn::Lanes(d)) {
            auto e0 = edge_lanes(0, i, x, y), e1 = edge_lanes(1, i, x, y), e2 = edge_lanes(2, i, x, y);
            const auto dx0 = hn::Set(d, dx_[0]), dx1 = hn::Set(d, dx_[1]), dx2 = hn::Set(d, dx_[2]);
            for (int r = begin; r < end; ++r) {
                covered |= inside(hn::Or(hn::Or(e0, e1), e2)) << (size_t(r) * kBlockWidth + i);
                e0 = hn::Add(e0, dx0);
                e1 = hn::Add(e1, dx1);
                e2 = hn::Add(e2, dx2);
            }
        }
        return covered;
    }

    HWY_INLINE uint32_t wave_of_pixel_offsets(int column, int row, int begin, int end) const {
        const RowInts d;
        uint32_t covered = 0;
        for (int r = begin; r < end; ++r) {
            const SampleOffset* const offsets = pass_.samples.per_pixel + (row + r) * pass_.size + column;
            for (size_t i = 0; i < kBlockWidth; i += hn::Lanes(d)) {
                hn::Vec<RowInts> x, y;
                hn::LoadInterleaved2(d, &offsets[i].x, x, y);
                x = hn::Add(x, hn::Mul(numbers_from(d, column + int32_t(i)), hn::Set(d, kSampleOne)));
                y = hn::Add(y, hn::Set(d, (row + r) * kSampleOne));
                const auto edge = [&](int e) HWY_ATTR {
                    const auto along_y = hn::Mul(hn::Set(d, dx_[e]), hn::Sub(y, hn::Set(d, y_[e])));
                    const auto along_x = hn::Mul(hn::Set(d, dy_[e]), hn::Sub(x, hn::Set(d, x_[e])));
                    return hn::Sub(hn::Sub(along_y, along_x), hn::Set(d, bias_[e]));
                };
                covered |= inside(hn::Or(hn::Or(edge(0), edge(1)), edge(2))) << (size_t(r) * kBlockWidth + i);
            }
        }
        return covered;
    }

    const TilePass& pass_;
    int32_t dx_[3], dy_[3], bias_[3];
    int32_t x_[3], y_[3];  // first vertices of the edges, 1/512 pixel from the tile's upper left corner
};

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::raster
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_RASTER_SMALL_TRIANGLE_INL_H
