// Lookups per second of the texture unit, one thread: coherent coordinates along a rotated scanline, warm texture.
#include "texunit/draw.h"
#include "texunit/memory_source.h"
#include "texunit/sample.h"
#include "texunit/texture.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace {

using namespace rawtexel::texunit;

constexpr int kWaves = 256;  // 8192 lookups: few enough that their coordinates stay in L2

std::unique_ptr<Texture> noise_texture(Format format, int extent) {
    std::vector<std::byte> texels(size_t(extent) * size_t(extent) * size_t(info(format).bytes_per_block));
    uint32_t state = 1;
    for (std::byte& byte : texels) {
        state = state * 1664525u + 1013904223u;
        byte = std::byte(state >> 24);
    }
    return std::make_unique<Texture>("noise", make_memory_source(format, extent, extent, std::move(texels)));
}

/// A rotated 8x4 wave walk whose pixels are `footprint` texels wide.
std::vector<WaveCoordinates> coherent_walk(int extent, float footprint) {
    std::vector<WaveCoordinates> waves(kWaves);
    const float step = footprint / float(extent), cosine = std::cos(0.35f), sine = std::sin(0.35f);
    for (int w = 0; w < kWaves; ++w) {
        for (int lane = 0; lane < kWaveLanes; ++lane) {
            const float x = float((w % 16) * kWaveWidth + lane % kWaveWidth), y = float((w / 16) * kWaveHeight + lane / kWaveWidth);
            waves[size_t(w)].u[lane] = step * (cosine * x - sine * y);
            waves[size_t(w)].v[lane] = step * (sine * x + cosine * y);
            waves[size_t(w)].dudx[lane] = step * cosine;
            waves[size_t(w)].dvdx[lane] = step * sine;
            waves[size_t(w)].dudy[lane] = -step * sine;
            waves[size_t(w)].dvdy[lane] = step * cosine;
        }
    }
    return waves;
}

void lookup(benchmark::State& state, Format format, int extent, float footprint, SamplerState sampler) {
    const std::unique_ptr<Texture> texture = noise_texture(format, extent);
    const std::vector<WaveCoordinates> waves = coherent_walk(extent, footprint);
    WaveColor color;
    for (const WaveCoordinates& at : waves) sample_wave(*texture, sampler, at, kWaveFull, color);
    for (auto _ : state) {
        for (const WaveCoordinates& at : waves) {
            sample_wave(*texture, sampler, at, kWaveFull, color);
            benchmark::DoNotOptimize(color);
        }
    }
    state.SetItemsProcessed(state.iterations() * kWaves * kWaveLanes);
}

constexpr SamplerState kNearest{Wrap::Repeat, Wrap::Repeat, Kernel::Nearest, Kernel::Nearest, MipMode::None};
constexpr SamplerState kBilinear{Wrap::Repeat, Wrap::Repeat, Kernel::Bilinear, Kernel::Bilinear, MipMode::None};
constexpr SamplerState kTrilinear{Wrap::Repeat, Wrap::Repeat, Kernel::Bilinear, Kernel::Bilinear, MipMode::Linear};

BENCHMARK_CAPTURE(lookup, nearest_rgba8, Format::RGBA8Unorm, 4096, 1.0f, kNearest);
BENCHMARK_CAPTURE(lookup, bilinear_rgba8, Format::RGBA8Unorm, 4096, 1.0f, kBilinear);
BENCHMARK_CAPTURE(lookup, bilinear_srgb8, Format::RGBA8Srgb, 4096, 1.0f, kBilinear);
BENCHMARK_CAPTURE(lookup, bilinear_half, Format::RGBA16Half, 4096, 1.0f, kBilinear);
BENCHMARK_CAPTURE(lookup, bilinear_float, Format::RGBA32Float, 4096, 1.0f, kBilinear);
BENCHMARK_CAPTURE(lookup, trilinear_rgba8, Format::RGBA8Unorm, 4096, 2.7f, kTrilinear);
BENCHMARK_CAPTURE(lookup, trilinear_srgb8, Format::RGBA8Srgb, 4096, 2.7f, kTrilinear);
BENCHMARK_CAPTURE(lookup, bilinear_rgba8_enlarged_30x, Format::RGBA8Unorm, 64, 1.0f / 30, kBilinear);

/// Every other kernel, on the finest level.
constexpr SamplerState through(Kernel kernel) { return {.magnify = kernel, .minify = kernel, .mip = MipMode::None}; }

