#include "cli/commands/explain.h"

#include "cli/explanation_report.h"
#include "cli/frame_setup.h"
#include "cli/illumination.h"
#include "cli/image_output.h"
#include "cli/limits.h"
#include "cli/option_values.h"
#include "cli/pixel_watcher.h"
#include "cli/view.h"
#include "shading/cluster_meshes.h"
#include "shading/accumulation.h"

#include <algorithm>
#include <optional>

namespace rawtexel::cli {
namespace {

/// Samples gathered before they are told: bounds the memory, while a frame's geometry is set up for many at once.
constexpr int kSamplesAtOnce = 256;

struct PixelPlace {
    int x = 0, y = 0;
};

PixelPlace parse_pixel(std::string_view text) {
    const std::vector<int64_t> values = parse_integers("--pixel", text, "X,Y", 2, 0, kMaxImageExtent - 1);
    return {int(values[0]), int(values[1])};
}

/// Throws UsageError where the pixel is not rendered.
void check_pixel(const PixelPlace& pixel, const RenderRequest& request) {
    const std::string place = "--pixel: " + std::to_string(pixel.x) + "," + std::to_string(pixel.y);
    const ImageSize size = request.image_size();
    if (pixel.x >= size.width || pixel.y >= size.height)
        throw UsageError(place + " is outside the image of " + print(size) + " (0,0 to " + std::to_string(size.width - 1) + "," +
                         std::to_string(size.height - 1) + ")");
    const shading::Crop& crop = request.crop;
    const bool inside = pixel.x >= crop.x && pixel.x < crop.x + crop.width && pixel.y >= crop.y && pixel.y < crop.y + crop.height;
    if (crop.width > 0 && !inside)
        throw UsageError(place + " is outside --crop " + print(crop) + "; both are in pixels of the whole image");
}

/// What is the same for all samples.
struct PixelFrame {
    const shading::Scene& scene;
    const shading::Lighting& lighting;
    shading::RenderOptions options;  ///< of the pixel alone
    PixelPlace pixel;
};

class ExplainCommand : public Command {
  public:
    std::string_view name() const override { return "explain"; }
    std::string_view usage() const override { return "explain SCENE --pixel X,Y [--sample N] [options]"; }
    std::string_view summary() const override {
        return "Explains one pixel of a render: of every sample the surfaces, their lookups with each tap, weight and value, the random "
               "numbers and the light; summed it is the rendered pixel bit for bit.";
    }

    void declare(CommandLine& line) override {
        line.arguments("SCENE", "a .gltf or .glb file, or a built-in scene (rawtexel list scenes)", 1, 1, words_);
        line.option("--pixel", "X,Y", "from the upper left corner of the whole image, whatever --crop says",
                    [this](const std::string& text) { pixel_ = parse_pixel(text); });
        line.option("--sample", "N",
                    "this sample alone, 0 to " + std::to_string(kMaxSamples - 1) + "; where there are fewer, --spp is N + 1 (default: all)",
                    [this](const std::string& text) { sample_ = int(parse_integer("--sample", text, 0, kMaxSamples - 1)); });
        line.flag("--json", "one JSON object instead of text", json_);
        declare_render_options(line, request_);
    }

    int run(const Invocation& invocation) override;

  private:
    void settle_words(const Invocation& invocation);
    ExplainedPixel heading(const PixelFrame& frame, const View& view) const;
    void tell_samples(const PixelFrame& frame, ExplanationReport& report, shading::SampleTree& sums) const;
    ExplainedMean find_mean(const PixelFrame& frame, const shading::SampleTree& sums, shading::Executor& executor) const;

