// Coverage of 8x4 waves of sample points by one triangle, exact; edge.h has the edge functions.
#if defined(RAWTEXEL_RASTER_COVERAGE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_RASTER_COVERAGE_INL_H
#undef RAWTEXEL_RASTER_COVERAGE_INL_H
#else
#define RAWTEXEL_RASTER_COVERAGE_INL_H
#endif

#include "raster/edge.h"
#include "raster/lanes-inl.h"
#include "raster/tile_grid.h"
#include "raster/visibility.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::raster {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// No vector is wider than a block's row of 8 pixels. Doubles set the pace of all that reaches depth; coverage alone runs in int32.
using RowInts = hn::CappedTag<int32_t, kBlockWidth>;
using RowDoubles = hn::CappedTag<double, kBlockWidth>;
using DepthFloats = hn::Rebind<float, RowDoubles>;
using DepthInts = hn::Rebind<int32_t, RowDoubles>;

inline constexpr int kHiZWidth = TileVisibility::kBlockSide;  // a Hi-Z block is two waves, one above the other
static_assert(kHiZWidth == kBlockWidth && kHiZWidth == 2 * kBlockHeight);
inline constexpr int kBlockLanes = kBlockWidth * kBlockHeight;

/// One bit per lane, of vectors of at most 8 lanes.
template <class D, class M>
HWY_INLINE uint32_t bits_of(D d, M mask) {
    uint8_t bits[8];
    hn::StoreMaskBits(d, mask, bits);
    return bits[0] & ((1u << hn::Lanes(d)) - 1);
}

/// From the lowest bits.
template <class D>
HWY_INLINE hn::Mask<D> mask_of(D d, uint32_t bits) {
    const uint8_t bytes[8] = {uint8_t(bits & 0xFFu)};
    return hn::LoadMaskBits(d, bytes);
}

/// Everything about the tile and this pass's sample points that no triangle changes.
struct TilePass {
    TilePass(const Frame& frame, int tile_x, int tile_y, const TileSamples& samples_)
        : samples(samples_),
          size(frame.options().tile_size),
          x(tile_x * size),
          y(tile_y * size),
          width(std::min(size, frame.options().width - x)),
          height(std::min(size, frame.options().height - y)) {
        std::fill_n(frame_offset, kBlockLanes, samples.frame);
        frame_x = double(samples.frame.x) / kSampleOne;
        frame_y = double(samples.frame.y) / kSampleOne;
        offset_box = {samples.frame.x, samples.frame.x, samples.frame.y, samples.frame.y};
        if (samples.per_pixel != nullptr) measure_offsets();
#ifndef NDEBUG
        const TileGrid grid(frame.options());
        assert(offset_box.x_min >= grid.reach().x_min && offset_box.x_max <= grid.reach().x_max);
        assert(offset_box.y_min >= grid.reach().y_min && offset_box.y_max <= grid.reach().y_max);
#endif
    }

    void measure_offsets() {
        SampleOffset least = samples.per_pixel[0], greatest = least;
        for (int row = 0; row < height; ++row) {
            const SampleOffset* const offset = samples.per_pixel + row * size;
            for (int column = 0; column < width; ++column) {
                least = {std::min(least.x, offset[column].x), std::min(least.y, offset[column].y)};
                greatest = {std::max(greatest.x, offset[column].x), std::max(greatest.y, offset[column].y)};
            }
        }
        offset_box = {least.x, greatest.x, least.y, greatest.y};
    }

    /// The tile lies inside the frame.
    bool whole() const { return width == size && height == size; }

    /// Lanes of the wave at (column, row) of the tile that lie inside the frame.
    uint32_t lanes_inside(int column, int row) const {
        const int columns = std::min(width - column, kBlockWidth), rows = std::min(height - row, kBlockHeight);
        if (columns <= 0 || rows <= 0) return 0;
        const uint32_t in_row = (1u << columns) - 1;
        return uint32_t((uint64_t{in_row * 0x01010101u}) & ((uint64_t{1} << (rows * kBlockWidth)) - 1));
    }

    /// Sample offsets by lane of the wave at (column, row).
    const SampleOffset* offsets(int column, int row, SampleOffset (&storage)[kBlockLanes]) const {
        if (samples.per_pixel == nullptr) return frame_offset;
        for (int r = 0; r < kBlockHeight; ++r) {
            std::copy_n(samples.per_pixel + (row + r) * size + column, kBlockWidth, storage + r * kBlockWidth);
        }
        return storage;
    }

    TileSamples samples;
    int size, x, y, width, height;  // pixels; width and height of the part inside the frame
    SampleBox offset_box;           // of all offsets in use
    double frame_x, frame_y;        // samples.frame in pixels
    SampleOffset frame_offset[kBlockLanes];
};

/// One edge of a triangle inside one tile.
struct TileEdge {
    TileEdge() = default;
    TileEdge(const Edge& edge, const TilePass& pass) : dx(edge.dx), dy(edge.dy) {
        at_tile = edge.at(int64_t{pass.x} * kSampleOne, int64_t{pass.y} * kSampleOne);
        constexpr int64_t last_pixel = (kHiZWidth - 1) * kSampleOne;
        const SampleBox block{pass.offset_box.x_min, last_pixel + pass.offset_box.x_max, pass.offset_box.y_min,
                              last_pixel + pass.offset_box.y_max};
        greatest = greatest_over(edge, block);
        smallest = smallest_over(edge, block);
    }
    /// Value at the upper left corner of the pixel (column, row) of the tile.
    int64_t at(int column, int row) const { return at_tile + (int64_t{dx} * row - int64_t{dy} * column) * kSampleOne; }

