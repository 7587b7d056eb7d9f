// Visibility of one tile in vectors; the meaning stands in raster/visibility.h.
#if defined(RAWTEXEL_RASTER_VISIBILITY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_RASTER_VISIBILITY_INL_H
#undef RAWTEXEL_RASTER_VISIBILITY_INL_H
#else
#define RAWTEXEL_RASTER_VISIBILITY_INL_H
#endif

#include "raster/edge.h"
#include "raster/visibility.h"

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::raster {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// No vector is wider than a block's row of 8 pixels. Doubles set the pace of all that reaches depth; coverage alone runs in int32.
using RowInts = hn::CappedTag<int32_t, kBlockWidth>;
using RowDoubles = hn::CappedTag<double, kBlockWidth>;
using DepthFloats = hn::Rebind<float, RowDoubles>;
using DepthInts = hn::Rebind<int32_t, RowDoubles>;

inline constexpr int kHiZWidth = 8;             // pixels along a side of a Hi-Z block: two waves, one above the other
inline constexpr int kBlockLanes = kBlockWidth * kBlockHeight;

template <class D, class M>
HWY_INLINE uint32_t bits_of(D d, M mask) {
    uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, mask, bytes);
    uint32_t bits;
    std::memcpy(&bits, bytes, sizeof(bits));
    return bits & uint32_t((uint64_t{1} << hn::Lanes(d)) - 1);
}

template <class D>
HWY_INLINE hn::Mask<D> mask_of(D d, uint32_t bits) {
    uint8_t bytes[8] = {};
    std::memcpy(bytes, &bits, sizeof(bits));
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
        offset_box = {samples.frame.x, samples.frame.x, samples.frame.y, samples.frame.y};
        if (samples.per_pixel != nullptr) measure_offsets();
#ifndef NDEBUG
        const double reach = std::ceil(double(frame.options().filter_radius) * kSampleOne);
        assert(double(offset_box.x_min) >= kSampleOne / 2 - reach && double(offset_box.x_max) <= kSampleOne / 2 + reach);
        assert(double(offset_box.y_min) >= kSampleOne / 2 - reach && double(offset_box.y_max) <= kSampleOne / 2 + reach);
#endif
    }

    void measure_offsets() {
        const SampleOffset first = samples.per_pixel[0];
        offset_box = {first.x, first.x, first.y, first.y};
        for (int row = 0; row < height; ++row) {
            for (const SampleOffset* o = samples.per_pixel + row * size; o != samples.per_pixel + row * size + width; ++o) {
                offset_box.x_min = std::min(offset_box.x_min, int64_t{o->x});
                offset_box.x_max = std::max(offset_box.x_max, int64_t{o->x});
                offset_box.y_min = std::min(offset_box.y_min, int64_t{o->y});
                offset_box.y_max = std::max(offset_box.y_max, int64_t{o->y});
            }
        }
    }

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
    int size, x, y, width, height;           // pixels; width and height of the part inside the frame
    SampleBox offset_box;                    // of all offsets in use
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
    int64_t at_tile;                // at the tile's upper left corner
    int64_t greatest, smallest;     // what the samples of an 8x8 block can differ by from the value at its upper left corner
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
                hn::Store(hn::Mul(hn::Iota(d, int32_t(i)), hn::Set(d, -edge_[e].dy)), d, column_step_[e] + i);
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
                const auto pixel_x = hn::Mul(hn::Iota(d, double(i)), hn::Set(d, double(kSampleOne)));
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
    int64_t frame_term_[3];         // what the frame's sample offset adds to each edge
    unsigned crossing_ = 0;         // edges that the samples of the block lie on both sides of, one bit each
    alignas(64) int32_t column_step_[3][kBlockWidth];
};

/// The one formula for depth: a pure function of triangle and sample point. Every step is monotonic in x and in y.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V depth_at(D d, const SetupTriangle& triangle, V from_origin_x, V from_origin_y) {
    const V along = hn::Add(hn::Mul(hn::Set(d, triangle.depth_dx), from_origin_x), hn::Mul(hn::Set(d, triangle.depth_dy), from_origin_y));
    return hn::Add(hn::Set(d, triangle.depth_at_origin), along);
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE V clamp_depth(D d, const SetupTriangle& triangle, V depth) {
    return hn::Min(hn::Max(depth, hn::Set(d, triangle.depth_min)), hn::Set(d, triangle.depth_max));
}

/// Draws triangles into one tile.
class TileRasterizer {
  public:
    TileRasterizer(const Frame& frame, const TilePass& pass, TileVisibility& out)
        : frame_(frame), pass_(pass), out_(out), blocks_x_(pass.size / kHiZWidth) {}

