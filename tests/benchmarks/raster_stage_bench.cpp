// Every stage of raster by itself, one thread: from clusters to what a pixel holds. raster_bench.cpp has whole scenes.
#include "raster/clip.h"
#include "raster/cluster_cull.h"
#include "raster/cluster_setup.h"
#include "raster/occlusion.h"
#include "raster/tile_grid.h"
#include "shading/tile_resolve.h"
#include "tests/benchmarks/raster_stages.h"

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace rawtexel;
using namespace rawtexel::raster;

constexpr int kWidth = 1024, kHeight = 512;

FrameOptions frame_options(int width = kWidth, int height = kHeight) {
    FrameOptions options;
    options.width = width;
    options.height = height;
    options.filter_radius = 0.5f;
    return options;
}

/// `count` things an iteration, a second.
void report(benchmark::State& state, const char* what, double count) {
    state.counters[what] = benchmark::Counter(count * double(state.iterations()), benchmark::Counter::kIsRate);
}

/// A mesh in pixels and depth, and a draw of it.
struct Sheet {
    /// columns x rows cells of `cell` pixels, two triangles each, a little off the pixel grid.
    Sheet(int columns, int rows, float cell, float depth, int width = kWidth, int height = kHeight) {
        for (int j = 0; j <= rows; ++j)
            for (int i = 0; i <= columns; ++i)
                positions.emplace_back(cell * float(i) + 0.13f, cell * float(j) + 0.29f, depth + 0.02f * std::sin(0.1f * float(i + j)));
        for (uint32_t j = 0; j < uint32_t(rows); ++j)
            for (uint32_t i = 0; i < uint32_t(columns); ++i) {
                const uint32_t stride = uint32_t(columns) + 1, a = j * stride + i;
                for (const uint32_t v : {a, a + stride, a + 1, a + 1, a + stride, a + stride + 1}) indices.push_back(v);
            }
        clusters = make_clusters(positions, indices);
        draw.positions = positions.data();
        draw.vertex_count = uint32_t(positions.size());
        draw.indices = indices.data();
        draw.triangle_count = uint32_t(indices.size() / 3);
        draw.clusters = &clusters;
        draw.clip_from_object = {2.0f / float(width), 0, 0, 0, 0, -2.0f / float(height), 0, 0, 0, 0, 1, 0, -1, 1, 0, 1};
    }
    Sheet(const Sheet&) = delete;
    Sheet& operator=(const Sheet&) = delete;

    /// All of its clusters, in need of no clipping.
    std::vector<VisibleCluster> visible() const {
        std::vector<VisibleCluster> all;
        for (uint32_t i = 0; i < clusters.clusters.size(); ++i) all.push_back({0, i, 1.0f, true, {}});
        return all;
    }

    std::vector<glm::vec3> positions;
    std::vector<uint32_t> indices;
    MeshClusters clusters;
    Draw draw;
};

void cluster_culling(benchmark::State& state) {
    const Sheet sheet(512, 256, 4.0f, 0.5f);
    const FrameOptions options = frame_options();
    const TileGrid grid(options);
    const ClusterCull test(sheet.draw, options, grid);
    for (auto _ : state)
        for (const Cluster& cluster : sheet.clusters.clusters) benchmark::DoNotOptimize(test.view(cluster, true));
    report(state, "clusters", double(sheet.clusters.clusters.size()));
    report(state, "triangles", double(sheet.draw.triangle_count));
}
BENCHMARK(cluster_culling)->Name("raster_stage/cluster culling")->Unit(benchmark::kMicrosecond);

/// A wall of cells of 64 pixels over the frame.
std::vector<Occluder> occluders_of(const Sheet& wall, const OcclusionBuffer& buffer, const FrameOptions& options, const TileGrid& grid) {
    const ClusterCull test(wall.draw, options, grid);
    std::vector<Occluder> all;
    for (uint32_t i = 0; i < wall.clusters.clusters.size(); ++i)
        all.push_back({0, i, buffer.cells_of(test.view(wall.clusters.clusters[i], true).box)});
    return all;
}

