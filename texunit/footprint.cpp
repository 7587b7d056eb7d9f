#include "texunit/footprint.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "texunit/footprint.cpp"
#include <hwy/foreach_target.h>

#include "texunit/anisotropy-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {

void measure(const LevelTable& table, const SamplerState& sampler, const WaveCoordinates& at, WaveFootprint& out) {
    LevelChoice choice;
    if (sampler.probes > 1 || sampler.probe_variance > 0) {
        ProbeChoice probes;
        select_footprint(table, sampler, at, choice, probes);
        out.anisotropy = probes.anisotropy, out.probes = probes.count;
        out.axis_u = probes.axis_u, out.axis_v = probes.axis_v;
    } else {
        select_levels(table, sampler, at, choice);
        out.axis_u = {}, out.axis_v = {};
        std::fill(out.anisotropy.lane, out.anisotropy.lane + kWaveLanes, 1.0f);
        std::fill(out.probes.lane, out.probes.lane + kWaveLanes, 1);
    }
    out.lod = choice.lod, out.finer = choice.finer, out.coarser = choice.coarser;
    out.fraction = choice.fraction, out.magnify = choice.magnify;
    if (sampler.ellipse > 0) {
        SamplerState probing = sampler;
        probing.probes = kMostProbes;
        ProbeChoice line;
        select_footprint(table, probing, at, choice, line);
        out.anisotropy = line.anisotropy;
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rawtexel::texunit {

HWY_EXPORT(measure);

void measure_footprint(const LevelTable& table, const SamplerState& sampler, const WaveCoordinates& at, WaveFootprint& out) {
    HWY_DYNAMIC_DISPATCH(measure)(table, sampler, at, out);
}

void set_quad_derivatives(WaveCoordinates& at) {
    constexpr int kRight = 1, kDown = kWaveWidth;
    for (int lane = 0; lane < kWaveLanes; ++lane) {
        const int quad = lane & ~(kRight | kDown);
        at.dudx[lane] = at.u[quad + kRight] - at.u[quad];
        at.dvdx[lane] = at.v[quad + kRight] - at.v[quad];
        at.dudy[lane] = at.u[quad + kDown] - at.u[quad];
        at.dvdy[lane] = at.v[quad + kDown] - at.v[quad];
    }
}

}  // namespace rawtexel::texunit
#endif
