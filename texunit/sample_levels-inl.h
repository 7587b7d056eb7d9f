// One position of a lookup on this instruction set, levels and kernels chosen: select -> fetch -> filter in each level, then mix.
#include "texunit/count-inl.h"
#include "texunit/filter-inl.h"
#include "texunit/footprint-inl.h"
#include "texunit/packed_bilinear-inl.h"
#include "texunit/wide_filter-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_SAMPLE_LEVELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_SAMPLE_LEVELS_INL_H_
#undef RAWTEXEL_TEXUNIT_SAMPLE_LEVELS_INL_H_
#else
#define RAWTEXEL_TEXUNIT_SAMPLE_LEVELS_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// 1 - fraction and fraction; of a kernel of one tap 1.
template <int W>
HWY_INLINE void narrow_weights(const WaveFloat& fraction, WaveFloat (&weight)[W]) {
    const FloatTag d;
    const auto one = hn::Set(d, 1.0f);
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        if constexpr (W == 1) {
            hn::Store(one, d, weight[0].lane + i);
        } else {
            const auto second = hn::Load(d, fraction.lane + i);
            hn::Store(hn::Sub(one, second), d, weight[0].lane + i);
            hn::Store(second, d, weight[1].lane + i);
        }
    }
}

/// Tells a listener of the taps of the lanes of `mask`. `scale` is the weight of a slice of a volume, else null.
template <int W, class Count>
HWY_NOINLINE void hear_taps(const LevelTable& table, const TapWave<W>& taps, bool cube, const WaveFloat* scale, WaveMask mask,
                            Count& count) {
    WaveFloat weight_x[W], weight_y[W];
    narrow_weights(taps.fraction_x, weight_x);
    narrow_weights(taps.fraction_y, weight_y);
    const auto axis = [&](const WaveInt(&texel)[W], const WaveFloat(&weight)[W], const WaveMask(&outside)[W]) {
        return AxisView{W, texel, weight, taps.leaves ? outside : nullptr};
    };
    hear_grid({axis(taps.x, weight_x, taps.outside_x), axis(taps.y, weight_y, taps.outside_y), taps.level, taps.slice, scale, 0,
               cube ? table.width.data() : nullptr},
              mask, count);
}

/// Fetches taps and filters them.
template <StorageClass storage, int W>
HWY_INLINE void read_flat_taps(Texture& texture, const SamplerState& sampler, bool cube, const TapWave<W>& taps, WaveColor& out) {
    if constexpr (storage == StorageClass::Packed32 && W == 2) {
        if (!taps.leaves) return filter_packed_bilinear(texture, sampler.reads_alpha, taps, out);
    }
    TexelWave<W * W> texels;
    fetch<storage>(texture, sampler.border, cube, taps, texels);
    filter<storage>(taps, texels, out);
}

/// One level of a 2-D texture or a cube map through a kernel of W taps an axis.
template <StorageClass storage, int W, class Count>
HWY_INLINE void sample_flat_level(Texture& texture, const SamplerState& sampler, const WavePosition& at, const WaveInt& level,
                                  WaveMask nearest, WaveMask counted, Count& count, WaveColor& out) {
    TapWave<W> taps;
    select_taps(texture.levels(), sampler, at, level, nearest, taps);
    if constexpr (Count::kReads) {
        read_flat_taps<storage>(texture, sampler, at.cube(), taps, out);
    } else {
        hear_taps(texture.levels(), taps, at.cube(), nullptr, counted, count);
    }
}

/// One level of a volume: its one or two slices, each filtered as a 2-D texture.
template <StorageClass storage, int W, class Count>
HWY_NOINLINE void sample_volume_level(Texture& texture, const SamplerState& sampler, const WavePosition& at, const WaveInt& level,
                                      WaveMask nearest, WaveMask counted, Count& count, WaveColor& out) {
    const LevelTable& table = texture.levels();
    WaveInt slice[W];
    WaveFloat fraction, weight[W];
    WaveMask outside[W] = {};
    select_axis(edge_rule(sampler.wrap_r), *at.w, table.depth, level, nearest, slice, fraction, {sampler.precision, nullptr}, outside);
    narrow_weights(fraction, weight);

    TapWave<W> taps;
    select_taps(table, sampler, at, level, nearest, taps);
    if (!taps.leaves) {
        std::fill(taps.outside_x, taps.outside_x + W, WaveMask{0});
        std::fill(taps.outside_y, taps.outside_y + W, WaveMask{0});
    }
    WaveColor colour[W];
    for (int n = 0; n < W; ++n) {
        TapWave<W> in_slice = taps;
        in_slice.slice = &slice[n];
        in_slice.leaves = taps.leaves || outside[n] != 0;
        for (WaveMask& lanes : in_slice.outside_x) lanes |= outside[n];
        const WaveMask weighing = weighing_lanes(weight[n], kWaveFull);
        if constexpr (Count::kReads) {
            if (weighing == 0) {
                colour[n] = colour[0];
                continue;
            }
            TexelWave<W * W> texels;
            fetch<storage>(texture, sampler.border, false, in_slice, texels);
            filter<storage>(in_slice, texels, colour[n]);
        } else if (weighing != 0) {
            hear_taps(table, in_slice, false, &weight[n], counted & weighing, count);
        }
    }
    if constexpr (!Count::kReads) return;
    out = colour[0];
    if constexpr (W == 2) mix_levels<storage>(fraction, colour[1], out);
}

