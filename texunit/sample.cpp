#include "texunit/sample.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "texunit/sample.cpp"
#include <hwy/foreach_target.h>

#include "texunit/sample-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {

void sample_counting(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, FetchCounter& count,
                     WaveColor& out) {
    sample_lanes(texture, sampler, at, mask, count, out, nullptr);
}

void sample_plain(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, WaveColor& out) {
    NoFetchCount count;
    sample_lanes(texture, sampler, at, mask, count, out, nullptr);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rawtexel::texunit {

HWY_EXPORT(sample_counting);
HWY_EXPORT(sample_plain);

void sample_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, WaveColor& out,
                 FetchCounts* counts) {
    if (counts == nullptr) {
        HWY_DYNAMIC_DISPATCH(sample_plain)(texture, sampler, at, mask, out);
        return;
    }
    FetchCounter counter{.texture = counts};
    HWY_DYNAMIC_DISPATCH(sample_counting)(texture, sampler, at, mask, counter, out);
}

}  // namespace rawtexel::texunit
#endif
