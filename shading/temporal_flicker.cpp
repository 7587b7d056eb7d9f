#include "shading/temporal_flicker.h"

#include <cassert>
#include <cmath>

namespace rawtexel::shading {

void TemporalFlicker::add(const Image& image) {
    if (frames_ == 0) {
        width_ = image.width;
        height_ = image.height;
        channels_ = image.channels;
        mean_.assign(image.values.size(), 0.0);
        squares_.assign(image.values.size(), 0.0);
    }
    assert(image.width == width_ && image.height == height_ && image.channels == channels_);
    ++frames_;
    for (size_t i = 0; i < mean_.size(); ++i) {
        const double value = double(image.values[i]), difference = value - mean_[i];
        mean_[i] += difference / frames_;
        squares_[i] += difference * (value - mean_[i]);
    }
}

Image TemporalFlicker::deviation() const {
    assert(frames_ > 0);
    Image image(width_, height_, channels_);
    for (size_t i = 0; i < squares_.size(); ++i) image.values[i] = float(std::sqrt(squares_[i] / frames_));
    return image;
}

double TemporalFlicker::rms() const {
    assert(frames_ > 0);
    double sum = 0.0;
    for (const double squares : squares_) sum += squares;
    return std::sqrt(sum / frames_ / double(squares_.size()));
}

}  // namespace rawtexel::shading
