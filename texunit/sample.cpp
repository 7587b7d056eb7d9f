#include "texunit/sample.h"

#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "texunit/sample.cpp"
#include <hwy/foreach_target.h>

#include "texunit/sample-inl.h"
#include "texunit/sample_alike-inl.h"
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

/// Calls `lookup` to read, and once more for everyone who listens.
template <class Lookup>
HWY_INLINE void with_policies(const LookupExtras& extras, const Lookup& lookup) {
    NoFetchCount plain;
    lookup(plain);
    if (extras.counts != nullptr) {
        FetchCounter counter{.counts = extras.counts};
        lookup(counter);
    }
    if (extras.sink != nullptr) {
        FetchRecorder recorder{.sink = extras.sink};
        lookup(recorder);
    }
}

/// The common case, without a detour over what might be asked for.
void sample_plain(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, WaveColor& out) {
    NoFetchCount plain;
    sample_lanes(texture, sampler, at, mask, plain, out, nullptr, nullptr);
}

void sample_flat(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, WaveColor& out,
                 const LookupExtras& extras) {
    with_policies(extras, [&](auto& policy) HWY_ATTR { sample_lanes(texture, sampler, at, mask, policy, out, extras.lod, extras.layer); });
}

void sample_volume(Texture& texture, const SamplerState& sampler, const WaveCoordinates3& at, WaveMask mask, WaveColor& out,
                   const LookupExtras& extras) {
    with_policies(extras, [&](auto& policy) HWY_ATTR { sample_volume_lanes(texture, sampler, at, mask, policy, out, extras.lod); });
}

void sample_cube(Texture& texture, const SamplerState& sampler, const WaveCoordinates3& at, WaveMask mask, WaveColor& out,
                 const LookupExtras& extras) {
    with_policies(extras,
                  [&](auto& policy) HWY_ATTR { sample_cube_lanes(texture, sampler, at, mask, policy, out, extras.lod, extras.layer); });
}

void count_flat(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, FetchCounter& counter,
                WaveFloat* lod) {
    WaveColor unread;
    sample_lanes(texture, sampler, at, mask, counter, unread, lod, nullptr);
}

void record_flat(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, TapSink& sink) {
    WaveColor unread;
    FetchRecorder recorder{.sink = &sink};
    sample_lanes(texture, sampler, at, mask, recorder, unread, nullptr, nullptr);
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
HWY_EXPORT(count_flat);
HWY_EXPORT(record_flat);
HWY_EXPORT(sample_alike_lanes);

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

bool can_sample_alike(const Texture& texture, const SamplerState& sampler) {
    const Shape& shape = texture.shape();
    return sampler.magnify == Kernel::Bilinear && sampler.minify == Kernel::Bilinear && sampler.is_isotropic() &&
           texture.texel_layout().storage == StorageClass::Packed32 && shape.layers == 1 && shape.depth == 1;
}

void sample_alike_wave(const AlikeTextures& textures, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask,
                       WaveFloat* lod) {
    assert(textures.count > 0 && mask != 0 && can_sample_alike(*textures.texture[0], sampler));
    HWY_DYNAMIC_DISPATCH(sample_alike_lanes)(textures, sampler, at, mask, lod);
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

void count_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, FetchCounter& counter,
                WaveFloat* lod) {
    HWY_DYNAMIC_DISPATCH(count_flat)(texture, sampler, at, mask, counter, lod);
}

void record_wave(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask, TapSink& sink) {
    HWY_DYNAMIC_DISPATCH(record_flat)(texture, sampler, at, mask, sink);
}

}  // namespace rawtexel::texunit
#endif
