#include "texunit/noise.h"

#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "texunit/noise.cpp"
#include <hwy/foreach_target.h>

#include "texunit/noise-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {

void number_wave(Noise noise, const RandomAddress& first, WaveFloat& numbers) { noise_lanes(noise, first, numbers); }

void number_pair_wave(Noise noise, const RandomAddress& first, Dimension second, WaveFloat& a, WaveFloat& b) {
    noise_pair_lanes(noise, first, second, a, b);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rawtexel::texunit {
namespace {

constexpr std::array kNoises = {
    NoiseInfo{Noise::White, "white", "hashed numbers, each unrelated to every other"},
    NoiseInfo{Noise::Sobol, "sobol", "Sobol's sequence, Owen-scrambled for each pixel: even over any aligned 2^k samples"},
    NoiseInfo{Noise::R2, "r2", "Kronecker sequences like Roberts' R2, shifted for each pixel: even over any number of samples"},
    NoiseInfo{Noise::Blue, "blue", "a mask of blue noise that moves by r2's steps: even over neighbouring pixels, and over samples"},
    NoiseInfo{Noise::Stbn, "stbn", "spatiotemporal blue noise: even over neighbouring pixels and over successive samples, anew after 32"}};

constexpr bool noises_are_in_order() {
    for (size_t i = 0; i < kNoises.size(); ++i) {
        if (size_t(kNoises[i].noise) != i) return false;
    }
    return kNoises.size() == size_t(Noise::Stbn) + 1;
}
static_assert(noises_are_in_order());

HWY_EXPORT(number_wave);
HWY_EXPORT(number_pair_wave);

}  // namespace

std::span<const NoiseInfo> all_noises() { return kNoises; }

std::string_view to_string(Noise noise) { return kNoises[size_t(noise)].name; }

std::optional<Noise> parse_noise(std::string_view text) {
    for (const NoiseInfo& known : kNoises) {
        if (known.name == text) return known.noise;
    }
    return std::nullopt;
}

void noise_wave(Noise noise, const RandomAddress& first, WaveFloat& numbers) { HWY_DYNAMIC_DISPATCH(number_wave)(noise, first, numbers); }

void noise_pair_wave(Noise noise, const RandomAddress& first, Dimension second, WaveFloat& a, WaveFloat& b) {
    HWY_DYNAMIC_DISPATCH(number_pair_wave)(noise, first, second, a, b);
}

}  // namespace rawtexel::texunit
#endif
