// The candidate fragments that visibility asked about at one sample of a tile: what the fetch models are made of.
#pragma once

#include "raster/visibility.h"
#include "texunit/wave.h"

#include <algorithm>
#include <compare>
#include <cstdint>
#include <vector>

namespace rawtexel::shading {

/// Fragments of one triangle in one wave that passed the depth test against what was drawn before.
struct LoggedCandidate {
    uint32_t setup_index;
    texunit::WaveMask lanes;    ///< inside the frame's visible pixels
    texunit::WaveMask covered;  ///< those of them that alpha let stand
    texunit::WaveFloat depth;
};

class CandidateLog {
  public:
    /// Opaque candidates are kept too.
    bool keeps_opaque = false;

    void clear() {
        entries_.clear();
        order_.clear();
    }
    /// `wave`: in the tile, row by row.
    void add(const raster::CandidateWave& candidate, uint32_t wave, texunit::WaveMask lanes, texunit::WaveMask covered) {
        if (lanes == 0) return;
        order_.push_back({wave, uint32_t(entries_.size())});
        LoggedCandidate& entry = entries_.emplace_back(LoggedCandidate{candidate.setup_index, lanes, covered, {}});
        std::copy_n(candidate.depth, texunit::kWaveLanes, entry.depth.lane);
    }

    /// When all are there, and before for_each_in_wave.
    void sort() { std::ranges::sort(order_); }
    /// Calls use(const LoggedCandidate&) for the candidates of a wave in the order in which they were drawn.
    template <class Use>
    void for_each_in_wave(uint32_t wave, const Use& use) const {
        const auto found = std::ranges::equal_range(order_, wave, {}, &Place::wave);
        for (auto place = found.begin(); place != found.end(); ++place) use(entries_[place->entry]);
    }

  private:
    // Sorted in place of the entries: those are large, and aligned more than the buffers of stable sorts are.
    struct Place {
        uint32_t wave, entry;
        auto operator<=>(const Place&) const = default;
    };
    std::vector<LoggedCandidate> entries_;
    std::vector<Place> order_;
};

}  // namespace rawtexel::shading