    template <class Coverage>
    void draw(uint32_t setup_index, Coverage& coverage) {
        const SetupTriangle& triangle = frame_.triangle(setup_index);
        const SampleBox box = bounds_of(triangle);
        const SampleBox& reach = pass_.offset_box;
        // Pixels, counted from the tile's corner, with a sample point inside the triangle's box.
        const int first_x = std::max(first_pixel(box.x_min - reach.x_max) - pass_.x, 0);
        const int first_y = std::max(first_pixel(box.y_min - reach.y_max) - pass_.y, 0);
        const int last_x = std::min(last_pixel(box.x_max - reach.x_min) - pass_.x, pass_.width - 1);
        const int last_y = std::min(last_pixel(box.y_max - reach.y_min) - pass_.y, pass_.height - 1);
        if (first_x > last_x || first_y > last_y) return;
        TriangleCoverage covered(triangle, pass_);
        for (int row = first_y & -kHiZWidth; row <= last_y; row += kHiZWidth) {
            for (int column = first_x & -kHiZWidth; column <= last_x; column += kHiZWidth) {
                if (!covered.enter_block(column, row)) continue;
                if (hidden(triangle, column, row)) {
                    ++out_.hiz_rejected;
                    continue;
                }
                for (int half = row; half < std::min(row + kHiZWidth, pass_.height); half += kBlockHeight) {
                    const uint32_t mask = covered.wave(column, half) & pass_.lanes_inside(column, half);
                    if (mask != 0) draw_wave(triangle, setup_index, column, half, mask, coverage);
                }
            }
        }
    }

  private:
    struct WaveDepth {
        alignas(64) float depth[kBlockLanes];
        uint32_t nearer = 0, equal = 0;
    };

    static int first_pixel(int64_t sample) { return int((sample + kSampleOne - 1) >> kSampleBits); }
    static int last_pixel(int64_t sample) { return int(sample >> kSampleBits); }

    size_t entry(int column, int row) const { return size_t(row) * size_t(pass_.size) + size_t(column); }
    size_t block(int column, int row) const { return size_t(row / kHiZWidth) * size_t(blocks_x_) + size_t(column / kHiZWidth); }

    /// Distance in pixels from the triangle's first vertex to the corner of the tile's pixel (column, row); exact.
    double from_origin_x(const SetupTriangle& triangle, int column) const {
        return pass_.x + column - double(triangle.x[0]) / kSubpixelOne;
    }
    double from_origin_y(const SetupTriangle& triangle, int row) const { return pass_.y + row - double(triangle.y[0]) / kSubpixelOne; }

    /// Whether opaque geometry hides the triangle in all of the 8x8 block. As every step of the depth formula is monotonic, its value at the
    /// nearest corner of the samples' box is at least the value at every sample, to the last bit.
    bool hidden(const SetupTriangle& triangle, int column, int row) {
        const float farthest = farthest_in_block(column, row);
        if (farthest == 0.0f) return false;
        const SampleBox& reach = pass_.offset_box;
        const int64_t last = (kHiZWidth - 1) * kSampleOne;
        const double dx = double(triangle.depth_dx > 0.0 ? last + reach.x_max : reach.x_min) / kSampleOne;
        const double dy = double(triangle.depth_dy > 0.0 ? last + reach.y_max : reach.y_min) / kSampleOne;
        const hn::CappedTag<double, 1> d;
        const hn::Rebind<float, decltype(d)> df;
        const auto nearest = depth_at(d, triangle, hn::Set(d, from_origin_x(triangle, column) + dx), hn::Set(d, from_origin_y(triangle, row) + dy));
        return hn::GetLane(clamp_depth(df, triangle, hn::DemoteTo(df, nearest))) < farthest;
    }

    float farthest_in_block(int column, int row) {
        const size_t index = block(column, row);
        if (out_.block_stale[index]) {
            float farthest = 1.0f;
            const int rows = std::min(kHiZWidth, pass_.height - row), columns = std::min(kHiZWidth, pass_.width - column);
            for (int r = 0; r < rows; ++r) {
                const float* const depth = out_.depth.data() + entry(column, row + r);
                farthest = std::min(farthest, *std::min_element(depth, depth + columns));
            }
            out_.block_farthest[index] = farthest;
            out_.block_stale[index] = 0;
        }
        return out_.block_farthest[index];
    }