void occlusion_drawing(benchmark::State& state) {
    const FrameOptions options = frame_options();
    const TileGrid grid(options);
    const Sheet wall(kWidth / 64 - 1, kHeight / 64 - 1, 64.0f, 0.8f);
    int64_t cells = 0;
    for (auto _ : state) {
        OcclusionBuffer buffer(options, grid);
        buffer.draw({&wall.draw, 1}, occluders_of(wall, buffer, options, grid));
        benchmark::DoNotOptimize(buffer.hides({0, 0, 0, 0}, 0.1f));
        cells = buffer.cell_count();
    }
    report(state, "pixels", double(cells) * kCellPixels * kCellPixels);
    report(state, "triangles", double(wall.draw.triangle_count));
}
BENCHMARK(occlusion_drawing)->Name("raster_stage/occlusion buffer, drawing")->Unit(benchmark::kMicrosecond);

void occlusion_testing(benchmark::State& state) {
    const FrameOptions options = frame_options();
    const TileGrid grid(options);
    const Sheet wall(kWidth / 64 - 1, kHeight / 64 - 1, 64.0f, 0.8f), crowd(440, 220, 2.0f, 0.3f);
    OcclusionBuffer buffer(options, grid);
    buffer.draw({&wall.draw, 1}, occluders_of(wall, buffer, options, grid));
    const std::vector<Occluder> behind = occluders_of(crowd, buffer, options, grid);
    int hidden = 0;
    for (auto _ : state) {
        hidden = 0;
        for (const Occluder& one : behind) hidden += buffer.hides(one.cells, 0.4f);
        benchmark::DoNotOptimize(hidden);
    }
    if (hidden == 0) state.SkipWithError("nothing is hidden");
    report(state, "clusters", double(behind.size()));
}
BENCHMARK(occlusion_testing)->Name("raster_stage/occlusion buffer, testing")->Unit(benchmark::kMicrosecond);

/// A mesh of 8 192 triangles, all of which are set up or, where they lie between the samples, culled.
void setting_up(benchmark::State& state, float cell, uint64_t FrameCounts::*fate) {
    FrameOptions options = frame_options();
    // Of a frame that samples pixels at their centres.
    options.reach = OffsetRange{256, 256, 256, 256};
    const TileGrid grid(options);
    const Sheet sheet(64, 64, cell, 0.5f);
    const std::vector<VisibleCluster> clusters = sheet.visible();
    constexpr uint32_t kCapacity = 16384;
    std::vector<SetupTriangle> room(kCapacity);
    uint64_t counted = 0;
    for (auto _ : state) {
        SetupBatch batch;
        batch.triangles = room.data();
        set_up_clusters({options, grid, {&sheet.draw, 1}}, clusters, kCapacity, batch);
        counted = batch.counts.*fate;
        benchmark::DoNotOptimize(batch.count);
    }
    if (counted < sheet.draw.triangle_count / 2) state.SkipWithError("most triangles have another fate");
    report(state, "triangles", double(sheet.draw.triangle_count));
}
BENCHMARK_CAPTURE(setting_up, visible, 4.0f, &FrameCounts::binned)
    ->Name("raster_stage/transform, cull, set up")
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(setting_up, small, 0.2f, &FrameCounts::culled_unsampled)
    ->Name("raster_stage/small triangles culled")
    ->Unit(benchmark::kMicrosecond);

