// The interval [0, 1) of a random number, cut lane by lane where a choice that is made with it changes.
#pragma once

#include "texunit/wave.h"

#include <algorithm>
#include <vector>

namespace rawtexel::texunit {

class NumberCells {
  public:
    void clear() {
        for (std::vector<float>& edges : edges_) edges.clear();
    }
    /// The choice of `lane` changes where the number is `at`; what is not inside (0, 1) cuts nothing.
    void add_step(int lane, float at) {
        if (at > 0 && at < 1) edges_[lane].push_back(at);
    }
    /// All steps are there.
    void finish() {
        count_ = 1;
        for (std::vector<float>& edges : edges_) {
            std::sort(edges.begin(), edges.end());
            edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
            count_ = std::max(count_, int(edges.size()) + 1);
        }
    }

    int count() const { return count_; }  ///< of the lane with most cells
    /// A number inside cell `cell` of each lane and the cell's length; 0 where the lane has no such cell.
    void take(int cell, WaveFloat& number, WaveFloat& length) const {
        for (int lane = 0; lane < kWaveLanes; ++lane) {
            const float low = edge(lane, cell - 1), high = edge(lane, cell);
            length[lane] = high - low;
            number[lane] = length[lane] > 0 ? low + length[lane] / 2 : 0;
        }
    }

  private:
    /// The upper end of cell `cell`.
    float edge(int lane, int cell) const {
        const std::vector<float>& edges = edges_[lane];
        return cell < 0 ? 0.0f : cell < int(edges.size()) ? edges[size_t(cell)] : 1.0f;
    }

    std::vector<float> edges_[kWaveLanes];
    int count_ = 1;
};

}  // namespace rawtexel::texunit
