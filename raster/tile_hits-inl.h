// Which triangles of a tile's bin have a sample point in their box, many at a time; of those of a few pixels, which pixels they cover.
#if defined(RAWTEXEL_RASTER_TILE_HITS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_RASTER_TILE_HITS_INL_H
#undef RAWTEXEL_RASTER_TILE_HITS_INL_H
#else
#define RAWTEXEL_RASTER_TILE_HITS_INL_H
#endif

#include "raster/coverage-inl.h"
#include "raster/small_triangle-inl.h"
#include "raster/visibility.h"

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::raster {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Every lane its own triangle.
using HitInts = hn::CappedTag<int32_t, 16>;
inline constexpr size_t kHitChunk = 128;      // looked at before they are drawn
inline constexpr size_t kCornerPadding = 16;  // so that vectors may read past the last triangle
static_assert(kHitChunk % kCornerPadding == 0);

/// One bit per lane.
template <class M>
HWY_INLINE uint32_t hit_bits(M mask) {
    const HitInts d;
    uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, mask, bytes);
    return uint32_t(bytes[0] | bytes[1] << 8) & ((1u << hn::Lanes(d)) - 1);
}

/// The corners of the bin's triangles, in 1/512 pixel from the tile's upper left corner, by coordinate: the same for all samples.
class CornerFinder {
  public:
    CornerFinder(const Frame& frame, std::span<const uint32_t> bin, const TilePass& pass, TileVisibility& out)
        : frame_(frame), bin_(bin), pass_(pass), corners_(out.corners) {
        const int tile_x = pass.x / pass.size, tile_y = pass.y / pass.size;
        known_ = corners_.frame == frame.serial() && corners_.tile_x == tile_x && corners_.tile_y == tile_y;
        if (known_) return;
        for (std::vector<int32_t>(*const axis)[3] : {&corners_.x, &corners_.y}) {
            for (std::vector<int32_t>& of_corner : *axis) {
                of_corner.resize(bin.size() + kCornerPadding);
                // Beyond every tile.
                std::fill_n(of_corner.begin() + ptrdiff_t(bin.size()), kCornerPadding, std::numeric_limits<int32_t>::max() / 2);
            }
        }
        corners_.opaque = 0;
        corners_.frame = 0;  // until all are found
        corners_.tile_x = tile_x;
        corners_.tile_y = tile_y;
    }

    /// Of the triangles [begin, end), after those before them.
    void find(size_t begin, size_t end) {
        if (known_) return;
        constexpr size_t kAhead = 24;  // triangles come from memory, and a bin's may lie far apart
        int32_t* const x[] = {corners_.x[0].data(), corners_.x[1].data(), corners_.x[2].data()};
        int32_t* const y[] = {corners_.y[0].data(), corners_.y[1].data(), corners_.y[2].data()};
        const int32_t left = pass_.x * kSampleOne, top = pass_.y * kSampleOne;
        size_t opaque = 0;
        for (size_t i = begin; i < end; ++i) {
            if (i + kAhead < bin_.size()) hwy::Prefetch(&frame_.triangle(bin_[i + kAhead]));
            const SetupTriangle& t = frame_.triangle(bin_[i]);
            for (size_t k = 0; k < 3; ++k) {
                x[k][i] = 2 * t.x[k] - left;
                y[k][i] = 2 * t.y[k] - top;
            }
            opaque += t.coverage == CoverageClass::Opaque;
        }
        corners_.opaque += opaque;
        if (end == bin_.size()) corners_.frame = frame_.serial();
    }

  private:
    const Frame& frame_;
    std::span<const uint32_t> bin_;
    const TilePass& pass_;
    TileVisibility::Corners& corners_;
    bool known_;
};

/// Finds the hits of one pass.
class HitFinder {
  public:
    /// `told`: somebody hears of opaque triangles, too, wave by wave.
    HitFinder(std::span<const uint32_t> bin, const TilePass& pass, bool told, TileVisibility& out)
        : bin_(bin), pass_(pass), covers_(!told && pass.samples.per_pixel == nullptr), corners_(out.corners), hits_(out.hits) {}

