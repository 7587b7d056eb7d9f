// One texture lookup for a wave: select taps -> fetch raw texels -> filter. The stages are in select-inl.h, fetch-inl.h, filter-inl.h.
#pragma once

#include "texunit/fetch_log.h"
#include "texunit/sampler.h"
#include "texunit/texture.h"
#include "texunit/wave.h"

#include <cassert>

namespace rawtexel::texunit {

/// Normalised coordinates and their screen-space derivatives. A coordinate that is not finite reads as 0, a derivative that is not finite
/// means the coarsest level.
struct WaveCoordinates {
    WaveFloat u, v;
    WaveFloat dudx, dvdx, dudy, dvdy;  ///< change of u, v over one pixel to the right, one pixel down
};

/// The same with three components: coordinates u, v, w of a volume, or a direction of any length into a cube map.
struct WaveCoordinates3 {
    WaveFloat position[3];
    WaveFloat dx[3], dy[3];  ///< change over one pixel to the right, one pixel down
};

/// What a lookup may be asked for besides its colour.
struct LookupExtras {
    const WaveFloat* layer =
        nullptr;                    ///< of an array: rounded to the nearest layer, ties to even, and kept within the array. Null: the first
    FetchCounts* counts = nullptr;  ///< added to
    TapSink* sink = nullptr;        ///< told of every tap
    WaveFloat* lod = nullptr;       ///< gets lambda clamped to the levels there are
};

/// Samples 2-D `texture`, or a layer of an array, at the lanes of `mask`; linear RGBA into `out`, whose other lanes are unspecified but
/// initialised. Level of detail by D3D11.3 7.18.11 and Vulkan "Level-of-Detail Operation". Kernels as texunit/kernel.h has them.
/// Precision: with coordinates and texels taken as exact the result is within (taps + 8)*2^-24 of the largest texel read, and 2^-20 of it
/// more where a level fraction enters; for kernels whose weights exceed 1, such as extreme Mitchell ones, times the sum of their weights'
/// magnitudes. The texel-space fraction is good to 2^-24 at any extent, lambda to 2^-21. Taps of weight 0 are neither read nor counted.
/// Nearest and (tri)linear results lie within the taps. The same bits on every instruction set; dispatches to the best one allowed
/// (texunit/simd.h). Throws TextureError when a block it needs is damaged.
void sample_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, WaveColor& out,
                 FetchCounts* counts = nullptr);
void sample_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, WaveColor& out,
                 const LookupExtras& extras);

/// Textures that differ in nothing but their texels, as the maps of a material often do, and what is read of each: none of the others'.
struct AlikeTextures {
    static constexpr int kMost = 8;

    int count = 0;
    Texture* texture[kMost];
    WaveColor* out[kMost];

    void add(Texture& another, WaveColor& to) {
        assert(count < kMost);
        texture[count] = &another;
        out[count++] = &to;
    }
};
/// Whether sample_alike_wave may read the texture through the sampler: a flat one of one layer and of 32 bits a texel, through a bilinear
/// kernel and isotropically.
bool can_sample_alike(const Texture& texture, const SamplerState& sampler);
/// sample_wave of each of at least one texture, all of one shape, to the bit, with levels and taps chosen once. `mask` is not 0. `lod` as
/// in LookupExtras.
void sample_alike_wave(const AlikeTextures& textures, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask,
                       WaveFloat* lod = nullptr);

/// sample_wave for a 3-D texture: SamplerState::wrap_r wraps the third coordinate, every kernel filters along three axes, lambda follows
/// from derivatives of three components (Vulkan "Scale Factor Operation"). Isotropic: `probes` and `ellipse` are not looked at.
void sample_volume_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates3& at, WaveMask mask, WaveColor& out,
                        const LookupExtras& extras = {});

/// The same for a cube map, or with `layer` for one cube of an array. Faces in the order and orientation of D3D and Vulkan; where
/// components tie Z beats Y beats X; derivatives by the quotient rule. Wraps are not looked at: beyond an edge comes the neighbouring face,
/// straight on across as many faces as a kernel reaches, and a tap beyond a corner is the mean of the three texels that meet there.
/// Isotropic.
void sample_cube_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates3& directions, WaveMask mask, WaveColor& out,
                      const LookupExtras& extras = {});

/// What sample_wave would ask for, without reading a texel: adds it to `counter`, or tells `sink` of every tap.
void count_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, FetchCounter& counter,
                WaveFloat* lod = nullptr);
void record_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, TapSink& sink);

}  // namespace rawtexel::texunit