void clipping(benchmark::State& state) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::vector<std::array<ScreenVertex, 3>> triangles(4096);
    for (std::array<ScreenVertex, 3>& triangle : triangles)
        for (size_t i = 0; i < 3; ++i) {
            // One corner behind the eye, the others before it.
            const double w = i == 0 ? -0.5 + 0.4 * unit(random) : 2 + unit(random);
            triangle[i] = {(500 + 400 * unit(random)) * w, (250 + 200 * unit(random)) * w, 0.1, w};
        }
    for (auto _ : state)
        for (const std::array<ScreenVertex, 3>& triangle : triangles) {
            ClipPolygon polygon(triangle);
            polygon.clip(outside_planes(triangle[0]) | outside_planes(triangle[1]) | outside_planes(triangle[2]));
            benchmark::DoNotOptimize(polygon.vertices().size());
        }
    report(state, "triangles", double(triangles.size()));
}
BENCHMARK(clipping)->Name("raster_stage/clipping")->Unit(benchmark::kMicrosecond);

void binning(benchmark::State& state, float cell) {
    const Sheet sheet(int(kWidth / cell) - 1, int(kHeight / cell) - 1, cell, 0.5f);
    const Frame frame(frame_options(), {&sheet.draw, 1});
    const TileGrid grid(frame.options());
    uint64_t entries = 0;
    for (auto _ : state) {
        entries = 0;
        frame.for_each_triangle([&](uint32_t, const SetupTriangle& triangle) {
            grid.for_each_touched(triangle, [&](size_t) {
                ++entries;
                return true;
            });
        });
        benchmark::DoNotOptimize(entries);
    }
    report(state, "triangles", double(frame.triangle_count()));
    report(state, "entries", double(entries));
}
BENCHMARK_CAPTURE(binning, small, 8.0f)->Name("raster_stage/binning, 8 pixels")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(binning, large, 100.0f)->Name("raster_stage/binning, 100 pixels")->Unit(benchmark::kMicrosecond);

/// Triangles of any shape over one tile of 64x64 pixels.
struct OneTile {
    OneTile() {
        std::mt19937 random(2);
        std::uniform_real_distribution<float> place(-40, 104);
        for (int i = 0; i < 256; ++i)
            for (int k = 0; k < 3; ++k) {
                positions.emplace_back(place(random), place(random), 0.5f);
                indices.push_back(uint32_t(indices.size()));
            }
        draw.positions = positions.data();
        draw.vertex_count = uint32_t(positions.size());
        draw.indices = indices.data();
        draw.triangle_count = uint32_t(indices.size() / 3);
        draw.cull = CullMode::None;
        draw.clip_from_object = {2.0f / 64, 0, 0, 0, 0, -2.0f / 64, 0, 0, 0, 0, 1, 0, -1, 1, 0, 1};
        for (int i = 0; i < 64 * 64; ++i) offsets.push_back({1 + 2 * int32_t(random() % 256), 1 + 2 * int32_t(random() % 256)});
    }
    std::vector<glm::vec3> positions;
    std::vector<uint32_t> indices;
    std::vector<SampleOffset> offsets;
    Draw draw;
};

void coverage(benchmark::State& state, bool per_pixel) {
    const OneTile tile;
    const Frame frame(frame_options(64, 64), {&tile.draw, 1});
    const uint32_t count = frame.triangle_count();
    uint64_t covered = 0;
    for (auto _ : state) {
        covered = stages::covered_samples(frame, count, {{129, 385}, per_pixel ? tile.offsets.data() : nullptr});
        benchmark::DoNotOptimize(covered);
    }
    report(state, "triangles", count);
    report(state, "samples", double(count) * 64 * 64);
    report(state, "covered", double(covered));
}
BENCHMARK_CAPTURE(coverage, frame_offset, false)->Name("raster_stage/coverage, one offset")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(coverage, pixel_offsets, true)->Name("raster_stage/coverage, an offset a pixel")->Unit(benchmark::kMicrosecond);

