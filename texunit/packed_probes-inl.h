// Anisotropic probes in one pass, texels in registers throughout: for 8-bit and block formats whose kernel is bilinear, which is where
// anisotropic filtering spends its time. The mean is taken over the stored numerators and scaled at the end.
#include "texunit/packed_texels-inl.h"
#include "texunit/probe_blocks-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_PACKED_PROBES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_PACKED_PROBES_INL_H_
#undef RAWTEXEL_TEXUNIT_PACKED_PROBES_INL_H_
#else
#define RAWTEXEL_TEXUNIT_PACKED_PROBES_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr bool is_power_of_two(int32_t n) { return (n & (n - 1)) == 0; }

/// Whether an axis wraps by a mask or by limits.
HWY_INLINE bool wraps_without_division(Wrap wrap, int32_t extent) {
    return wrap == Wrap::ClampToEdge || ((wrap == Wrap::Repeat || wrap == Wrap::MirroredRepeat) && is_power_of_two(extent));
}

/// Whether sample_packed_probes takes these lookups. Depends on texture and sampler alone, so that what is counted is what is sampled.
HWY_INLINE bool takes_packed_probes(const Texture& texture, const SamplerState& sampler) {
    const LevelTable& table = texture.levels();
    return texture.texel_layout().storage == StorageClass::Packed32 && sampler.magnify == Kernel::Bilinear &&
           sampler.minify == Kernel::Bilinear && sampler.precision == Precision::Exact &&
           wraps_without_division(sampler.wrap_s, table.width[0]) && wraps_without_division(sampler.wrap_t, table.height[0]);
}

/// Indices of a probe's four texels, and its fractions.
struct ProbeTexels {
    IntVec upper_left, upper_right, lower_left, lower_right;
    FloatVec x, y;
};

HWY_INLINE ProbeTexels texels_of(IntVec offset, IntVec left, IntVec right, IntVec upper, IntVec lower, FloatVec x, FloatVec y) {
    const auto above = hn::Add(offset, upper), below = hn::Add(offset, lower);
    return {hn::Add(above, left), hn::Add(above, right), hn::Add(below, left), hn::Add(below, right), x, y};
}

template <bool repeats>
HWY_INLINE ProbeTexels probe_texels(const ProbeLevel& level, FloatVec place) {
    if constexpr (!repeats) {
        const ProbeTaps s = probe_taps(level.s, place), t = probe_taps(level.t, place);
        return texels_of(level.offset, column_offset_v<kPacked>(s.first), column_offset_v<kPacked>(s.second),
                         row_offset_v<kPacked>(t.first, level.row_stride), row_offset_v<kPacked>(t.second, level.row_stride), s.fraction,
                         t.fraction);
    }
    const IntTag di;
    IntVec column, row;
    FloatVec x, y;
    split_place(level.s, place, column, x);
    split_place(level.t, place, row, y);
    const auto left = column_offset_v<kPacked>(hn::And(column, level.s.last));
    const auto upper = row_offset_v<kPacked>(hn::And(row, level.t.last), level.row_stride);
    const auto next = [&](IntVec here, IntVec others, IntVec bits, FloatVec fraction) HWY_ATTR {
        const auto after = hn::And(hn::Add(hn::Or(here, others), hn::Set(di, 1)), bits);
        return hn::IfThenElse(is_zero(fraction), here, after);
    };
    const auto right = next(left, hn::Set(di, kRowsOfPage), level.column_bits, x);
    const auto lower = next(upper, level.other_rows, level.row_bits, y);
    return texels_of(level.offset, left, right, upper, lower, x, y);
}

struct PackedWords {
    WordVec upper_left, upper_right, lower_left, lower_right;
    FloatVec x, y;
};

/// A probe, bilinear, in stored numbers.
template <PackedFields fields>
HWY_INLINE void filter_packed(const PackedDecoder<fields>& decoder, const PackedWords& words, FloatVec (&mean)[4]) {
    FloatVec left[4], right[4], above[4];
    decoder.numbers(words.upper_left, left);
    decoder.numbers(words.upper_right, right);
    for (int c = 0; c < 4; ++c) above[c] = lerp(words.x, left[c], right[c]);
    decoder.numbers(words.lower_left, left);
    decoder.numbers(words.lower_right, right);
    for (int c = 0; c < 4; ++c) mean[c] = lerp(words.y, above[c], lerp(words.x, left[c], right[c]));
}

