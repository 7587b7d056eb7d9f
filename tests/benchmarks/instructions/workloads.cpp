#include "tests/benchmarks/instructions/workloads.h"

#include "raster/frame.h"
#include "raster/visibility.h"
#include "scenes/builtin.h"
#include "shading/camera.h"
#include "shading/cluster_meshes.h"
#include "shading/render.h"
#include "texunit/block_codec.h"
#include "texunit/draw.h"
#include "texunit/memory_source.h"
#include "texunit/sample.h"
#include "texunit/texture.h"

#include <cmath>
#include <cstddef>
#include <memory>
#include <random>

namespace rawtexel::instructions {
namespace {

using texunit::Format, texunit::Kernel, texunit::MipMode, texunit::SamplerState;

std::vector<std::byte> random_bytes(size_t count) {
    std::mt19937_64 random(1);
    std::vector<std::byte> bytes(count);
    for (std::byte& byte : bytes) byte = std::byte(random());
    return bytes;
}

constexpr int kWaves = 64;

/// Waves along a turned scanline, pixels `footprint` texels wide.
std::vector<texunit::WaveCoordinates> walk(int extent, float footprint) {
    std::vector<texunit::WaveCoordinates> waves(kWaves);
    const float step = footprint / float(extent), cosine = std::cos(0.35f), sine = std::sin(0.35f);
    for (int w = 0; w < kWaves; ++w) {
        for (int lane = 0; lane < texunit::kWaveLanes; ++lane) {
            const float x = float(w % 8 * texunit::kWaveWidth + lane % texunit::kWaveWidth),
                        y = float(w / 8 * texunit::kWaveHeight + lane / texunit::kWaveWidth);
            texunit::WaveCoordinates& at = waves[size_t(w)];
            at.u[lane] = step * (cosine * x - sine * y), at.v[lane] = step * (sine * x + cosine * y);
            at.dudx[lane] = step * cosine, at.dvdx[lane] = step * sine;
            at.dudy[lane] = -step * sine, at.dvdy[lane] = step * cosine;
        }
    }
    return waves;
}

Workload lookup(const std::string& name, Format format, float footprint, const SamplerState& sampler) {
    return {"lookup/" + name, "lookup", kWaves * texunit::kWaveLanes, [=]() -> std::function<void()> {
                constexpr int kExtent = 256;
                const auto bytes = size_t(texunit::info(format).bytes_per_block) * kExtent * kExtent;
                auto texture =
                    std::make_shared<texunit::Texture>("noise", texunit::make_memory_source(format, kExtent, kExtent, random_bytes(bytes)));
                return [=, waves = walk(kExtent, footprint)] {
                    texunit::WaveColor colour;
                    texunit::DrawNumbers numbers{};
                    const texunit::NumberRoles roles = texunit::roles_of(sampler);
                    texunit::RandomAddress address;
                    for (size_t w = 0; w < waves.size(); ++w) {
                        if (sampler.estimator == texunit::Estimator::All) {
                            texunit::sample_wave(*texture, sampler, waves[w], texunit::kWaveFull, colour);
                        } else {
                            address.x = uint32_t(w % 8) * texunit::kWaveWidth, address.y = uint32_t(w / 8) * texunit::kWaveHeight;
                            texunit::draw_numbers(address, numbers, texunit::Noise::White, roles);
                            texunit::sample_drawn_wave(*texture, sampler, waves[w], texunit::kWaveFull, numbers, colour);
                        }
                    }
                };
            }};
}

Workload decode(Format format) {
    constexpr size_t kBlocks = 1024;
    return {"decode/" + std::string(texunit::info(format).name), "texel", kBlocks * 16, [=]() -> std::function<void()> {
                const auto block_bytes = size_t(texunit::info(format).bytes_per_block);
                auto room = std::make_shared<std::vector<std::byte>>(64 + 16 * 16);
                return [=, blocks = random_bytes(kBlocks * block_bytes), decoder = texunit::block_decoder(format)] {
                    std::byte* const texels = room->data() + (64 - uintptr_t(room->data()) % 64);
                    for (size_t i = 0; i < kBlocks; ++i) decoder(blocks.data() + i * block_bytes, texels);
                };
            }};
}

constexpr int kRasterWidth = 256, kRasterHeight = 128;

/// Squares of two triangles, `cell` pixels wide, over the frame and a little off its grid; object space is (pixel x, pixel y, depth).
struct Grid {
    explicit Grid(float cell) {
        const int columns = int(kRasterWidth / cell), rows = int(kRasterHeight / cell);
        for (int j = 0; j <= rows; ++j)
            for (int i = 0; i <= columns; ++i)
                positions.emplace_back(cell * float(i) + 0.13f, cell * float(j) + 0.29f, 0.5f + 0.02f * std::sin(0.1f * float(i + j)));
        for (uint32_t j = 0; j < uint32_t(rows); ++j)
            for (uint32_t i = 0; i < uint32_t(columns); ++i) {
                const uint32_t stride = uint32_t(columns) + 1, a = j * stride + i;
                for (const uint32_t v : {a, a + stride, a + 1, a + 1, a + stride, a + stride + 1}) indices.push_back(v);
            }
        clusters = raster::make_clusters(positions, indices);
        draw.positions = positions.data();
        draw.vertex_count = uint32_t(positions.size());
        draw.indices = indices.data();
        draw.triangle_count = uint32_t(indices.size() / 3);
        draw.clusters = &clusters;
        draw.clip_from_object = {2.0f / kRasterWidth, 0, 0, 0, 0, -2.0f / kRasterHeight, 0, 0, 0, 0, 1, 0, -1, 1, 0, 1};
    }
    Grid(const Grid&) = delete;
    Grid& operator=(const Grid&) = delete;

