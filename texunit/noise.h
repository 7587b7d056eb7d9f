// Noises: how the addressed numbers of texunit/random.h are related over the samples of a pixel and over neighbouring pixels. Each is
// uniform over pixels and seeds and, but for white, more even than chance over samples, over pixels or over both.
#pragma once

#include "texunit/random.h"
#include "texunit/wave.h"

#include <optional>
#include <span>
#include <string_view>

namespace rawtexel::texunit {

enum class Noise : uint8_t {
    White,  ///< random_float of the address
    Sobol,  ///< (0, 2)-sequences, shuffled and Owen-scrambled for each pixel and dimension (Burley 2020): any aligned 2^k samples are a net
    R2,     ///< Kronecker sequences, shifted for each pixel and dimension, in the manner of Roberts' R2
    Blue,   ///< a mask of spatial blue noise for the first sample, to which later samples add the steps of r2
    Stbn,   ///< spatiotemporal blue noise (Wolfe et al. 2022), masks of 32 samples, placed anew after each 32
};

struct NoiseInfo {
    Noise noise;
    std::string_view name;
    std::string_view description;  ///< one line for people
};
std::span<const NoiseInfo> all_noises();

std::string_view to_string(Noise noise);  // white sobol r2 blue stbn
std::optional<Noise> parse_noise(std::string_view text);

/// The numbers of first.dimension for the 8x4 pixels right of and below (first.x, first.y). Multiples of 2^-24 in [0, 1), the same on every
/// instruction set; sample n of a pixel does not depend on how many there are. Dimensions and surfaces are unrelated to each other.
void noise_wave(Noise noise, const RandomAddress& first, WaveFloat& numbers);

/// The numbers of two dimensions that are used together, such as TapX and TapY. `a` are those of noise_wave for first.dimension. Where the
/// noise can it makes the points (a, b) even over the unit square: (0, 2)-nets of sobol, Kronecker pairs of r2, masks of pairs for blue and stbn.
void noise_pair_wave(Noise noise, const RandomAddress& first, Dimension second, WaveFloat& a, WaveFloat& b);

}  // namespace rawtexel::texunit
