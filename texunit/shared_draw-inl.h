// Draws of lookups that share their numbers, and the list of all that they can draw. Meaning: texunit/shared_draw.h.
#include "texunit/draw_lanes-inl.h"
#include "texunit/number_cells.h"
#include "texunit/shared_draw.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cassert>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_SHARED_DRAW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_SHARED_DRAW_INL_H_
#undef RAWTEXEL_TEXUNIT_SHARED_DRAW_INL_H_
#else
#define RAWTEXEL_TEXUNIT_SHARED_DRAW_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE bool has_negative_lobes(const SamplerState& sampler) {
    return sampler.ellipse <= 0 && !(weighs_as_probability(sampler.magnify) && weighs_as_probability(sampler.minify));
}

/// A set ready to be drawn from.
struct DrawnSet {
    HWY_INLINE explicit DrawnSet(const LookupSet& set) : mask(set.mask), count(set.count) {
        for (int k = 0; k < count; ++k) {
            const SharedLookup& from = set.lookup[k];
            if (HWY_UNLIKELY(from.solid != nullptr || from.layer != nullptr)) {
                find_place(from, k);
            } else {
                lookup[k] = flat_lookup(*from.levels, *from.sampler, *from.at);
            }
        }
    }
    DrawnSet(const DrawnSet&) = delete;

    const WaveMask mask;
    const int count;
    DrawnLookup lookup[kMostSharedLookups];

  private:
    HWY_NOINLINE void find_place(const SharedLookup& from, int k) {
        assert(from.solid == nullptr || from.sampler->is_isotropic());
        if (from.cube) {
            lookup[k] = cube_lookup(*from.levels, *from.sampler, *from.solid, mask, from.layer, from.layers, solid_[k]);
        } else if (from.solid != nullptr) {
            lookup[k] = volume_lookup(*from.levels, *from.sampler, *from.solid, solid_[k]);
        } else {
            lookup[k] = flat_lookup(*from.levels, *from.sampler, *from.at);
            select_layers(*from.layer, mask, from.layers, solid_[k].cube.slice);
            lookup[k].position.slice = &solid_[k].cube.slice;
        }
    }

    SolidCoordinates solid_[kMostSharedLookups];
};

HWY_INLINE bool has_negative_lobes(const DrawnSet& set) {
    return std::any_of(set.lookup, set.lookup + set.count, [](const DrawnLookup& l) { return has_negative_lobes(*l.sampler); });
}

/// The slices that a lookup draws from.
HWY_INLINE WaveInt slice_of(const DrawnLookup& lookup) {
    return HWY_UNLIKELY(lookup.position.slice != nullptr) ? *lookup.position.slice : WaveInt{};
}

/// A texel of one lookup.
HWY_INLINE void draw_one(const DrawnSet& set, int k, const DrawNumbers& numbers, Lobes lobes, const LobeMass& mass, TexelDraw& draw) {
    const DrawnLookup& lookup = set.lookup[k];
    draw.slice = slice_of(lookup);
    draw_lanes(lookup, set.mask, numbers, lobes, mass, draw);
}

/// One texel of each lookup.
HWY_INLINE void draw_each(const DrawnSet& set, const DrawNumbers& numbers, Lobes lobes, const LobeMass& mass, TexelDraw* draw) {
    for (int k = 0; k < set.count; ++k) draw_one(set, k, numbers, lobes, mass, draw[k]);
}

/// Lane by lane the larger of both.
HWY_INLINE void keep_larger(const WaveFloat& other, WaveFloat& largest) {
    const FloatTag d;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d))
        hn::Store(hn::Max(hn::Load(d, largest.lane + i), hn::Load(d, other.lane + i)), d, largest.lane + i);
}

/// A texel of each lookup's positive weights, and the largest mass of negative ones.
HWY_NOINLINE inline void draw_positive(const DrawnSet& set, const DrawNumbers& numbers, TexelDraw* draw, WaveFloat& mass) {
    mass = {};
    for (int k = 0; k < set.count; ++k) {
        WaveFloat own;
        draw_one(set, k, numbers, Lobes::Positive, {nullptr, &own}, draw[k]);
        keep_larger(own, mass);
    }
}

/// The largest mass of negative weights at the level and the probe that the numbers choose.
HWY_INLINE void find_mass(const DrawnSet& set, const DrawNumbers& numbers, WaveFloat& mass) {
    TexelDraw draw[kMostSharedLookups];
    draw_positive(set, numbers, draw, mass);
}

HWY_INLINE WaveMask lanes_above_zero(const WaveFloat& values) {
    const FloatTag d;
    WaveMask lanes = 0;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) lanes |= wave_mask(d, hn::Load(d, values.lane + i) > hn::Zero(d), i);
    return lanes;
}

