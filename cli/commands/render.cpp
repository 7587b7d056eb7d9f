#include "cli/commands/render.h"

#include "cli/camera_path.h"
#include "cli/fetch_files.h"
#include "cli/frame_sequence.h"
#include "cli/frame_setup.h"
#include "cli/illumination.h"
#include "cli/image_output.h"
#include "cli/limits.h"
#include "cli/metadata.h"
#include "cli/option_values.h"
#include "cli/output_files.h"
#include "cli/progress.h"
#include "cli/render_options.h"
#include "cli/run_record.h"
#include "cli/scenario.h"
#include "cli/stats.h"
#include "cli/view.h"
#include "scenes/load.h"
#include "scenes/output_file.h"
#include "shading/cluster_meshes.h"
#include "shading/reference.h"
#include "shading/render.h"

#include <optional>
#include <span>

namespace rawtexel::cli {
namespace {

scenes::Placement placement(const RenderRequest& request) {
    const ImageSize size = request.image_size();
    return {request.crop.x, request.crop.y, size.width, size.height};
}

double sample_count(const shading::RenderOptions& options) {
    const bool cropped = options.crop.width > 0;
    const double width = cropped ? options.crop.width : options.width, height = cropped ? options.crop.height : options.height;
    return width * height * options.spp;
}

void print_fetches(std::ostream& out, const shading::RenderResult& result) {
    const texunit::FetchCounts fetches = result.fetches->total();
    out << "Fetches: " << fetches.lookups << " lookups, " << fetches.taps << " taps, " << fetches.texels_requested << " texels";
    if (result.samples_shaded > 0)
        out << " (" << print_quantity(double(fetches.texels_requested) / double(result.samples_shaded)) << "texels per shaded sample)";
    out << '\n';
}

void print_sequence(std::ostream& out, const RunRecord& record) {
    const SequenceRecord& sequence = *record.sequence;
    out << "Frames: " << sequence.frames << ", accumulate " << print_accumulate(record.request.sequence);
    if (sequence.flicker_rms)
        out << ", flicker " << print_number(float(*sequence.flicker_rms)) << " over the last " << sequence.flicker_frames;
    if (sequence.disoccluded) out << ", " << print_number(float(*sequence.disoccluded)) << " of the pixels without history";
    out << '\n';
}

class RenderCommand : public Command {
  public:
    std::string_view name() const override { return "render"; }
    std::string_view usage() const override { return "render SCENE -o FILE [options]"; }
    std::string_view summary() const override {
        return "Renders a scene to an image whose format follows the extension: .exr .hdr .tif hold linear radiance in floats; "
               ".png .jpg and the like get exposure, tone map and transfer in 8 bits.";
    }

    void declare(CommandLine& line) override {
        line.arguments("SCENE", "a .gltf or .glb file, or a built-in scene (rawtexel list scenes)", 0, 1, words_);
        line.option("-o,--output", "FILE", "the image to write", [this](const std::string& text) { output_ = text; });
        line.option("--scenario", "JSON",
                    "scene, output, camera and environment as google/model-viewer's fidelity tools pass them; options beside it win",
                    [this](const std::string& text) { scenario_ = parse_scenario(text); });
        declare_render_options(line, request_);
        declare_sequence_options(line, request_.sequence);
        line.group("More output");
        line.option("--aov", "LIST", "layers of an .exr: any of depth,normal,albedo,uv,lod,material,texels,lines,spp",
                    [this](const std::string& text) { aovs_ = parse_aovs(text); });
        line.option("--counts", "FILE.exr", "the image with layers of counts, pixel by pixel (rawtexel list counters)",
                    [this](const std::string& text) { counts_ = text; });
        line.option("--trace", "FILE.zst", "every texel read, one by one (docs/fetches.md)",
                    [this](const std::string& text) { trace_ = text; });
        line.option("--stats", "FILE", "the run's numbers as JSON", [this](const std::string& text) { stats_ = text; });
        line.option("--repeat", "N",
                    "render the frame N times for its timing, 1 to " + std::to_string(kMaxRepeats) +
                        "; image and counters are the first's (default 1)",
                    [this](const std::string& text) { repeats_ = int(parse_integer("--repeat", text, 1, kMaxRepeats)); });
    }

    int run(const Invocation& invocation) override;

