// Random numbers by address: a number is a hash of (pixel, sample, surface, dimension, seed), never the next of a stream.
#pragma once

#include <cstdint>

namespace rawtexel::texunit {

/// The role a number plays. Values are fixed: adding a role never changes the numbers of another.
enum class Dimension : uint32_t {
    PixelX = 0, PixelY = 1,      ///< sub-pixel position
    TapX = 2, TapY = 3, TapZ = 4,
    Level = 5, Probe = 6, Sign = 7,
    Coverage = 8,                ///< MASK and BLEND
    Layer = 9, Light = 10, Plane = 11,
};

struct RandomAddress {
    uint32_t x = 0, y = 0;       ///< pixel of the whole frame
    uint32_t sample = 0;
    uint32_t surface = 0;        ///< 0 for opaque geometry, else 1 + scene-order triangle id
    Dimension dimension = Dimension::PixelX;
    uint32_t seed = 0;
};

/// 32 well-mixed bits.
uint32_t random_bits(const RandomAddress& address);

/// In [0, 1): the top 24 bits times 2^-24. Never 1.
float random_float(const RandomAddress& address);

}  // namespace rawtexel::texunit
