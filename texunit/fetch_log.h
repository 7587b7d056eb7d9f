// What lookups ask for. What a lookup does with its taps is a policy, and the wave code is compiled once for each:
//
//   NoFetchCount    reads and filters them: the plain path, which counts nothing and pays nothing for it
//   FetchCounter    adds them up, per texture, level and pixel, and marks the texels they name
//   FetchRecorder   tells a TapSink of each by itself: traces, fetch streams
//
// The last two read no texel: what is asked for follows from the texture's shape and the sampler alone.
#pragma once

#include "texunit/texel_source.h"
#include "texunit/touched_texels.h"
#include "texunit/wave.h"

#include <array>
#include <cstdint>

namespace rawtexel::texunit {

class Texture;

/// Demanded counts: what material and sampler ask for, independent of skips, threads and tile size. Taps of weight 0 are not asked for; a
/// tap that takes the border colour reads no texel and is not counted; a tap beyond the corner of a cube map is three.
struct FetchCounts {
    uint64_t lookups = 0;                             ///< one map asked at one shading point
    uint64_t taps = 0;                                ///< taps weighed
    uint64_t texels_requested = 0;                    ///< texel reads, with repeats
    std::array<uint64_t, kMaxLevels> level_texels{};  ///< the same by level

    FetchCounts& operator+=(const FetchCounts& other);
    bool operator==(const FetchCounts&) const = default;
};

/// One tap of a wave. Every pointer has 32 lanes, of which only those of `lanes` mean anything.
struct WaveTap {
    WaveMask lanes;   ///< lanes that weigh it
    WaveMask border;  ///< those of them that take the border colour and read nothing
    const WaveInt* level;
    const WaveInt* slice;     ///< array layer, 6*cube + face, or depth slice; null: slice 0
    const WaveInt* x;         ///< texel of that level and slice as decoded,
    const WaveInt* y;         ///< (texunit/level_table.h has its index)
    const WaveFloat* weight;  ///< the product over the axes, never 0
};

/// Hears of every tap of every lookup. A lane's taps come by probe, finer level before coarser, slice, row and column. Its share of the
/// lookup is the tap's weight times the level's times the probe's.
class TapSink {
  public:
    virtual ~TapSink() = default;
    /// The lookups of `lanes` in `texture` begin; one probe of weight 1 unless begin_probe says otherwise.
    virtual void begin_lookup(const Texture& texture, WaveMask lanes) = 0;
    /// Another probe begins, that weighs `weight`.
    virtual void begin_probe(const WaveFloat& weight) = 0;
    /// A level begins: the coarser one with weight `fraction`, or the finer one with 1 - `fraction`.
    virtual void begin_level(const WaveFloat& fraction, bool coarser) = 0;
    virtual void tap(const WaveTap& tap) = 0;
};

struct NoFetchCount {
    static constexpr bool kReads = true;
    static constexpr bool kCounts = false;
    static constexpr bool kRecords = false;
};

/// One per worker; merged in any order, since sums of integers do not depend on it.
struct FetchCounter {
    static constexpr bool kReads = false;
    static constexpr bool kCounts = true;
    static constexpr bool kRecords = false;
    FetchCounts* counts = nullptr;    ///< of the texture looked up now
    TouchedBits touched{};            ///< of that texture; marks nothing where empty
    Wave<uint32_t>* pixel = nullptr;  ///< texels requested by each lane's pixel, added to; null where nobody asks

    const Texture* texture = nullptr;  ///< set by the lookup
};

struct FetchRecorder {
    static constexpr bool kReads = false;
    static constexpr bool kCounts = false;
    static constexpr bool kRecords = true;
    TapSink* sink = nullptr;  ///< never null
};

}  // namespace rawtexel::texunit