/// factor*(value + addend), lane by lane.
HWY_INLINE void set_weight(const WaveFloat& value, float addend, float factor, WaveFloat& weight) {
    const FloatTag d;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto sum = hn::Add(hn::Load(d, value.lane + i), hn::Set(d, addend));
        hn::Store(hn::Mul(sum, hn::Set(d, factor)), d, weight.lane + i);
    }
}

/// use(tap) of one draw.
template <class Use>
HWY_INLINE void draw_set(const LookupSet& lookups, const DrawNumbers& positive, const DrawNumbers& negative, const Use& use) {
    const DrawnSet set(lookups);
    SharedTap tap;
    tap.lanes = set.mask;
    if (!has_negative_lobes(set)) {
        std::fill_n(tap.weight.lane, kWaveLanes, 1.0f);
        draw_each(set, positive, Lobes::Positive, {}, tap.draw);
        return use(tap);
    }
    WaveFloat mass;
    if (set.lookup[0].sampler->estimator == Estimator::AbsWeight) {
        for (int k = 0; k < set.count; ++k)
            draw_one(set, k, positive, Lobes::Magnitude, {nullptr, k == 0 ? &tap.weight : nullptr}, tap.draw[k]);
        return use(tap);
    }
    draw_positive(set, positive, tap.draw, mass);
    set_weight(mass, 1.0f, 1.0f, tap.weight);
    use(tap);
    tap.lanes = set.mask & lanes_above_zero(mass);
    if (tap.lanes == 0) return;
    draw_each(set, negative, Lobes::Negative, {&mass, nullptr}, tap.draw);
    set_weight(mass, 0.0f, -1.0f, tap.weight);
    use(tap);
}

// --- the steps of the inverse distributions, lane by lane

HWY_INLINE void step_levels(const LevelChoice& choice, WaveMask mask, NumberCells& cells) {
    for (WaveMask rest = mask; rest != 0; rest &= rest - 1) {
        const auto lane = int(hwy::Num0BitsBelowLS1Bit_Nonzero32(rest));
        cells.add_step(lane, choice.fraction[lane]);
    }
}

HWY_INLINE void step_probes(const SamplerState& sampler, const ProbeChoice& probes, WaveMask mask, NumberCells& cells) {
    const bool equal_weights = sampler.probe_variance <= 0;
    for (WaveMask rest = mask; rest != 0; rest &= rest - 1) {
        const auto lane = int(hwy::Num0BitsBelowLS1Bit_Nonzero32(rest));
        const int count = probes.count[lane];
        float before = 0;
        for (int n = 1; n < count; ++n) {
            before += gaussian_probes().weight[size_t(kMostProbes * count + n - 1)];
            cells.add_step(lane, equal_weights ? float(n) / float(count) : before);
        }
    }
}

HWY_INLINE void step_signs(const SignedTaps& taps, Lobes lobes, const WaveFloat* wanted, WaveMask mask, NumberCells& cells) {
    const FloatTag d;
    WaveFloat share[kVolumePatterns];
    const int count = sign_patterns(taps);
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const SignShares shares = sign_shares(taps, lobes, wanted, i);
        for (int n = 0; n < count; ++n) hn::Store(shares.share[n], d, share[n].lane + i);
    }
    for (WaveMask rest = mask; rest != 0; rest &= rest - 1) {
        const auto lane = int(hwy::Num0BitsBelowLS1Bit_Nonzero32(rest));
        float before = 0;
        for (int n = 0; n + 1 < count; ++n) cells.add_step(lane, before += share[n][lane]);
    }
}

template <class Probabilities>
HWY_INLINE void step_axis(const AxisTaps& taps, const Probabilities& probabilities, WaveMask mask, NumberCells& cells) {
    const FloatTag d;
    WaveFloat sum;
    for (int k = 0; k + 1 < taps.count; ++k) {
        for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
            const auto before = k == 0 ? hn::Zero(d) : hn::Load(d, sum.lane + i);
            hn::Store(hn::Add(before, probabilities(hn::Load(d, taps.weight[k].lane + i), i)), d, sum.lane + i);
        }
        for (WaveMask rest = mask; rest != 0; rest &= rest - 1) {
            const auto lane = int(hwy::Num0BitsBelowLS1Bit_Nonzero32(rest));
            cells.add_step(lane, sum[lane]);
        }
    }
}

/// What enumeration goes by.
struct Enumeration {
    const DrawnSet& set;
    Lobes lobes;
    WaveFloat mass{};  ///< of the negative weights, which follows from level and probe alone: both draws share those
};

