// Visibility of one tile in vectors; the meaning stands in raster/visibility.h.
#if defined(RAWTEXEL_RASTER_VISIBILITY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_RASTER_VISIBILITY_INL_H
#undef RAWTEXEL_RASTER_VISIBILITY_INL_H
#else
#define RAWTEXEL_RASTER_VISIBILITY_INL_H
#endif

#include "raster/coverage-inl.h"
#include "raster/edge.h"
#include "raster/visibility.h"

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::raster {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

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

    /// Whether what is drawn hides the triangle in all of the 8x8 block; only writes of opaque geometry make the block look again. As every
    /// step of the depth formula is monotonic, its value at the nearest corner of the samples' box is at least the value at every sample,
    /// to the last bit.
    bool hidden(const SetupTriangle& triangle, int column, int row) {
        const float farthest = farthest_in_block(column, row);
        if (farthest == 0.0f) return false;
        const SampleBox& reach = pass_.offset_box;
        const int64_t last = (kHiZWidth - 1) * kSampleOne;
        const double dx = double(triangle.depth_dx > 0.0 ? last + reach.x_max : reach.x_min) / kSampleOne;
        const double dy = double(triangle.depth_dy > 0.0 ? last + reach.y_max : reach.y_min) / kSampleOne;
        const hn::CappedTag<double, 1> d;
        const hn::Rebind<float, decltype(d)> df;
        const auto nearest =
            depth_at(d, triangle, hn::Set(d, from_origin_x(triangle, column) + dx), hn::Set(d, from_origin_y(triangle, row) + dy));
        return hn::GetLane(clamp_depth(df, triangle, hn::DemoteTo(df, nearest))) < farthest;
    }

    float farthest_in_block(int column, int row) {
        const size_t index = block(column, row);
        if (out_.block_stale[index]) {
            out_.block_stale[index] = 0;
            out_.block_farthest[index] =
                least_depth(column, row, std::min(kHiZWidth, pass_.width - column), std::min(kHiZWidth, pass_.height - row));
        }
        return out_.block_farthest[index];
    }

    float least_depth(int column, int row, int columns, int rows) const {
        const hn::CappedTag<float, kHiZWidth> d;
        float least = 1.0f;
        auto least_by_column = hn::Set(d, least);
        for (int r = 0; r < rows; ++r) {
            const float* const depth = out_.depth.data() + entry(column, row + r);
            if (columns < kHiZWidth) {
                least = std::min(least, *std::min_element(depth, depth + columns));
                continue;
            }
            for (size_t i = 0; i < kHiZWidth; i += hn::Lanes(d)) least_by_column = hn::Min(least_by_column, hn::LoadU(d, depth + i));
        }
        return std::min(least, hn::GetLane(hn::MinOfLanes(d, least_by_column)));
    }

    template <class Coverage>
    HWY_INLINE void draw_wave(const SetupTriangle& triangle, uint32_t setup_index, int column, int row, uint32_t mask, Coverage& coverage) {
        WaveDepth wave;
        measure_depth(triangle, column, row, mask, wave);
        uint32_t winners = mask & wave.nearer;
        for (uint32_t ties = mask & wave.equal; ties != 0; ties &= ties - 1) {
            const int lane = std::countr_zero(ties);
            const uint32_t other = out_.triangle[entry(column + lane % kBlockWidth, row + lane / kBlockWidth)];
            if (precedes(triangle, setup_index, other)) winners |= 1u << lane;
        }
        if (winners == 0) return;
        const auto ask = [&](auto&& who) {
            SampleOffset storage[kBlockLanes];
            const SampleOffset* const offsets = pass_.offsets(column, row, storage);
            return who(CandidateWave{&triangle, setup_index, pass_.x + column, pass_.y + row, winners, offsets, wave.depth});
        };
        if (triangle.coverage != CoverageClass::Opaque) {
            winners &= ask(coverage);
        } else {
            out_.block_stale[block(column, row)] = 1;
            if constexpr (requires(const CandidateWave& opaque) { coverage.opaque(opaque); }) {
                ask([&](const CandidateWave& candidate) { coverage.opaque(candidate); });
            }
        }
        write(setup_index, column, row, winners, wave);
    }

    /// Whether the triangle comes before another one of equal depth. Pieces of one triangle share its id.
    bool precedes(const SetupTriangle& triangle, uint32_t setup_index, uint32_t other) const {
        if (other == kNoTriangle) return true;
        const uint32_t other_id = frame_.triangle(other).triangle_id;
        return triangle.triangle_id != other_id ? triangle.triangle_id < other_id : setup_index < other;
    }

    /// Depth of the wave's rows that hold lanes of the mask, and how it compares with what is there.
    HWY_INLINE void measure_depth(const SetupTriangle& triangle, int column, int row, uint32_t mask, WaveDepth& wave) const {
        const RowDoubles d;
        const DepthFloats df;
        const DepthInts di;
        const auto to_pixels = hn::Set(d, 1.0 / kSampleOne);
        auto offset_x = hn::Set(d, double(pass_.samples.frame.x) / kSampleOne);
        auto offset_y = hn::Set(d, double(pass_.samples.frame.y) / kSampleOne);
        const double origin_x = from_origin_x(triangle, column);
        for (int r = 0; r < kBlockHeight; ++r) {
            if ((mask >> (r * kBlockWidth) & 0xFFu) == 0) continue;
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
    // The triangles of a bin may lie far apart in memory: far enough ahead, and not too far.
    constexpr size_t kAhead = 8;
    for (size_t i = 0; i < bin.size(); ++i) {
        if (i + kAhead < bin.size()) hwy::Prefetch(&frame.triangle(bin[i + kAhead]));
        rasterizer.draw(bin[i], coverage);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::raster
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_RASTER_VISIBILITY_INL_H
