// What is left of earlier frames: the exponential moving average, in place or moved with the surfaces.
#pragma once

#include "shading/executor.h"
#include "shading/image.h"
#include "shading/scene.h"
#include "shading/temporal_depth.h"
#include "shading/temporal_options.h"

#include <cstdint>
#include <optional>

namespace rawtexel::shading {

/// For each value history + weight * (frame - history), in float, the frame itself where `weight` is 1; the first frame becomes the
/// history.
void move_towards(const Image& frame, float weight, Image& history);

/// A tap of the history shows the surface at hand when its depth differs from the expected one by no more than this share of it, or than
/// this many times as much as the surface's depth differs between the pixel and the nearer of its neighbours along x and along y, added.
inline constexpr double kDepthTolerance = 0.02, kSlopeTolerance = 2.0;
/// Histories may leave the range of the pixel's 3x3 neighbours by this share of the range's ends, so that rounding clips nothing.
inline constexpr float kClampSlack = 1e-5f;

/// Accumulates frames of a camera that moves through a scene that does not. Of each pixel's centre it finds where its surface, or what
/// is infinitely far behind it, was seen in the frame before, and fetches the history there, bilinearly from those of the four pixels
/// that show the same surface. Where there are none the frame itself is the history. A camera at rest fetches every pixel's own history as
/// it is, whose move_towards is then the moving average's.
class ReprojectedHistory {
  public:
    /// `options` with Accumulation::Reproject.
    ReprojectedHistory(const TemporalOptions& options, int width, int height);

    /// Adds a frame of `width` x `height` pixels, seen by `camera`, whose center_depth is `depth`. Returns the accumulated image, which
    /// stays until the next frame. The same bits for any executor.
    const Image& add(const Image& frame, const Camera& camera, Image depth, Executor& executor);

    /// Pixels of the last frame that found no history.
    uint64_t disoccluded() const { return disoccluded_; }

  private:
    struct View {
        FrameProjection projection;
        Image depth;
    };
    struct Fetched {
        bool found = false;
        float color[3] = {};
    };

    void reproject_row(const Image& frame, const View& now, int y, Image& out, uint64_t& disoccluded) const;
    Fetched fetch(const View& now, int x, int y) const;

    TemporalOptions options_;
    int width_, height_;
    Image history_;
    std::optional<View> before_;
    uint64_t disoccluded_ = 0;
};

}  // namespace rawtexel::shading
