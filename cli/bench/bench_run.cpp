#include "cli/bench/bench_run.h"

#include "cli/bench/file_names.h"
#include "cli/comparable_image.h"
#include "cli/flip_comparison.h"
#include "cli/frame_setup.h"
#include "cli/illumination.h"
#include "cli/image_output.h"
#include "cli/limits.h"
#include "cli/metadata.h"
#include "cli/option_values.h"
#include "cli/texture_stats.h"
#include "cli/view.h"
#include "scenes/image_io.h"
#include "shading/cluster_meshes.h"
#include "shading/reference.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace rawtexel::cli {
namespace {

using Json = nlohmann::ordered_json;
using shading::Image;

constexpr double kTruthGoal = 1e-3;  ///< of the root mean square of the image, where the user gave no goal

/// The time for the sweep is over.
struct TimeOver {};

double root_mean_square(const Image& image) {
    double sum = 0;
    for (const float value : image.values) sum += double(value) * double(value);
    return std::sqrt(sum / double(std::max<size_t>(image.values.size(), 1)));
}

double mean(const Image& image) {
    double sum = 0;
    for (const float value : image.values) sum += double(value);
    return sum / double(std::max<size_t>(image.values.size(), 1));
}

/// Everything of a scene that its configurations share.
struct Stage {
    std::string name;
    std::unique_ptr<shading::Scene> scene;
    View view;
    shading::Lighting lighting;
    Sweep sweep;
};

class BenchRunner {
  public:
    BenchRunner(const BenchPlan& plan, SweepFile& file, const Invocation& invocation, shading::Executor& executor, ProgressReport& progress,
                const std::function<void(const std::string&)>& opened)
        : plan_(plan), file_(file), invocation_(invocation), executor_(executor), progress_(progress), opened_(opened) {}

    std::vector<SceneResults> run() {
        // All scenes are looked at before the first is measured: what cannot be loaded shows at once, and how much there is to do.
        progress_.begin("loading");
        std::vector<Sweep> sweeps;
        for (const std::string& name : plan_.scenes) sweeps.push_back(load(name).sweep);
        for (size_t i = 0; i < sweeps.size(); ++i) total_ += remaining_effort(plan_.scenes[i], sweeps[i]);
        file_.begin();
        progress_.begin("measuring", total_, "shaded texels");
        std::vector<SceneResults> results;
        for (size_t i = 0; i < plan_.scenes.size(); ++i) results.push_back(measure_scene(i));
        return results;
    }

  private:
    double pixels() const {
        const shading::Crop& crop = plan_.base.crop;
        const ImageSize size = plan_.base.image_size();
        return crop.width > 0 ? double(crop.width) * crop.height : double(size.width) * size.height;
    }

    Stage load(const std::string& name) {
        Stage stage;
        stage.name = name;
        std::vector<std::string> paths;
        scenes::LoadOptions options = load_options(plan_.base, invocation_, progress_);
        options.opened = [&](const std::string& path) {
            paths.push_back(path);
            opened_(path);
        };
        // What a file is warned of is said once.
        if (!loaded_.insert(name).second) options.warn = {};
        if (!options.warn) options.warn = [](const std::string&) {};
        stage.scene = std::make_unique<shading::Scene>(load_scene(name, plan_.base, options));
        if (!plan_.base.policy.empty()) paths.push_back(plan_.base.policy);
        const auto& environment = plan_.base.light.environment;
        if (environment && environment->kind == EnvironmentKind::File) paths.push_back(environment->file);
        file_.check_files(name, paths);
        const ImageSize size = plan_.base.image_size();
        stage.view = choose_view(*stage.scene, plan_.base.view, float(size.width) / float(size.height));
        stage.sweep = plan_sweep(plan_.axes, plan_.base, plan_.budget, [&](const RenderRequest& request) {
            return shading::refusal(*stage.scene, frame_options(request, stage.view.camera));
        });
        if (stage.sweep.configurations.empty())
            throw UsageError(name + ": no configuration is left to measure (" + stage.sweep.left_out.front().options + ": " +
                             stage.sweep.left_out.front().reason + ")");
        return stage;
    }