    int32_t dx, dy;
    int64_t at_tile;             // at the tile's upper left corner
    int64_t greatest, smallest;  // what the samples of an 8x8 block can differ by from the value at its upper left corner
};

/// Coverage of the waves of one triangle: bit per lane.
class TriangleCoverage {
  public:
    TriangleCoverage(const SetupTriangle& triangle, const TilePass& pass) : pass_(pass) {
        const RowInts d;
        for (int e = 0; e < 3; ++e) {
            edge_[e] = TileEdge(edge_of(triangle, e), pass);
            frame_term_[e] = int64_t{edge_[e].dx} * pass.samples.frame.y - int64_t{edge_[e].dy} * pass.samples.frame.x;
            for (size_t i = 0; i < kBlockWidth; i += hn::Lanes(d)) {
                hn::Store(hn::Mul(numbers_from(d, int32_t(i)), hn::Set(d, -edge_[e].dy)), d, column_step_[e] + i);
            }
        }
    }

    /// Whether the 8x8 block may hold a covered sample; if so, readies the edges that cross it.
    bool enter_block(int column, int row) {
        crossing_ = 0;
        for (int e = 0; e < 3; ++e) {
            const int64_t value = edge_[e].at(column, row);
            if (value + edge_[e].greatest < 0) return false;
            if (value + edge_[e].smallest < 0) crossing_ |= 1u << e;
        }
        return true;
    }

    /// Whether all samples of the block entered last are covered.
    bool fills_block() const { return crossing_ == 0; }

    /// Covered lanes of the wave at (column, row), in the block entered last.
    uint32_t wave(int column, int row) const {
        if (crossing_ == 0) return 0xFFFFFFFFu;
        return pass_.samples.per_pixel == nullptr ? wave_of_frame_offset(column, row) : wave_of_pixel_offsets(column, row);
    }

  private:
    /// All samples of the tile lie on one lattice of pitch 512, so e >= 0 holds exactly where floor(e/512) >= 0, and that floor moves by
    /// whole dx and dy from pixel to pixel. An edge that crosses an 8x8 block is zero somewhere between its samples: within the block
    /// |floor(e/512)| <= 7*(|dx| + |dy|) + 1 < 2^28, and int32 is safe.
    HWY_INLINE uint32_t wave_of_frame_offset(int column, int row) const {
        const RowInts d;
        int32_t first[3];
        for (int e = 0; e < 3; ++e) first[e] = int32_t((edge_[e].at(column, row) + frame_term_[e]) >> kSampleBits);
        uint32_t missed = 0;
        for (int r = 0; r < kBlockHeight; ++r) {
            for (size_t i = 0; i < kBlockWidth; i += hn::Lanes(d)) {
                auto outside = hn::Zero(d);
                for (int e = 0; e < 3; ++e) {
                    if ((crossing_ >> e & 1u) == 0) continue;
                    outside = hn::Or(outside, hn::Add(hn::Set(d, first[e] + r * edge_[e].dx), hn::Load(d, column_step_[e] + i)));
                }
                missed |= bits_of(d, hn::Lt(outside, hn::Zero(d))) << (size_t(r) * kBlockWidth + i);
            }
        }
        return ~missed;
    }

    /// Every pixel has its own offset. All terms are integers below 2^53, so doubles are exact.
    HWY_INLINE uint32_t wave_of_pixel_offsets(int column, int row) const {
        const RowDoubles d;
        const DepthInts di;
        uint32_t covered = 0;
        for (int r = 0; r < kBlockHeight; ++r) {
            const SampleOffset* const offsets = pass_.samples.per_pixel + (row + r) * pass_.size + column;
            for (size_t i = 0; i < kBlockWidth; i += hn::Lanes(d)) {
                hn::Vec<DepthInts> offset_x, offset_y;
                hn::LoadInterleaved2(di, &offsets[i].x, offset_x, offset_y);
                const auto pixel_x = hn::Mul(numbers_from(d, double(i)), hn::Set(d, double(kSampleOne)));
                const auto x = hn::Add(hn::PromoteTo(d, offset_x), pixel_x), y = hn::PromoteTo(d, offset_y);
                auto inside = hn::Ge(x, x);
                for (int e = 0; e < 3; ++e) {
                    if ((crossing_ >> e & 1u) == 0) continue;
                    const auto step = hn::Sub(hn::Mul(y, hn::Set(d, double(edge_[e].dx))), hn::Mul(x, hn::Set(d, double(edge_[e].dy))));
                    const auto value = hn::Add(hn::Set(d, double(edge_[e].at(column, row + r))), step);
                    inside = hn::And(inside, hn::Ge(value, hn::Zero(d)));
                }
                covered |= bits_of(d, inside) << (size_t(r) * kBlockWidth + i);
            }
        }
        return covered;
    }

    const TilePass& pass_;
    TileEdge edge_[3];
    int64_t frame_term_[3];  // what the frame's sample offset adds to each edge
    unsigned crossing_ = 0;  // edges that the samples of the block lie on both sides of, one bit each
    alignas(64) int32_t column_step_[3][kBlockWidth];
};

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::raster
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_RASTER_COVERAGE_INL_H