/// One level through a kernel of any width.
template <StorageClass storage, class Count>
HWY_NOINLINE void sample_wide_level(Texture& texture, const SamplerState& sampler, const Kernel& kernel, const WavePosition& at,
                                    const WaveInt& level, WaveMask counted, Count& count, WaveColor& out) {
    const LevelTable& table = texture.levels();
    WideTaps taps;
    taps.level = &level;
    taps.slice = at.slice;
    taps.cube = at.cube();
    taps.volume = at.w != nullptr;
    select_wide_axis(kernel, rule_of(at, sampler.wrap_s), *at.u, table.width, level, {sampler.precision, at.u_rest}, taps.x);
    select_wide_axis(kernel, rule_of(at, sampler.wrap_t), *at.v, table.height, level, {sampler.precision, at.v_rest}, taps.y);
    if (taps.volume) {
        select_wide_axis(kernel, edge_rule(sampler.wrap_r), *at.w, table.depth, level, {sampler.precision, nullptr}, taps.z);
    }
    if constexpr (Count::kReads) {
        filter_wide<storage>(texture, sampler.border, taps, out);
    } else {
        TapGrid grid{view(taps.x), view(taps.y), &level, at.slice, nullptr, 0, taps.cube ? table.width.data() : nullptr};
        if (!taps.volume) return hear_grid(grid, counted, count);
        for (int z = 0; z < taps.z.count; ++z) {
            grid.slice = &taps.z.texel[z];
            grid.scale = &taps.z.weight[z];
            grid.outside_slice = taps.z.leaves ? taps.z.outside[z] : 0;
            hear_grid(grid, counted, count);
        }
    }
}

/// Both levels of a choice, each by `sample_level(level, lanes that count, colour)`, mixed.
template <StorageClass storage, class Count, class SampleLevel>
HWY_INLINE void mix_sampled_levels(const LevelChoice& choice, WaveMask mask, Count& count, WaveColor& out,
                                   const SampleLevel& sample_level) {
    begin_level(choice.fraction, false, count);
    sample_level(choice.finer, mask, out);
    if (!choice.mixes) return;
    const FloatTag d;
    WaveMask mixing = 0;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        mixing |= wave_mask(d, hn::Ne(hn::Load(d, choice.fraction.lane + i), hn::Zero(d)), i);
    }
    WaveColor coarser;
    begin_level(choice.fraction, true, count);
    sample_level(choice.coarser, mask & mixing, coarser);
    if constexpr (Count::kReads) mix_levels<storage>(choice.fraction, coarser, out);
}

/// Kernels of at most W = 1 or 2 taps an axis; `nearest` lanes take one.
template <StorageClass storage, int W, class Count>
HWY_NOINLINE void sample_narrow(Texture& texture, const SamplerState& sampler, const WavePosition& at, const LevelChoice& choice,
                                WaveMask nearest, WaveMask mask, Count& count, WaveColor& out) {
    mix_sampled_levels<storage>(
        choice, mask, count, out, [&](const WaveInt& level, WaveMask counted, WaveColor& colour) HWY_ATTR __attribute__((always_inline)) {
            if (at.w != nullptr) return sample_volume_level<storage, W>(texture, sampler, at, level, nearest, counted, count, colour);
            sample_flat_level<storage, W>(texture, sampler, at, level, nearest, counted, count, colour);
        });
}

template <StorageClass storage, class Count>
HWY_NOINLINE void sample_wide(Texture& texture, const SamplerState& sampler, const Kernel& kernel, const WavePosition& at,
                              const LevelChoice& choice, WaveMask mask, Count& count, WaveColor& out) {
    mix_sampled_levels<storage>(choice, mask, count, out, [&](const WaveInt& level, WaveMask counted, WaveColor& colour) HWY_ATTR {
        sample_wide_level<storage>(texture, sampler, kernel, at, level, counted, count, colour);
    });
}

constexpr bool is_narrow(const Kernel& kernel) { return kernel.kind == KernelKind::Nearest || kernel.kind == KernelKind::Bilinear; }