    double truth_effort(const std::optional<texunit::Kernel>& filter) const {
        const Configuration all{filter, {.mip = texunit::MipMode::None}, texunit::Estimator::All, shading::FilterOrder::After, 1};
        return effort(all) * pixels() * truth_samples(filter, pixels(), plan_.budget);
    }
    double configuration_effort(const Configuration& configuration) const {
        return effort(configuration) * pixels() * configuration.spp * (1 + repeats_of(configuration, pixels(), plan_.budget));
    }
    double remaining_effort(const std::string& scene, const Sweep& sweep) const {
        double sum = 0;
        std::set<std::string> filters;
        for (const Configuration& configuration : sweep.configurations) {
            if (file_.measurement(scene, shell_quoted(options_of(configuration)))) continue;
            sum += configuration_effort(configuration);
            const std::string filter = print_filter(configuration.filter);
            if (filters.insert(filter).second && !file_.truth(scene, filter)) sum += truth_effort(configuration.filter);
        }
        return sum;
    }
    void advance(double work) {
        done_ += work;
        progress_.update(total_ > 0 ? done_ / total_ : 1.0);
    }
    /// Of a piece of the work that is under way.
    void show(double work, double share) { progress_.update(total_ > 0 ? (done_ + work * share) / total_ : 1.0); }

    /// When a scene may begin nothing more: the scenes after it keep a tenth of the time each.
    bool is_over(size_t scene) const {
        if (!plan_.seconds) return false;
        const double later = double(plan_.scenes.size() - 1 - scene);
        const double kept = *plan_.seconds * std::min(0.1 * later, 0.5);
        return ProgressReport::steady_seconds() - plan_.start > *plan_.seconds - kept;
    }

    SceneResults measure_scene(size_t index) {
        Stage stage = load(plan_.scenes[index]);
        shading::cluster_meshes(*stage.scene, executor_);
        SceneResults results;
        results.scene = stage.name;
        results.camera = stage.view.options;
        bool has_light = false;
        std::optional<Image> truth_image;
        std::optional<Truth> truth;
        for (const Configuration& configuration : stage.sweep.configurations) {
            const std::string filter = print_filter(configuration.filter);
            const std::string options = shell_quoted(options_of(configuration));
            const Measurement* finished = file_.measurement(stage.name, options);
            const bool known = finished && exists(finished->picture);
            if (!known && is_over(index)) {
                leave_out_for_time(stage, configuration);
                continue;
            }
            if (!has_light) {
                stage.lighting = make_lighting(*stage.scene, plan_.base.light, executor_);
                has_light = true;
            }
            if (!truth || truth->filter != filter) {
                truth.reset();
                try {
                    truth = find_truth(stage, configuration.filter, index);
                } catch (const TimeOver&) {
                    leave_out_for_time(stage, configuration);
                    continue;
                }
                truth_image = read_comparable(plan_.folder + "/" + truth->picture).image;
                results.truths.push_back(*truth);
            }
            if (known) {
                results.measurements.push_back(*finished);
                continue;
            }
            Measurement measurement = measure(stage, configuration, *truth_image);
            file_.add(measurement);
            results.measurements.push_back(std::move(measurement));
        }
        results.left_out = std::move(stage.sweep.left_out);
        return results;
    }

    void leave_out_for_time(Stage& stage, const Configuration& configuration) {
        stage.sweep.leave_out(configuration, "--quick: the minute was over (the same command with --resume goes on)", /*late=*/true);
        advance(configuration_effort(configuration));
    }

    bool exists(const std::string& picture) const {
        std::error_code error;
        return std::filesystem::is_regular_file(plan_.folder + "/" + picture, error);
    }

    std::string picture_name(const std::string& scene, const std::string& rest) const {
        return "pictures/" + scene_word(scene, plan_.scenes) + "_" + rest + ".exr";
    }

    std::string command_of(const std::string& scene, const std::string& picture, const std::vector<std::string>& options) const {
        std::vector<std::string> words{"rawtexel", "render", scene, "-o", picture};
        words.insert(words.end(), options.begin(), options.end());
        return shell_quoted(words);
    }

