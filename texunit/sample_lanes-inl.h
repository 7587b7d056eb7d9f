// One lookup for a wave on this instruction set, from coordinates to colour: the definitions behind texunit/sample-inl.h.
#include "texunit/elliptical-inl.h"
#include "texunit/packed_probes-inl.h"
#include "texunit/sample_levels-inl.h"
#include "texunit/solid-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_SAMPLE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_SAMPLE_LANES_INL_H_
#undef RAWTEXEL_TEXUNIT_SAMPLE_LANES_INL_H_
#else
#define RAWTEXEL_TEXUNIT_SAMPLE_LANES_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Nobody asks: nothing is read.
HWY_INLINE void answer_empty_mask(WaveColor& out, WaveFloat* lod) {
    out = {};
    if (lod != nullptr) *lod = {};
}

/// Several probes, or an ellipse, instead of one isotropic lookup.
template <class Count>
HWY_NOINLINE void sample_anisotropic(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, const WavePosition& position,
                                     WaveMask mask, Count& count, WaveColor& out, WaveFloat* lod) {
    if (sampler.ellipse > 0) {
        WaveFloat level;
        return sample_ellipses(texture, sampler, at, position.slice, mask, count, out, lod == nullptr ? level : *lod);
    }
    LevelChoice choice;
    ProbeChoice probes;
    select_footprint(texture.levels(), sampler, at, choice, probes);
    if (lod != nullptr) *lod = choice.lod;
    if (takes_packed_probes(texture, sampler)) return sample_packed_probes(texture, sampler, choice, probes, position, mask, count, out);
    const auto sample_at = [&](const WavePosition& place, WaveMask active, WaveColor& colour)
                               HWY_ATTR { sample_levels(texture, sampler, place, choice, active, count, colour); };
    sample_probes(sampler, probes, position, mask, count, sample_at, out);
}

template <class Count>
HWY_NOINLINE void sample_lanes(Texture& texture, const SamplerState& sampler, const WaveCoordinates& coordinates, WaveMask mask,
                               Count& count, WaveColor& out, WaveFloat* lod, const WaveFloat* layer) {
    if (mask == 0) return answer_empty_mask(out, lod);
    WaveCoordinates filled;
    if (mask != kWaveFull) fill_inactive(coordinates, mask, filled);
    const WaveCoordinates& at = mask == kWaveFull ? coordinates : filled;

    WavePosition position{&at.u, &at.v};
    WaveInt slice;
    if (layer != nullptr) {
        select_layers(*layer, mask, texture.shape().layers, slice);
        position.slice = &slice;
    }
    begin_lookups(texture, mask, count);
    if (!sampler.is_isotropic()) {
        return sample_anisotropic(texture, sampler, at, position, mask, count, out, lod);
    }
    LevelChoice choice;
    choose_levels(texture.levels(), sampler, at, choice, lod);
    sample_levels(texture, sampler, position, choice, mask, count, out);
}

HWY_INLINE void fill_inactive(const WaveCoordinates3& at, WaveMask mask, WaveCoordinates3& filled) {
    for (int axis = 0; axis < 3; ++axis) {
        repeat_first(at.position[axis], mask, filled.position[axis]);
        repeat_first(at.dx[axis], mask, filled.dx[axis]);
        repeat_first(at.dy[axis], mask, filled.dy[axis]);
    }
}

/// Volumes and cube maps are sampled by one isotropic probe.
HWY_INLINE SamplerState isotropic(SamplerState sampler) {
    sampler.probes = 1;
    sampler.probe_variance = 0;
    sampler.ellipse = 0;
    return sampler;
}

template <class Count>
HWY_NOINLINE void sample_volume_lanes(Texture& texture, const SamplerState& sampler, const WaveCoordinates3& coordinates, WaveMask mask,
                                      Count& count, WaveColor& out, WaveFloat* lod) {
    if (mask == 0) return answer_empty_mask(out, lod);
    WaveCoordinates3 at;
    fill_inactive(coordinates, mask, at);
    const SamplerState state = isotropic(sampler);
    LevelChoice choice;
    WaveCoordinates flat{at.position[0], at.position[1], {}, {}, {}, {}};
    if (!needs_no_level(state, lod)) flatten_derivatives(texture.levels(), state.lod_rule, at, flat);
    choose_levels(texture.levels(), state, flat, choice, lod);
    begin_lookups(texture, mask, count);
    sample_levels(texture, state, {.u = &at.position[0], .v = &at.position[1], .w = &at.position[2]}, choice, mask, count, out);
}

template <class Count>
HWY_NOINLINE void sample_cube_lanes(Texture& texture, const SamplerState& sampler, const WaveCoordinates3& directions, WaveMask mask,
                                    Count& count, WaveColor& out, WaveFloat* lod, const WaveFloat* layer) {
    if (mask == 0) return answer_empty_mask(out, lod);
    WaveCoordinates3 at;
    fill_inactive(directions, mask, at);
    CubeCoordinates cube;
    project_onto_faces(at, cube);
    if (layer != nullptr) add_cube(*layer, mask, texture.shape().layers / 6, cube.slice);
    const SamplerState state = isotropic(sampler);
    LevelChoice choice;
    choose_levels(texture.levels(), state, cube.face, choice, lod);
    begin_lookups(texture, mask, count);
    const WavePosition position{.u = &cube.face.u, .v = &cube.face.v, .slice = &cube.slice, .u_rest = &cube.u_rest, .v_rest = &cube.v_rest};
    sample_levels(texture, state, position, choice, mask, count, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_SAMPLE_LANES_INL_H_
