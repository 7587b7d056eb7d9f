// Texel reads one by one, in the order of lanes: what cache models and traces are made of.
#pragma once

#include "texunit/fetch_log.h"
#include "texunit/texture.h"

#include <array>
#include <cstdint>
#include <vector>

namespace rawtexel::texunit {

/// One texel read: which texture of a set, which level, and the texel's index in the decoded layout (texunit/level_table.h).
class TexelFetch {
  public:
    static constexpr uint32_t kMostTextures = 1u << 24;
    TexelFetch(uint32_t texture, int level, int32_t texel)
        : bits_(uint64_t{texture} << 36 | uint64_t(level) << 32 | uint64_t(uint32_t(texel))) {}
    uint32_t texture() const { return uint32_t(bits_ >> 36); }
    int level() const { return int(bits_ >> 32 & 15); }
    int32_t texel() const { return int32_t(bits_ & 0xFFFFFFFFu); }

  private:
    uint64_t bits_;
};

/// The reads of one pixel at one sample: `count` of FetchStream::fetches, after those of the entries before.
struct PixelFetches {
    uint16_t x, y;  ///< pixel of the frame
    uint32_t sample;
    uint32_t count;
};

/// A stretch of the canonical order: 64x64 tiles row by row, samples, waves in Morton order, lanes, lookups, taps.
struct FetchStream {
    std::vector<PixelFetches> pixels;
    std::vector<TexelFetch> fetches;

    void clear();
    bool empty() const { return pixels.empty(); }
    size_t bytes() const { return pixels.size() * sizeof(PixelFetches) + fetches.size() * sizeof(TexelFetch); }
};

/// Turns waves of lookups into a stream: what the lanes ask for together is put one lane after the other.
class FetchStreamRecorder final : public TapSink {
  public:
    /// The lookups that follow, up to end_wave, belong to the wave whose upper left pixel is (x, y).
    void begin_wave(int x, int y, uint32_t sample);
    /// Place of the texture that is looked up next.
    void set_texture(uint32_t texture) { place_ = texture; }
    /// Appends what the wave asked for.
    void end_wave(FetchStream& stream);
    /// What lane `lane` has asked for since begin_wave.
    const std::vector<TexelFetch>& fetches(int lane) const { return lanes_[size_t(lane)]; }

    void begin_lookup(const Texture& texture, WaveMask lanes) override;
    void begin_probe(const WaveFloat&) override {}
    void begin_level(const WaveFloat&, bool) override {}
    void tap(const WaveTap& tap) override;

  private:
    std::array<std::vector<TexelFetch>, kWaveLanes> lanes_;
    const Texture* texture_ = nullptr;
    uint32_t place_ = 0, sample_ = 0;
    int x_ = 0, y_ = 0;
};

}  // namespace rawtexel::texunit
