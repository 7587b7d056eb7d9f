// Numbers per second of each noise, one thread: one dimension, and the two of a pair, over the waves of a 512x512 frame.
#include "texunit/noise.h"

#include <benchmark/benchmark.h>

namespace {

using namespace rawtexel::texunit;

constexpr uint32_t kExtent = 512;

template <class Numbers>
void walk(benchmark::State& state, const Numbers& numbers) {
    uint32_t sample = 0;
    for (auto _ : state) {
        for (uint32_t y = 0; y < kExtent; y += kWaveHeight) {
            for (uint32_t x = 0; x < kExtent; x += kWaveWidth) numbers(RandomAddress{x, y, sample, 0, Dimension::TapX});
        }
        ++sample;
    }
}

void noise(benchmark::State& state, Noise noise) {
    WaveFloat a;
    walk(state, [&](const RandomAddress& first) {
        noise_wave(noise, first, a);
        benchmark::DoNotOptimize(a);
    });
    state.SetItemsProcessed(state.iterations() * kExtent * kExtent);
}

void noise_pair(benchmark::State& state, Noise noise) {
    WaveFloat a, b;
    walk(state, [&](const RandomAddress& first) {
        noise_pair_wave(noise, first, Dimension::TapY, a, b);
        benchmark::DoNotOptimize(a);
        benchmark::DoNotOptimize(b);
    });
    state.SetItemsProcessed(2 * state.iterations() * kExtent * kExtent);
}

BENCHMARK_CAPTURE(noise, white, Noise::White);
BENCHMARK_CAPTURE(noise, sobol, Noise::Sobol);
BENCHMARK_CAPTURE(noise, r2, Noise::R2);
BENCHMARK_CAPTURE(noise, blue, Noise::Blue);
BENCHMARK_CAPTURE(noise, stbn, Noise::Stbn);
BENCHMARK_CAPTURE(noise_pair, white, Noise::White);
BENCHMARK_CAPTURE(noise_pair, sobol, Noise::Sobol);
BENCHMARK_CAPTURE(noise_pair, r2, Noise::R2);
BENCHMARK_CAPTURE(noise_pair, blue, Noise::Blue);
BENCHMARK_CAPTURE(noise_pair, stbn, Noise::Stbn);

}  // namespace
