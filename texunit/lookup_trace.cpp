#include "texunit/lookup_trace.h"

#include "texunit/footprint.h"

#include <algorithm>
#include <cassert>

namespace rawtexel::texunit {
namespace {

/// Lane 0 of all the taps a lookup tells of.
class LaneRecorder final : public TapSink {
  public:
    void begin_lookup(const Texture&, WaveMask) override {}
    void begin_probe(const WaveFloat& weight) override { probe_ = double(weight[0]); }
    void begin_level(const WaveFloat& fraction, bool coarser) override {
        level_ = coarser ? double(fraction[0]) : 1.0 - double(fraction[0]);
        coarser_ = coarser;
    }
    void tap(const WaveTap& tap) override {
        if ((tap.lanes & 1) == 0) return;
        const bool border = (tap.border & 1) != 0;
        TracedTap traced{(*tap.level)[0],
                         tap.slice == nullptr ? 0 : (*tap.slice)[0],
                         (*tap.x)[0],
                         (*tap.y)[0],
                         double((*tap.weight)[0]) * level_ * probe_,
                         border,
                         {}};
        (coarser_ ? coarser_taps_ : taps_).push_back(traced);
    }

    /// The finer level's taps before the coarser's, whatever the order of probes and levels.
    std::vector<TracedTap> take_taps() {
        taps_.insert(taps_.end(), coarser_taps_.begin(), coarser_taps_.end());
        return std::move(taps_);
    }

  private:
    double probe_ = 1, level_ = 1;
    bool coarser_ = false;
    std::vector<TracedTap> taps_, coarser_taps_;
};

/// Runs `sample(extras, colour)` for lane 0 and gathers what it tells.
template <class Sample>
LookupTrace trace(Texture& texture, const SamplerState& sampler, const Sample& sample) {
    LaneRecorder recorder;
    WaveFloat lod;
    WaveColor colour;
    sample(LookupExtras{.sink = &recorder, .lod = &lod}, colour);
    LookupTrace trace;
    trace.lod = lod[0];
    trace.taps = recorder.take_taps();
    for (TracedTap& tap : trace.taps) {
        tap.value = tap.border ? sampler.border : texture.texel(tap.level, tap.slice, tap.x, tap.y);
    }
    for (size_t c = 0; c < 4; ++c) trace.result[c] = colour.channel[c][0];
    return trace;
}

WaveCoordinates3 spread(const LaneCoordinates3& at) {
    WaveCoordinates3 wave{};
    for (size_t axis = 0; axis < 3; ++axis) {
        wave.position[axis][0] = at.position[axis];
        wave.dx[axis][0] = at.dx[axis], wave.dy[axis][0] = at.dy[axis];
    }
    return wave;
}

constexpr WaveMask kFirstLane = 1;

}  // namespace

LookupTrace trace_lookup(Texture& texture, const SamplerState& sampler, const LaneCoordinates& at, float layer) {
    WaveCoordinates wave{};
    wave.u[0] = at.u, wave.v[0] = at.v;
    wave.dudx[0] = at.dudx, wave.dvdx[0] = at.dvdx;
    wave.dudy[0] = at.dudy, wave.dvdy[0] = at.dvdy;
    WaveFloat layers{};
    layers[0] = layer;
    LookupTrace traced = trace(texture, sampler, [&](LookupExtras extras, WaveColor& colour) {
        if (texture.shape().layers > 1) extras.layer = &layers;
        sample_wave(texture, sampler, wave, kFirstLane, colour, extras);
    });
    WaveFootprint footprint;
    measure_footprint(texture.levels(), sampler, wave, footprint);
    traced.anisotropy = footprint.anisotropy[0];
    return traced;
}

LookupTrace trace_volume_lookup(Texture& texture, const SamplerState& sampler, const LaneCoordinates3& at) {
    return trace(texture, sampler, [&](const LookupExtras& extras, WaveColor& colour) {
        sample_volume_wave(texture, sampler, spread(at), kFirstLane, colour, extras);
    });
}

LookupTrace trace_cube_lookup(Texture& texture, const SamplerState& sampler, const LaneCoordinates3& direction, float cube) {
    WaveFloat cubes{};
    cubes[0] = cube;
    return trace(texture, sampler, [&](LookupExtras extras, WaveColor& colour) {
        if (texture.shape().cubes() > 1) extras.layer = &cubes;
        sample_cube_wave(texture, sampler, spread(direction), kFirstLane, colour, extras);
    });
}

}  // namespace rawtexel::texunit
