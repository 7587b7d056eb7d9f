#include "cli/commands/vectors.h"

#include "cli/footprint_options.h"
#include "cli/frame_setup.h"
#include "cli/illumination.h"
#include "cli/limits.h"
#include "cli/option_values.h"
#include "cli/output_files.h"
#include "cli/vectors/scene_suite.h"
#include "cli/vectors/suite_files.h"
#include "cli/view.h"
#include "scenes/image_io.h"
#include "shading/cluster_meshes.h"

#include <filesystem>

namespace rawtexel::cli {
namespace {

class VectorsCommand : public Command {
  public:
    std::string_view name() const override { return "vectors"; }
    std::string_view usage() const override { return "vectors (--suite NAME | --from SCENE) -o DIR"; }
    std::string_view summary() const override {
        return "Writes test vectors for ports of samplers: textures, sampler states, coordinates, derivatives and random numbers, and what "
               "a "
               "right port answers, with the interval of legal values where precision leaves freedom.";
    }

    void declare(CommandLine& line) override {
        line.option("--suite", "NAME", "one of `rawtexel list suites`, or `all`, each in a folder of its own",
                    [this](const std::string& text) { suite_ = text; });
        line.option("--from", "SCENE", "a suite of the lookups of a frame: a .gltf or .glb file, or a built-in scene",
                    [this](const std::string& text) { scene_ = text; });
        line.option("-o,--output", "DIR", "the folder to write, made where it is missing",
                    [this](const std::string& text) { output_ = text; });
        line.group("Of --from");
        line.option("--cases", "N", "lookups taken, spread over the frame (default 1024)", scene_option([this](const std::string& text) {
                        cases_ = size_t(parse_integer("--cases", text, 1, int64_t(kMostSceneCases)));
                    }));
        line.option("--size", "WxH", "of the frame, in pixels (default 1280x720)",
                    scene_option([this](const std::string& text) { request_.size = parse_size(text); }));
        line.option("--camera", "NAME|INDEX", "a camera of the scene",
                    scene_option([this](const std::string& text) { request_.view.camera = text; }));
        line.option("--orbit", "YAW,PITCH[,ZOOM]", "a camera around the scene, in degrees",
                    scene_option([this](const std::string& text) { request_.view.orbit = parse_orbit(text); }));
        line.option("--estimator", "NAME", "all, or one that draws (rawtexel list estimators): cases are draws then",
                    scene_option([this](const std::string& text) {
                        request_.lookup.filtering.estimator = parse_choice("--estimator", text,
                                                                           {texunit::Estimator::All, texunit::Estimator::Reservoir,
                                                                            texunit::Estimator::Jitter, texunit::Estimator::AbsWeight});
                    }));
        line.option("--seed", "S", "of the draws' numbers (default 0)", scene_option([this](const std::string& text) {
                        request_.samples.seed = uint32_t(parse_integer("--seed", text, 0, 0xFFFFFFFF));
                    }));
        declare_lookup_options(line, request_.lookup);
        declare_footprint_options(line, request_.lookup.footprint, &request_.lookup.names_lod_rule);
    }

    int run(const Invocation& invocation) override {
        if (suite_.empty() && scene_.empty())
            throw UsageError("--suite NAME or --from SCENE is missing (usage: rawtexel " + std::string(usage()) + ")");
        if (!suite_.empty() && !scene_.empty()) throw UsageError("--suite or --from, not both");
        if (output_.empty()) throw UsageError("-o DIR is missing (usage: rawtexel " + std::string(usage()) + ")");
        if (!scene_.empty()) {
            write(make_from_scene(invocation), output_, invocation);
            return kDone;
        }
        check_no_scene_options();
        std::vector<std::string> names;
        for (const SuiteInfo& info : all_suites()) names.emplace_back(info.name);
        if (suite_ == "all") {
            for (const std::string& each : names) write(*make_suite(each), output_ + "/" + each, invocation);
            return kDone;
        }
        const std::optional<Suite> suite = make_suite(suite_);
        names.emplace_back("all");
        if (!suite) throw unknown_value("--suite", suite_, names);
        write(*suite, output_, invocation);
        return kDone;
    }

  private:
    /// Remembers that an option was given that says something of a frame.
    CommandLine::Reader scene_option(CommandLine::Reader read) {
        return [this, read = std::move(read)](const std::string& text) {
            names_scene_option_ = true;
            read(text);
        };
    }

    void check_no_scene_options() const {
        if (names_scene_option_ || print_choices(request_.lookup) != print_choices(LookupOptions{}) || request_.lookup.names_lod_rule)
            throw UsageError("--suite " + suite_ + ": options of frames and lookups go with --from SCENE; suites have their own");
    }

    /// The suite's files replace none of the scene's.
    void check_not_read(const std::vector<std::string>& opened) const {
        std::vector<OutputFile> outputs;
        for (const char* file : {kSuiteFile, kCasesFile, kExpectedFile, kTexturesFile, kTexelsFile, kWordsFile})
            outputs.push_back({"-o", output_ + "/" + file});
        check_apart(outputs, opened);
    }

    Suite make_from_scene(const Invocation& invocation) {
        if (request_.lookup.precision == texunit::Precision::Gpu)
            throw UsageError("--precision gpu: vectors have exact lookups, and the interval that a device's precision leaves");
        if (request_.lookup.footprint.area == shading::FootprintArea::Sample)
            throw UsageError("--footprint sample: the frame has one sample a pixel");
        settle(request_);
        ProgressReport progress(invocation.err, ProgressMode::Never, invocation.err_is_terminal);
        std::vector<std::string> opened;
        scenes::LoadOptions files = load_options(request_, invocation, progress);
        files.opened = [&](const std::string& path) { opened.push_back(path); };
        shading::Scene scene = load_scene(scene_, request_, files);
        check_not_read(opened);
        const auto executor = shading::make_executor(shading::default_executor_kind(), 0);
        shading::cluster_meshes(scene, *executor);
        const ImageSize size = request_.image_size();
        const View view = choose_view(scene, request_.view, float(size.width) / float(size.height));
        // Lookups of the frame's surfaces do not depend on its light.
        request_.light.shadows = false;
        request_.light.environment = EnvironmentOption{};
        const shading::Lighting lighting = make_lighting(scene, request_.light, *executor);
        const shading::RenderOptions options = frame_options(request_, view.camera);
        check_lookups(scene, options);
        return make_scene_suite(scene_, scene, lighting, options, cases_);
    }

    static void write(const Suite& suite, const std::string& folder, const Invocation& invocation) {
        write_suite(suite, folder);
        invocation.out << "Saved: " << folder << "/" << kSuiteFile << " (" << suite.name << ", " << suite.cases.size() << " cases in "
                       << suite.groups.size() << (suite.groups.size() == 1 ? " group" : " groups");
        if (suite.left_out > 0) invocation.out << "; " << suite.left_out << " left out, whose texel is a matter of rounding";
        invocation.out << ")\n";
    }

    std::string suite_, scene_, output_;
    size_t cases_ = 1024;
    bool names_scene_option_ = false;
    RenderRequest request_;
};

}  // namespace

std::unique_ptr<Command> make_vectors_command() { return std::make_unique<VectorsCommand>(); }

}  // namespace rawtexel::cli
