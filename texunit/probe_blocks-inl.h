// What must be there before packed probes are read: counts their taps and ensures their blocks, or shows quickly that nothing is missing.
#include "texunit/page_blocks.h"
#include "texunit/probe_lines-inl.h"
#include "texunit/probes-inl.h"
#include "texunit/sample_levels-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_PROBE_BLOCKS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_PROBE_BLOCKS_INL_H_
#undef RAWTEXEL_TEXUNIT_PROBE_BLOCKS_INL_H_
#else
#define RAWTEXEL_TEXUNIT_PROBE_BLOCKS_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The taps of probe `n` in one level, as the policies and `ensure` take them.
HWY_NOINLINE inline void select_packed_taps(const LevelTable& table, const SamplerState& sampler, const WaveInt& level,
                                            const ProbeChoice& probes, const WavePosition& centre, int n, TapWave<2>& taps) {
    const FloatTag d;
    const IntTag di;
    taps.level = &level;
    taps.slice = centre.slice;
    taps.leaves = false;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const ProbePlaces places(sampler.probe_variance > 0 ? gaussian_probes() : uniform_probes(), hn::Load(di, probes.count.lane + i));
        const ProbeLevel here = probe_level(table, sampler, centre, probes, level, i);
        const auto store = [&](const ProbeTaps& axis, WaveInt(&index)[2], WaveFloat& fraction) HWY_ATTR {
            hn::Store(axis.first, di, index[0].lane + i);
            hn::Store(axis.second, di, index[1].lane + i);
            hn::Store(axis.fraction, d, fraction.lane + i);
        };
        store(probe_taps(here.s, places.place(n)), taps.x, taps.fraction_x);
        store(probe_taps(here.t, places.place(n)), taps.y, taps.fraction_y);
    }
}

/// Texels that the probes of each lane lie between, not wrapped.
struct ProbeBounds {
    WaveInt left, right, top, bottom;
};

HWY_INLINE void bound_probes(const LevelTable& table, const SamplerState& sampler, const WaveInt& level, const ProbeChoice& probes,
                             const WavePosition& centre, ProbeBounds& bounds) {
    const FloatTag d;
    const IntTag di;
    const ProbeTable& line = sampler.probe_variance > 0 ? gaussian_probes() : uniform_probes();
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const ProbeLevel here = probe_level(table, sampler, centre, probes, level, i);
        const auto first = hn::GatherIndex(d, line.place.data(), hn::Mul(hn::Load(di, probes.count.lane + i), hn::Set(di, kMostProbes)));
        const auto bound = [&](const ProbeAxis& axis, WaveInt& least, WaveInt& most) HWY_ATTR {
            // Probes are centred, so the last one's place is the first one's negated; a texel more on either side covers rounding.
            const auto reach = hn::Abs(hn::Mul(first, axis.direction));
            const auto low = hn::Sub(hn::ConvertTo(di, hn::Floor(hn::Sub(axis.start, reach))), hn::Set(di, 1));
            const auto high = hn::Add(hn::ConvertTo(di, hn::Floor(hn::Add(axis.start, reach))), hn::Set(di, 2));
            hn::Store(hn::Add(axis.base, low), di, least.lane + i);
            hn::Store(hn::Add(axis.base, high), di, most.lane + i);
        };
        bound(here.s, bounds.left, bounds.right);
        bound(here.t, bounds.top, bounds.bottom);
    }
}

/// Whether every block of the rectangle of unwrapped texels [left, right] x [top, bottom] in the first slice of a repeating level is ready.
/// False too where there are many.
HWY_NOINLINE inline bool rectangle_ready(const Texture& texture, int level, int left, int right, int top, int bottom) {
    constexpr int kMostPages = 64;
    constexpr int kPage = 1 << page_shape(kPacked).log2_width;  // texels, and as high
    static_assert(page_shape(kPacked).log2_width == page_shape(kPacked).log2_height &&
                  kPage * kPage == kTexelsPerBlock * BlockStates::kGroup);
    const LevelTable& table = texture.levels();
    const int width = table.width[size_t(level)], height = table.height[size_t(level)];
    // A small level is read whole.
    if (right - left >= width || width < kPage) left = 0, right = width - 1;
    if (bottom - top >= height || height < kPage) top = 0, bottom = height - 1;
    const int first_column = left & ~(kPage - 1), first_row = top & ~(kPage - 1);
    if (int64_t((right - first_column) / kPage + 1) * ((bottom - first_row) / kPage + 1) > kMostPages) return false;
    for (int y = first_row; y <= bottom; y += kPage) {
        const uint64_t rows = kPageBlocks.rows_between((std::max(top, y) - y) / 4, (std::min(bottom, y + kPage - 1) - y) / 4);
        for (int x = first_column; x <= right; x += kPage) {
            const uint64_t columns = kPageBlocks.columns_between((std::max(left, x) - x) / 4, (std::min(right, x + kPage - 1) - x) / 4);
            const int32_t page = texel_index(table, kPacked, level, 0, x & (width - 1), y & (height - 1)) / (kPage * kPage);
            if ((rows & columns & ~texture.ready_blocks(page)) != 0) return false;
        }
    }
    return true;
}

