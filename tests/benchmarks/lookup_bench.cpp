// Lookups per second of the texture unit, one thread: coherent coordinates along a rotated scanline, warm texture.
#include "texunit/memory_source.h"
#include "texunit/sample.h"
#include "texunit/texture.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace {

using namespace rawtexel::texunit;

constexpr int kWaves = 256;   // 8192 lookups: few enough that their coordinates stay in L2

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

}  // namespace
