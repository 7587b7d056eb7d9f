// Draws for vector code that already runs on this instruction set. Declared here, compiled once, in draw.cpp: the stages behind them
// (draw_lanes-inl.h, shared_draw-inl.h) are large.
#include "texunit/shared_draw.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_DRAW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_DRAW_INL_H_
#undef RAWTEXEL_TEXUNIT_DRAW_INL_H_
#else
#define RAWTEXEL_TEXUNIT_DRAW_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {

/// draw_numbers, or where `negative` negative_draw_numbers, of texunit/draw.h. `states`: the caller's, for waves that follow each other.
void number_lanes(const RandomAddress& first, bool negative, Noise noise, const NumberRoles& roles, RandomStates& states,
                  DrawNumbers& numbers);

/// draw_shared and enumerate_shared.
void draw_shared_lanes(const LookupSet& set, const DrawNumbers& positive, const DrawNumbers& negative, const UseTap& use);
void enumerate_shared_lanes(const LookupSet& set, const UseTap& use);

/// read_drawn_wave.
void read_drawn_lanes(Texture& texture, const SamplerState& sampler, const TexelDraw& draw, WaveColor& out);

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_DRAW_INL_H_