/// act(lookup, kernel, lanes) for both kernels of each lookup's sampler, where `lanes` use them; `place` of the numbers chosen so far.
template <class Act>
HWY_INLINE void for_each_kernel(const DrawnSet& set, const DrawNumbers& numbers, const Act& act) {
    for (int k = 0; k < set.count; ++k) {
        const DrawnLookup& lookup = set.lookup[k];
        WaveInt level;
        DrawnPlace place(lookup, level);
        draw_place(lookup, numbers, place);
        const WaveMask magnified = place.choice.magnify & set.mask, minified = set.mask & ~magnified;
        if (magnified != 0) act(lookup, lookup.sampler->magnify, place, magnified);
        if (minified != 0) act(lookup, lookup.sampler->minify, place, minified);
    }
}

HWY_NOINLINE inline void find_level_cells(const Enumeration& e, const DrawNumbers& numbers, NumberCells& cells) {
    cells.clear();
    for (int k = 0; k < e.set.count; ++k) {
        const DrawnLookup& lookup = e.set.lookup[k];
        WaveInt level;
        DrawnPlace place(lookup, level);
        draw_place(lookup, numbers, place);
        if (place.choice.mixes) step_levels(place.choice, e.set.mask, cells);
    }
    cells.finish();
}

HWY_NOINLINE inline void find_probe_cells(const Enumeration& e, NumberCells& cells) {
    cells.clear();
    for (int k = 0; k < e.set.count; ++k) {
        const DrawnLookup& lookup = e.set.lookup[k];
        if (lookup.sampler->is_isotropic()) continue;
        LevelChoice choice;
        ProbeChoice probes;
        select_footprint(*lookup.levels, *lookup.sampler, *lookup.at, choice, probes);
        step_probes(*lookup.sampler, probes, e.set.mask, cells);
    }
    cells.finish();
}

HWY_NOINLINE inline void find_sign_cells(const Enumeration& e, const DrawNumbers& numbers, NumberCells& cells) {
    cells.clear();
    for_each_kernel(e.set, numbers, [&](const DrawnLookup& lookup, const Kernel& kernel, const DrawnPlace& place, WaveMask lanes) HWY_ATTR {
        if (weighs_as_probability(kernel)) return;
        SignedTaps taps;
        select_signed_axes(lookup, kernel, place, taps);
        step_signs(taps, e.lobes, &e.mass, lanes, cells);
    });
    cells.finish();
}

/// Cells of the numbers that choose a texel along each axis.
struct TexelCells {
    NumberCells x, y, z;
};

/// Beyond a cube map's corner one texel of three is drawn.
HWY_INLINE void step_corners(const TextureTaps& taps, WaveMask mask, NumberCells& cells) {
    const auto leaving = [](const AxisTaps& axis) {
        WaveMask lanes = 0;
        for (int k = 0; k < axis.count; ++k) lanes |= axis.outside[k];
        return lanes;
    };
    for (WaveMask rest = mask & leaving(taps.x) & leaving(taps.y); rest != 0; rest &= rest - 1) {
        const auto lane = int(hwy::Num0BitsBelowLS1Bit_Nonzero32(rest));
        cells.add_step(lane, 1.0f / 3);
        cells.add_step(lane, 2.0f / 3);
    }
}

HWY_NOINLINE inline void find_texel_cells(const Enumeration& e, const DrawNumbers& numbers, TexelCells& cells) {
    for (NumberCells* axis : {&cells.x, &cells.y, &cells.z}) axis->clear();
    for_each_kernel(e.set, numbers, [&](const DrawnLookup& lookup, const Kernel& kernel, const DrawnPlace& place, WaveMask lanes) HWY_ATTR {
        SignedTaps taps;
        if (weighs_as_probability(kernel)) {
            select_axes(lookup, kernel, place, taps);
            step_axis(taps.x, AsProbabilities(), lanes, cells.x);
            step_axis(taps.y, AsProbabilities(), lanes, cells.y);
            if (taps.volume) step_axis(taps.z, AsProbabilities(), lanes, cells.z);
        } else {
            select_signed_axes(lookup, kernel, place, taps);
            const DrawnSigns signs = draw_signs(taps, e.lobes, {&e.mass, nullptr}, numbers.sign);
            step_axis(taps.x, OfOneSign(taps.sums_x, signs.negative_x), lanes, cells.x);
            step_axis(taps.y, OfOneSign(taps.sums_y, signs.negative_y), lanes, cells.y);
            if (taps.volume) step_axis(taps.z, OfOneSign(taps.sums_z, signs.negative_z), lanes, cells.z);
        }
        if (lookup.position.cube()) step_corners(taps, lanes, cells.z);
    });
    for (NumberCells* axis : {&cells.x, &cells.y, &cells.z}) axis->finish();
}

HWY_INLINE void multiply(const WaveFloat& a, const WaveFloat& b, WaveFloat& product) {
    const FloatTag d;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d))
        hn::Store(hn::Mul(hn::Load(d, a.lane + i), hn::Load(d, b.lane + i)), d, product.lane + i);
}