/// Whether the rectangles around the probes of all lanes, level by level, are ready: a quick answer to what prepare_packed_probes asks tap
/// by tap. False says nothing.
HWY_NOINLINE inline bool surely_ready(const Texture& texture, const SamplerState& sampler, const WaveInt& level, const ProbeChoice& probes,
                                      const WavePosition& centre) {
    if (centre.slice != nullptr || sampler.wrap_s != Wrap::Repeat || sampler.wrap_t != Wrap::Repeat) return false;
    ProbeBounds bounds;
    bound_probes(texture.levels(), sampler, level, probes, centre, bounds);
    const IntTag di;
    for (WaveMask pending = kWaveFull; pending != 0;) {
        const int32_t here = level.lane[hwy::Num0BitsBelowLS1Bit_Nonzero32(pending)];
        auto left = hn::Set(di, INT32_MAX), right = hn::Set(di, -INT32_MAX), top = left, bottom = right;
        for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(di)) {
            const auto lanes = hn::Eq(hn::Load(di, level.lane + i), hn::Set(di, here));
            const auto bound = [&](const WaveInt& values, IntVec otherwise)
                                   HWY_ATTR { return hn::IfThenElse(lanes, hn::Load(di, values.lane + i), otherwise); };
            left = hn::Min(left, bound(bounds.left, left)), right = hn::Max(right, bound(bounds.right, right));
            top = hn::Min(top, bound(bounds.top, top)), bottom = hn::Max(bottom, bound(bounds.bottom, bottom));
            pending &= ~wave_mask(di, lanes, i);
        }
        const auto least = [](IntVec v) HWY_ATTR { return -largest_lane(hn::Neg(v)); };
        if (!rectangle_ready(texture, here, least(left), largest_lane(right), least(top), largest_lane(bottom))) return false;
    }
    return true;
}

HWY_INLINE WaveMask mixing_lanes(const LevelChoice& choice) {
    const FloatTag d;
    WaveMask lanes = 0;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        lanes |= wave_mask(d, hn::Ne(hn::Load(d, choice.fraction.lane + i), hn::Zero(d)), i);
    }
    return lanes;
}

/// Makes sure that the texels of all probes may be read, or tells a listener of their taps.
template <class Count>
HWY_NOINLINE void prepare_packed_probes(Texture& texture, const SamplerState& sampler, const LevelChoice& choice, const ProbeChoice& probes,
                                        const WavePosition& centre, WaveMask mask, Count& count) {
    const ProbeTable& table = sampler.probe_variance > 0 ? gaussian_probes() : uniform_probes();
    const WaveMask mixing = mixing_lanes(choice) & mask;
    for (int n = 0; n < probes.most; ++n) {
        const WaveMask active = lanes_with_probe(probes, n, mask);
        if (active == 0) break;
        announce_probe(table, probes, n, count);
        for (const bool coarser : {false, true}) {
            const WaveMask reading = coarser ? active & mixing : active;
            if (reading == 0) continue;
            const WaveInt& level = coarser ? choice.coarser : choice.finer;
            TapWave<2> taps;
            select_packed_taps(texture.levels(), sampler, level, probes, centre, n, taps);
            begin_level(choice.fraction, coarser, count);
            if constexpr (Count::kReads) {
                WaveInt index[4];
                tap_indices<kPacked>(texture.levels(), taps, index);
                ensure(texture, level, index);
            } else {
                hear_taps(texture.levels(), taps, false, nullptr, reading, count);
            }
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_PROBE_BLOCKS_INL_H_