    /// The shared options that mean something to `request`: one that draws nothing takes none of draws.
    std::vector<std::string> shared_options(const RenderRequest& request) const {
        const shading::FilteringOptions &filtering = request.lookup.filtering, &shared = plan_.base.lookup.filtering;
        const std::pair<const char*, bool> taken[] = {{"--taps", filtering.taps == shared.taps},
                                                      {"--random", filtering.sharing == shared.sharing},
                                                      {"--noise", filtering.noise == shared.noise},
                                                      {"--signed-numbers", filtering.common_numbers == shared.common_numbers}};
        std::vector<std::string> options;
        for (const auto& [name, value] : plan_.options) {
            const auto draw = std::ranges::find_if(taken, [&](const auto& one) { return one.first == name; });
            if (draw != std::end(taken) && !draw->second) continue;
            options.push_back(name);
            if (!value.empty()) options.push_back(value);
        }
        return options;
    }

    RunRecord record_of(const Stage& stage, const RenderRequest& request, const std::string& command) const {
        RunRecord record;
        record.scene = stage.name;
        record.command = command;
        record.view = stage.view.options;
        record.request = request;
        return record;
    }

    void write_picture(const std::string& picture, const RunRecord& record) const {
        const ImageSize size = plan_.base.image_size();
        const shading::Crop& crop = plan_.base.crop;
        scenes::write_float(plan_.folder + "/" + picture, record.result.radiance, {}, image_metadata(record, false),
                            {crop.x, crop.y, size.width, size.height});
    }

    Truth find_truth(const Stage& stage, const std::optional<texunit::Kernel>& filter, size_t index) {
        const Truth* finished = file_.truth(stage.name, print_filter(filter));
        if (finished && exists(finished->picture)) return *finished;
        RenderRequest request = plan_.base;
        request.lookup.filter = filter;
        request.lookup.footprint = {};
        request.lookup.filtering = {};
        request.lookup.names_lod_rule = false;
        request.lookup.precision = texunit::Precision::Exact;
        request.samples.seed = ~plan_.base.samples.seed;
        request.samples.pixel_jitter = shading::PixelJitter::Frame;
        request.samples.adaptive.reset();

        Truth truth;
        truth.scene = stage.name;
        truth.filter = print_filter(filter);
        truth.seed = request.samples.seed;
        truth.goal = plan_.truth_error.value_or(0.0);
        if (!plan_.truth_error) {
            const Image glance =
                shading::render(*stage.scene, stage.lighting, frame_options(request, stage.view.camera), executor_).radiance;
            truth.goal = std::clamp(kTruthGoal * root_mean_square(glance), 1e-6, 1e6);
        }
        request.samples.reference = float(truth.goal);
        truth.goal = double(*request.samples.reference);
        const shading::RenderOptions options = frame_options(request, stage.view.camera);
        const bool limited = !plan_.truth_error || plan_.budget.quick;
        const shading::ReferenceGoal goal{truth.goal, limited ? truth_samples(filter, pixels(), plan_.budget) : kMaxSamples};
        const double start = ProgressReport::steady_seconds(), work = truth_effort(filter);
        shading::Reference reference = render_reference(*stage.scene, stage.lighting, options, goal, executor_, [&](double share) {
            if (is_over(index)) throw TimeOver{};
            show(work, share);
        });
        truth.seconds = ProgressReport::steady_seconds() - start;
        truth.standard_error = reference.standard_error;
        truth.samples = reference.samples;
        truth.picture = picture_name(stage.name, file_word(truth.filter) + "_truth");
        truth.command = truth_command(truth);
        RunRecord record = record_of(stage, request, truth.command);
        record.request.samples.spp = truth.samples;
        record.standard_error = truth.standard_error;
        record.result = std::move(reference.result);
        write_picture(truth.picture, record);
        file_.add(truth);
        advance(work);
        return truth;
    }

    /// With the goal that ends after as many samples.
    std::string truth_command(const Truth& truth) const {
        // What leaves the truth no choice or is its own.
        static const std::set<std::string> kOthers{"--lod-rule",     "--lod-bias",       "--derivatives", "--footprint",
                                                   "--taps",         "--random",         "--noise",       "--blend",
                                                   "--shadow-taps",  "--texture-jitter", "--precision",   "--signed-numbers",
                                                   "--pixel-jitter", "--adaptive",       "--baseline",    "--seed"};
        std::vector<std::string> options;
        for (const auto& [name, value] : plan_.options) {
            if (kOthers.contains(name)) continue;
            options.push_back(name);
            if (!value.empty()) options.push_back(value);
        }
        const double goal = truth.standard_error < truth.goal ? truth.goal : truth.standard_error * (1 + 1e-6);
        for (const std::string& word : {std::string("--filter"), truth.filter, std::string("--seed"), std::to_string(truth.seed),
                                        std::string("--reference"), print_number(std::max(float(goal), 1e-6f))})
            options.push_back(word);
        return command_of(truth.scene, truth.picture, options);
    }