    /// Appends the hits of the triangles [begin, end), whose corners are known; `begin` is a multiple of kHitChunk.
    void find(size_t begin, size_t end) {
        const HitInts d;
        size_t count = hits_.size();
        hits_.resize(count + (end - begin));
        for (size_t i = begin; i < end; i += hn::Lanes(d)) count = find_lanes(i, count);
        hits_.resize(count);
    }

  private:
    using Vector = hn::Vec<HitInts>;
    static constexpr int kSide = TileVisibility::Hit::kTiny;

    static HWY_INLINE Vector set(int64_t v) { return hn::Set(HitInts(), int32_t(v)); }

    /// Of the triangles `i` and on; returns how many hits there are with them.
    HWY_INLINE size_t find_lanes(size_t i, size_t count) {
        const HitInts d;
        Vector x[3], y[3];
        for (size_t k = 0; k < 3; ++k) {
            x[k] = hn::LoadU(d, corners_.x[k].data() + i);
            y[k] = hn::LoadU(d, corners_.y[k].data() + i);
        }
        const Vector x_min = hn::Min(hn::Min(x[0], x[1]), x[2]), x_max = hn::Max(hn::Max(x[0], x[1]), x[2]);
        const Vector y_min = hn::Min(hn::Min(y[0], y[1]), y[2]), y_max = hn::Max(hn::Max(y[0], y[1]), y[2]);
        const auto first = [&](Vector low, int64_t offset) HWY_ATTR {
            return hn::Max(hn::ShiftRight<kSampleBits>(hn::Add(low, set(kSampleOne - 1 - offset))), hn::Zero(d));
        };
        const auto last = [&](Vector high, int64_t offset, int extent)
                              HWY_ATTR { return hn::Min(hn::ShiftRight<kSampleBits>(hn::Sub(high, set(offset))), set(extent - 1)); };
        const SampleBox& offsets = pass_.offset_box;
        const Vector first_x = first(x_min, offsets.x_max), first_y = first(y_min, offsets.y_max);
        const Vector last_x = last(x_max, offsets.x_min, pass_.width), last_y = last(y_max, offsets.y_min, pass_.height);
        const Vector right = hn::Sub(last_x, first_x), down = hn::Sub(last_y, first_y);
        uint32_t hit = hit_bits(hn::Gt(hn::Min(right, down), set(-1)));
        if (hit == 0) return count;

        const auto small = hn::Lt(hn::Max(hn::Sub(x_max, x_min), hn::Sub(y_max, y_min)), set(2 * SmallTriangle::kExtent + 1));
        const uint32_t is_small = hit_bits(small);
        uint32_t tiny = 0;
        alignas(64) int32_t covered[kCornerPadding];
        if (covers_) {
            const auto is_tiny = hn::And(small, hn::Lt(hn::Max(right, down), set(kSide)));
            tiny = hit & opaque_lanes(i) & hit_bits(is_tiny);
            if (tiny != 0) {
                const Vector pixels =
                    find_covered(x, y, first_x, first_y, hn::IfThenElseZero(is_tiny, right), hn::IfThenElseZero(is_tiny, down));
                hn::Store(pixels, d, covered);
                // Beside the one pixel there is to look at; all others are held against Hi-Z first.
                hit &= ~(tiny & hit_bits(hn::Eq(hn::Or(hn::Or(right, down), pixels), hn::Zero(d))));
            }
        }
        alignas(64) int32_t left[kCornerPadding], top[kCornerPadding], across[kCornerPadding], below[kCornerPadding];
        hn::Store(first_x, d, left);
        hn::Store(first_y, d, top);
        hn::Store(last_x, d, across);
        hn::Store(last_y, d, below);
        for (; hit != 0; hit &= hit - 1) {
            const size_t lane = size_t(std::countr_zero(hit));
            const bool known = (tiny >> lane & 1u) != 0;
            hits_[count++] = {bin_[i + lane],
                              int16_t(left[lane]),
                              int16_t(top[lane]),
                              int16_t(across[lane]),
                              int16_t(below[lane]),
                              known ? uint16_t(covered[lane]) : uint16_t{0},
                              (is_small >> lane & 1u) != 0,
                              known};
        }
        return count;
    }

