// A texel drawn from the exact ellipse of a footprint (texunit/ellipse.h), at any ratio of its axes. One pixel at a time, in double.
#pragma once

#include "texunit/draw.h"
#include "texunit/ellipse.h"

namespace rawtexel::texunit {

/// A lane of a wave that is looked up by its ellipse.
EllipseLookup ellipse_lookup(const WaveCoordinates& at, int lane);

/// The sampler with the level in its bounds that a draw with `number` reads: level 0, or with a finite sampler.hybrid_bias that many levels
/// finer than roomy_level, a real number of which the number draws a neighbour, but none coarser than roomy_level. What the level has
/// filtered is not filtered again.
SamplerState with_drawn_level(const LevelTable& table, const SamplerState& sampler, const EllipseLookup& at, float number);

/// Draws each lane of `mask` an offset from the Gaussian whose convolution with the texel's box the exact filter is, one number an axis,
/// and then the texel that holds it (filter importance sampling). 4e-6 of the offsets lie beyond the cut of the exact filter. Fills the
/// lanes of `mask` in all of `draw` but `slice`.
void jitter_ellipses(const LevelTable& table, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask,
                     const DrawNumbers& numbers, TexelDraw& draw);

/// Lanes outside `mask`, which is not 0, repeat its first one.
void repeat_first_draw(WaveMask mask, TexelDraw& draw);

}  // namespace rawtexel::texunit
