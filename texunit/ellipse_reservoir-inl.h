// A texel drawn from the exact ellipse of a footprint by weighing all its texels: weighted reservoir sampling of a stream of weights.
#include "texunit/ellipse_draw.h"
#include "texunit/elliptical-inl.h"
#include "texunit/reservoir.h"

#include <hwy/highway.h>

#include <cassert>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_ELLIPSE_RESERVOIR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_ELLIPSE_RESERVOIR_INL_H_
#undef RAWTEXEL_TEXUNIT_ELLIPSE_RESERVOIR_INL_H_
#else
#define RAWTEXEL_TEXUNIT_ELLIPSE_RESERVOIR_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The sum of the weights of a lane's ellipse, and then use(chunk, slot, weight) of every texel.
template <class Use>
HWY_INLINE void for_each_ellipse_texel(const LevelTable& table, const SamplerState& sampler, const EllipseLookup& at, const Use& use) {
    EllipseWalk walk;
    begin_walk(table, sampler, at, 0, walk);
    WaveFloat weight;
    for_each_chunk(table, sampler, walk.ellipse, walk.chunk, [&](EllipseChunk& chunk) HWY_ATTR {
        ellipse_weights(walk.ellipse, chunk, weight);
        for (int slot = 0; slot < chunk.used; ++slot) use(chunk, slot, weight[slot]);
    });
}

/// Fills all of `draw` but `slice`; lanes outside `mask`, which is not 0, are left as they are.
HWY_NOINLINE inline void stream_ellipses(const LevelTable& table, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask,
                                         const DrawNumbers& numbers, TexelDraw& draw) {
    draw.border = 0;
    for (WaveMask rest = mask; rest != 0; rest &= rest - 1) {
        const auto lane = int(hwy::Num0BitsBelowLS1Bit_Nonzero32(rest));
        const EllipseLookup lookup = ellipse_lookup(at, lane);
        const SamplerState state = with_drawn_level(table, sampler, lookup, numbers.level[lane]);
        // Two numbers of 24 bits make the 32 that the reservoir starts from.
        const auto bits = [](float number) { return uint32_t(number * 0x1p24f); };
        StreamingReservoir reservoir(bits(numbers.x[lane]) << 8 ^ mix_bits(bits(numbers.y[lane])));
        for_each_ellipse_texel(table, state, lookup, [&](const EllipseChunk& chunk, int slot, float weight) {
            if (!reservoir.offer(double(weight))) return;
            draw.level[lane] = chunk.level[slot], draw.x[lane] = chunk.x[slot], draw.y[lane] = chunk.y[slot];
            draw.border = (draw.border & ~(WaveMask{1} << lane)) | (chunk.border >> slot & 1) << lane;
        });
        assert(reservoir.sum() > 0);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_ELLIPSE_RESERVOIR_INL_H_
