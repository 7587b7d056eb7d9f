#include "cli/commands/bench.h"

#include "cli/bench/bench_page.h"
#include "cli/bench/bench_plots.h"
#include "cli/bench/bench_report.h"
#include "cli/bench/bench_run.h"
#include "cli/bench/file_names.h"
#include "cli/frame_setup.h"
#include "cli/limits.h"
#include "cli/option_values.h"
#include "cli/output_files.h"
#include "cli/output_folder.h"
#include "scenes/output_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
#include <span>

namespace rawtexel::cli {
namespace {

const std::vector<std::string> kDefaultScenes{"bumps", "metal-edge", "magnify", "plane"};
constexpr ImageSize kFullSize{128, 72}, kQuickSize{64, 36};
constexpr double kQuickSeconds = 55;  ///< leaves some for the page
constexpr NumberRange kReferenceError{1e-6f, 1e6f};

void write_text(const std::string& path, const std::string& text) { scenes::write_file(path, std::as_bytes(std::span(text))); }

class BenchCommand : public Command {
  public:
    std::string_view name() const override { return "bench"; }
    std::string_view usage() const override { return "bench [SCENE...] -o DIR [options]"; }
    std::string_view summary() const override {
        return "Measures time, fetches and error of every combination of kernels, levels, estimators, orders and samples against the "
               "truth, "
               "and writes bench.json, bench.csv, plots, pictures and index.html, which shows all of it.";
    }

    void declare(CommandLine& line) override {
        line_ = &line;
        line.arguments("SCENE", ".gltf or .glb files, or built-in scenes (default bumps metal-edge magnify plane)", 0, size_t(-1), scenes_);
        line.option("-o,--output", "DIR", "the folder to write, made where it is missing",
                    [this](const std::string& text) { output_ = text; });
        line.flag("--quick", "a sweep that ends within a minute on two cores: fewer settings and samples of small frames", quick_);
        line.flag("--resume", "go on with a sweep into DIR that was interrupted: what it finished is kept", resume_);
        line.option("--repeat", "N",
                    "timed frames of every configuration, 1 to " + std::to_string(kMaxRepeats) +
                        " (default 3 to 9, with --quick 2 to 5: the fewer the more a frame shades)",
                    [this](const std::string& text) { repeats_ = int(parse_integer("--repeat", text, 1, kMaxRepeats)); });
        request_.samples.pixel_jitter = shading::PixelJitter::Pixel;
        declare_render_options(line, request_);
        declare_axes(line, axes_);
        line.replace_option("--size", "WxH",
                            "extents in pixels, 1 to " + std::to_string(kMaxImageExtent) + " (default " + print(kFullSize) +
                                ", with --quick " + print(kQuickSize) + ")",
                            [this](const std::string& text) { request_.size = parse_size(text); });
        line.replace_option(
            "--pixel-jitter", "frame|pixel", "one offset per sample for all pixels, or one per pixel (the default here)",
            [this](const std::string& text) {
                using shading::PixelJitter;
                request_.samples.pixel_jitter = parse_choice("--pixel-jitter", text, {PixelJitter::Frame, PixelJitter::Pixel});
            });
        line.replace_option("--reference", "ERROR",
                            "the truths' standard error, " + print(kReferenceError) +
                                " (default: a thousandth of the image's root mean square, as far as an affordable number of samples goes)",
                            [this](const std::string& text) { truth_error_ = parse_number("--reference", text, kReferenceError); });
    }

    int run(const Invocation& invocation) override;

  private:
    BenchPlan make_plan();
    void check_shared() const;
    GivenOptions settings() const;
    GivenOptions shared_options() const;
    std::vector<std::string> input_files() const;
    void write_files(const OutputFolder& folder, std::span<const SceneResults> results, const std::string& command,
                     shading::Executor& executor) const;

