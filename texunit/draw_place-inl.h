// Where a draw picks its texel: the probe and the level, each drawn with a number of its own, in a texture of any shape.
#include "texunit/draw.h"
#include "texunit/footprint-inl.h"
#include "texunit/gather-inl.h"
#include "texunit/probes-inl.h"
#include "texunit/solid-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_DRAW_PLACE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_DRAW_PLACE_INL_H_
#undef RAWTEXEL_TEXUNIT_DRAW_PLACE_INL_H_
#else
#define RAWTEXEL_TEXUNIT_DRAW_PLACE_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The probe that each lane draws: the last one before which the probabilities sum to no more than the lane's number.
HWY_INLINE void draw_probes(const ProbeTable& table, bool equal_weights, const ProbeChoice& probes, const WaveFloat& number,
                            WaveInt& probe) {
    const FloatTag d;
    const IntTag di;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto count = hn::Load(di, probes.count.lane + i);
        const auto random = hn::Load(d, number.lane + i);
        const auto last = hn::Sub(count, hn::Set(di, 1));
        if (equal_weights) {
            // The product may round up to the count.
            hn::Store(hn::Min(hn::ConvertTo(di, hn::Mul(random, hn::ConvertTo(d, count))), last), di, probe.lane + i);
            continue;
        }
        auto drawn = hn::Zero(di);
        auto before = hn::Zero(d);
        const auto first = hn::Mul(count, hn::Set(di, kMostProbes));
        for (int n = 0; n < probes.most; ++n) {
            const auto index = hn::Set(di, n);
            const auto takes = hn::And(hn::RebindMask(di, random >= before), hn::Not(last < index));
            drawn = hn::IfThenElse(takes, index, drawn);
            before = hn::Add(before, gather_from(table.weight.data(), hn::Add(first, hn::Min(index, last))));
        }
        hn::Store(drawn, di, probe.lane + i);
    }
}

/// The level that each lane draws.
HWY_INLINE void draw_levels(const LevelChoice& choice, const WaveFloat& number, WaveInt& level) {
    const FloatTag d;
    const IntTag di;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto coarser = hn::RebindMask(di, hn::Load(d, number.lane + i) < hn::Load(d, choice.fraction.lane + i));
        hn::Store(hn::IfThenElse(coarser, hn::Load(di, choice.coarser.lane + i), hn::Load(di, choice.finer.lane + i)), di, level.lane + i);
    }
}

/// Moves the coordinates to the probe that each lane draws.
HWY_NOINLINE inline void move_to_probes(const SamplerState& sampler, const ProbeChoice& probes, const WaveCoordinates& at,
                                        const WaveFloat& number, WaveFloat& u, WaveFloat& v) {
    const bool equal_weights = sampler.probe_variance <= 0;
    const ProbeTable& table = equal_weights ? uniform_probes() : gaussian_probes();
    WaveInt probe;
    draw_probes(table, equal_weights, probes, number, probe);
    const FloatTag d;
    const IntTag di;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto count = hn::Load(di, probes.count.lane + i);
        const auto index = hn::Add(hn::Mul(count, hn::Set(di, kMostProbes)), hn::Load(di, probe.lane + i));
        // A single probe lies at the centre.
        const auto place = gather_from(table.place.data(), index);
        const auto moved = [&](Wrap wrap, const WaveFloat& from, const WaveFloat& axis) HWY_ATTR {
            return fused_multiply_add(place, hn::Load(d, axis.lane + i), in_period(wrap, hn::Load(d, from.lane + i)));
        };
        hn::Store(moved(sampler.wrap_s, at.u, probes.axis_u), d, u.lane + i);
        hn::Store(moved(sampler.wrap_t, at.v, probes.axis_v), d, v.lane + i);
    }
}

/// A lookup as draws see it, whatever the shape of its texture: flat coordinates, whose derivatives choose the level, and the position
/// among the texels, which of volumes and cube maps is more.
struct DrawnLookup {
    const LevelTable* levels;
    const SamplerState* sampler;
    const WaveCoordinates* at;
    WavePosition position;
};

