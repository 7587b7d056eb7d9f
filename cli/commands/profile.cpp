#include "cli/commands/profile.h"

#include "cli/fetch_files.h"
#include "cli/frame_setup.h"
#include "cli/image_output.h"
#include "cli/metadata.h"
#include "cli/option_values.h"
#include "cli/output_files.h"
#include "cli/output_folder.h"
#include "cli/profile_page.h"
#include "cli/profile_report.h"
#include "cli/profile_run.h"
#include "cli/render_options.h"
#include "cli/reports/heat_map.h"
#include "cli/shell_words.h"
#include "scenes/output_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>
#include <span>

namespace rawtexel::cli {
namespace {

using shading::PixelCount;

std::string heat_map_name(PixelCount count) { return "heat-" + std::string(to_string(count)) + ".png"; }

std::string heat_map_label(PixelCount count) {
    switch (count) {
        case PixelCount::TexelsRequested: return "texel reads a pixel";
        case PixelCount::LinesPixel: return "distinct 64-byte lines";
        case PixelCount::LinesFirst: return "64-byte lines, first touch";
        case PixelCount::BlocksFirst: return "4x4 blocks, first touch";
        case PixelCount::L1Miss: return "l1 misses a pixel";
        case PixelCount::L2Miss: return "l2 misses a pixel";
        case PixelCount::Level: return "mean level of detail";
        case PixelCount::Anisotropy: return "mean anisotropy";
        case PixelCount::Samples: break;
    }
    return "samples of surfaces";
}

void write_text(const std::string& path, const std::string& text) { scenes::write_file(path, std::as_bytes(std::span(text))); }

class ProfileCommand : public Command {
  public:
    std::string_view name() const override { return "profile"; }
    std::string_view usage() const override { return "profile SCENE -o DIR [options]"; }
    std::string_view summary() const override {
        return "Renders a scene with every counter on and writes what it fetches into a folder: profile.json, textures.csv, counts.exr, "
               "render.png, heat-*.png, and index.html, which shows all of it.";
    }

    void declare(CommandLine& line) override {
        line.arguments("SCENE", "a .gltf or .glb file, or a built-in scene (rawtexel list scenes)", 1, 1, words_);
        line.option("-o,--output", "DIR", "the folder to write, made where it is missing",
                    [this](const std::string& text) { output_ = text; });
        line.repeated_option(
            "--compare-with", "OPTIONS",
            "other settings beside, such as \"--filter bspline --order after\": options that look up textures, sample, and count "
            "(may be given again)",
            [this](const std::string& text) { compared_.push_back(text); });
        line.option("--trace", "FILE.zst", "every texel read, one by one (docs/fetches.md)",
                    [this](const std::string& text) { trace_ = text; });
        declare_render_options(line, request_);
    }

    int run(const Invocation& invocation) override;

  private:
    std::vector<ProfileSetting> settle_settings() const;
    std::vector<std::string> input_files(std::span<const ProfileSetting> settings) const;
    void write_files(const OutputFolder& folder, ProfileRuns& runs, shading::Executor& executor, double start) const;