/// Sixteen triangles over all of a tile, the nearest last or first.
void depth(benchmark::State& state, bool nearest_first) {
    constexpr int kLayers = 16;
    std::vector<glm::vec3> positions;
    std::vector<uint32_t> indices;
    for (int layer = 0; layer < kLayers; ++layer) {
        const float z = 0.9f - 0.05f * float(nearest_first ? layer : kLayers - 1 - layer);
        for (const glm::vec3& p : {glm::vec3(-64, -64, z), glm::vec3(-64, 256, z), glm::vec3(256, -64, z)}) {
            positions.push_back(p);
            indices.push_back(uint32_t(indices.size()));
        }
    }
    Draw draw;
    draw.positions = positions.data();
    draw.vertex_count = uint32_t(positions.size());
    draw.indices = indices.data();
    draw.triangle_count = kLayers;
    draw.clip_from_object = {2.0f / 64, 0, 0, 0, 0, -2.0f / 64, 0, 0, 0, 0, 1, 0, -1, 1, 0, 1};
    FrameOptions options = frame_options(64, 64);
    options.scene_order = true;
    const Frame frame(options, {&draw, 1});
    TileVisibility tile;
    for (auto _ : state) {
        tile_visibility_opaque(frame, 0, 0, {{129, 385}, nullptr}, tile);
        benchmark::DoNotOptimize(tile.depth.data());
    }
    if ((tile.hiz_rejected > 0) != nearest_first) state.SkipWithError("Hi-Z did not do what is timed");
    report(state, "samples", double(kLayers) * 64 * 64);
}
BENCHMARK_CAPTURE(depth, tested, false)->Name("raster_stage/depth, every layer nearer")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(depth, hidden, true)->Name("raster_stage/Hi-Z, every layer hidden")->Unit(benchmark::kMicrosecond);

void interpolation(benchmark::State& state, bool one_triangle, stages::Derivatives derivatives) {
    const OneTile tile;
    const Frame frame(frame_options(64, 64), {&tile.draw, 1});
    uint32_t setup_index[32];
    for (uint32_t lane = 0; lane < 32; ++lane) setup_index[lane] = one_triangle ? 0 : lane / 4;
    BarycentricWave wave;
    for (auto _ : state) {
        stages::interpolate_tile(frame, setup_index, derivatives, wave);
        benchmark::DoNotOptimize(wave);
    }
    report(state, "samples", 64 * 64);
}
BENCHMARK_CAPTURE(interpolation, one, true, stages::Derivatives::Analytic)
    ->Name("raster_stage/interpolation and derivatives, a triangle a wave")
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(interpolation, eight, false, stages::Derivatives::Analytic)
    ->Name("raster_stage/interpolation and derivatives, eight triangles a wave")
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(interpolation, quads, true, stages::Derivatives::OfQuads)
    ->Name("raster_stage/interpolation and derivatives of quads")
    ->Unit(benchmark::kMicrosecond);

void resolve(benchmark::State& state) {
    const Sheet sheet(4, 4, 16.0f, 0.5f);
    const Frame frame(frame_options(), {&sheet.draw, 1});
    shading::TileInputs inputs;
    inputs.frame = &frame;
    inputs.visible = {0, 0, kWidth, kHeight};
    shading::TileResolver resolver(inputs);
    constexpr size_t kValues = 3 * 64 * 64;
    shading::SampleTree sums(kValues);
    for (uint64_t sample = 0; sample < 4; ++sample) sums.add(sample, std::vector<float>(kValues, 0.3f));
    shading::RenderResult result;
    result.radiance = shading::Image(kWidth, kHeight, 3);
    for (auto _ : state) {
        for (int y = 0; y < kHeight / 64; ++y)
            for (int x = 0; x < kWidth / 64; ++x) resolver.resolve_radiance(x, y, sums, result);
        benchmark::DoNotOptimize(result.radiance.values.data());
    }
    report(state, "pixels", double(kWidth) * kHeight);
}
BENCHMARK(resolve)->Name("raster_stage/resolve")->Unit(benchmark::kMicrosecond);

}  // namespace