    template <class Coverage>
    HWY_INLINE void draw_wave(const SetupTriangle& triangle, uint32_t setup_index, int column, int row, uint32_t mask, Coverage& coverage) {
        WaveDepth wave;
        measure_depth(triangle, column, row, wave);
        uint32_t winners = mask & wave.nearer;
        for (uint32_t ties = mask & wave.equal; ties != 0; ties &= ties - 1) {
            const int lane = std::countr_zero(ties);
            if (precedes(triangle, setup_index, out_.triangle[entry(column + lane % kBlockWidth, row + lane / kBlockWidth)])) winners |= 1u << lane;
        }
        if (winners == 0) return;
        if (triangle.coverage == CoverageClass::Opaque) {
            out_.block_stale[block(column, row)] = 1;
        } else {
            SampleOffset storage[kBlockLanes];
            const SampleOffset* const offsets = pass_.offsets(column, row, storage);
            winners &= coverage(CandidateWave{&triangle, setup_index, pass_.x + column, pass_.y + row, winners, offsets});
        }
        write(setup_index, column, row, winners, wave);
    }

    /// Whether the triangle comes before another one of equal depth. Pieces of one triangle share its id.
    bool precedes(const SetupTriangle& triangle, uint32_t setup_index, uint32_t other) const {
        if (other == kNoTriangle) return true;
        const uint32_t other_id = frame_.triangle(other).triangle_id;
        return triangle.triangle_id != other_id ? triangle.triangle_id < other_id : setup_index < other;
    }

    HWY_INLINE void measure_depth(const SetupTriangle& triangle, int column, int row, WaveDepth& wave) const {
        const RowDoubles d;
        const DepthFloats df;
        const DepthInts di;
        const auto to_pixels = hn::Set(d, 1.0 / kSampleOne);
        auto offset_x = hn::Set(d, double(pass_.samples.frame.x) / kSampleOne), offset_y = hn::Set(d, double(pass_.samples.frame.y) / kSampleOne);
        const double origin_x = from_origin_x(triangle, column);
        for (int r = 0; r < kBlockHeight; ++r) {
            const float* const stored = out_.depth.data() + entry(column, row + r);
            const auto origin_y = hn::Set(d, from_origin_y(triangle, row + r));
            for (size_t i = 0; i < kBlockWidth; i += hn::Lanes(d)) {
                if (pass_.samples.per_pixel != nullptr) {
                    hn::Vec<DepthInts> x, y;
                    hn::LoadInterleaved2(di, &pass_.samples.per_pixel[entry(column, row + r) + i].x, x, y);
                    offset_x = hn::Mul(hn::PromoteTo(d, x), to_pixels);
                    offset_y = hn::Mul(hn::PromoteTo(d, y), to_pixels);
                }
                const auto x = hn::Add(hn::Iota(d, origin_x + double(i)), offset_x), y = hn::Add(origin_y, offset_y);
                const auto depth = clamp_depth(df, triangle, hn::DemoteTo(df, depth_at(d, triangle, x, y)));
                const auto so_far = hn::LoadU(df, stored + i);
                const size_t lane = size_t(r) * kBlockWidth + i;
                hn::Store(depth, df, wave.depth + lane);
                wave.nearer |= bits_of(df, hn::Gt(depth, so_far)) << lane;
                wave.equal |= bits_of(df, hn::Eq(depth, so_far)) << lane;
            }
        }
    }

    HWY_INLINE void write(uint32_t setup_index, int column, int row, uint32_t lanes, const WaveDepth& wave) {
        const hn::CappedTag<float, kBlockWidth> df;
        const hn::CappedTag<uint32_t, kBlockWidth> du;
        for (int r = 0; r < kBlockHeight; ++r) {
            if ((lanes >> (r * kBlockWidth) & 0xFFu) == 0) continue;
            const size_t at = entry(column, row + r);
            for (size_t i = 0; i < kBlockWidth; i += hn::Lanes(df)) {
                const size_t lane = size_t(r) * kBlockWidth + i;
                const uint32_t bits = lanes >> lane;
                hn::BlendedStore(hn::Load(df, wave.depth + lane), mask_of(df, bits), df, out_.depth.data() + at + i);
                hn::BlendedStore(hn::Set(du, setup_index), mask_of(du, bits), du, out_.triangle.data() + at + i);
            }
        }
    }

    const Frame& frame_;
    const TilePass& pass_;
    TileVisibility& out_;
    int blocks_x_;
};

template <class Coverage>
void tile_visibility(const Frame& frame, int tile_x, int tile_y, const TileSamples& samples, Coverage&& coverage, TileVisibility& out) {
    out.reset(frame.options().tile_size);
    const std::span<const uint32_t> bin = frame.bin(tile_x, tile_y);
    if (bin.empty()) return;
    const TilePass pass(frame, tile_x, tile_y, samples);
    TileRasterizer rasterizer(frame, pass, out);
    for (const uint32_t setup_index : bin) rasterizer.draw(setup_index, coverage);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::raster
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_RASTER_VISIBILITY_INL_H
