// A lookup of one place by all lanes of a wave, in a texture of any shape: drawn, listed and weighed.
#pragma once

#include "texunit/shared_draw.h"

namespace rawtexel::texunit {

/// `at` of flat textures and arrays, `solid` of volumes and cube maps; `layer` of arrays.
struct PlacedLookup {
    Texture* texture;
    SamplerState sampler;
    WaveCoordinates at{};
    WaveCoordinates3 solid{};
    WaveFloat layer{};

    bool is_solid() const { return texture->shape().depth > 1 || texture->shape().cube; }
    int layers() const { return texture->shape().cubes(); }

    LookupSet set() const {
        LookupSet set;
        set.mask = kWaveFull;
        set.count = 1;
        SharedLookup& lookup = set.lookup[0];
        lookup = {&texture->levels(), &sampler, &at};
        if (is_solid()) lookup.at = nullptr, lookup.solid = &solid, lookup.cube = texture->shape().cube;
        if (layers() > 1) lookup.layer = &layer, lookup.layers = layers();
        return set;
    }
    void listen(TapSink& sink) const {
        WaveColor unread;
        LookupExtras extras{.sink = &sink};
        if (layers() > 1) extras.layer = &layer;
        if (texture->shape().cube) return sample_cube_wave(*texture, sampler, solid, 1, unread, extras);
        if (is_solid()) return sample_volume_wave(*texture, sampler, solid, 1, unread, extras);
        sample_wave(*texture, sampler, at, 1, unread, extras);
    }
};

}  // namespace rawtexel::texunit