/// One kernel for all lanes.
template <StorageClass storage, class Count>
HWY_INLINE void sample_kernel(Texture& texture, const SamplerState& sampler, const Kernel& kernel, const WavePosition& at,
                              const LevelChoice& choice, WaveMask mask, Count& count, WaveColor& out) {
    if (kernel.kind == KernelKind::Nearest) {
        sample_narrow<storage, 1>(texture, sampler, at, choice, kWaveFull, mask, count, out);
    } else if (kernel.kind == KernelKind::Bilinear) {
        sample_narrow<storage, 2>(texture, sampler, at, choice, 0, mask, count, out);
    } else {
        sample_wide<storage>(texture, sampler, kernel, at, choice, mask, count, out);
    }
}

/// The lanes of `mask` by themselves: the others repeat one of them.
template <StorageClass storage, class Count>
HWY_NOINLINE void sample_lanes_apart(Texture& texture, const SamplerState& sampler, const Kernel& kernel, const WavePosition& at,
                                     const LevelChoice& choice, WaveMask mask, Count& count, WaveColor& out) {
    WaveFloat u, v, w, u_rest, v_rest;
    WaveInt slice;
    WavePosition apart = at;
    const auto repeat = [&](const auto*& lanes, auto& filled) HWY_ATTR {
        if (lanes == nullptr) return;
        repeat_first(*lanes, mask, filled);
        lanes = &filled;
    };
    repeat(apart.u, u);
    repeat(apart.v, v);
    repeat(apart.w, w);
    repeat(apart.u_rest, u_rest);
    repeat(apart.v_rest, v_rest);
    repeat(apart.slice, slice);
    LevelChoice levels = choice;
    repeat_first(choice.finer, mask, levels.finer);
    repeat_first(choice.coarser, mask, levels.coarser);
    repeat_first(choice.fraction, mask, levels.fraction);
    sample_kernel<storage>(texture, sampler, kernel, apart, levels, mask, count, out);
}

/// Magnified lanes through one kernel, minified ones through another.
template <StorageClass storage, class Count>
HWY_NOINLINE void sample_two_kernels(Texture& texture, const SamplerState& sampler, const WavePosition& at, const LevelChoice& choice,
                                     WaveMask mask, Count& count, WaveColor& out) {
    const WaveMask magnified = choice.magnify & mask, minified = mask & ~choice.magnify;
    if (minified == 0) return sample_kernel<storage>(texture, sampler, sampler.magnify, at, choice, mask, count, out);
    if (magnified == 0) return sample_kernel<storage>(texture, sampler, sampler.minify, at, choice, mask, count, out);
    if (is_narrow(sampler.magnify) && is_narrow(sampler.minify)) {
        return sample_narrow<storage, 2>(texture, sampler, at, choice, nearest_lanes(sampler, choice), mask, count, out);
    }
    WaveColor small;
    sample_lanes_apart<storage>(texture, sampler, sampler.magnify, at, choice, magnified, count, out);
    sample_lanes_apart<storage>(texture, sampler, sampler.minify, at, choice, minified, count, small);
    if constexpr (!Count::kReads) return;
    const FloatTag d;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto lanes = lanes_of(d, magnified, i);
        for (int c = 0; c < 4; ++c) {
            float* const colour = out.channel[c].lane + i;
            hn::Store(hn::IfThenElse(lanes, hn::Load(d, colour), hn::Load(d, small.channel[c].lane + i)), d, colour);
        }
    }
}

template <StorageClass storage, class Count>
HWY_INLINE void sample_stored(Texture& texture, const SamplerState& sampler, const WavePosition& at, const LevelChoice& choice,
                              WaveMask mask, Count& count, WaveColor& out) {
    if (sampler.magnify == sampler.minify) {
        return sample_kernel<storage>(texture, sampler, sampler.magnify, at, choice, mask, count, out);
    }
    sample_two_kernels<storage>(texture, sampler, at, choice, mask, count, out);
}

/// Samples the levels of `choice` at `at` and mixes them: one lookup, or one probe of it. Lanes outside `mask`, which is not 0, repeat an
/// active one in `at` and in `choice`, so that they read what is read anyway; what they get is unspecified but initialised. A policy that
/// does not read leaves `out` alone.
template <class Count>
HWY_INLINE void sample_levels(Texture& texture, const SamplerState& sampler, const WavePosition& at, const LevelChoice& choice,
                              WaveMask mask, Count& count, WaveColor& out) {
    // Who only listens does not care how texels are stored.
    if constexpr (!Count::kReads) return sample_stored<StorageClass::Packed32>(texture, sampler, at, choice, mask, count, out);
    switch (texture.texel_layout().storage) {
        case StorageClass::Packed32: return sample_stored<StorageClass::Packed32>(texture, sampler, at, choice, mask, count, out);
        case StorageClass::Packed64: return sample_stored<StorageClass::Packed64>(texture, sampler, at, choice, mask, count, out);
        case StorageClass::Half4: return sample_stored<StorageClass::Half4>(texture, sampler, at, choice, mask, count, out);
        case StorageClass::Float4: return sample_stored<StorageClass::Float4>(texture, sampler, at, choice, mask, count, out);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_SAMPLE_LEVELS_INL_H_
