#include "cli/frame_setup.h"

#include "cli/policy_file.h"
#include "cli/word_list.h"

namespace rawtexel::cli {

void choose_instruction_set(texunit::Simd simd) {
    if (texunit::choose_simd(simd)) return;
    std::vector<std::string> available;
    for (const texunit::Simd set : texunit::available_simd()) available.emplace_back(to_string(set));
    throw UsageError("--simd: " + std::string(to_string(simd)) + " is not available on this machine (" + join(available, " ") + ")");
}

scenes::LoadOptions load_options(const RenderRequest& request, const Invocation& invocation, ProgressReport& progress) {
    scenes::LoadOptions options;
    options.texture.mip_storage = request.lookup.mip_storage;
    options.files = request.lookup.files;
    options.warn = [&](const std::string& what) {
        progress.clear();
        warn(invocation, what);
    };
    return options;
}

shading::Scene load_scene(const std::string& name, const RenderRequest& request, const scenes::LoadOptions& options) {
    shading::Scene scene = scenes::load(name, options);
    if (!request.policy.empty()) apply_policy_file(request.policy, scene);
    return scene;
}

shading::RenderOptions frame_options(const RenderRequest& request, const shading::Camera& camera) {
    shading::RenderOptions options;
    options.width = request.image_size().width;
    options.height = request.image_size().height;
    options.crop = request.crop;
    options.camera = camera;
    options.spp = request.samples.spp;
    options.adaptive_error = double(request.samples.adaptive.value_or(0.0f));
    options.pixel_filter = request.samples.pixel_filter;
    options.pixel_jitter = request.samples.pixel_jitter;
    options.seed = request.samples.seed;
    options.filter = request.lookup.filter;
    options.mip = request.lookup.mip;
    options.footprint = request.lookup.footprint;
    options.filtering = request.lookup.filtering;
    options.precision = request.lookup.precision;
    options.background = request.tone.white_backdrop ? glm::vec3(0.0f) : request.light.background;
    options.coverage = request.tone.white_backdrop;
    options.fetches.count = request.fetches.counts();
    options.fetches.model = request.fetches.model.value_or(shading::FetchModel::Visible);
    options.fetches.cache = request.fetches.cache;
    options.tile_size = request.machine.tile_size;
    options.skips = request.machine.skips.skips;
    return options;
}

void check_lookups(const shading::Scene& scene, const shading::RenderOptions& options) {
    const std::string refusal = shading::refusal(scene, options);
    if (!refusal.empty()) throw UsageError(refusal);
}

}  // namespace rawtexel::cli
