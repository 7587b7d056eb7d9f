// Visibility of one tile in vectors; the meaning stands in raster/visibility.h.
#if defined(RAWTEXEL_RASTER_VISIBILITY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_RASTER_VISIBILITY_INL_H
#undef RAWTEXEL_RASTER_VISIBILITY_INL_H
#else
#define RAWTEXEL_RASTER_VISIBILITY_INL_H
#endif

#include "raster/coverage-inl.h"
#include "raster/edge.h"
#include "raster/small_triangle-inl.h"
#include "raster/tile_hits-inl.h"
#include "raster/visibility.h"

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

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

/// Of the blocks that the frame's border crosses, the pixels inside.
inline void count_inside(const TilePass& pass, TileVisibility& out) {
    for (int row = 0; row < pass.size; row += kHiZWidth) {
        for (int column = 0; column < pass.size; column += kHiZWidth) {
            const int columns = std::clamp(pass.width - column, 0, kHiZWidth), rows = std::clamp(pass.height - row, 0, kHiZWidth);
            out.block[size_t(row / kHiZWidth) * size_t(pass.size / kHiZWidth) + size_t(column / kHiZWidth)].open = int16_t(columns * rows);
        }
    }
}

/// Draws triangles into one tile.
class TileRasterizer {
  public:
    TileRasterizer(const Frame& frame, const TilePass& pass, TileVisibility& out)
        : frame_(frame),
          pass_(pass),
          out_(out),
          blocks_x_(pass.size / kHiZWidth),
          unwritten_(out.may_leave_blocks ? out.block.size() : 0),
          hiz_(frame.options().skips.hiz) {}

    template <class Coverage>
    void draw(const TileVisibility::Hit& hit, Coverage& coverage) {
        constexpr bool is_told = requires(const CandidateWave& opaque) { coverage.opaque(opaque); };
        const SetupTriangle& triangle = frame_.triangle(hit.setup_index);
        if (hit.small) {
            write_blocks(hit);
            if (is_told || triangle.coverage != CoverageClass::Opaque || hit.last_x - hit.first_x >= kBlockWidth) {
                draw_small(triangle, hit.setup_index, hit, coverage);
            } else if (hit.first_x == hit.last_x && hit.first_y == hit.last_y) {
                draw_point(triangle, hit);
            } else {
                draw_narrow(triangle, hit);
            }
        } else {
            draw_large(triangle, hit.setup_index, hit, coverage);
        }
    }

    /// What is tiny, opaque and asks nobody: pixels known to be covered, one after the other.
    HWY_INLINE void draw_tiny(const TileVisibility::Hit& hit) {
        constexpr int kSide = TileVisibility::Hit::kTiny;
        const SetupTriangle& triangle = frame_.triangle(hit.setup_index);
        write_blocks(hit);
        const uint32_t first_x = uint32_t(hit.first_x), first_y = uint32_t(hit.first_y), setup_index = hit.setup_index;
        const uint32_t across = first_x ^ uint32_t(hit.last_x), down = first_y ^ uint32_t(hit.last_y);
        TileVisibility::Block* const blocks = out_.block.data();
        const size_t stride = size_t(pass_.size), blocks_x = size_t(blocks_x_), first = first_y * stride + first_x;
        const auto block_of = [&](uint32_t column, uint32_t row) { return row / kHiZWidth * blocks_x + column / kHiZWidth; };
        TileVisibility::Block& first_block = blocks[block_of(first_x, first_y)];
        // Most blocks still have pixels that show nothing, when small triangles come.
        if (hiz_ && (across | down) != 0 && first_block.open == 0 && rejects(triangle, hit)) return;
        if (hit.covered == 0) return;
        // What whoever shades the tile reads of triangles that cover something, each in a line of its own.
        hwy::Prefetch(&triangle.rounded_inverse_w);
        // Bytes that are written may be anything's, so that all else is to be at hand.
        const hn::CappedTag<double, 1> d;
        const hn::Rebind<float, decltype(d)> df;
        const auto depth_dx = hn::Set(d, triangle.depth_dx), depth_dy = hn::Set(d, triangle.depth_dy);
        const auto at_origin = hn::Set(d, triangle.depth_at_origin);
        const float depth_max = triangle.depth_max;
        const auto least = hn::Set(df, triangle.depth_min), greatest = hn::Set(df, depth_max);
        const auto x = hn::Set(d, from_origin_x(triangle, hit.first_x) + pass_.frame_x);
        const auto y = hn::Set(d, from_origin_y(triangle, hit.first_y) + pass_.frame_y);
        float* const depths = out_.depth.data();
        uint32_t* const triangles = out_.triangle.data();
        uint8_t* const covered = out_.covered.data();
        const bool in_one_block = (across | down) < kHiZWidth;
        int fresh = 0;
        bool written = false;
        for (uint32_t rest = hit.covered; rest != 0; rest &= rest - 1) {
            const uint32_t bit = uint32_t(std::countr_zero(rest)), c = bit % kSide, r = bit / kSide;
            // As depth_at() and clamp_depth() have it.
            const auto along =
                hn::Add(hn::Mul(depth_dx, hn::Add(x, hn::Set(d, kSteps[c]))), hn::Mul(depth_dy, hn::Add(y, hn::Set(d, kSteps[r]))));
            const float depth = hn::GetLane(hn::Min(hn::Max(hn::DemoteTo(df, hn::Add(at_origin, along)), least), greatest));
            const size_t at = first + r * stride + c;
            const float so_far = depths[at];
            if (depth < so_far || (depth == so_far && !precedes(triangle, setup_index, triangles[at]))) continue;
            depths[at] = depth;
            triangles[at] = setup_index;
            const uint32_t held = covered[at / 8], pixel = 1u << at % 8;
            covered[at / 8] = uint8_t(held | pixel);
            fresh += (held & pixel) == 0;
            written = true;
            if (!in_one_block) {
                tell_block(blocks[block_of(first_x + c, first_y + r)], std::exchange(fresh, 0), depth_max);
                written = false;
            }
        }
        if (written) tell_block(first_block, fresh, depth_max);
    }