  private:
    void settle_words();
    std::vector<OutputFile> output_files() const;
    std::vector<std::string> input_files() const;
    void check_sequence() const;
    void check_truth() const;
    void check_all_apart(std::span<const std::string> inputs) const;
    void check_before_long_work(const Invocation& invocation) const;
    shading::Scene load_scene(const Invocation& invocation, ProgressReport& progress) const;
    shading::RenderResult render_frames(const shading::Scene& scene, const shading::Lighting& lighting,
                                        const shading::RenderOptions& options, shading::Executor& executor, ProgressReport& progress,
                                        RunRecord& record) const;
    shading::RenderResult render_truth(const shading::Scene& scene, const shading::Lighting& lighting,
                                       const shading::RenderOptions& options, shading::Executor& executor, ProgressReport& progress,
                                       RunRecord& record) const;
    shading::RenderResult render_sequence(const shading::Scene& scene, const View& view, const shading::Lighting& lighting,
                                          const shading::RenderOptions& options, shading::Executor& executor, ProgressReport& progress,
                                          RunRecord& record) const;
    void write_stats(const RunRecord& record, const shading::Scene& scene) const;

    std::vector<std::string> words_;
    std::string scene_, output_, stats_, counts_, trace_;
    std::optional<Scenario> scenario_;
    RenderRequest request_;
    std::vector<shading::Aov> aovs_;
    int repeats_ = 1;
};

// Scene, output and request from everything that was given, in whatever order.
void RenderCommand::settle_words() {
    if (scenario_) {
        if (!words_.empty()) throw UsageError("--scenario names its model itself: unexpected argument '" + words_[0] + "'");
        scene_ = scenario_->model;
        if (output_.empty()) output_ = scenario_->output_file;
        apply(*scenario_, request_);
    } else {
        if (words_.empty()) throw UsageError("missing argument SCENE (usage: rawtexel " + std::string(usage()) + ")");
        scene_ = words_[0];
    }
    if (output_.empty()) throw UsageError("-o FILE is missing (usage: rawtexel " + std::string(usage()) + ")");
    settle(request_);
    if (request_.sequence.is_sequence()) check_sequence();
    if (request_.samples.reference) check_truth();
}

void RenderCommand::check_sequence() const {
    const SequenceOptions& sequence = request_.sequence;
    check(sequence, request_.samples.spp);
    if (repeats_ > 1) throw UsageError("--repeat times one frame: it makes no sense beside --frames and the options with it");
    if (request_.tone.white_backdrop)
        throw UsageError("--scenario without a skybox asks for one image over white: --frames and the options with it make none");
    const bool counts = request_.fetches.counts() || !counts_.empty() || !trace_.empty();
    if (counts && request_.crop.width > 0 && sequence.temporal().accumulation == shading::Accumulation::Reproject)
        throw UsageError("--accumulate reproject renders whole frames to cut --crop from: their fetches are not those of the crop");
    if (!sequence.frames_out.empty()) check_image_format("--frames-out", frame_name(sequence.frames_out, 0));
    if (sequence.flicker.empty()) return;
    check_image_format("--flicker", sequence.flicker);
    if (!scenes::is_float_format(sequence.flicker))
        throw UsageError("--flicker: '" + sequence.flicker + "' cannot hold floats, a format that can is '.exr'");
}

// Batches of samples are rendered until they suffice, and nothing but their radiance is put together.
void RenderCommand::check_truth() const {
    const bool counts = request_.fetches.counts() || !counts_.empty() || !trace_.empty();
    const std::pair<bool, const char*> asked[] = {{counts, "--count, --cache, --fetch-model, --counts and --trace"},
                                                  {!aovs_.empty(), "--aov"},
                                                  {repeats_ > 1, "--repeat"},
                                                  {request_.tone.white_backdrop, "--scenario without a skybox"}};
    for (const auto& [given, options] : asked)
        if (given) throw UsageError("--reference makes an image and nothing else: " + std::string(options) + " cannot go with it");
}

std::vector<OutputFile> RenderCommand::output_files() const {
    std::vector<OutputFile> files{{"-o", output_}};
    if (!stats_.empty()) files.push_back({"--stats", stats_});
    if (!counts_.empty()) files.push_back({"--counts", counts_});
    if (!trace_.empty()) files.push_back({"--trace", trace_});
    if (!request_.sequence.flicker.empty()) files.push_back({"--flicker", request_.sequence.flicker});
    if (!request_.sequence.frames_out.empty()) files.push_back({"--frames-out", frame_name(request_.sequence.frames_out, 0)});
    return files;
}

std::vector<std::string> RenderCommand::input_files() const {
    std::vector<std::string> files{scene_};
    const auto& environment = request_.light.environment;
    if (environment && environment->kind == EnvironmentKind::File) files.push_back(environment->file);
    const auto& path = request_.sequence.path;
    if (path && path->kind == CameraPathKind::File) files.push_back(path->file);
    if (!request_.policy.empty()) files.push_back(request_.policy);
    return files;
}

// With every frame's file, one after the other: they differ from each other by their numbers.
void RenderCommand::check_all_apart(std::span<const std::string> inputs) const {
    std::vector<OutputFile> outputs = output_files();
    check_apart(outputs, inputs);
    const SequenceOptions& sequence = request_.sequence;
    if (sequence.frames_out.empty()) return;
    for (int frame = 1; frame < sequence.frames; ++frame) {
        outputs.back().path = frame_name(sequence.frames_out, frame);
        check_apart(outputs, inputs);
    }
}

// The format is known, the places can be written.
void RenderCommand::check_before_long_work(const Invocation& invocation) const {
    check_image_format("-o", output_);
    if (!aovs_.empty() && !stores_layers(output_))
        throw UsageError("--aov: '" + output_ + "' cannot hold layers, the format that can is '.exr'");
    if (!counts_.empty() && !stores_layers(counts_))
        throw UsageError("--counts: '" + counts_ + "' cannot hold layers, the format that can is '.exr'");
    const ToneOptions& tone = request_.tone;
    const bool tone_asked = tone.exposure || tone.transfer || (tone.tone_map && !request_.light.peer_shading);
    if (tone_asked && scenes::is_float_format(output_))
        warn(invocation, output_ + ": --exposure, --tonemap and --transfer change nothing here, the format holds linear radiance");
    check_outputs(output_files(), input_files());
    check_all_apart(input_files());
}

shading::Scene RenderCommand::load_scene(const Invocation& invocation, ProgressReport& progress) const {
    std::vector<std::string> opened;
    scenes::LoadOptions options = load_options(request_, invocation, progress);
    options.camera_animations = request_.sequence.path && request_.sequence.path->kind == CameraPathKind::Gltf;
    options.opened = [&](const std::string& path) { opened.push_back(path); };
    shading::Scene scene = cli::load_scene(scene_, request_, options);
    check_all_apart(opened);
    return scene;
}

// The first frame counts; the others are for the clock alone.
shading::RenderResult RenderCommand::render_frames(const shading::Scene& scene, const shading::Lighting& lighting,
                                                   const shading::RenderOptions& options, shading::Executor& executor,
                                                   ProgressReport& progress, RunRecord& record) const {
    progress.begin("rendering", sample_count(options) * repeats_);
    shading::RenderResult first;
    shading::RenderOptions frame = options;
    for (int repeat = 0; repeat < repeats_; ++repeat) {
        if (repeat > 0) frame.fetches.trace = nullptr;
        shading::RenderResult result =
            shading::render(scene, lighting, frame, executor, [&](double share) { progress.update((repeat + share) / repeats_); });
        record.times.frame_s.push_back(result.times.frame_s);
        if (repeat > 0) continue;
        record.work = texture_work(scene);
        first = std::move(result);
    }
    progress.finish();
    return first;
}

shading::RenderResult RenderCommand::render_truth(const shading::Scene& scene, const shading::Lighting& lighting,
                                                  const shading::RenderOptions& options, shading::Executor& executor,
                                                  ProgressReport& progress, RunRecord& record) const {
    progress.begin("rendering the truth");
    const shading::ReferenceGoal goal{.error = double(*request_.samples.reference), .most_samples = kMaxSamples};
    shading::Reference reference =
        render_reference(scene, lighting, options, goal, executor, [&](double share) { progress.update(share); });
    progress.finish();
    record.work = texture_work(scene);
    record.times.frame_s.push_back(reference.result.times.frame_s);
    record.standard_error = reference.standard_error;
    record.request.samples.spp = reference.samples;
    return std::move(reference.result);
}

shading::RenderResult RenderCommand::render_sequence(const shading::Scene& scene, const View& view, const shading::Lighting& lighting,
                                                     const shading::RenderOptions& options, shading::Executor& executor,
                                                     ProgressReport& progress, RunRecord& record) const {
    const SequenceOptions& sequence = request_.sequence;
    const shading::CameraPath path = make_camera_path(sequence, scene, request_.view, view);
    if (sequence.path) check_camera_path(path, sequence.frames, "--camera-path " + print(*sequence.path));
    progress.begin("rendering", sample_count(options) * sequence.frames);
    SequenceHooks hooks;
    hooks.progress = [&](double share) { progress.update(share); };
    hooks.first_frame_done = [&] { record.work = texture_work(scene); };
    if (!sequence.frames_out.empty())
        hooks.frame_done = [&](int frame, const shading::Image& image) {
            const std::string file = frame_name(sequence.frames_out, frame);
            shading::RenderResult shown;
            shown.radiance = image;
            write_image(file, shown, request_.tone, placement(request_), image_metadata(record, !scenes::is_float_format(file)));
        };
    SequenceResult result = cli::render_sequence({scene, lighting, options, path, sequence}, executor, hooks);
    progress.finish();
    record.times.frame_s = std::move(result.frame_s);
    record.sequence = std::move(result.record);
    if (!sequence.flicker.empty())
        scenes::write_float(sequence.flicker, result.flicker, {}, image_metadata(record, false), placement(request_));
    return std::move(result.result);
}

void RenderCommand::write_stats(const RunRecord& record, const shading::Scene& scene) const {
    const std::string text = stats_json(record, scene);
    scenes::write_file(stats_, std::as_bytes(std::span(text)));
}

int RenderCommand::run(const Invocation& invocation) {
    const double start = ProgressReport::steady_seconds();
    settle_words();
    check_before_long_work(invocation);
    choose_instruction_set(request_.machine.simd);
    const auto executor = shading::make_executor(shading::default_executor_kind(), request_.machine.threads);

    ProgressReport progress(invocation.err, request_.machine.progress, invocation.err_is_terminal);
    progress.begin("loading");
    shading::Scene scene = load_scene(invocation, progress);
    shading::cluster_meshes(scene, *executor);
    const ImageSize size = request_.image_size();
    const View view = choose_view(scene, request_.view, float(size.width) / float(size.height));
    progress.begin("preparing light");
    const shading::Lighting lighting = make_lighting(scene, request_.light, *executor);

    RunRecord record;
    record.scene = scene_;
    record.command = invocation.command_line;
    record.view = view.options;
    record.request = request_;
    record.times.load_s = ProgressReport::steady_seconds() - start;
    shading::RenderOptions options = frame_options(request_, view.camera);
    check_lookups(scene, options);
    options.aovs = aovs_;
    options.fetches.pixel_layers = !counts_.empty();
    std::optional<TraceFile> trace;
    if (!trace_.empty()) options.fetches.trace = &trace.emplace(trace_).writer();
    if (request_.samples.reference)
        record.result = render_truth(scene, lighting, options, *executor, progress, record);
    else if (request_.sequence.is_sequence())
        record.result = render_sequence(scene, view, lighting, options, *executor, progress, record);
    else
        record.result = render_frames(scene, lighting, options, *executor, progress, record);
    if (record.standard_error && *record.standard_error >= double(*request_.samples.reference))
        warn(invocation, "--reference: " + print_number(float(*record.standard_error)) + " is the error reached after " +
                             std::to_string(record.request.samples.spp) + " samples, the most there are");

    const double write_start = ProgressReport::steady_seconds();
    const scenes::Metadata metadata = image_metadata(record, !scenes::is_float_format(output_));
    write_image(output_, record.result, request_.tone, placement(request_), metadata);
    if (!counts_.empty()) write_counts(counts_, record.result, placement(request_), metadata);
    if (trace) trace->finish();
    const double end = ProgressReport::steady_seconds();
    record.times.write_s = end - write_start;
    record.times.total_s = end - start;
    if (!stats_.empty()) write_stats(record, scene);

    invocation.out << "Camera: " << view.options << '\n';
    if (record.sequence) print_sequence(invocation.out, record);
    if (record.standard_error)
        invocation.out << "Standard error: " << print_number(float(*record.standard_error)) << " after " << record.request.samples.spp
                       << " samples per pixel\n";
    if (const std::optional<double> mean = mean_samples(record.result))
        invocation.out << "Samples: " << print_quantity(*mean) << "per pixel, the mean\n";
    if (record.result.fetches) print_fetches(invocation.out, record.result);
    invocation.out << "Saved: " << output_ << '\n';
    return kDone;
}

}  // namespace

std::unique_ptr<Command> make_render_command() { return std::make_unique<RenderCommand>(); }

}  // namespace rawtexel::cli
