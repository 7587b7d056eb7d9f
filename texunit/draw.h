// A lookup of one texel, drawn with the probability that its filter weighs it with: filter reservoir sampling (Wyman et al. 2024,
// "Filtering After Shading With Stochastic Texture Filtering"). The mean of many draws is what sample_wave returns.
#pragma once

#include "texunit/random.h"
#include "texunit/sample.h"

namespace rawtexel::texunit {

/// Uniform numbers in [0, 1), one a lane for each choice and independent of each other. Maps that share them read the same texel.
struct DrawNumbers {
    WaveFloat x, y;   ///< the texel along either axis (Dimension::TapX, TapY)
    WaveFloat level;  ///< the coarser level or the finer (Dimension::Level)
    WaveFloat probe;  ///< of an anisotropic lookup (Dimension::Probe)
    WaveFloat sign;   ///< of SignedDraw: which signs the axes' weights have (Dimension::Sign)
};

/// The numbers of a wave whose upper left pixel is (first.x, first.y); first.dimension is not looked at.
void draw_numbers(const RandomAddress& first, DrawNumbers& numbers);
/// Those of the negative weights' texel: its own but for level and probe, which both share.
void negative_draw_numbers(const RandomAddress& first, DrawNumbers& numbers);

/// The texel that each lane drew.
struct TexelDraw {
    WaveInt level, slice, x, y;
    WaveMask border = 0;  ///< lanes that take the border colour
};

/// Positivization of kernels with negative lobes (Wyman et al. 2024): one texel drawn from the positive weights and one from the magnitudes
/// of the negative ones. The lookup's value is positive_weight*S(positive) - negative_weight*S(negative), whatever S makes of a texel; the
/// weights are the sums of either sign, so their difference is 1 and a constant has no variance. Where negative_weight is 0 (on a texel's
/// centre, or for kernels without negative lobes) the negative texel means nothing and may be read all the same.
struct SignedDraw {
    TexelDraw positive, negative;
    WaveFloat positive_weight, negative_weight;
};

/// Whether all weights of the kernel are probabilities. Others need two draws, one for either sign.
bool weighs_as_probability(const Kernel& kernel);

/// Draws for the lanes of `mask` in a 2-D texture, or in `layer` of an array; reads no texel. The kernels' weights are probabilities
/// (asserted), and sampler.ellipse is 0. Levels, probes and kernels are chosen as by sample_wave; other lanes repeat an active one.
void draw_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, const DrawNumbers& numbers,
               TexelDraw& draw, const WaveFloat* layer = nullptr);

/// The same for kernels of any sign, separably: the signs of the two axes are drawn first, then a texel along each from the weights of its
/// sign.
void draw_signed_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, const DrawNumbers& positive,
                      const DrawNumbers& negative, SignedDraw& draw, const WaveFloat* layer = nullptr);

/// The drawn texels, linear RGBA. Throws TextureError as sample_wave does.
void read_drawn_wave(Texture& texture, const SamplerState& sampler, const TexelDraw& draw, WaveColor& out);

/// Both at once.
void sample_drawn_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, const DrawNumbers& numbers,
                       WaveColor& out, const WaveFloat* layer = nullptr);

}  // namespace rawtexel::texunit
