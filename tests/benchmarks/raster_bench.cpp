// Geometry and visibility alone, by stage, at 1920x1080 on two threads: triangles a second of what is submitted.
#include "raster/frame.h"
#include "raster/visibility.h"

#include <benchmark/benchmark.h>
#include <glm/gtc/matrix_transform.hpp>

#include <atomic>
#include <cmath>
#include <list>
#include <thread>
#include <vector>

namespace {

using namespace rawtexel;

constexpr int kWidth = 1920, kHeight = 1080, kThreads = 2;

void threads_for(int64_t count, const std::function<void(int64_t)>& body) {
    std::atomic<int64_t> next{0};
    const auto work = [&] {
        for (int64_t i; (i = next++) < count;) body(i);
    };
    std::vector<std::thread> others;
    for (int i = 1; i < kThreads; ++i) others.emplace_back(work);
    work();
    for (std::thread& thread : others) thread.join();
}

struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<uint32_t> indices;

    /// columns x rows cells of two triangles; `at` gives the points of the lattice.
    template <class At>
    void add_grid(int columns, int rows, At&& at) {
        const uint32_t first = uint32_t(positions.size()), stride = uint32_t(columns) + 1;
        for (int j = 0; j <= rows; ++j)
            for (int i = 0; i <= columns; ++i) positions.push_back(at(i, j));
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i) {
                const uint32_t a = first + uint32_t(j) * stride + uint32_t(i), b = a + 1, c = a + stride, d = c + 1;
                for (const uint32_t v : {a, c, b, b, c, d}) indices.push_back(v);
            }
    }
};

/// Meshes, and draws that refer to them.
struct BenchScene {
    std::vector<Mesh> meshes;
    std::list<raster::MeshClusters> clusters;  ///< of the draws: made once, as the scene's are
    std::vector<raster::Draw> draws;
    uint32_t triangles = 0;

    void add_draw(const Mesh& mesh, const glm::mat4& clip_from_object) {
        raster::Draw draw;
        draw.positions = mesh.positions.data();
        draw.vertex_count = uint32_t(mesh.positions.size());
        draw.indices = mesh.indices.data();
        draw.triangle_count = uint32_t(mesh.indices.size() / 3);
        if (draws.empty() || draws.back().positions != draw.positions)
            clusters.push_back(raster::make_clusters(mesh.positions, mesh.indices));
        draw.clusters = &clusters.back();
        draw.clip_from_object = clip_from_object;
        draw.first_triangle_id = triangles;
        triangles += draw.triangle_count;
        draws.push_back(draw);
    }
};

/// Object space is (pixel x, pixel y, depth).
glm::mat4 clip_from_pixels() { return {2.0f / kWidth, 0, 0, 0, 0, -2.0f / kHeight, 0, 0, 0, 0, 1, 0, -1, 1, 0, 1}; }

/// Cells of `size` pixels, a little off the pixel grid, before or behind one another.
void add_layer(BenchScene& scene, float size, float depth) {
    const int columns = int(std::ceil(float(kWidth) / size)), rows = int(std::ceil(float(kHeight) / size));
    scene.meshes.emplace_back().add_grid(columns, rows, [&](int i, int j) {
        return glm::vec3(float(i) * size + 0.13f, float(j) * size + 0.29f, depth + 0.02f * std::sin(0.1f * float(i + j)));
    });
}

BenchScene grid_scene(float cell) {
    BenchScene scene;
    add_layer(scene, cell, 0.5f);
    scene.add_draw(scene.meshes[0], clip_from_pixels());
    return scene;
}

BenchScene wall_scene(bool wall, bool crowd) {
    BenchScene scene;
    scene.meshes.reserve(2);
    add_layer(scene, 2.0f, 0.3f);
    add_layer(scene, 60.0f, 0.8f);
    if (crowd) scene.add_draw(scene.meshes[0], clip_from_pixels());
    if (wall) scene.add_draw(scene.meshes[1], clip_from_pixels());
    return scene;
}

/// A hundred balls of 20 000 triangles, seen from above at an angle.
BenchScene spheres_scene() {
    BenchScene scene;
    constexpr int kAround = 100, kRings = 101;
    scene.meshes.emplace_back().add_grid(kAround, kRings - 1, [&](int i, int j) {
        const float turn = 6.2831853f * float(i % kAround) / float(kAround), rise = 3.1415927f * float(j) / float(kRings - 1);
        return 0.43f * glm::vec3(std::cos(turn) * std::sin(rise), std::cos(rise), -std::sin(turn) * std::sin(rise));
    });
    const glm::mat4 view = glm::lookAt(glm::vec3(7.0f, 6.5f, 9.0f), glm::vec3(0.0f), glm::vec3(0, 1, 0));
    const float focal = 2.4f, near_plane = 0.1f;
    const glm::mat4 clip = {focal * kHeight / kWidth, 0, 0, 0, 0, focal, 0, 0, 0, 0, 0, -1, 0, 0, near_plane, 0};
    for (int z = 0; z < 10; ++z)
        for (int x = 0; x < 10; ++x)
            scene.add_draw(scene.meshes[0],
                           clip * view * glm::translate(glm::mat4(1.0f), glm::vec3(float(x) - 4.5f, 0.0f, float(z) - 4.5f)));
    return scene;
}