/// Calls use(numbers, volume, lanes) for every cell of the numbers' space in which no lookup changes its texel; lanes are those in which
/// the cell has a volume.
template <class Use>
HWY_INLINE void for_each_cell(Enumeration& e, const Use& use) {
    const bool is_signed = has_negative_lobes(e.set);
    NumberCells levels, probes, signs;
    TexelCells texels;
    DrawNumbers numbers{};
    WaveFloat level_volume, probe_volume, sign_volume, slice_volume, row_volume, volume, length;
    find_level_cells(e, numbers, levels);
    for (int l = 0; l < levels.count(); ++l) {
        levels.take(l, numbers.level, level_volume);
        find_probe_cells(e, probes);
        for (int p = 0; p < probes.count(); ++p) {
            probes.take(p, numbers.probe, length);
            multiply(level_volume, length, probe_volume);
            if (is_signed) find_mass(e.set, numbers, e.mass);
            find_sign_cells(e, numbers, signs);
            for (int s = 0; s < signs.count(); ++s) {
                signs.take(s, numbers.sign, length);
                multiply(probe_volume, length, sign_volume);
                find_texel_cells(e, numbers, texels);
                for (int z = 0; z < texels.z.count(); ++z) {
                    texels.z.take(z, numbers.z, length);
                    multiply(sign_volume, length, slice_volume);
                    for (int y = 0; y < texels.y.count(); ++y) {
                        texels.y.take(y, numbers.y, length);
                        multiply(slice_volume, length, row_volume);
                        for (int x = 0; x < texels.x.count(); ++x) {
                            texels.x.take(x, numbers.x, length);
                            multiply(row_volume, length, volume);
                            const WaveMask lanes = e.set.mask & lanes_above_zero(volume);
                            if (lanes != 0) use(numbers, volume, lanes);
                        }
                    }
                }
            }
        }
    }
}

/// The texels of a set's only lookup, an ellipse; one after the other in each lane.
template <class Use>
HWY_INLINE void enumerate_ellipse(const DrawnSet& set, const Use& use) {
    const DrawnLookup& lookup = set.lookup[0];
    SamplerState state = *lookup.sampler;
    state.hybrid_bias = std::numeric_limits<float>::infinity();
    SharedTap tap;
    tap.draw[0].slice = slice_of(lookup);
    for (WaveMask rest = set.mask; rest != 0; rest &= rest - 1) {
        const auto lane = int(hwy::Num0BitsBelowLS1Bit_Nonzero32(rest));
        const EllipseLookup at = ellipse_lookup(*lookup.at, lane);
        double sum = 0;
        for_each_ellipse_texel(*lookup.levels, state, at, [&](const EllipseChunk&, int, float weight) { sum += double(weight); });
        tap.lanes = WaveMask{1} << lane;
        tap.weight = {};
        for_each_ellipse_texel(*lookup.levels, state, at, [&](const EllipseChunk& chunk, int slot, float weight) HWY_ATTR {
            if (weight <= 0) return;
            TexelDraw& draw = tap.draw[0];
            std::fill_n(draw.level.lane, kWaveLanes, chunk.level[slot]);
            std::fill_n(draw.x.lane, kWaveLanes, chunk.x[slot]);
            std::fill_n(draw.y.lane, kWaveLanes, chunk.y[slot]);
            draw.border = (chunk.border >> slot & 1) != 0 ? kWaveFull : 0;
            tap.weight[lane] = float(double(weight) / sum);
            use(tap);
        });
    }
}

/// use(tap) of every tuple.
template <class Use>
HWY_INLINE void enumerate_set(const LookupSet& lookups, const Use& use) {
    assert(can_enumerate(lookups));
    const DrawnSet set(lookups);
    if (set.lookup[0].sampler->ellipse > 0) return enumerate_ellipse(set, use);
    SharedTap tap;
    for (const Lobes lobes : {Lobes::Positive, Lobes::Negative}) {
        if (lobes == Lobes::Negative && !has_negative_lobes(set)) break;
        Enumeration e{.set = set, .lobes = lobes};
        for_each_cell(e, [&](const DrawNumbers& numbers, const WaveFloat& volume, WaveMask lanes) HWY_ATTR {
            tap.lanes = lanes;
            if (lobes == Lobes::Negative) {
                tap.lanes &= lanes_above_zero(e.mass);
                set_weight(e.mass, 0.0f, -1.0f, tap.weight);
            } else {
                set_weight(e.mass, 1.0f, 1.0f, tap.weight);
            }
            if (tap.lanes == 0) return;
            multiply(volume, tap.weight, tap.weight);
            draw_each(set, numbers, lobes, {&e.mass, nullptr}, tap.draw);
            use(tap);
        });
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_SHARED_DRAW_INL_H_