BENCHMARK_CAPTURE(lookup, quadratic_rgba8, Format::RGBA8Unorm, 4096, 1.0f, through(Kernel::Quadratic));
BENCHMARK_CAPTURE(lookup, bspline_rgba8, Format::RGBA8Unorm, 4096, 1.0f, through(Kernel::BSpline));
BENCHMARK_CAPTURE(lookup, bspline_srgb8, Format::RGBA8Srgb, 4096, 1.0f, through(Kernel::BSpline));
BENCHMARK_CAPTURE(lookup, bspline_unorm16, Format::RGBA16Unorm, 4096, 1.0f, through(Kernel::BSpline));
BENCHMARK_CAPTURE(lookup, bspline_half, Format::RGBA16Half, 4096, 1.0f, through(Kernel::BSpline));
BENCHMARK_CAPTURE(lookup, bspline_float, Format::RGBA32Float, 4096, 1.0f, through(Kernel::BSpline));
BENCHMARK_CAPTURE(lookup, mitchell_rgba8, Format::RGBA8Unorm, 4096, 1.0f, through(Kernel::mitchell()));
BENCHMARK_CAPTURE(lookup, catmull_rom_rgba8, Format::RGBA8Unorm, 4096, 1.0f, through(Kernel::CatmullRom));
BENCHMARK_CAPTURE(lookup, lanczos2_rgba8, Format::RGBA8Unorm, 4096, 1.0f, through(Kernel::Lanczos2));
BENCHMARK_CAPTURE(lookup, lanczos3_rgba8, Format::RGBA8Unorm, 4096, 1.0f, through(Kernel::Lanczos3));
BENCHMARK_CAPTURE(lookup, gaussian_rgba8, Format::RGBA8Unorm, 4096, 1.0f, through(Kernel::gaussian()));
BENCHMARK_CAPTURE(lookup, gaussian_2_rgba8, Format::RGBA8Unorm, 4096, 1.0f, through(Kernel::gaussian(2.0f)));
BENCHMARK_CAPTURE(lookup, gaussian_point_rgba8, Format::RGBA8Unorm, 4096, 1.0f, through(Kernel::gaussian_point()));
BENCHMARK_CAPTURE(lookup, bilinear_border_rgba8, Format::RGBA8Unorm, 4096, 1.0f,
                  SamplerState{Wrap::ClampToBorder, Wrap::ClampToBorder, Kernel::Bilinear, Kernel::Bilinear, MipMode::None});

/// A cube map of one grey.
class GreyCube final : public TexelSource {
  public:
    explicit GreyCube(int extent) : extent_(extent) {}
    Format format() const override { return Format::RGBA8Unorm; }
    Shape shape() const override { return {.width = extent_, .height = extent_, .layers = 6, .cube = true}; }
    uint64_t stored_bytes() const override { return 4; }
    void decode_block(int, int, int, int, std::byte* texels) override { std::fill(texels, texels + 64, std::byte{128}); }

  private:
    int extent_;
};

void cube_lookup(benchmark::State& state, SamplerState sampler) {
    Texture texture("cube", std::make_unique<GreyCube>(512));
    // Waves of neighbouring directions all around.
    std::vector<WaveCoordinates3> waves(kWaves);
    for (int w = 0; w < kWaves; ++w) {
        for (int lane = 0; lane < kWaveLanes; ++lane) {
            const float yaw = 0.02454f * float(w) + 0.002f * float(lane % kWaveWidth),
                        pitch = 0.005f * float(w) - 0.6f + 0.002f * float(lane / kWaveWidth);
            const float direction[3] = {std::cos(pitch) * std::cos(yaw), std::sin(pitch), std::cos(pitch) * std::sin(yaw)};
            for (size_t axis = 0; axis < 3; ++axis) waves[size_t(w)].position[axis][lane] = direction[axis];
        }
    }
    WaveColor color;
    for (const WaveCoordinates3& at : waves) sample_cube_wave(texture, sampler, at, kWaveFull, color);
    for (auto _ : state) {
        for (const WaveCoordinates3& at : waves) {
            sample_cube_wave(texture, sampler, at, kWaveFull, color);
            benchmark::DoNotOptimize(color);
        }
    }
    state.SetItemsProcessed(state.iterations() * kWaves * kWaveLanes);
}
BENCHMARK_CAPTURE(cube_lookup, bilinear_rgba8, kBilinear);
BENCHMARK_CAPTURE(cube_lookup, bspline_rgba8, through(Kernel::BSpline));

/// One texel drawn, its numbers included; beside lookup/nearest_rgba8 and its enlarged form the price of a stochastic filter.
void drawn_lookup(benchmark::State& state, int extent, float footprint, SamplerState sampler, Estimator estimator) {
    sampler.estimator = estimator;
    const std::unique_ptr<Texture> texture = noise_texture(Format::RGBA8Unorm, extent);
    const std::vector<WaveCoordinates> waves = coherent_walk(extent, footprint);
    WaveColor color;
    DrawNumbers numbers{};
    for (const WaveCoordinates& at : waves) sample_wave(*texture, sampler, at, kWaveFull, color);
    RandomAddress address;
    const NumberRoles roles = roles_of(sampler);
    RandomStates states;
    for (auto _ : state) {
        ++address.sample;
        for (size_t w = 0; w < waves.size(); ++w) {
            address.x = uint32_t(w % 16) * kWaveWidth;
            address.y = uint32_t(w / 16) * kWaveHeight;
            draw_numbers(address, numbers, Noise::White, roles, states);
            sample_drawn_wave(*texture, sampler, waves[w], kWaveFull, numbers, color);
            benchmark::DoNotOptimize(color);
        }
    }
    state.SetItemsProcessed(state.iterations() * kWaves * kWaveLanes);
}
BENCHMARK_CAPTURE(drawn_lookup, bilinear_reservoir, 4096, 1.0f, kBilinear, Estimator::Reservoir);
BENCHMARK_CAPTURE(drawn_lookup, bspline_reservoir, 4096, 1.0f, through(Kernel::BSpline), Estimator::Reservoir);
BENCHMARK_CAPTURE(drawn_lookup, bspline_jitter, 4096, 1.0f, through(Kernel::BSpline), Estimator::Jitter);
BENCHMARK_CAPTURE(drawn_lookup, bspline_reservoir_enlarged_30x, 64, 1.0f / 30, through(Kernel::BSpline), Estimator::Reservoir);
BENCHMARK_CAPTURE(lookup, nearest_rgba8_enlarged_30x, Format::RGBA8Unorm, 64, 1.0f / 30, kNearest);

}  // namespace
