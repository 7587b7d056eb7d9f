// The candidate fragments that visibility asked about at one sample of a tile: what the fetch models are made of.
#pragma once

#include "raster/visibility.h"
#include "texunit/wave.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace rawtexel::shading {

/// Fragments of one triangle in one wave that passed the depth test against what was drawn before.
struct LoggedCandidate {
    uint32_t setup_index;
    uint32_t wave;              ///< in the tile, row by row
    texunit::WaveMask lanes;    ///< inside the frame's visible pixels
    texunit::WaveMask covered;  ///< those of them that alpha let stand
    texunit::WaveFloat depth;
};

class CandidateLog {
  public:
    /// Opaque candidates are kept too.
    bool keeps_opaque = false;

    void clear() { entries_.clear(); }
    void add(const raster::CandidateWave& candidate, uint32_t wave, texunit::WaveMask lanes, texunit::WaveMask covered) {
        if (lanes == 0) return;
        LoggedCandidate& entry = entries_.emplace_back(LoggedCandidate{candidate.setup_index, wave, lanes, covered, {}});
        std::copy_n(candidate.depth, texunit::kWaveLanes, entry.depth.lane);
    }
    /// By wave; within a wave in the order in which they were drawn.
    const std::vector<LoggedCandidate>& sorted() {
        std::ranges::stable_sort(entries_, {}, &LoggedCandidate::wave);
        return entries_;
    }

  private:
    std::vector<LoggedCandidate> entries_;
};

}  // namespace rawtexel::shading
