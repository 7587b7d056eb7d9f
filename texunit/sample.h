// One texture lookup for a wave: select taps -> fetch raw texels -> filter. The stages are in select-inl.h, fetch-inl.h, filter-inl.h.
#pragma once

#include "texunit/fetch_log.h"
#include "texunit/sampler.h"
#include "texunit/texture.h"
#include "texunit/wave.h"

namespace rawtexel::texunit {

/// Normalised coordinates and their screen-space derivatives. A coordinate that is not finite reads as 0, a derivative that is not finite
/// means the coarsest level.
struct WaveCoordinates {
    WaveFloat u, v;
    WaveFloat dudx, dvdx, dudy, dvdy;   ///< change of u, v over one pixel to the right, one pixel down
};

/// Samples 2-D `texture` at the lanes of `mask`; linear RGBA into `out`, whose other lanes are unspecified but initialised. Level of detail
/// by D3D11.3 7.18.11 and Vulkan "Level-of-Detail Operation": lambda = log2(max(|d(s, t)/dx|, |d(s, t)/dy|)), s and t in texels of level 0.
/// Precision: the texel-space fraction is good to 2^-23 at any extent, lambda to 2^-21; taps of weight 0 are neither read nor counted, and
/// the result lies within the taps. The same bits on every instruction set; dispatches to the best one allowed (texunit/simd.h).
/// `counts` null: nothing is counted. Throws TextureError when a block it needs is damaged.
void sample_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, WaveColor& out,
                 FetchCounts* counts = nullptr);

}  // namespace rawtexel::texunit