    std::vector<std::string> words_, compared_;
    std::string output_, trace_;
    RenderRequest request_;
};

void settle_for_counting(RenderRequest& request) {
    if (request.samples.reference) throw UsageError("--reference makes an image and nothing else: profile cannot count its fetches");
    request.fetches.count = true;
    if (!request.fetches.cache) request.fetches.cache.emplace();
    settle(request);
}

RenderRequest with_options(RenderRequest request, const std::string& options) {
    CommandLine line{"profile --compare-with OPTIONS", "Settings beside the profile's own."};
    std::vector<std::string> none;
    line.arguments("", "", 0, 0, none);
    declare_setting_options(line, request);
    declare_fetch_options(line, request.fetches);
    try {
        const std::vector<std::string> words = shell_words(options);
        if (words.empty()) throw UsageError("no options");
        if (!line.parse(words)) throw UsageError("--help makes no setting");
        settle_for_counting(request);
    } catch (const UsageError& error) {
        throw UsageError("--compare-with '" + options + "': " + error.what());
    }
    return request;
}

std::vector<ProfileSetting> ProfileCommand::settle_settings() const {
    std::vector<ProfileSetting> settings{{"", request_}};
    settle_for_counting(settings[0].request);
    for (const std::string& options : compared_) settings.push_back({options, with_options(request_, options)});
    return settings;
}

std::vector<std::string> ProfileCommand::input_files(std::span<const ProfileSetting> settings) const {
    std::vector<std::string> files{words_[0]};
    const auto& environment = request_.light.environment;
    if (environment && environment->kind == EnvironmentKind::File) files.push_back(environment->file);
    for (const ProfileSetting& setting : settings)
        if (!setting.request.policy.empty()) files.push_back(setting.request.policy);
    return files;
}

int ProfileCommand::run(const Invocation& invocation) {
    if (output_.empty()) throw UsageError("-o DIR is missing (usage: rawtexel " + std::string(usage()) + ")");
    ProfilePlan plan{words_[0], settle_settings(), nullptr, {}};
    choose_instruction_set(request_.machine.simd);
    const OutputFolder folder(output_);
    std::vector<OutputFile> outputs;
    for (const char* file : {"profile.json", "textures.csv", "counts.exr", "render.png", "index.html"})
        outputs.push_back({"-o", folder / file});
    for (int i = 0; i < shading::kPixelCounts; ++i) outputs.push_back({"-o", folder / heat_map_name(PixelCount(i))});
    if (!trace_.empty()) outputs.push_back({"--trace", trace_});
    check_outputs(outputs, input_files(plan.settings));

    std::vector<std::string> opened;
    plan.opened = [&](const std::string& path) { opened.push_back(path); };
    std::optional<TraceFile> trace;
    if (!trace_.empty()) plan.trace = &trace.emplace(trace_).writer();
    const auto executor = shading::make_executor(shading::default_executor_kind(), request_.machine.threads);
    ProgressReport progress(invocation.err, request_.machine.progress, invocation.err_is_terminal);
    const double start = ProgressReport::steady_seconds();
    ProfileRuns runs = run_profile(plan, invocation, *executor, progress);
    check_apart(outputs, opened);
    progress.begin("writing");
    write_files(folder, runs, *executor, start);
    if (trace) trace->finish();
    progress.finish();

    invocation.out << "Camera: " << runs.frame.record.view << '\n' << "Saved: " << folder / "index.html" << '\n';
    return kDone;
}

// Pictures first: the numbers hold how long they took. `start`: seconds on the clock when the run began.
void ProfileCommand::write_files(const OutputFolder& folder, ProfileRuns& runs, shading::Executor& executor, double start) const {
    RunRecord& record = runs.frame.record;
    const double write_start = ProgressReport::steady_seconds();
    const shading::FrameFetches& fetches = *record.result.fetches;
    const ImageSize size = record.request.image_size();
    const scenes::Placement placement{record.request.crop.x, record.request.crop.y, size.width, size.height};
    executor.parallel_for(shading::kPixelCounts + 2, [&](int64_t index, int) {
        if (index == 0) return write_counts(folder / "counts.exr", record.result, placement, image_metadata(record, false));
        if (index == 1)
            return write_image(folder / "render.png", record.result, record.request.tone, placement, image_metadata(record, true));
        const auto count = PixelCount(index - 2);
        const shading::Image& values = fetches.pixel(count);
        const Canvas map = draw_heat_map(values, {heat_map_label(count), 0.0, finite_maximum(values)});
        scenes::write_8bit(folder / heat_map_name(count), map.width, map.height, 3, map.codes, image_metadata(record, false));
    });
    record.times.write_s = ProgressReport::steady_seconds() - write_start;
    record.times.total_s = ProgressReport::steady_seconds() - start;
    const nlohmann::ordered_json profile = profile_json(runs);
    write_text(folder / "textures.csv", textures_csv(profile));
    write_text(folder / "profile.json", profile.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
    write_text(folder / "index.html", profile_page(runs, profile, executor));
}

}  // namespace

std::unique_ptr<Command> make_profile_command() { return std::make_unique<ProfileCommand>(); }

}  // namespace rawtexel::cli