    /// Opaque triangles come first in a bin.
    uint32_t opaque_lanes(size_t i) const {
        const size_t opaque = corners_.opaque > i ? corners_.opaque - i : 0;
        return opaque >= kCornerPadding ? 0xFFFFu : (1u << opaque) - 1;
    }

    /// Bit kSide*row + column, from the first pixel on, of the pixels [0, right] x [0, down]. Sample points lie no farther from the
    /// triangle than SmallTriangle's do.
    HWY_INLINE Vector find_covered(const Vector (&x)[3], const Vector (&y)[3], Vector first_x, Vector first_y, Vector right,
                                   Vector down) const {
        const HitInts d;
        const Vector px = hn::Add(hn::ShiftLeft<kSampleBits>(first_x), set(pass_.samples.frame.x));
        const Vector py = hn::Add(hn::ShiftLeft<kSampleBits>(first_y), set(pass_.samples.frame.y));
        Vector row[3], step_x[3], step_y[3];
        for (size_t e = 0; e < 3; ++e) {
            const size_t next = e == 2 ? 0 : e + 1;
            const Vector dx = hn::ShiftRight<1>(hn::Sub(x[next], x[e])), dy = hn::ShiftRight<1>(hn::Sub(y[next], y[e]));
            const auto top_left = hn::Or(hn::Lt(dy, hn::Zero(d)), hn::And(hn::Eq(dy, hn::Zero(d)), hn::Gt(dx, hn::Zero(d))));
            const Vector at = hn::Sub(hn::Mul(dx, hn::Sub(py, y[e])), hn::Mul(dy, hn::Sub(px, x[e])));
            row[e] = hn::Sub(at, hn::IfThenZeroElse(top_left, set(1)));
            step_x[e] = hn::ShiftLeft<kSampleBits>(dy);
            step_y[e] = hn::ShiftLeft<kSampleBits>(dx);
        }
        const int columns = 1 + int(hn::GetLane(hn::MaxOfLanes(d, right))), rows = 1 + int(hn::GetLane(hn::MaxOfLanes(d, down)));
        Vector outside = hn::Zero(d);
        for (int r = 0; r < rows; ++r) {
            Vector e0 = row[0], e1 = row[1], e2 = row[2];
            for (int c = 0; c < columns; ++c) {
                const Vector sign = hn::ShiftRight<31>(hn::Or(hn::Or(e0, e1), e2));
                outside = hn::Or(outside, hn::And(sign, set(1 << (kSide * r + c))));
                e0 = hn::Sub(e0, step_x[0]);
                e1 = hn::Sub(e1, step_x[1]);
                e2 = hn::Sub(e2, step_x[2]);
            }
            for (size_t e = 0; e < 3; ++e) row[e] = hn::Add(row[e], step_y[e]);
        }
        const Vector one = set(1);
        const Vector in_row = hn::Sub(hn::Shl(set(2), right), one);
        const Vector in_rows = hn::Sub(hn::Shl(set(1 << kSide), hn::Mul(down, set(kSide))), one);
        return hn::AndNot(outside, hn::And(hn::Mul(in_row, set(0x1111)), in_rows));
    }

    std::span<const uint32_t> bin_;
    const TilePass& pass_;
    bool covers_;
    const TileVisibility::Corners& corners_;
    std::vector<TileVisibility::Hit>& hits_;
};

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::raster
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_RASTER_TILE_HITS_INL_H
