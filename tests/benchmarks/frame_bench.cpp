// Whole frames of the built-in scenes, 1920x1080, one sample a pixel, all cores: geometry to resolved image.
#include "scenes/builtin.h"
#include "shading/camera.h"
#include "shading/cluster_meshes.h"
#include "shading/render.h"

#include <benchmark/benchmark.h>

#include <string>

namespace {

using namespace rawtexel;

void frame(benchmark::State& state, const scenes::BuiltinScene& builtin) {
    shading::Scene scene = builtin.make({});
    const auto executor = shading::make_executor(shading::default_executor_kind(), 0);
    shading::cluster_meshes(scene, *executor);
    std::shared_ptr<const shading::Environment> environment;
    if (scene.environment == shading::EnvironmentRequest::Sky)
        environment = std::make_shared<shading::Environment>(shading::sky_latlong(), *executor);
    const shading::Lighting lighting = shading::resolve_lighting(scene, scene.lights, 0.0f, environment, true, *executor);

    shading::RenderOptions options;
    options.width = 1920;
    options.height = 1080;
    options.camera = scene.cameras.empty() ? shading::default_camera(scene.bounds(), 1920.0f / 1080.0f) : scene.cameras[0];
    shading::render(scene, lighting, options, *executor);  // textures are decoded on first touch
    shading::RenderTimes sum;
    for (auto _ : state) {
        const shading::RenderResult result = shading::render(scene, lighting, options, *executor);
        sum.geometry_s += result.times.geometry_s;
        sum.raster_s += result.times.raster_s;
        sum.shade_s += result.times.shade_s;
    }
    const double frames = double(state.iterations());
    state.counters["geometry_ms"] = 1e3 * sum.geometry_s / frames;
    state.counters["raster_ms_threads"] = 1e3 * sum.raster_s / frames;
    state.counters["shade_ms_threads"] = 1e3 * sum.shade_s / frames;
}

}  // namespace

int main(int argc, char** argv) {
    for (const scenes::BuiltinScene& builtin : scenes::builtin_scenes()) {
        benchmark::RegisterBenchmark(("frame/" + std::string(builtin.name)).c_str(),
                                     [&builtin](benchmark::State& state) { frame(state, builtin); })
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