    std::vector<std::string> words_;
    std::optional<PixelPlace> pixel_;
    std::optional<int> sample_;
    bool json_ = false;
    RenderRequest request_;
};

void ExplainCommand::settle_words(const Invocation& invocation) {
    if (!pixel_) throw UsageError("--pixel X,Y is missing (usage: rawtexel " + std::string(usage()) + ")");
    if (request_.samples.reference) throw UsageError("--reference: explain tells of samples, of which --spp says how many");
    if (request_.samples.adaptive) throw UsageError("--adaptive: explain tells of one pixel, and blocks of pixels stop as a whole");
    settle(request_);
    check_pixel(*pixel_, request_);
    if (sample_) request_.samples.spp = std::max(request_.samples.spp, *sample_ + 1);
    if (request_.fetches.counts())
        warn(invocation, "--count, --fetch-model and --cache change nothing here: told are the lookups that made the pixel");
}

ExplainedPixel ExplainCommand::heading(const PixelFrame& frame, const View& view) const {
    return {.scene = words_[0],
            .camera = view.options,
            .width = frame.options.width,
            .height = frame.options.height,
            .x = frame.pixel.x,
            .y = frame.pixel.y,
            .spp = frame.options.spp,
            .pixel_filter = frame.options.pixel_filter,
            .pixel_jitter = frame.options.pixel_jitter,
            .seed = frame.options.seed};
}

// Renders the samples in stretches, each of which is told before the next begins.
void ExplainCommand::tell_samples(const PixelFrame& frame, ExplanationReport& report, shading::SampleTree& sums) const {
    const auto one_thread = shading::make_executor(shading::ExecutorKind::Threads, 1);
    PixelWatcher watcher(frame.pixel.x, frame.pixel.y, frame.options, frame.lighting);
    shading::RenderOptions options = frame.options;
    options.image_spp = frame.options.spp;
    options.fragment_listener = &watcher;
    const int first = sample_.value_or(0), end = sample_ ? first + 1 : frame.options.spp;
    for (int next = first; next < end; next += options.spp) {
        options.first_sample = uint32_t(next);
        options.spp = std::min(kSamplesAtOnce, end - next);
        shading::render(frame.scene, frame.lighting, options, *one_thread);
        for (const ExplainedSample& sample : watcher.take()) {
            report.sample(sample);
            sums.add(sample.sample, {&sample.radiance.x, 3});
        }
    }
}

// Beside the samples' mean the pixel as `render` makes it, with nobody watching.
ExplainedMean ExplainCommand::find_mean(const PixelFrame& frame, const shading::SampleTree& sums, shading::Executor& executor) const {
    const shading::Image pixel = shading::render(frame.scene, frame.lighting, frame.options, executor).radiance;
    const shading::DisplayOptions display = display_options(request_.tone);
    const std::vector<uint8_t> codes = shading::encode_8bit(shading::tone_mapped(pixel, display), display.transfer);
    ExplainedMean mean;
    sums.mean(0, {&mean.mean.x, 3});
    mean.rendered = {pixel.values[0], pixel.values[1], pixel.values[2]};
    std::copy_n(codes.begin(), 3, mean.codes.begin());
    mean.display = "exposure " + print_number(display.exposure) + ", " + std::string(to_string(display.tone_map)) + ", " +
                   std::string(to_string(display.transfer));
    return mean;
}

int ExplainCommand::run(const Invocation& invocation) {
    settle_words(invocation);
    choose_instruction_set(request_.machine.simd);
    const auto executor = shading::make_executor(shading::default_executor_kind(), request_.machine.threads);

    ProgressReport progress(invocation.err, request_.machine.progress, invocation.err_is_terminal);
    progress.begin("loading");
    shading::Scene scene = load_scene(words_[0], request_, load_options(request_, invocation, progress));
    shading::cluster_meshes(scene, *executor);
    const ImageSize size = request_.image_size();
    const View view = choose_view(scene, request_.view, float(size.width) / float(size.height));
    progress.begin("preparing light");
    const shading::Lighting lighting = make_lighting(scene, request_.light, *executor);
    progress.finish();

    PixelFrame frame{scene, lighting, frame_options(request_, view.camera), *pixel_};
    check_lookups(scene, frame.options);
    frame.options.crop = {pixel_->x, pixel_->y, 1, 1};
    frame.options.fetches = {};
    const auto report = json_ ? make_explanation_json(invocation.out) : make_explanation_text(invocation.out);
    shading::SampleTree sums(3);
    report->begin(heading(frame, view));
    tell_samples(frame, *report, sums);
    if (sample_) {
        report->end(nullptr);
        return kDone;
    }
    const ExplainedMean mean = find_mean(frame, sums, *executor);
    report->end(&mean);
    return same_bits(mean.mean, mean.rendered) ? kDone : kCheckFailed;
}

}  // namespace

std::unique_ptr<Command> make_explain_command() { return std::make_unique<ExplainCommand>(); }

}  // namespace rawtexel::cli