    raster::Frame frame() const {
        raster::FrameOptions options;
        options.width = kRasterWidth;
        options.height = kRasterHeight;
        options.filter_radius = 0.5f;
        return raster::Frame(options, {&draw, 1});
    }

    std::vector<glm::vec3> positions;
    std::vector<uint32_t> indices;
    raster::MeshClusters clusters;
    raster::Draw draw;
};

int64_t triangles_of(float cell) { return int64_t(kRasterWidth / cell) * int64_t(kRasterHeight / cell) * 2; }

std::string pixels(float cell) { return std::to_string(int(cell)) + " pixels"; }

Workload geometry(float cell) {
    return {"raster/setup, " + pixels(cell), "triangle", triangles_of(cell), [=]() -> std::function<void()> {
                return [grid = std::make_shared<Grid>(cell)] { const raster::Frame frame = grid->frame(); };
            }};
}

Workload visibility(float cell) {
    return {"raster/visibility, " + pixels(cell), "pixel", kRasterWidth * kRasterHeight, [=]() -> std::function<void()> {
                auto grid = std::make_shared<Grid>(cell);
                auto frame = std::make_shared<raster::Frame>(grid->frame());
                return [=, tile = std::make_shared<raster::TileVisibility>()] {
                    for (int y = 0; y < frame->tiles_y(); ++y)
                        for (int x = 0; x < frame->tiles_x(); ++x)
                            raster::tile_visibility_opaque(*frame, x, y, {{129, 385}, nullptr}, *tile);
                };
            }};
}

struct PreparedFrame {
    explicit PreparedFrame(const scenes::BuiltinScene& builtin)
        : scene(builtin.make({})), executor(shading::make_executor(shading::ExecutorKind::Threads, 1)) {
        shading::cluster_meshes(scene, *executor);
        // Without the sky: to integrate it takes minutes here, and a frame only looks it up.
        lighting = shading::resolve_lighting(scene, scene.lights, 0.2f, nullptr, true, *executor);
        options.width = kWidth;
        options.height = kHeight;
        options.camera = scene.cameras.empty() ? shading::default_camera(scene.bounds(), float(kWidth) / kHeight) : scene.cameras[0];
    }
    static constexpr int kWidth = 128, kHeight = 72;

    shading::Scene scene;
    std::unique_ptr<shading::Executor> executor;
    shading::Lighting lighting;
    shading::RenderOptions options;
};

Workload frame(const scenes::BuiltinScene& builtin) {
    return {"frame/" + std::string(builtin.name), "pixel", PreparedFrame::kWidth * PreparedFrame::kHeight,
            [&builtin]() -> std::function<void()> {
                return [prepared = std::make_shared<PreparedFrame>(builtin)] {
                    shading::render(prepared->scene, prepared->lighting, prepared->options, *prepared->executor);
                };
            }};
}

SamplerState through(const Kernel& kernel, MipMode mip = MipMode::None) { return {.magnify = kernel, .minify = kernel, .mip = mip}; }

}  // namespace

std::vector<Workload> all_workloads() {
    SamplerState one_tap = through(Kernel::BSpline), anisotropic = through(Kernel::Bilinear, MipMode::Linear);
    one_tap.estimator = texunit::Estimator::Reservoir;
    anisotropic.probes = 16;
    std::vector<Workload> all = {
        lookup("nearest, rgba8", Format::RGBA8Unorm, 1, through(Kernel::Nearest)),
        lookup("bilinear, rgba8", Format::RGBA8Unorm, 1, through(Kernel::Bilinear)),
        lookup("bilinear, srgb8", Format::RGBA8Srgb, 1, through(Kernel::Bilinear)),
        lookup("bilinear, half", Format::RGBA16Half, 1, through(Kernel::Bilinear)),
        lookup("bilinear, float", Format::RGBA32Float, 1, through(Kernel::Bilinear)),
        lookup("trilinear, rgba8", Format::RGBA8Unorm, 2.7f, through(Kernel::Bilinear, MipMode::Linear)),
        lookup("16 probes, rgba8", Format::RGBA8Unorm, 2.7f, anisotropic),
        lookup("bspline, rgba8", Format::RGBA8Unorm, 1, through(Kernel::BSpline)),
        lookup("lanczos3, rgba8", Format::RGBA8Unorm, 1, through(Kernel::Lanczos3)),
        lookup("bspline, one tap, rgba8", Format::RGBA8Unorm, 1, one_tap),
        lookup("bspline enlarged 30 times, rgba8", Format::RGBA8Unorm, 1.0f / 30, through(Kernel::BSpline)),
    };
    for (const Format format : {Format::BC1RgbUnorm, Format::BC3Unorm, Format::BC5Unorm, Format::BC6HUfloat, Format::BC7Unorm})
        all.push_back(decode(format));
    for (const float cell : {2.0f, 16.0f}) {
        all.push_back(geometry(cell));
        all.push_back(visibility(cell));
    }
    for (const scenes::BuiltinScene& builtin : scenes::builtin_scenes()) all.push_back(frame(builtin));
    return all;
}

}  // namespace rawtexel::instructions
