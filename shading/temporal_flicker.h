// How much an image changes from frame to frame.
#pragma once

#include "shading/image.h"

#include <vector>

namespace rawtexel::shading {

/// Mean and deviation over time of every value of a sequence of images (Welford 1962), in double.
class TemporalFlicker {
  public:
    void add(const Image& image);
    int frames() const { return frames_; }

    /// The standard deviation of each value over the frames added, around their mean; 0 after one frame. At least one (asserted).
    Image deviation() const;
    /// Root mean square of deviation() over all its values.
    double rms() const;

  private:
    int frames_ = 0;
    int width_ = 0, height_ = 0, channels_ = 0;
    std::vector<double> mean_, squares_;  ///< squares: sums of squared differences from the mean
};

}  // namespace rawtexel::shading
