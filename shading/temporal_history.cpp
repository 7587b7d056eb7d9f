#include "shading/temporal_history.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

namespace rawtexel::shading {
namespace {

/// Constants stay what they are, and so do frames of weight 1.
float moved_towards(float history, float frame, float weight) { return weight == 1.0f ? frame : history + weight * (frame - history); }

/// How much depth differs between a pixel and the nearer of two opposite neighbours; 0 where both are infinitely far or outside.
double one_sided(const Image& depth, int x, int y, int dx, int dy) {
    const float here = *depth.pixel(x, y);
    double least = HUGE_VAL;
    for (const int side : {-1, 1}) {
        const int nx = x + side * dx, ny = y + side * dy;
        if (nx < 0 || ny < 0 || nx >= depth.width || ny >= depth.height) continue;
        least = std::min(least, std::abs(double(*depth.pixel(nx, ny)) - double(here)));
    }
    return std::isfinite(least) ? least : 0.0;
}

/// How far the depth of a tap may be from the expected one.
double tolerance(const Image& depth, int x, int y, double expected) {
    const double slope = one_sided(depth, x, y, 1, 0) + one_sided(depth, x, y, 0, 1);
    return std::max(kDepthTolerance * expected, kSlopeTolerance * slope);
}

/// Least and greatest value of a channel among a pixel and its neighbours in the image, widened by the slack.
std::pair<float, float> neighbour_range(const Image& image, int x, int y, int channel) {
    float least = HUGE_VALF, greatest = -HUGE_VALF;
    for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, image.height - 1); ++ny)
        for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, image.width - 1); ++nx) {
            const float value = image.pixel(nx, ny)[channel];
            least = std::min(least, value);
            greatest = std::max(greatest, value);
        }
    return {least - kClampSlack * std::abs(least), greatest + kClampSlack * std::abs(greatest)};
}

}  // namespace

void move_towards(const Image& frame, float weight, Image& history) {
    if (history.values.empty()) {
        history = frame;
        return;
    }
    assert(history.values.size() == frame.values.size());
    for (size_t i = 0; i < frame.values.size(); ++i) history.values[i] = moved_towards(history.values[i], frame.values[i], weight);
}

ReprojectedHistory::ReprojectedHistory(const TemporalOptions& options, int width, int height)
    : options_(options), width_(width), height_(height) {
    assert(options.accumulation == Accumulation::Reproject && options.weight > 0.0f && options.weight <= 1.0f);
}

const Image& ReprojectedHistory::add(const Image& frame, const Camera& camera, Image depth, Executor& executor) {
    assert(frame.width == width_ && frame.height == height_ && frame.channels == 3);
    assert(depth.width == width_ && depth.height == height_ && depth.channels == 1);
    View now{FrameProjection(camera, width_, height_), std::move(depth)};
    disoccluded_ = 0;
    if (!before_) {
        history_ = frame;
    } else {
        Image next(width_, height_, 3);
        std::vector<uint64_t> disoccluded(size_t(height_), 0);
        executor.parallel_for(height_, [&](int64_t y, int) { reproject_row(frame, now, int(y), next, disoccluded[size_t(y)]); });
        for (const uint64_t count : disoccluded) disoccluded_ += count;
        history_ = std::move(next);
    }
    before_ = std::move(now);
    return history_;
}

void ReprojectedHistory::reproject_row(const Image& frame, const View& now, int y, Image& out, uint64_t& disoccluded) const {
    for (int x = 0; x < width_; ++x) {
        const Fetched fetched = fetch(now, x, y);
        if (!fetched.found) ++disoccluded;
        for (int c = 0; c < 3; ++c) {
            const float value = frame.pixel(x, y)[c];
            float history = fetched.found ? fetched.color[c] : value;
            if (options_.clamp) {
                const auto [least, greatest] = neighbour_range(frame, x, y, c);
                history = std::min(std::max(history, least), greatest);
            }
            out.pixel(x, y)[c] = moved_towards(history, value, options_.weight);
        }
    }
}

ReprojectedHistory::Fetched ReprojectedHistory::fetch(const View& now, int x, int y) const {
    // Where the pixel's surface was. Both cameras project it, so that a camera at rest moves nothing by as much as a rounding.
    const glm::dvec2 center(x + 0.5, y + 0.5);
    const double depth = double(*now.depth.pixel(x, y));
    const bool surface = std::isfinite(depth);
    FrameProjection::Point here, there;
    if (surface) {
        const glm::dvec3 world = now.projection.world(center, depth);
        here = now.projection.project(world);
        there = before_->projection.project(world);
    } else {
        const glm::dvec3 direction = now.projection.direction(center);
        here = now.projection.project_direction(direction);
        there = before_->projection.project_direction(direction);
    }
    const glm::dvec2 then = center + (there.pixel - here.pixel);
    const bool seen = there.depth > 0.0 && then.x >= 0.0 && then.y >= 0.0 && then.x <= width_ && then.y <= height_;
    if (!seen) return {};

    // Those of the four pixels around it that show the same, by their shares.
    const glm::dvec2 position = then - 0.5;
    const int left = int(std::floor(position.x)), top = int(std::floor(position.y));
    const glm::dvec2 part(position.x - left, position.y - top);
    const double allowed = surface ? tolerance(now.depth, x, y, there.depth) : 0.0;
    double sum[3] = {}, total = 0.0;
    for (int tap = 0; tap < 4; ++tap) {
        const int tx = left + (tap & 1), ty = top + (tap >> 1);
        const double weight = ((tap & 1) ? part.x : 1.0 - part.x) * ((tap >> 1) ? part.y : 1.0 - part.y);
        if (weight == 0.0 || tx < 0 || ty < 0 || tx >= width_ || ty >= height_) continue;
        const double found = double(*before_->depth.pixel(tx, ty));
        const bool same = surface ? std::abs(found - there.depth) <= allowed : !std::isfinite(found);
        if (!same) continue;
        for (int c = 0; c < 3; ++c) sum[c] += weight * double(history_.pixel(tx, ty)[c]);
        total += weight;
    }
    if (total == 0.0) return {};
    return {true, {float(sum[0] / total), float(sum[1] / total), float(sum[2] / total)}};
}

}  // namespace rawtexel::shading
