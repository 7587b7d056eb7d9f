// One texture lookup for a wave: select taps -> fetch raw texels -> filter. The stages themselves are in select-inl.h, fetch-inl.h and filter-inl.h.
#pragma once

#include "texunit/fetch_log.h"
#include "texunit/sampler.h"
#include "texunit/texture.h"
#include "texunit/wave.h"

namespace rawtexel::texunit {

/// Normalised coordinates and their screen-space derivatives. Non-finite coordinates read as 0, non-finite derivatives as the coarsest level.
struct WaveCoordinates {
    WaveFloat u, v;
    WaveFloat dudx, dvdx, dudy, dvdy;   ///< change of u, v over one pixel to the right, one pixel down
};

/// Samples 2-D `texture` at the lanes of `mask`; linear RGBA into `out`. Level of detail by D3D11.3 7.18.11 / Vulkan 16.5: lambda = log2(max(|d(st)/dx|, |d(st)/dy|)).
/// Dispatches to the best instruction set allowed (texunit/simd.h). `counts` null: nothing is counted.
void sample_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, WaveColor& out,
                 FetchCounts* counts = nullptr);

}  // namespace rawtexel::texunit
