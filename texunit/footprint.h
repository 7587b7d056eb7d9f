// The footprints of a wave: what a lookup decides before it touches a texel. For tools and tests; lookups decide it on their way.
#pragma once

#include "texunit/sample.h"

namespace rawtexel::texunit {

struct WaveFootprint {
    WaveFloat lod;             ///< lambda after bias and bounds, clamped to the levels there are
    WaveFloat anisotropy;      ///< eta: ratio of the axes, at most SamplerState::probes; of SamplerState::ellipse at most 64
    WaveInt finer, coarser;    ///< levels read; coarser = finer where one is
    WaveFloat fraction;        ///< share of the coarser level
    WaveMask magnify = 0;      ///< lanes that use the magnification kernel
    WaveInt probes;            ///< 1..64
    WaveFloat axis_u, axis_v;  ///< the probes' line (texunit/probe_table.h), 0 for a single probe
};

/// The same bits as sample_wave's own decisions, but of `ellipse`, which has a level of its own. Kernels and wraps other than
/// ClampToBorder have no say.
void measure_footprint(const LevelTable& table, const SamplerState& sampler, const WaveCoordinates& at, WaveFootprint& out);

/// Gives every lane the coarse derivatives of its 2x2 quad, as GPUs form them (Vulkan "Derivative Operations", DPdxCoarse and DPdyCoarse):
/// differences between the quad's upper left lane and its right and lower neighbours. `u` and `v` are coordinates of full quads.
void set_quad_derivatives(WaveCoordinates& at);

}  // namespace rawtexel::texunit
