#include "cli/profile_run.h"

#include "cli/frame_setup.h"
#include "cli/illumination.h"
#include "cli/view.h"
#include "shading/cluster_meshes.h"

namespace rawtexel::cli {
namespace {

using shading::FetchModel;

class ProfileRunner {
  public:
    ProfileRunner(const ProfilePlan& plan, const Invocation& invocation, shading::Executor& executor, ProgressReport& progress)
        : plan_(plan), invocation_(invocation), executor_(executor), progress_(progress) {}

    ProfileRuns run() {
        ProfileRuns runs;
        Prepared prepared = prepare(plan_.settings[0]);
        runs.frame = render_closely(prepared, plan_.trace);
        for (const FetchModel model : {FetchModel::Visible, FetchModel::Forward, FetchModel::Quad})
            runs.models.emplace_back(
                model, model == prepared.options.fetches.model ? RunRecord{} : render_counted(prepared, *runs.frame.scene, model));
        for (size_t i = 1; i < plan_.settings.size(); ++i) {
            Prepared other = prepare(plan_.settings[i]);
            runs.compared.push_back(render_closely(other, nullptr));
        }
        return runs;
    }

  private:
    struct Prepared {
        const ProfileSetting* setting = nullptr;
        std::unique_ptr<shading::Scene> scene;
        View view;
        shading::Lighting lighting;
        shading::RenderOptions options;
        double load_s = 0;
    };

    Prepared prepare(const ProfileSetting& setting) {
        const double start = ProgressReport::steady_seconds();
        progress_.begin("loading");
        Prepared prepared;
        prepared.setting = &setting;
        scenes::LoadOptions options = load_options(setting.request, invocation_, progress_);
        options.opened = plan_.opened;
        // What a file is warned of is said once.
        if (&setting != &plan_.settings[0]) options.warn = {};
        prepared.scene = std::make_unique<shading::Scene>(load_scene(plan_.scene, setting.request, options));
        shading::cluster_meshes(*prepared.scene, executor_);
        const ImageSize size = setting.request.image_size();
        prepared.view = choose_view(*prepared.scene, setting.request.view, float(size.width) / float(size.height));
        progress_.begin("preparing light");
        prepared.lighting = make_lighting(*prepared.scene, setting.request.light, executor_);
        prepared.options = frame_options(setting.request, prepared.view.camera);
        check_lookups(*prepared.scene, prepared.options);
        prepared.load_s = ProgressReport::steady_seconds() - start;
        return prepared;
    }

    RunRecord render(const Prepared& prepared, const shading::Scene& scene, const shading::RenderOptions& options) {
        const shading::Crop& crop = options.crop;
        const double pixels = crop.width > 0 ? double(crop.width) * crop.height : double(options.width) * options.height;
        progress_.begin("counting what is fetched (" + std::string(to_string(options.fetches.model)) + ")", pixels * options.spp);
        RunRecord record;
        record.scene = plan_.scene;
        record.command = invocation_.command_line;
        record.view = prepared.view.options;
        record.request = prepared.setting->request;
        record.request.fetches.model = options.fetches.model;
        record.times.load_s = prepared.load_s;
        record.result = shading::render(scene, prepared.lighting, options, executor_, [&](double share) { progress_.update(share); });
        record.times.frame_s.push_back(record.result.times.frame_s);
        record.work = texture_work(scene);
        return record;
    }

    ProfiledFrame render_closely(Prepared& prepared, texunit::FetchTraceWriter* trace) {
        shading::RenderOptions options = prepared.options;
        options.fetches.pixel_layers = true;
        options.fetches.trace = trace;
        ProfiledFrame frame{prepared.setting->options, std::move(prepared.scene), {}};
        frame.record = render(prepared, *frame.scene, options);
        return frame;
    }

    RunRecord render_counted(const Prepared& prepared, const shading::Scene& scene, FetchModel model) {
        shading::RenderOptions options = prepared.options;
        options.fetches.model = model;
        return render(prepared, scene, options);
    }

    const ProfilePlan& plan_;
    const Invocation& invocation_;
    shading::Executor& executor_;
    ProgressReport& progress_;
};

}  // namespace

ProfileRuns run_profile(const ProfilePlan& plan, const Invocation& invocation, shading::Executor& executor, ProgressReport& progress) {
    return ProfileRunner(plan, invocation, executor, progress).run();
}

}  // namespace rawtexel::cli