  private:
    static constexpr double kSteps[] = {0, 1, 2, 3};
    static_assert(std::size(kSteps) == TileVisibility::Hit::kTiny);

    /// Opaque geometry was written to the block; `fresh` pixels held none before.
    static HWY_INLINE void tell_block(TileVisibility::Block& told, int fresh, float depth_max) {
        told.open = int16_t(told.open - fresh);
        told.stale = true;
        told.nearest = std::max(told.nearest, depth_max);
    }

    /// Depth along the rows of a wave, in vectors.
    struct DepthLanes {
        HWY_INLINE DepthLanes(const SetupTriangle& triangle_, const TilePass& pass_, double origin_x_)
            : triangle(triangle_), pass(pass_), origin_x(origin_x_) {
            const RowDoubles d;
            if (pass.samples.per_pixel != nullptr) return;
            for (size_t i = 0; i < kBlockWidth; i += hn::Lanes(d)) {
                const auto x = hn::Add(numbers_from(d, origin_x + double(i)), hn::Set(d, pass.frame_x));
                hn::Store(hn::Mul(hn::Set(d, triangle.depth_dx), x), d, along_x + i);
            }
        }

        /// Of the pixels `i` and on of a row; `pixel`: the tile's entry of its first one. As depth_at() has it.
        HWY_INLINE hn::Vec<DepthFloats> at(size_t i, double origin_y, size_t pixel) const {
            const RowDoubles d;
            const DepthFloats df;
            const DepthInts di;
            if (pass.samples.per_pixel == nullptr) {
                const auto along = hn::Add(hn::Load(d, along_x + i), hn::Set(d, triangle.depth_dy * (origin_y + pass.frame_y)));
                return clamp_depth(df, triangle, hn::DemoteTo(df, hn::Add(hn::Set(d, triangle.depth_at_origin), along)));
            }
            const auto to_pixels = hn::Set(d, 1.0 / kSampleOne);
            hn::Vec<DepthInts> offset_x, offset_y;
            hn::LoadInterleaved2(di, &pass.samples.per_pixel[pixel + i].x, offset_x, offset_y);
            const auto x = hn::Add(numbers_from(d, origin_x + double(i)), hn::Mul(hn::PromoteTo(d, offset_x), to_pixels));
            const auto y = hn::Add(hn::Set(d, origin_y), hn::Mul(hn::PromoteTo(d, offset_y), to_pixels));
            return clamp_depth(df, triangle, hn::DemoteTo(df, depth_at(d, triangle, x, y)));
        }

        const SetupTriangle& triangle;
        const TilePass& pass;
        double origin_x;
        alignas(64) double along_x[kBlockWidth];
    };

    struct WaveDepth {
        alignas(64) float depth[kBlockLanes];
        uint32_t nearer = 0, equal = 0;
    };