    Measurement measure(const Stage& stage, const Configuration& configuration, const Image& truth) {
        RenderRequest request = with_configuration(plan_.base, configuration);
        request.fetches.count = true;
        settle(request);
        const int repeats = repeats_of(configuration, pixels(), plan_.budget);
        const double work = configuration_effort(configuration);

        Measurement one;
        one.scene = stage.name;
        one.filter = print_filter(configuration.filter);
        one.minification = print(configuration.minification);
        one.estimator = std::string(to_string(configuration.estimator));
        one.order = std::string(to_string(configuration.order));
        one.spp = configuration.spp;
        one.hybrid_bias = configuration.minification.hybrid_bias;
        one.one_tap = is_one_tap(configuration, plan_.base);
        one.ellipse = configuration.minification.ellipse > 0;
        std::vector<std::string> options = options_of(configuration);
        one.options = shell_quoted(options);
        const std::vector<std::string> shared = shared_options(request);
        options.insert(options.begin(), shared.begin(), shared.end());
        one.picture = picture_name(stage.name, file_word(one.filter) + "_" + file_word(one.minification) + "_" + one.estimator + "_" +
                                                   one.order + "_" + std::to_string(one.spp));
        one.command = command_of(stage.name, one.picture, options);

        // Counted once: what the textures hold is decoded from then on, so that no timed frame is the first.
        RunRecord record = record_of(stage, request, one.command);
        shading::RenderOptions frame = frame_options(request, stage.view.camera);
        frame.fetches.pixel_lines = true;
        const auto show_frame = [&](int number) {
            return [this, number, repeats, work](double share) { show(work, (number + share) / (1 + repeats)); };
        };
        record.result = shading::render(*stage.scene, stage.lighting, frame, executor_, show_frame(0));
        record.work = texture_work(*stage.scene);
        write_picture(one.picture, record);
        measure_picture(record, *stage.scene, truth, one);

        frame.fetches = {};
        for (int repeat = 0; repeat < repeats; ++repeat) {
            const shading::RenderTimes times =
                shading::render(*stage.scene, stage.lighting, frame, executor_, show_frame(1 + repeat)).times;
            one.frame_s.push_back(times.frame_s);
            one.geometry_s.push_back(times.geometry_s);
            one.raster_s.push_back(times.raster_s);
            one.shade_s.push_back(times.shade_s);
        }
        advance(work);
        return one;
    }

    void measure_picture(const RunRecord& record, const shading::Scene& scene, const Image& truth, Measurement& one) {
        const shading::RenderResult& result = record.result;
        one.width = result.radiance.width;
        one.height = result.radiance.height;
        one.samples_shaded = result.samples_shaded;
        one.mean_spp = shading::mean_samples(result);
        one.error = image_error(result.radiance.values, truth.values);
        const FlipComparison flip = flip_comparison({result.radiance, true}, {truth, true}, {}, executor_);
        one.flip = flip.figures.mean;
        one.flip_kind = std::string(to_string(flip.kind));
        one.lines_per_pixel = mean(result.fetches->pixel(shading::PixelCount::LinesPixel));
        Json stats;
        add_texture_stats(record, scene, stats);
        one.texture = stats.at("texture");
        for (const char* key : {"performed", "layouts"}) one.texture.erase(key);
    }

    const BenchPlan& plan_;
    SweepFile& file_;
    const Invocation& invocation_;
    shading::Executor& executor_;
    ProgressReport& progress_;
    const std::function<void(const std::string&)>& opened_;
    std::set<std::string> loaded_;
    double total_ = 0, done_ = 0;  ///< effort
};

}  // namespace

const Truth& SceneResults::truth_of(const Measurement& measurement) const {
    return *std::ranges::find(truths, measurement.filter, &Truth::filter);
}

std::vector<SceneResults> run_bench(const BenchPlan& plan, SweepFile& file, const Invocation& invocation, shading::Executor& executor,
                                    ProgressReport& progress, const std::function<void(const std::string&)>& opened) {
    return BenchRunner(plan, file, invocation, executor, progress, opened).run();
}

}  // namespace rawtexel::cli
