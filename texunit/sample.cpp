#include "texunit/sample.h"

#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "texunit/sample.cpp"
#include <hwy/foreach_target.h>

#include "texunit/sample-inl.h"
#include "texunit/sample_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {

// What sample-inl.h declares, for every policy.
template void sample_lanes(Texture&, const SamplerState&, const WaveCoordinates&, WaveMask, NoFetchCount&, WaveColor&, WaveFloat*,
                           const WaveFloat*);
template void sample_lanes(Texture&, const SamplerState&, const WaveCoordinates&, WaveMask, FetchCounter&, WaveColor&, WaveFloat*,
                           const WaveFloat*);
template void sample_lanes(Texture&, const SamplerState&, const WaveCoordinates&, WaveMask, FetchRecorder&, WaveColor&, WaveFloat*,
                           const WaveFloat*);
template void sample_volume_lanes(Texture&, const SamplerState&, const WaveCoordinates3&, WaveMask, NoFetchCount&, WaveColor&, WaveFloat*);
template void sample_volume_lanes(Texture&, const SamplerState&, const WaveCoordinates3&, WaveMask, FetchCounter&, WaveColor&, WaveFloat*);
template void sample_volume_lanes(Texture&, const SamplerState&, const WaveCoordinates3&, WaveMask, FetchRecorder&, WaveColor&, WaveFloat*);
template void sample_cube_lanes(Texture&, const SamplerState&, const WaveCoordinates3&, WaveMask, NoFetchCount&, WaveColor&, WaveFloat*,
                                const WaveFloat*);
template void sample_cube_lanes(Texture&, const SamplerState&, const WaveCoordinates3&, WaveMask, FetchCounter&, WaveColor&, WaveFloat*,
                                const WaveFloat*);
template void sample_cube_lanes(Texture&, const SamplerState&, const WaveCoordinates3&, WaveMask, FetchRecorder&, WaveColor&, WaveFloat*,
                                const WaveFloat*);

/// Calls `lookup` with the policy that `extras` asks for.
template <class Lookup>
HWY_INLINE void with_policy(const LookupExtras& extras, const Lookup& lookup) {
    if (extras.sink != nullptr) {
        FetchCounts unasked;
        FetchRecorder recorder;
        recorder.texture = extras.counts != nullptr ? extras.counts : &unasked;
        recorder.sink = extras.sink;
        lookup(recorder);
    } else if (extras.counts != nullptr) {
        FetchCounter counter{.texture = extras.counts};
        lookup(counter);
    } else {
        NoFetchCount nothing;
        lookup(nothing);
    }
}

/// The common case, without a detour over what might be asked for.
void sample_plain(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, WaveColor& out) {
    NoFetchCount nothing;
    sample_lanes(texture, sampler, at, mask, nothing, out, nullptr, nullptr);
}

void sample_flat(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, WaveColor& out,
                 const LookupExtras& extras) {
    with_policy(extras, [&](auto& count) HWY_ATTR { sample_lanes(texture, sampler, at, mask, count, out, extras.lod, extras.layer); });
}

void sample_volume(Texture& texture, const SamplerState& sampler, const WaveCoordinates3& at, WaveMask mask, WaveColor& out,
                   const LookupExtras& extras) {
    with_policy(extras, [&](auto& count) HWY_ATTR { sample_volume_lanes(texture, sampler, at, mask, count, out, extras.lod); });
}

void sample_cube(Texture& texture, const SamplerState& sampler, const WaveCoordinates3& at, WaveMask mask, WaveColor& out,
                 const LookupExtras& extras) {
    with_policy(extras, [&](auto& count) HWY_ATTR { sample_cube_lanes(texture, sampler, at, mask, count, out, extras.lod, extras.layer); });
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rawtexel::texunit {

HWY_EXPORT(sample_plain);
HWY_EXPORT(sample_flat);
HWY_EXPORT(sample_volume);
HWY_EXPORT(sample_cube);

void sample_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, WaveColor& out,
                 const LookupExtras& extras) {
    assert(texture.shape().depth == 1);
    HWY_DYNAMIC_DISPATCH(sample_flat)(texture, sampler, at, mask, out, extras);
}

void sample_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, WaveColor& out,
                 FetchCounts* counts) {
    if (counts != nullptr) return sample_wave(texture, sampler, at, mask, out, LookupExtras{.counts = counts});
    assert(texture.shape().depth == 1);
    HWY_DYNAMIC_DISPATCH(sample_plain)(texture, sampler, at, mask, out);
}

void sample_volume_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates3& at, WaveMask mask, WaveColor& out,
                        const LookupExtras& extras) {
    assert(texture.shape().layers == 1);
    HWY_DYNAMIC_DISPATCH(sample_volume)(texture, sampler, at, mask, out, extras);
}

void sample_cube_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates3& directions, WaveMask mask, WaveColor& out,
                      const LookupExtras& extras) {
    assert(texture.shape().layers % 6 == 0 && texture.shape().width == texture.shape().height);
    HWY_DYNAMIC_DISPATCH(sample_cube)(texture, sampler, directions, mask, out, extras);
}

}  // namespace rawtexel::texunit
#endif