    /// Opaque and small, with one pixel to look at: what draw_small comes to.
    HWY_INLINE void draw_point(const SetupTriangle& triangle, const TileVisibility::Hit& hit) {
        const int column = hit.first_x, row = hit.first_y;
        const size_t at = entry(column, row);
        const SampleOffset offset = pass_.samples.per_pixel == nullptr ? pass_.samples.frame : pass_.samples.per_pixel[at];
        if (!SmallTriangle::covers(triangle, (pass_.x + column) * kSampleOne + offset.x, (pass_.y + row) * kSampleOne + offset.y)) return;
        const hn::CappedTag<double, 1> d;
        const hn::Rebind<float, decltype(d)> df;
        const auto x = hn::Set(d, from_origin_x(triangle, column) + double(offset.x) / kSampleOne);
        const auto y = hn::Set(d, from_origin_y(triangle, row) + double(offset.y) / kSampleOne);
        const float depth = hn::GetLane(clamp_depth(df, triangle, hn::DemoteTo(df, depth_at(d, triangle, x, y))));
        const float so_far = out_.depth[at];
        if (depth < so_far || (depth == so_far && !precedes(triangle, hit.setup_index, out_.triangle[at]))) return;
        out_.depth[at] = depth;
        out_.triangle[at] = hit.setup_index;
        cover(column & -kBlockWidth, row, 1u << column % kBlockWidth);
        note_block(block(column, row), triangle.depth_max);
    }

    /// Opaque, small and no wider than eight pixels, which two rows of lanes hold.
    HWY_INLINE void draw_narrow(const SetupTriangle& triangle, const TileVisibility::Hit& hit) {
        if (hiz_ && hit.last_y - hit.first_y <= kHiZWidth && rejects(triangle, hit)) return;
        const SmallTriangle covers(triangle, pass_);
        for (int column = hit.first_x & -kBlockWidth; column <= hit.last_x; column += kBlockWidth) {
            // Of those in the tile's rows, the pixels inside of the frame.
            const uint32_t inside = (2u << std::min(hit.last_x - column, kBlockWidth - 1)) - 1;
            const DepthLanes depth_of(triangle, pass_, from_origin_x(triangle, column));
            // Blocks are told of what is written once all of their rows are.
            int fresh = 0;
            bool written = false;
            const auto tell = [&](int row) HWY_ATTR {
                if (!std::exchange(written, false)) return;
                tell_block(out_.block[block(column, row)], std::exchange(fresh, 0), triangle.depth_max);
            };
            covers.for_each_row(column, hit.first_y, hit.last_y, [&](int row, uint32_t covered) HWY_ATTR {
                if (row % kHiZWidth == 0) tell(row - 1);
                if ((covered & inside) == 0) return;
                const uint32_t winners = draw_row(triangle, hit.setup_index, entry(column, row), row, covered & inside, depth_of);
                uint8_t& held = out_.covered[entry(column, row) / 8];
                fresh += std::popcount(winners & ~uint32_t{held});
                held |= uint8_t(winners);
                written |= winners != 0;
            });
            tell(hit.last_y);
        }
    }

    /// Whether what is drawn hides all of the blocks that the hit, no larger than one, may lie in; counts them.
    HWY_INLINE bool rejects(const SetupTriangle& triangle, const TileVisibility::Hit& hit) {
        const size_t blocks[4] = {block(hit.first_x, hit.first_y), block(hit.last_x, hit.first_y), block(hit.first_x, hit.last_y),
                                  block(hit.last_x, hit.last_y)};
        if (!hides_all(blocks, triangle.depth_max)) return false;
        out_.hiz_rejected += uint64_t(1 + (blocks[0] != blocks[1])) * uint64_t(1 + (blocks[0] != blocks[2]));
        return true;
    }

    HWY_INLINE bool hides_all(const size_t (&blocks)[4], float depth_max) {
        const auto hides = [&](size_t b) HWY_ATTR {
            const TileVisibility::Block& held = out_.block[b];
            return held.open == 0 && depth_max < held.nearest &&
                   depth_max < farthest_in_block(int(b) % blocks_x_ * kHiZWidth, int(b) / blocks_x_ * kHiZWidth);
        };
        return hides(blocks[0]) && (blocks[3] == blocks[0] || (hides(blocks[1]) && hides(blocks[2]) && hides(blocks[3])));
    }