HWY_INLINE DrawnLookup flat_lookup(const LevelTable& levels, const SamplerState& sampler, const WaveCoordinates& at) {
    return {&levels, &sampler, &at, {.u = &at.u, .v = &at.v}};
}

/// What a volume or a cube map is looked up with instead of its own coordinates.
struct SolidCoordinates {
    WaveCoordinates flat;  ///< of volumes
    CubeCoordinates cube;
};

/// A lookup of a volume; `solid` and `at` outlive it.
HWY_INLINE DrawnLookup volume_lookup(const LevelTable& levels, const SamplerState& sampler, const WaveCoordinates3& at,
                                     SolidCoordinates& solid) {
    solid.flat.u = at.position[0], solid.flat.v = at.position[1];
    flatten_derivatives(levels, sampler.lod_rule, at, solid.flat);
    return {&levels, &sampler, &solid.flat, {.u = &at.position[0], .v = &at.position[1], .w = &at.position[2]}};
}

/// A lookup of a cube map, or with `layer` of one of `cubes`; `solid` outlives it.
HWY_INLINE DrawnLookup cube_lookup(const LevelTable& levels, const SamplerState& sampler, const WaveCoordinates3& directions, WaveMask mask,
                                   const WaveFloat* layer, int cubes, SolidCoordinates& solid) {
    CubeCoordinates& cube = solid.cube;
    project_onto_faces(directions, cube);
    if (layer != nullptr) add_cube(*layer, mask, cubes, cube.slice);
    return {&levels,
            &sampler,
            &cube.face,
            {.u = &cube.face.u, .v = &cube.face.v, .slice = &cube.slice, .u_rest = &cube.u_rest, .v_rest = &cube.v_rest}};
}

/// Where and in which level each lane draws its texel.
struct DrawnPlace {
    DrawnPlace(const DrawnLookup& lookup, WaveInt& drawn_level) : position(&lookup.position), level(drawn_level) {}

    LevelChoice choice;            ///< beside `mixes` and `magnify` set only where there is a choice
    const WavePosition* position;  ///< the lookup's own, or that of its probes
    WaveInt& level;
    WaveFloat probe_u, probe_v;
    WavePosition of_probes;
};

HWY_INLINE void take_base_level(DrawnPlace& place) {
    place.level = {};
    place.choice.magnify = kWaveFull, place.choice.mixes = false;
}

/// The level and the probe, where there is a choice.
HWY_NOINLINE inline void choose_place(const DrawnLookup& lookup, const DrawNumbers& numbers, DrawnPlace& place) {
    const SamplerState& sampler = *lookup.sampler;
    if (!sampler.is_isotropic()) {
        ProbeChoice probes;
        select_footprint(*lookup.levels, sampler, *lookup.at, place.choice, probes);
        if (probes.most > 1) {
            move_to_probes(sampler, probes, *lookup.at, numbers.probe, place.probe_u, place.probe_v);
            place.of_probes = lookup.position;
            place.of_probes.u = &place.probe_u, place.of_probes.v = &place.probe_v;
            place.position = &place.of_probes;
        }
    } else {
        if (magnifies_throughout(*lookup.levels, sampler, *lookup.at)) return take_base_level(place);
        select_levels(*lookup.levels, sampler, *lookup.at, place.choice);
    }
    if (!place.choice.mixes) {
        place.level = place.choice.finer;
        return;
    }
    draw_levels(place.choice, numbers.level, place.level);
}

/// All lanes of the lookup's coordinates are active or repeat one that is.
HWY_INLINE void draw_place(const DrawnLookup& lookup, const DrawNumbers& numbers, DrawnPlace& place) {
    if (!lookup.sampler->is_isotropic() || !needs_no_level(*lookup.sampler, nullptr)) return choose_place(lookup, numbers, place);
    take_base_level(place);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_DRAW_PLACE_INL_H_