    const CommandLine* line_ = nullptr;  ///< parsed by the time that run is called
    std::vector<std::string> scenes_;
    std::string output_;
    bool quick_ = false, resume_ = false;
    std::optional<int> repeats_;
    std::optional<float> truth_error_;
    RenderRequest request_;
    SweepAxes axes_;
};

// What is wrong with every configuration is an error, not a reason to leave them all out.
void BenchCommand::check_shared() const {
    RenderRequest shared = request_;
    shading::FilteringOptions& filtering = shared.lookup.filtering;
    const shading::FilteringOptions plain;
    filtering.taps = plain.taps;
    filtering.sharing = plain.sharing;
    filtering.common_numbers = plain.common_numbers;
    shared.lookup.footprint.ellipse = 0;
    shared.lookup.footprint.area = shading::FootprintArea::Pixel;
    shared.samples.spp = kMaxSamples;
    if (filtering.texture_jitter != shading::TextureJitter::None) shared.lookup.mip = texunit::MipMode::None;
    settle(shared);
    const bool draws = axes_.estimators.empty() || std::ranges::any_of(axes_.estimators, [](texunit::Estimator estimator) {
                           return estimator != texunit::Estimator::All;
                       });
    const bool draws_otherwise = filtering.texture_jitter != shading::TextureJitter::None || filtering.blend == shading::Blend::Draw ||
                                 filtering.shadow_taps == shading::ShadowTaps::One || draws_level(filtering.baseline);
    for (const auto& [name, value] : line_->given())
        if (!draws && (name == "--taps" || name == "--random" || name == "--signed-numbers" || (name == "--noise" && !draws_otherwise)))
            throw UsageError(name + ": --estimator all draws nothing");
}

BenchPlan BenchCommand::make_plan() {
    if (output_.empty()) throw UsageError("-o DIR is missing (usage: rawtexel " + std::string(usage()) + ")");
    if (scenes_.empty()) scenes_ = kDefaultScenes;
    for (size_t i = 0; i < scenes_.size(); ++i)
        if (std::find(scenes_.begin(), scenes_.begin() + std::ptrdiff_t(i), scenes_[i]) != scenes_.begin() + std::ptrdiff_t(i))
            throw UsageError("'" + scenes_[i] + "' is named twice");
    if (!request_.size) request_.size = quick_ ? kQuickSize : kFullSize;
    check_shared();

    BenchPlan plan;
    plan.scenes = scenes_;
    plan.folder = output_;
    plan.base = request_;
    plan.axes = axes_;
    plan.budget = quick_ ? quick_budget(scenes_.size()) : full_budget();
    if (repeats_) plan.budget.least_repeats = plan.budget.most_repeats = *repeats_;
    if (truth_error_) plan.truth_error = double(*truth_error_);
    plan.options = shared_options();
    if (quick_) {
        plan.seconds = kQuickSeconds;
        const shading::Crop& crop = request_.crop;
        const ImageSize size = request_.image_size();
        const double pixels = crop.width > 0 ? double(crop.width) * crop.height : double(size.width) * size.height;
        const double most = quick_pixels(plan.budget);
        if (pixels > most)
            throw UsageError("--quick: frames of " + std::to_string(int64_t(pixels)) + " pixels take more than a minute (allowed: up to " +
                             std::to_string(int64_t(most)) + " for " + std::to_string(scenes_.size()) +
                             (scenes_.size() == 1 ? " scene)" : " scenes)"));
    }
    return plan;
}

/// Everything but where results go and how progress shows.
GivenOptions BenchCommand::settings() const {
    GivenOptions settings;
    for (const std::string& scene : scenes_) settings.emplace_back(scene, "");
    for (const auto& option : line_->given())
        if (option.first != "--output" && option.first != "--resume" && option.first != "--progress") settings.push_back(option);
    std::ranges::sort(settings.begin() + std::ptrdiff_t(scenes_.size()), settings.end());
    return settings;
}

/// Of `render`, that make every configuration's picture.
GivenOptions BenchCommand::shared_options() const {
    static const std::set<std::string> kOwn{"--output",    "--resume", "--quick",     "--repeat",      "--progress", "--filter",
                                            "--mip",       "--aniso",  "--estimator", "--order",       "--spp",      "--hybrid-bias",
                                            "--reference", "--count",  "--cache",     "--fetch-model", "--threads",  "--tile-size",
                                            "--simd",      "--skip",   "--no-skip"};
    GivenOptions options;
    bool size = false, jitter = false;
    for (const auto& option : line_->given()) {
        if (kOwn.contains(option.first) || option.first.starts_with("--ewa")) continue;
        size = size || option.first == "--size";
        jitter = jitter || option.first == "--pixel-jitter";
        options.push_back(option);
    }
    if (!size) options.emplace_back("--size", print(request_.image_size()));
    if (!jitter) options.emplace_back("--pixel-jitter", "pixel");
    return options;
}

std::vector<std::string> BenchCommand::input_files() const {
    std::vector<std::string> files = scenes_;
    const auto& environment = request_.light.environment;
    if (environment && environment->kind == EnvironmentKind::File) files.push_back(environment->file);
    if (!request_.policy.empty()) files.push_back(request_.policy);
    return files;
}

int BenchCommand::run(const Invocation& invocation) {
    const double start = ProgressReport::steady_seconds();
    BenchPlan plan = make_plan();
    plan.start = start;
    choose_instruction_set(request_.machine.simd);
    const OutputFolder folder(output_);
    const OutputFolder pictures(folder / "pictures"), plots(folder / "plots");
    const std::string sweep = folder / "sweep.jsonl";
    std::vector<OutputFile> outputs;
    for (const char* file : {"bench.json", "bench.csv", "index.html", "sweep.jsonl"}) outputs.push_back({"-o", folder / file});
    check_outputs(outputs, input_files());
    if (!resume_ && SweepFile::is_interrupted(sweep))
        warn(invocation, output_ + ": the sweep that was interrupted there begins anew (--resume goes on with it)");
    SweepFile file = resume_ ? SweepFile::resumed(sweep, settings()) : SweepFile(sweep, settings());

    const auto executor = shading::make_executor(shading::default_executor_kind(), request_.machine.threads);
    ProgressReport progress(invocation.err, request_.machine.progress, invocation.err_is_terminal);
    const size_t kept = file.finished();
    const std::vector<SceneResults> results =
        run_bench(plan, file, invocation, *executor, progress, [&](const std::string& path) { check_apart(outputs, std::vector{path}); });
    progress.begin("writing");
    write_files(folder, results, invocation.command_line, *executor);
    progress.finish();

    size_t measured = 0, left_out = 0, late = 0;
    for (const SceneResults& scene : results) {
        measured += scene.measurements.size();
        for (const LeftOut& one : scene.left_out) (one.late ? late : left_out) += one.spps.size();
    }
    if (late > 0)
        warn(invocation,
             "the time was over: " + std::to_string(late) + " configurations were not measured (the same command with --resume goes on)");
    else
        file.end();
    invocation.out << "Measured: " << measured << (measured == 1 ? " configuration" : " configurations");
    if (kept > 0) invocation.out << ", " << kept << " of them before the interruption";
    invocation.out << "; left out: " << left_out << '\n' << "Saved: " << folder / "index.html" << '\n';
    return kDone;
}

void BenchCommand::write_files(const OutputFolder& folder, std::span<const SceneResults> results, const std::string& command,
                               shading::Executor& executor) const {
    std::vector<SceneAnalysis> analyses;
    std::vector<std::vector<BenchPlot>> plots;
    size_t first = 0;
    for (const SceneResults& scene : results) {
        analyses.push_back(analyse(scene));
        plots.push_back(bench_plots(scene, analyses.back().series, analyses.back().fronts, first, scene_word(scene.scene, scenes_)));
        first += scene.measurements.size();
    }
    for (const std::vector<BenchPlot>& drawn : plots)
        for (const BenchPlot& plot : drawn) write_text(folder / plot.file, plot_svg(plot.plot));
    const nlohmann::ordered_json bench = bench_json(results, analyses, command);
    write_text(folder / "bench.csv", bench_csv(bench));
    write_text(folder / "bench.json", bench.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
    write_text(folder / "index.html", bench_page(output_, results, analyses, plots, bench, request_.tone, executor));
}

}  // namespace

std::unique_ptr<Command> make_bench_command() { return std::make_unique<BenchCommand>(); }

}  // namespace rawtexel::cli