    /// Wave by wave: too few pixels for tests of whole blocks to pay.
    template <class Coverage>
    HWY_INLINE void draw_small(const SetupTriangle& triangle, uint32_t setup_index, const TileVisibility::Hit& pixels, Coverage& coverage) {
        const SmallTriangle covered(triangle, pass_);
        for (int row = pixels.first_y & -kBlockHeight; row <= pixels.last_y; row += kBlockHeight) {
            const int begin = std::max(pixels.first_y - row, 0), end = std::min(pixels.last_y - row + 1, kBlockHeight);
            for (int column = pixels.first_x & -kBlockWidth; column <= pixels.last_x; column += kBlockWidth) {
                if (hiz_ && triangle.depth_max < farthest_worth_knowing(triangle.depth_max, column, row)) {
                    // Counted once a block: for its upper half, or its lower one where the triangle does not reach the upper.
                    out_.hiz_rejected += row % kHiZWidth == 0 || row == (pixels.first_y & -kBlockHeight);
                    continue;
                }
                uint32_t mask = covered.wave(column, row, begin, end);
                if (!pass_.whole()) mask &= pass_.lanes_inside(column, row);
                if (mask != 0) draw_wave(triangle, setup_index, column, row, mask, coverage);
            }
        }
    }

    template <class Coverage>
    HWY_NOINLINE void draw_large(const SetupTriangle& triangle, uint32_t setup_index, const TileVisibility::Hit& pixels,
                                 Coverage& coverage) {
        constexpr bool is_told = requires(const CandidateWave& opaque) { coverage.opaque(opaque); };
        TriangleCoverage covered(triangle, pass_);
        for (int row = pixels.first_y & -kHiZWidth; row <= pixels.last_y; row += kHiZWidth) {
            for (int column = pixels.first_x & -kHiZWidth; column <= pixels.last_x; column += kHiZWidth) {
                if (!covered.enter_block(column, row)) continue;
                TileVisibility::Block& entered = out_.block[block(column, row)];
                if (!entered.written) {
                    if (!is_told && triangle.coverage == CoverageClass::Opaque && entered.open == kHiZWidth * kHiZWidth &&
                        covered.fills_block()) {
                        fill_block(triangle, setup_index, entered);
                        continue;
                    }
                    write_block(column, row, entered);
                }
                if (hiz_ && hidden(triangle, column, row)) {
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

    /// All pixels of a block that shows nothing so far, without a look at their depth.
    static void fill_block(const SetupTriangle& triangle, uint32_t setup_index, TileVisibility::Block& block) {
        block.shown = setup_index;
        block.open = 0;
        block.stale = true;
        block.nearest = triangle.depth_max;
    }

    /// Before single pixels of the blocks are looked at.
    HWY_INLINE void write_blocks(const TileVisibility::Hit& pixels) {
        if (unwritten_ == 0) return;
        for (int row = pixels.first_y & -kHiZWidth; row <= pixels.last_y; row += kHiZWidth) {
            for (int column = pixels.first_x & -kHiZWidth; column <= pixels.last_x; column += kHiZWidth) {
                TileVisibility::Block& reached = out_.block[block(column, row)];
                if (!reached.written) write_block(column, row, reached);
            }
        }
    }

    /// The entries of what the block has shown so far.
    HWY_NOINLINE void write_block(int column, int row, TileVisibility::Block& block) {
        const RowDoubles d;
        const DepthFloats df;
        const hn::Rebind<uint32_t, RowDoubles> du;
        const bool empty = block.shown == kNoTriangle;
        const SetupTriangle* const triangle = empty ? nullptr : &frame_.triangle(block.shown);
        block.written = true;
        --unwritten_;
        for (size_t i = 0; i < kHiZWidth; i += hn::Lanes(d)) {
            for (int r = row; r < row + kHiZWidth; ++r) {
                const size_t at = entry(column, r);
                out_.covered[at / 8] = empty ? 0 : 0xFF;
                hn::StoreU(hn::Set(du, block.shown), du, out_.triangle.data() + at + i);
                if (empty) hn::StoreU(hn::Zero(df), df, out_.depth.data() + at + i);
            }
        }
        if (empty) return;
        const DepthLanes depth_of(*triangle, pass_, from_origin_x(*triangle, column));
        for (int r = row; r < row + kHiZWidth; ++r) {
            const size_t at = entry(column, r);
            const double origin_y = from_origin_y(*triangle, r);
            for (size_t i = 0; i < kHiZWidth; i += hn::Lanes(d)) hn::StoreU(depth_of.at(i, origin_y, at), df, out_.depth.data() + at + i);
        }
    }

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

    /// Notes that eight pixels of a row from (column, row) on hold opaque geometry.
    HWY_INLINE void cover(int column, int row, uint32_t pixels) {
        uint8_t& covered = out_.covered[entry(column, row) / 8];
        TileVisibility::Block& noted = out_.block[block(column, row)];
        noted.open = int16_t(noted.open - std::popcount(pixels & ~uint32_t{covered}));
        covered |= uint8_t(pixels);
    }
    HWY_INLINE void note_block(size_t which, float depth_max) {
        TileVisibility::Block& noted = out_.block[which];
        noted.stale = true;
        noted.nearest = std::max(noted.nearest, depth_max);
    }

    /// Depth of the block's farthest pixel; 0 as long as some pixel shows nothing.
    float farthest_in_block(int column, int row) {
        TileVisibility::Block& block_state = out_.block[block(column, row)];
        if (block_state.stale && block_state.open == 0) {
            block_state.stale = false;
            block_state.farthest = least_depth(column & -kHiZWidth, row & -kHiZWidth);
        }
        return block_state.farthest;
    }

    /// The same or less: what is nearer than all that the block holds need not know.
    HWY_INLINE float farthest_worth_knowing(float depth_max, int column, int row) {
        const TileVisibility::Block& block_state = out_.block[block(column, row)];
        return depth_max < block_state.nearest ? farthest_in_block(column, row) : 0.0f;
    }

    /// Over the block's pixels inside the frame.
    float least_depth(int column, int row) const {
        const int columns = std::min(kHiZWidth, pass_.width - column), rows = std::min(kHiZWidth, pass_.height - row);
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
        constexpr bool is_told = requires(const CandidateWave& opaque) { coverage.opaque(opaque); };
        if (!is_told && triangle.coverage == CoverageClass::Opaque) {
            draw_opaque(triangle, setup_index, column, row, mask);
        } else {
            draw_candidates(triangle, setup_index, column, row, mask, coverage);
        }
    }

    /// What is written makes the block look for its farthest pixel again.
    HWY_INLINE void note_opaque(const SetupTriangle& triangle, int column, int row, uint32_t lanes) {
        if (out_.block[block(column, row)].open != 0) {
            for (int r = 0; r < kBlockHeight; ++r) cover(column, row + r, lanes >> (r * kBlockWidth) & 0xFFu);
        }
        note_block(block(column, row), triangle.depth_max);
    }

    /// Compares and writes eight pixels from entry `at` on, where nobody is to be asked; returns those written.
    HWY_INLINE uint32_t draw_row(const SetupTriangle& triangle, uint32_t setup_index, size_t at, int row, uint32_t pixels,
                                 const DepthLanes& depth_of) {
        const RowDoubles d;
        const DepthFloats df;
        const hn::Rebind<uint32_t, RowDoubles> du;
        const double origin_y = from_origin_y(triangle, row);
        uint32_t written = 0;
        for (size_t i = 0; i < kBlockWidth; i += hn::Lanes(d)) {
            const uint32_t lanes = pixels >> i & ((1u << hn::Lanes(d)) - 1);
            if (lanes == 0) continue;
            const auto depth = depth_of.at(i, origin_y, at);
            const auto so_far = hn::LoadU(df, out_.depth.data() + at + i);
            uint32_t winners = lanes & bits_of(df, hn::Gt(depth, so_far));
            for (uint32_t ties = lanes & bits_of(df, hn::Eq(depth, so_far)); ties != 0; ties &= ties - 1) {
                const size_t lane = size_t(std::countr_zero(ties));
                if (precedes(triangle, setup_index, out_.triangle[at + i + lane])) winners |= 1u << lane;
            }
            if (winners == 0) continue;
            written |= winners << i;
            // Whole vectors: what is read again at once comes from the store's queue only where none was masked.
            if (winners == (1u << hn::Lanes(d)) - 1) {
                hn::StoreU(depth, df, out_.depth.data() + at + i);
                hn::StoreU(hn::Set(du, setup_index), du, out_.triangle.data() + at + i);
                continue;
            }
            hn::StoreU(hn::IfThenElse(mask_of(df, winners), depth, so_far), df, out_.depth.data() + at + i);
            const auto other = hn::LoadU(du, out_.triangle.data() + at + i);
            hn::StoreU(hn::IfThenElse(mask_of(du, winners), hn::Set(du, setup_index), other), du, out_.triangle.data() + at + i);
        }
        return written;
    }

    HWY_INLINE void draw_opaque(const SetupTriangle& triangle, uint32_t setup_index, int column, int row, uint32_t mask) {
        const DepthLanes depth_of(triangle, pass_, from_origin_x(triangle, column));
        uint32_t written = 0;
        for (int r = 0; r < kBlockHeight; ++r) {
            const uint32_t pixels = mask >> (r * kBlockWidth) & 0xFFu;
            if (pixels != 0)
                written |= draw_row(triangle, setup_index, entry(column, row + r), row + r, pixels, depth_of) << (r * kBlockWidth);
        }
        if (written != 0) note_opaque(triangle, column, row, written);
    }

    template <class Coverage>
    HWY_NOINLINE void draw_candidates(const SetupTriangle& triangle, uint32_t setup_index, int column, int row, uint32_t mask,
                                      Coverage& coverage) {
        WaveDepth wave;
        measure_depth(triangle, column, row, mask, wave);
        uint32_t winners = mask & wave.nearer;
        for (uint32_t ties = mask & wave.equal; ties != 0; ties &= ties - 1) {
            const int lane = std::countr_zero(ties);
            const uint32_t other = out_.triangle[entry(column + lane % kBlockWidth, row + lane / kBlockWidth)];
            if (precedes(triangle, setup_index, other)) winners |= 1u << lane;
        }
        if (winners == 0) return;
        SampleOffset storage[kBlockLanes];
        const CandidateWave candidate{&triangle, setup_index, pass_.x + column, pass_.y + row, winners, pass_.offsets(column, row, storage),
                                      wave.depth};
        if (triangle.coverage != CoverageClass::Opaque) {
            winners &= coverage(candidate);
        } else {
            note_opaque(triangle, column, row, winners);
            if constexpr (requires { coverage.opaque(candidate); }) coverage.opaque(candidate);
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
        const DepthLanes depth_of(triangle, pass_, from_origin_x(triangle, column));
        for (int r = 0; r < kBlockHeight; ++r) {
            if ((mask >> (r * kBlockWidth) & 0xFFu) == 0) continue;
            const size_t at = entry(column, row + r);
            const double origin_y = from_origin_y(triangle, row + r);
            for (size_t i = 0; i < kBlockWidth; i += hn::Lanes(d)) {
                const auto depth = depth_of.at(i, origin_y, at), so_far = hn::LoadU(df, out_.depth.data() + at + i);
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
    size_t unwritten_;  ///< blocks
    bool hiz_;
};

template <class Coverage>
void tile_visibility(const Frame& frame, int tile_x, int tile_y, const TileSamples& samples, Coverage&& coverage, TileVisibility& out) {
    out.reset(frame.options().tile_size);
    const std::span<const uint32_t> bin = frame.bin(tile_x, tile_y);
    if (bin.empty()) return;
    const TilePass pass(frame, tile_x, tile_y, samples);
    if (!pass.whole()) count_inside(pass, out);
    TileRasterizer rasterizer(frame, pass, out);

    constexpr bool is_told = requires(const CandidateWave& opaque) { coverage.opaque(opaque); };
    CornerFinder corners(frame, bin, pass, out);
    HitFinder finder(bin, pass, is_told, out);
    out.hits.clear();
    constexpr size_t kAhead = 4;  // the triangles of a bin may lie far apart in memory: far enough ahead, and not too far
    for (size_t begin = 0; begin < bin.size(); begin += kHitChunk) {
        const size_t end = std::min(begin + kHitChunk, bin.size()), first = out.hits.size();
        corners.find(begin, end);
        finder.find(begin, end);
        // The next ones come from memory while these are drawn.
        const size_t next = std::min(end + kHitChunk, bin.size());
        for (size_t i = first, wanted = end; i < out.hits.size(); ++i, ++wanted) {
            if (wanted < next) hwy::Prefetch(&frame.triangle(bin[wanted]));
            if (i + kAhead < out.hits.size()) hwy::Prefetch(&frame.triangle(out.hits[i + kAhead].setup_index));
            if (out.hits[i].tiny) {
                rasterizer.draw_tiny(out.hits[i]);
            } else {
                rasterizer.draw(out.hits[i], coverage);
            }
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::raster
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_RASTER_VISIBILITY_INL_H