/// The running mean over probes of one level, in stored numbers.
template <bool repeats, PackedFields fields>
HWY_INLINE void sample_packed_level(const Texture& texture, const ProbeLevel& level, const ProbePlaces& places, FloatVec (&mean)[4]) {
    const PackedDecoder<fields> decoder(texture.texel_layout());
    const auto* const base = reinterpret_cast<const uint32_t*>(texture.texels());
    auto m0 = hn::Zero(FloatTag()), m1 = m0, m2 = m0, m3 = m0;
    for (int n = 0; n < places.most; ++n) {
        const ProbeTexels at = probe_texels<repeats>(level, places.place(n));
        const PackedWords words{gather_from(base, at.upper_left),
                                gather_from(base, at.upper_right),
                                gather_from(base, at.lower_left),
                                gather_from(base, at.lower_right),
                                at.x,
                                at.y};
        // The share of probe 0 is 1, so the mean starts with it.
        const auto share = places.share(n);
        FloatVec probe[4];
        filter_packed(decoder, words, probe);
        m0 = lerp(share, m0, probe[0]), m1 = lerp(share, m1, probe[1]), m2 = lerp(share, m2, probe[2]), m3 = lerp(share, m3, probe[3]);
    }
    mean[0] = m0, mean[1] = m1, mean[2] = m2, mean[3] = m3;
}

/// All probes of the wave: means of both levels, mixed. Mixing their means is mixing every probe, for a lane's fraction is one.
template <bool repeats, PackedFields fields>
HWY_NOINLINE void sample_packed_wave(const Texture& texture, const SamplerState& sampler, const LevelChoice& choice,
                                     const ProbeChoice& probes, const WavePosition& centre, WaveColor& out) {
    const FloatTag d;
    const PackedDecoder<fields> decoder(texture.texel_layout());
    const ProbeTable& table = sampler.probe_variance > 0 ? gaussian_probes() : uniform_probes();
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const ProbePlaces places(table, hn::Load(IntTag(), probes.count.lane + i));
        const auto fraction = hn::Load(d, choice.fraction.lane + i);
        FloatVec mean[4], coarse[4];
        sample_packed_level<repeats, fields>(texture, probe_level(texture.levels(), sampler, centre, probes, choice.finer, i), places,
                                             mean);
        if (!hn::AllTrue(d, hn::Eq(fraction, hn::Zero(d)))) {
            sample_packed_level<repeats, fields>(texture, probe_level(texture.levels(), sampler, centre, probes, choice.coarser, i), places,
                                                 coarse);
            for (int c = 0; c < 4; ++c) mean[c] = lerp(fraction, mean[c], coarse[c]);
        }
        for (int c = 0; c < 4; ++c) hn::Store(decoder.value(c, mean[c]), d, out.channel[c].lane + i);
    }
}

/// The weighted mean of each lane's probes, where takes_packed_probes says so; arguments as of sample_levels.
template <class Count>
HWY_INLINE void sample_packed_probes(Texture& texture, const SamplerState& sampler, const LevelChoice& choice, const ProbeChoice& probes,
                                     const WavePosition& centre, WaveMask mask, Count& count, WaveColor& out) {
    if constexpr (!Count::kReads) return prepare_packed_probes(texture, sampler, choice, probes, centre, mask, count);
    const auto ready = [&](const WaveInt& level) HWY_ATTR {
        return (levels_read(level) & ~texture.ready_levels()) == 0 || surely_ready(texture, sampler, level, probes, centre);
    };
    if (!ready(choice.finer) || !ready(choice.coarser)) {
        prepare_packed_probes(texture, sampler, choice, probes, centre, mask, count);
    }
    const bool repeats = sampler.wrap_s == Wrap::Repeat && sampler.wrap_t == Wrap::Repeat;
    with_fields(texture.texel_layout().fields, [&](auto constant) HWY_ATTR {
        constexpr PackedFields kFields = decltype(constant)::value;
        if (repeats) return sample_packed_wave<true, kFields>(texture, sampler, choice, probes, centre, out);
        sample_packed_wave<false, kFields>(texture, sampler, choice, probes, centre, out);
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_PACKED_PROBES_INL_H_
