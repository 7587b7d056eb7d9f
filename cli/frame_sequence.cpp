#include "cli/frame_sequence.h"

#include "cli/progress.h"
#include "shading/fetch_account.h"
#include "shading/temporal_depth.h"
#include "shading/temporal_flicker.h"
#include "shading/temporal_history.h"
#include "shading/temporal_sums.h"

#include <algorithm>
#include <utility>

namespace rawtexel::cli {
namespace {

using shading::Accumulation;
using shading::Image;
using shading::RenderOptions;
using shading::RenderResult;

Image cut(const Image& image, const shading::Crop& crop) {
    Image part(crop.width, crop.height, image.channels);
    for (int y = 0; y < crop.height; ++y)
        std::copy_n(image.pixel(crop.x, crop.y + y), size_t(crop.width) * size_t(image.channels), part.pixel(0, y));
    return part;
}

/// From frames to accumulated images.
class Accumulator {
  public:
    Accumulator(const SequenceInputs& inputs, shading::Executor& executor)
        : inputs_(inputs), temporal_(inputs.sequence.temporal()), executor_(executor) {
        if (temporal_.accumulation == Accumulation::Reproject) reprojected_.emplace(temporal_, inputs.options.width, inputs.options.height);
    }

    /// What the frames must be rendered with.
    void prepare(RenderOptions& options) {
        if (temporal_.accumulation == Accumulation::Mean) options.sums = &sums_;
        if (reprojected_) options.crop = {};
    }

    /// Replaces the frame's image by the accumulated one.
    void add(const shading::Camera& camera, Image& frame) {
        if (temporal_.accumulation == Accumulation::Ema) {
            shading::move_towards(frame, temporal_.weight, average_);
            frame = average_;
        } else if (reprojected_) {
            Image depth = shading::center_depth(inputs_.scene, camera, frame.width, frame.height, executor_);
            frame = reprojected_->add(frame, camera, std::move(depth), executor_);
            disoccluded_ += reprojected_->disoccluded();
        }
    }

    bool is_whole() const { return reprojected_.has_value(); }
    uint64_t disoccluded() const { return disoccluded_; }

  private:
    const SequenceInputs& inputs_;
    shading::TemporalOptions temporal_;
    shading::Executor& executor_;
    shading::TemporalSums sums_;
    Image average_;
    std::optional<shading::ReprojectedHistory> reprojected_;
    uint64_t disoccluded_ = 0;
};

/// The part of a whole frame that was asked for.
void cut_all(const shading::Crop& crop, RenderResult& result) {
    if (crop.width == 0) return;
    result.radiance = cut(result.radiance, crop);
    for (shading::Layer& layer : result.layers) layer.image = cut(layer.image, crop);
}

RenderOptions frame_options(const SequenceInputs& inputs, int frame) {
    RenderOptions options = inputs.options;
    options.camera = inputs.path.frame(frame, inputs.sequence.frames);
    options.first_sample = uint32_t(frame) * uint32_t(options.spp);
    // The tiles of all frames are those that the first one's fetches ask for.
    if (options.fetches.needs_order()) options.tile_size = shading::kCanonicalTile;
    if (frame > 0) {
        options.fetches = {};
        options.fetches.model = inputs.options.fetches.model;
    }
    if (frame + 1 < inputs.sequence.frames) options.aovs.clear();
    return options;
}

void record_flicker(const shading::TemporalFlicker& flicker, bool wanted, SequenceResult& sequence) {
    if (flicker.frames() == 0) return;
    sequence.record.flicker_frames = flicker.frames();
    sequence.record.flicker_rms = flicker.rms();
    if (wanted) sequence.flicker = flicker.deviation();
}

}  // namespace

SequenceResult render_sequence(const SequenceInputs& inputs, shading::Executor& executor, const SequenceHooks& hooks) {
    const int frames = inputs.sequence.frames;
    SequenceResult sequence;
    sequence.record.frames = frames;
    Accumulator accumulator(inputs, executor);
    shading::TemporalFlicker flicker;
    for (int frame = 0; frame < frames; ++frame) {
        RenderOptions options = frame_options(inputs, frame);
        accumulator.prepare(options);
        RenderResult result = shading::render(inputs.scene, inputs.lighting, options, executor,
                                              [&](double share) { hooks.progress((frame + share) / frames); });
        sequence.frame_s.push_back(result.times.frame_s);
        if (frame == 0) hooks.first_frame_done();

        const double start = ProgressReport::steady_seconds();
        accumulator.add(options.camera, result.radiance);
        if (accumulator.is_whole()) cut_all(inputs.options.crop, result);
        if (frames >= kLeastFlickerFrames && frame >= first_flicker_frame(frames)) flicker.add(result.radiance);
        sequence.record.accumulate_s += ProgressReport::steady_seconds() - start;

        if (frame == 0) {
            sequence.result = std::move(result);
        } else {
            sequence.result.radiance = std::move(result.radiance);
            sequence.result.layers = std::move(result.layers);
        }
        hooks.frame_done(frame, sequence.result.radiance);
    }
    if (accumulator.is_whole() && frames > 1)
        sequence.record.disoccluded =
            double(accumulator.disoccluded()) / (double(inputs.options.width) * inputs.options.height * (frames - 1));
    record_flicker(flicker, !inputs.sequence.flicker.empty(), sequence);
    return sequence;
}

}  // namespace rawtexel::cli
