// What the numbers of a wave have in common: steps of sequences, orders of samples and places in masks. Used by texunit/noise-inl.h.
#pragma once

#include "texunit/noise_table.h"
#include "texunit/random.h"

#include <array>

namespace rawtexel::texunit {

constexpr uint32_t reverse_bits(uint32_t bits) {
    bits = (bits & 0x55555555u) << 1 | (bits >> 1 & 0x55555555u);
    bits = (bits & 0x33333333u) << 2 | (bits >> 2 & 0x33333333u);
    bits = (bits & 0x0F0F0F0Fu) << 4 | (bits >> 4 & 0x0F0F0F0Fu);
    bits = (bits & 0x00FF00FFu) << 8 | (bits >> 8 & 0x00FF00FFu);
    return bits << 16 | bits >> 16;
}

/// Owen's nested uniform scrambling of numbers whose bits are reversed: each bit flips or not by a hash of `seed` and of the bits below it.
/// Vegdahl's constants for Laine and Karras's form (2021, "Building a Better LK Hash").
constexpr uint32_t scramble_reversed(uint32_t bits, uint32_t seed) {
    bits ^= bits * 0x3D20ADEAu;
    bits += seed;
    bits *= seed >> 16 | 1;
    bits ^= bits * 0x05526C56u;
    return bits ^ bits * 0x53A22864u;
}

/// Steps of the Kronecker sequences n*step mod 1 in units of 2^-32, by dimension. PixelX and PixelY have Roberts' R2 (2018, "The
/// Unreasonable Effectiveness of Quasirandom Sequences"): 1/g and 1/g^2 with g^3 = g + 1, as the sub-pixel offsets of all noises do. Level
/// has the inverse golden ratio. The others were searched for: alone they are badly approximable (q*|q*step| >= 0.19 for q to 4096, |x|
/// being the distance from the nearest integer), and so are any two (|j*k|*|j*step + k*other| >= 0.0028 for j, k to 32). The numbers of two
/// dimensions thus fill the square. TapX and TapY fill it as evenly as R2 does, and with the sub-pixel offsets the four-dimensional cube:
/// were their steps R2's, a pixel's place would decide its tap, and no number of samples would bring the filter's mean.
inline constexpr std::array<uint32_t, 16> kKroneckerSteps = {
    3242174889u, 2447445413u,  // PixelX, PixelY
    0x381124E3u, 0x69A03383u,  // TapX, TapY
    0x6B91306Bu,               // TapZ
    2654435769u,               // Level
    0xA4103207u,               // Probe
    0x72B19DBBu,               // Sign
    0x8F7D0B45u,               // Coverage
    0x4B76AC7Bu,               // Layer
    0x633D2267u,               // Light
    0x9BA82E39u,               // Plane
    0x3A90FDEFu, 0x5F015069u,  // NegativeX, NegativeY
    0x3687BC87u,               // NegativeZ
    0x4F8CFF13u,               // NegativeSign
};

/// How far a dimension's Kronecker sequence has come at the address's sample. Surfaces take the samples in orders of their own, which are
/// nested uniform shuffles: any aligned 2^k samples are 2^k successive ones. So do dimensions beyond those that have steps.
constexpr uint32_t kronecker_offset(const RandomAddress& address, Dimension dimension) {
    const auto role = uint32_t(dimension);
    const uint32_t step = kKroneckerSteps[role % kKroneckerSteps.size()];
    const uint32_t order = address.surface ^ role / uint32_t(kKroneckerSteps.size()) * kRandomStart;
    if (order == 0) return address.sample * step;
    const uint32_t key = mix_bits(mix_bits(kRandomStart ^ address.seed) ^ order);
    return reverse_bits(scramble_reversed(reverse_bits(address.sample), key)) * step;
}

/// Where in a mask a wave's numbers are, and how they are changed.
struct MaskPlace {
    uint32_t x, y;    ///< added to the pixel's
    uint32_t slice;   ///< of the first sample of the period
    uint32_t key;     ///< of the bits below the ranks
    uint32_t flip_a;  ///< all ones where the numbers run downwards
    uint32_t flip_b;  ///< of the second numbers of pairs
};

/// The place of `first` in its period. Periods, surfaces and seeds shift the mask at random; dimensions stand on a fixed 4x4 grid and vary
/// by half a cell, far enough from each other that what one says of another is lost.
constexpr MaskPlace place_in_mask(const NoiseMask& mask, const RandomAddress& first, uint32_t period) {
    const uint32_t shift = mix_bits(mix_bits(mix_bits(kRandomStart ^ first.seed) + period) ^ first.surface);
    const auto role = uint32_t(first.dimension);
    const uint32_t own = mix_bits(shift ^ (role + 1) * kRandomStart);
    const int cell_bits = mask.extent_bits - 2;
    const uint32_t half_cell = (1u << (cell_bits - 1)) - 1;
    return {.x = shift + ((role & 3) << cell_bits) + (own & half_cell),
            .y = (shift >> 16) + ((role >> 2 & 3) << cell_bits) + (own >> 8 & half_cell),
            .slice = own >> 16,
            .key = mix_bits(own),
            .flip_a = 0u - (own >> 30 & 1),
            .flip_b = 0u - (own >> 31)};
}

}  // namespace rawtexel::texunit
