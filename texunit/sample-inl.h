// One lookup for a wave on this instruction set, for vector code that already runs on it. Declared here, compiled once, in sample.cpp:
// the stages behind it (sample_lanes-inl.h) are large.
#include "texunit/lanes-inl.h"
#include "texunit/sample.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_SAMPLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_SAMPLE_INL_H_
#undef RAWTEXEL_TEXUNIT_SAMPLE_INL_H_
#else
#define RAWTEXEL_TEXUNIT_SAMPLE_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {

/// sample_wave of texunit/sample.h. Lanes outside `mask` of `out` hold the colour of the first active lane, all zero for an empty mask.
/// `lod`, when asked for, gets lambda clamped to the levels there are. Count is NoFetchCount, or FetchCounter or FetchRecorder, which leave
/// `out` alone.
template <class Count>
void sample_lanes(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, Count& count, WaveColor& out,
                  WaveFloat* lod, const WaveFloat* layer = nullptr);

/// sample_alike_wave.
void sample_alike_lanes(const AlikeTextures& textures, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask,
                        WaveFloat* lod);

/// sample_volume_wave and sample_cube_wave in the same way.
template <class Count>
void sample_volume_lanes(Texture& texture, const SamplerState& sampler, const WaveCoordinates3& at, WaveMask mask, Count& count,
                         WaveColor& out, WaveFloat* lod);
template <class Count>
void sample_cube_lanes(Texture& texture, const SamplerState& sampler, const WaveCoordinates3& directions, WaveMask mask, Count& count,
                       WaveColor& out, WaveFloat* lod, const WaveFloat* layer = nullptr);

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_SAMPLE_INL_H_
