// Random numbers by address: a number is a hash of (pixel, sample, surface, dimension, seed), never the next of a stream.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace rawtexel::texunit {

/// The role a number plays. Values are fixed: adding a role never changes the numbers of another.
enum class Dimension : uint32_t {
    PixelX = 0,
    PixelY = 1,  ///< sub-pixel position
    TapX = 2,
    TapY = 3,
    TapZ = 4,
    Level = 5,
    Probe = 6,
    Sign = 7,
    Coverage = 8,  ///< MASK and BLEND
    Layer = 9,
    Light = 10,
    Plane = 11,
    NegativeX = 12,  ///< the texel that a kernel's negative weights draw
    NegativeY = 13,
    NegativeZ = 14,
    NegativeSign = 15,
    LightY = 16,  ///< with Light a point: which texel of a shadow's filter
    TextureX = 17,
    TextureY = 18,  ///< where in the pixel textures are looked up, apart from coverage
};
inline constexpr size_t kDimensions = 19;

struct RandomAddress {
    uint32_t x = 0, y = 0;  ///< pixel of the whole frame
    uint32_t sample = 0;
    uint32_t surface = 0;  ///< 0 for opaque geometry, else 1 + scene-order triangle id
    Dimension dimension = Dimension::PixelX;
    uint32_t seed = 0;
};

// How: the words of the address are absorbed one after the other, seed, sample, surface, dimension, x and y, each by an exclusive or and
// Wellons' two-round multiply-xorshift permutation `lowbias32` (exact bias 0.17 of 1, https://github.com/skeeto/hash-prospector). Each step
// is a bijection of the 32-bit state, so addresses that differ in one word never collide. The pixel comes last, so that a wave shares all
// but the last two steps. The dimension is spread by the golden ratio first, since its values are few and small. The vector form
// (texunit/random-inl.h) gives the same bits.

constexpr uint32_t kRandomStart = 0x9E3779B9u;  ///< 2^32 / golden ratio: keeps the all-zero address off the permutation's fixed point 0

constexpr uint32_t mix_bits(uint32_t bits) {
    bits = (bits ^ bits >> 16) * 0x7FEB352Du;
    bits = (bits ^ bits >> 15) * 0x846CA68Bu;
    return bits ^ bits >> 16;
}

/// A dimension as it is absorbed.
constexpr uint32_t spread(Dimension dimension) { return (uint32_t(dimension) + 1) * kRandomStart; }

/// The state that all pixels share.
constexpr uint32_t random_state(uint32_t seed, uint32_t sample, uint32_t surface, Dimension dimension) {
    const uint32_t state = mix_bits(mix_bits(kRandomStart ^ seed) ^ sample);
    return mix_bits(mix_bits(state ^ surface) ^ spread(dimension));
}

/// What the pixels of one seed, sample and surface share, absorbed once for whoever asks for many waves of their numbers.
class RandomStates {
  public:
    /// random_state of the address, whose pixel is not looked at.
    constexpr uint32_t of(const RandomAddress& address, Dimension dimension) {
        if (!known_ || address.seed != seed_ || address.sample != sample_ || address.surface != surface_) absorb(address);
        return state_[size_t(dimension)];
    }

  private:
    // Not inlined: vector moves of the address, which was written word by word just before, would wait for those writes.
    [[gnu::noinline]] constexpr void absorb(const RandomAddress& address) {
        seed_ = address.seed, sample_ = address.sample, surface_ = address.surface, known_ = true;
        for (size_t n = 0; n < kDimensions; ++n) state_[n] = random_state(seed_, sample_, surface_, Dimension(n));
    }

    bool known_ = false;
    uint32_t seed_ = 0, sample_ = 0, surface_ = 0;
    std::array<uint32_t, kDimensions> state_{};
};

/// 32 well-mixed bits.
constexpr uint32_t random_bits(const RandomAddress& address) {
    const uint32_t state = random_state(address.seed, address.sample, address.surface, address.dimension);
    return mix_bits(mix_bits(state ^ address.x) ^ address.y);
}

/// In [0, 1): the top 24 bits times 2^-24. Never 1.
constexpr float unit_float(uint32_t bits) { return float(bits >> 8) * 0x1p-24f; }
constexpr float random_float(const RandomAddress& address) { return unit_float(random_bits(address)); }

}  // namespace rawtexel::texunit
