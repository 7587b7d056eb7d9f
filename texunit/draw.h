// A lookup of one texel, drawn with the probability that its filter weighs it with (Pharr, Wronski, Salvi and Fajardo 2024, "Filtering
// After Shading With Stochastic Texture Filtering"). The mean of many draws is what sample_wave returns. Lookups that share their numbers,
// such as the maps of a material, are drawn together by texunit/shared_draw.h.
#pragma once

#include "texunit/noise.h"
#include "texunit/random.h"
#include "texunit/sample.h"

namespace rawtexel::texunit {

/// Uniform numbers in [0, 1), one a lane for each choice and independent of each other. Maps that share them read the same texel. Texels
/// rise with their numbers; the coarser level is drawn where the number is below its weight.
struct DrawNumbers {
    WaveFloat x, y;   ///< the texel along either axis (Dimension::TapX, TapY)
    WaveFloat level;  ///< the coarser level or the finer (Dimension::Level)
    WaveFloat probe;  ///< of an anisotropic lookup (Dimension::Probe)
    WaveFloat sign;   ///< of kernels with negative lobes: which signs the axes' weights have (Dimension::Sign)
    /// Of volumes the slice, of cube maps which of the three texels that meet beyond a corner (Dimension::TapZ). Flat lookups never look.
    WaveFloat z;
};

/// Which numbers beside x, y and z the draws of a lookup look at.
struct NumberRoles {
    bool level = true, probe = true, sign = true;
};
NumberRoles roles_of(const SamplerState& sampler);

/// The numbers of a wave whose upper left pixel is (first.x, first.y), but for z and those of roles that are not asked for, which stay as
/// they were; first.dimension is not looked at.
void draw_numbers(const RandomAddress& first, DrawNumbers& numbers, Noise noise = Noise::White, const NumberRoles& roles = {});
/// Those of the negative weights' texel: its own but for level and probe, which both share.
void negative_draw_numbers(const RandomAddress& first, DrawNumbers& numbers, Noise noise = Noise::White, const NumberRoles& roles = {});
/// draw_numbers from states that the caller keeps, for waves that follow each other.
void draw_numbers(const RandomAddress& first, DrawNumbers& numbers, Noise noise, const NumberRoles& roles, RandomStates& states);
/// numbers.z alone, for volumes and cube maps.
void draw_depth_numbers(const RandomAddress& first, DrawNumbers& numbers, Noise noise = Noise::White);
void negative_draw_depth_numbers(const RandomAddress& first, DrawNumbers& numbers, Noise noise = Noise::White);

/// The texel that each lane drew. `slice`: array layer, depth slice, or 6*cube + face.
struct TexelDraw {
    WaveInt level, slice, x, y;
    WaveMask border = 0;  ///< lanes that take the border colour
};

/// Positivization of kernels with negative lobes (Pharr et al. 2024): one texel drawn from the positive weights and one from the magnitudes
/// of the negative ones. The lookup's value is positive_weight*S(positive) - negative_weight*S(negative), whatever S makes of a texel.
/// negative_weight is the sum of the negative weights' magnitudes and positive_weight is 1 + negative_weight, so a constant has no
/// variance. Where negative_weight is 0 (on a texel's centre, or for kernels without negative lobes) the negative texel means nothing and
/// may be read all the same.
struct SignedDraw {
    TexelDraw positive, negative;
    WaveFloat positive_weight, negative_weight;
};

/// Draws for the lanes of `mask` in a 2-D texture, or in `layer` of an array (of volumes and cube maps: texunit/shared_draw.h), as
/// sampler.estimator says (All draws as Reservoir does); reads no texel. The kernels' weights are probabilities (asserted). Levels, probes
/// and kernels are chosen as by sample_wave; where sampler.ellipse is positive the draw is from the ellipse. Other lanes repeat an active
/// one.
void draw_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, const DrawNumbers& numbers,
               TexelDraw& draw, const WaveFloat* layer = nullptr);

/// The same for kernels of any sign, separably: the signs of the two axes are drawn first, then a texel along each from the weights of its
/// sign.
void draw_signed_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, const DrawNumbers& positive,
                      const DrawNumbers& negative, SignedDraw& draw, const WaveFloat* layer = nullptr);

/// One texel of a kernel of any sign, drawn by the magnitude of its weight: the lookup's value is factor*S(texel), factor being the sum of
/// the magnitudes times the weight's sign. Unbiased, but noisy even on a constant.
void draw_absolute_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, const DrawNumbers& numbers,
                        TexelDraw& draw, WaveFloat& factor, const WaveFloat* layer = nullptr);

/// What a draw of the lanes of `mask` asks for, of slice 0: added to `counter`, or told to `sink`. `first`: of the lookup's draws, which
/// begins it.
void count_drawn_wave(const Texture& texture, const TexelDraw& draw, WaveMask mask, bool first, FetchCounter& counter);
void record_drawn_wave(const Texture& texture, const TexelDraw& draw, WaveMask mask, bool first, TapSink& sink);

/// The drawn texels, linear RGBA. Throws TextureError as sample_wave does.
void read_drawn_wave(Texture& texture, const SamplerState& sampler, const TexelDraw& draw, WaveColor& out);

/// Both at once.
void sample_drawn_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, const DrawNumbers& numbers,
                       WaveColor& out, const WaveFloat* layer = nullptr);

}  // namespace rawtexel::texunit