/// Triangles that the near plane cuts, each with a corner behind the eye.
BenchScene clipped_scene() {
    BenchScene scene;
    scene.meshes.emplace_back().add_grid(400, 250, [&](int i, int j) {
        return glm::vec3(0.02f * float(i) - 4.0f, 0.02f * float(j) - 2.5f, (i + j) % 2 == 0 ? -1.0f : 0.5f);
    });
    const glm::mat4 clip = {2.4f * kHeight / kWidth, 0, 0, 0, 0, 2.4f, 0, 0, 0, 0, 0, -1, 0, 0, 0.1f, 0};
    scene.add_draw(scene.meshes[0], clip);
    return scene;
}

/// Slivers across many tiles each.
BenchScene slivers_scene() {
    BenchScene scene;
    scene.meshes.emplace_back().add_grid(1, 10000, [&](int i, int j) {
        const float turn = 0.0001f * 6.2831853f * float(j), radius = i == 0 ? 20.0f : 500.0f;
        return glm::vec3(960 + radius * std::cos(turn), 540 + radius * std::sin(turn), 0.5f);
    });
    scene.add_draw(scene.meshes[0], clip_from_pixels());
    return scene;
}

raster::FrameOptions frame_options() {
    raster::FrameOptions options;
    options.width = kWidth;
    options.height = kHeight;
    options.filter_radius = 0.5f;
    return options;
}

void draw_tiles(const raster::Frame& frame, int samples, uint64_t* sum = nullptr) {
    std::atomic<uint64_t> seen{0};
    threads_for(int64_t{frame.tiles_x()} * frame.tiles_y(), [&](int64_t i) {
        thread_local raster::TileVisibility tile;
        for (int s = 0; s < samples; ++s) {
            const raster::SampleOffset offset{1 + 2 * ((s * 97) % 256), 1 + 2 * ((s * 57) % 256)};
            raster::tile_visibility_opaque(frame, int(i % frame.tiles_x()), int(i / frame.tiles_x()), {offset, nullptr}, tile);
        }
        if (sum != nullptr)
            for (const uint32_t triangle : tile.triangle) seen += triangle != raster::kNoTriangle;
    });
    if (sum != nullptr) *sum = seen;
}

void report(benchmark::State& state, const BenchScene& scene) {
    state.counters["Mtri/s"] = benchmark::Counter(1e-6 * scene.triangles * double(state.iterations()), benchmark::Counter::kIsRate);
}

void clusters(benchmark::State& state, const BenchScene& scene) {
    size_t triangles = 0;
    for (auto _ : state)
        for (const Mesh& mesh : scene.meshes) {
            benchmark::DoNotOptimize(raster::make_clusters(mesh.positions, mesh.indices).clusters.size());
            triangles += mesh.indices.size() / 3;
        }
    state.counters["Mtri/s"] = benchmark::Counter(1e-6 * double(triangles), benchmark::Counter::kIsRate);
}

void geometry(benchmark::State& state, const BenchScene& scene) {
    for (auto _ : state) benchmark::DoNotOptimize(raster::Frame(frame_options(), scene.draws, threads_for).triangle_count());
    report(state, scene);
}

void visibility(benchmark::State& state, const BenchScene& scene, int samples) {
    const raster::Frame frame(frame_options(), scene.draws, threads_for);
    for (auto _ : state) draw_tiles(frame, samples);
    report(state, scene);
}

void whole(benchmark::State& state, const BenchScene& scene) {
    for (auto _ : state) draw_tiles(raster::Frame(frame_options(), scene.draws, threads_for), 1);
    report(state, scene);
}

void add(const char* name, const BenchScene& (*scene)()) {
    const std::string prefix = std::string("raster/") + name;
    const auto one = [](benchmark::internal::Benchmark* b) { b->Unit(benchmark::kMillisecond)->UseRealTime(); };
    one(benchmark::RegisterBenchmark((prefix + "/clusters").c_str(), [=](benchmark::State& s) { clusters(s, scene()); }));
    one(benchmark::RegisterBenchmark((prefix + "/geometry").c_str(), [=](benchmark::State& s) { geometry(s, scene()); }));
    one(benchmark::RegisterBenchmark((prefix + "/visibility").c_str(), [=](benchmark::State& s) { visibility(s, scene(), 1); }));
    one(benchmark::RegisterBenchmark((prefix + "/visibility16").c_str(), [=](benchmark::State& s) { visibility(s, scene(), 16); }));
    one(benchmark::RegisterBenchmark((prefix + "/frame").c_str(), [=](benchmark::State& s) { whole(s, scene()); }));
}

template <auto Make, auto... Arguments>
const BenchScene& the() {
    static const BenchScene scene = Make(Arguments...);
    return scene;
}

BenchScene small_grid() { return grid_scene(2.0f); }
BenchScene middle_grid() { return grid_scene(8.0f); }
BenchScene large_grid() { return grid_scene(32.0f); }

const bool registered = [] {
    add("grid2", the<small_grid>);
    add("grid8", the<middle_grid>);
    add("grid32", the<large_grid>);
    add("spheres", the<spheres_scene>);
    add("clipped", the<clipped_scene>);
    add("slivers", the<slivers_scene>);
    add("wall", the<wall_scene, true, false>);
    add("crowd", the<wall_scene, false, true>);
    add("wall_before_crowd", the<wall_scene, true, true>);
    return true;
}();

}  // namespace
