// The same scene, filter and shading by us and by software OpenGL in one run: time, and error against a converged image.
#include "scenes/load.h"
#include "shading/camera.h"
#include "shading/cluster_meshes.h"
#include "shading/render.h"
#include "tests/benchmarks/peer/machine.h"
#include "tests/benchmarks/peer/opengl_frame.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>

namespace rawtexel::peer {

std::string_view to_string(Filter filter) {
    constexpr std::array<std::string_view, 5> kNames{"bilinear", "trilinear", "anisotropic-16", "cubic-16-taps", "cubic-one-tap"};
    return kNames[size_t(filter)];
}

namespace {

using Clock = std::chrono::steady_clock;
using nlohmann::json;
using shading::Image;

struct Case {
    std::string scene;
    Filter filter;
};

const std::vector<Case> kUsual = {{"plane", Filter::Trilinear},      {"plane", Filter::Anisotropic16}, {"magnify", Filter::Bilinear},
                                  {"magnify", Filter::Cubic16Taps},  {"magnify", Filter::CubicOneTap}, {"spheres", Filter::Trilinear},
                                  {"spheres", Filter::Anisotropic16}};

struct Wanted {
    int frames = 11, reference_spp = 64;
    Setting setting;
};

shading::RenderOptions options_of(const Setting& setting) {
    shading::RenderOptions options;
    options.width = setting.width;
    options.height = setting.height;
    options.camera = setting.camera;
    const bool cubic = setting.filter == Filter::Cubic16Taps || setting.filter == Filter::CubicOneTap;
    const bool levels = setting.filter == Filter::Trilinear || setting.filter == Filter::Anisotropic16;
    options.filter = cubic ? texunit::Kernel::BSpline : texunit::Kernel::Bilinear;
    options.mip = levels ? texunit::MipMode::Linear : texunit::MipMode::None;
    options.footprint.probes = setting.filter == Filter::Anisotropic16 ? 16 : 1;
    if (setting.filter == Filter::CubicOneTap) options.filtering.estimator = texunit::Estimator::Reservoir;
    return options;
}

/// What both sides would show with many samples and no levels.
Image converged(const shading::Scene& scene, const shading::Lighting& lighting, const Wanted& wanted, shading::Executor& executor) {
    shading::RenderOptions options = options_of(wanted.setting);
    options.filtering = {};
    options.footprint = {};
    options.mip = texunit::MipMode::None;
    options.spp = wanted.reference_spp;
    return shading::render(scene, lighting, options, executor).radiance;
}

/// Root mean square of the difference, of what a screen can show.
double error(const Image& image, const Image& reference) {
    double sum = 0;
    for (size_t i = 0; i < image.values.size(); ++i) {
        const auto shown = [](float value) { return double(std::clamp(value, 0.0f, 1.0f)); };
        sum += std::pow(shown(image.values[i]) - shown(reference.values[i]), 2);
    }
    return std::sqrt(sum / double(image.values.size()));
}

double milliseconds(const std::function<void()>& act) {
    const Clock::time_point start = Clock::now();
    act();
    return 1e3 * std::chrono::duration<double>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

shading::Light light_of(const shading::Scene& scene) {
    const auto sun = std::ranges::find(scene.lights, shading::Light::Type::Directional, &shading::Light::type);
    if (sun != scene.lights.end()) return *sun;
    shading::Light light;
    light.direction = glm::normalize(glm::vec3(-0.4f, -1.0f, -0.3f));
    light.intensity = 3.0f;
    return light;
}

json run(const Case& one, Wanted wanted) {
    shading::Scene scene = scenes::load(one.scene);
    Setting& setting = wanted.setting;
    setting.filter = one.filter;
    setting.light = light_of(scene);
    const float aspect = float(setting.width) / float(setting.height);
    setting.camera = scene.cameras.empty() ? shading::default_camera(scene.bounds(), aspect) : scene.cameras[0];
    const auto executor = shading::make_executor(shading::default_executor_kind(), setting.threads);
    shading::cluster_meshes(scene, *executor);
    const shading::Lighting lighting = shading::resolve_lighting(scene, {setting.light}, setting.ambient, nullptr, false, *executor);

    std::string why_not;
    const std::unique_ptr<OpenglFrame> peer = make_opengl_frame(scene, setting, why_not);
    if (!peer) throw std::runtime_error(why_not);
    const shading::RenderOptions options = options_of(setting);
    Image ours = shading::render(scene, lighting, options, *executor).radiance;  // textures are decoded on first touch
    peer->draw(0);                                                               // shaders are compiled on first use
    std::vector<double> our_ms, peer_ms;
    for (int frame = 0; frame < wanted.frames; ++frame) {
        our_ms.push_back(milliseconds([&] { ours = shading::render(scene, lighting, options, *executor).radiance; }));
        peer_ms.push_back(milliseconds([&] { peer->draw(frame); }));
    }
    const Image truth = converged(scene, lighting, wanted, *executor);
    const Image theirs = peer->read();
    const double our_error = error(ours, truth), peer_error = error(theirs, truth);
    json result{{"scene", one.scene},
                {"filter", to_string(one.filter)},
                {"ours_ms", median(our_ms)},
                {"peer_ms", median(peer_ms)},
                {"time_ratio", median(peer_ms) / median(our_ms)},
                {"ours_rmse", our_error},
                {"peer_rmse", peer_error},
                {"difference_rmse", error(ours, theirs)},
                {"peer", peer->name()}};
    if (our_error > 0) result["error_ratio"] = peer_error / our_error;
    std::printf("%-24s %-15s %9.2f %9.2f %7.2fx   %.5f  %.5f  %.5f\n", one.scene.c_str(), std::string(to_string(one.filter)).c_str(),
                median(our_ms), median(peer_ms), median(peer_ms) / median(our_ms), our_error, peer_error, error(ours, theirs));
    std::fflush(stdout);
    return result;
}

int main_of(int argc, char** argv) {
    CLI::App app(
        "The same frames by rawtexel and by Mesa's llvmpipe: medians of frames taken in turn, and errors against a converged image.");
    Wanted wanted;
    std::vector<std::string> scenes;
    std::string filter, file;
    std::vector<std::string> names;
    for (int k = 0; k <= int(Filter::CubicOneTap); ++k) names.emplace_back(to_string(Filter(k)));
    app.add_option("SCENE", scenes, "files or built-in scenes (default: plane, magnify and spheres with their usual filters)");
    app.add_option("--filter", filter, "of the scenes named (default trilinear)")->check(CLI::IsMember(names));
    app.add_option("--frames", wanted.frames, "of either side")->check(CLI::Range(1, 1000));
    app.add_option("--threads", wanted.setting.threads, "of either side")->check(CLI::Range(1, 64));
    app.add_option("--width", wanted.setting.width)->check(CLI::Range(16, 8192));
    app.add_option("--height", wanted.setting.height)->check(CLI::Range(16, 8192));
    app.add_option("--reference-spp", wanted.reference_spp, "samples of the converged image")->check(CLI::Range(1, 4096));
    app.add_option("--json", file, "the figures with the machine's description");
    CLI11_PARSE(app, argc, argv);

    std::vector<Case> cases = scenes.empty() ? kUsual : std::vector<Case>{};
    const Filter chosen = filter.empty() ? Filter::Trilinear : Filter(std::ranges::find(names, filter) - names.begin());
    for (const std::string& scene : scenes) cases.push_back({scene, chosen});
    std::printf("%-24s %-15s %9s %9s %8s   %-8s %-8s %s\n", "scene", "filter", "ours, ms", "peer, ms", "peer/ours", "ours", "peer",
                "ours to peer (RMSE)");
    json all{{"machine", machine_description()},  {"width", wanted.setting.width}, {"height", wanted.setting.height},
             {"threads", wanted.setting.threads}, {"frames", wanted.frames},       {"cases", json::array()}};
    for (const Case& one : cases) all["cases"].push_back(run(one, wanted));
    if (!file.empty()) std::ofstream(file) << all.dump(2) << '\n';
    return 0;
}

}  // namespace
}  // namespace rawtexel::peer

int main(int argc, char** argv) {
    try {
        return rawtexel::peer::main_of(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "rawtexel_peer_bench: %s\n", error.what());
        return 3;
    }
}
