// The bits of a block, least significant first, and index streams with their anchors' missing bits put back.
#pragma once

#include "texunit/little_endian.h"

#include <cstddef>
#include <cstdint>

namespace rawtexel::texunit {

/// 128 bits of a block, addressed from the least significant bit of its first byte.
struct BlockBits {
    uint64_t low, high;

    explicit BlockBits(const std::byte* block) : low(load<uint64_t>(block)), high(load<uint64_t>(block + 8)) {}

    /// `count` bits from bit `first`; first <= 127, count <= 63, first + count <= 128. Folds to a shift or two when the arguments are
    /// constants.
    constexpr uint64_t field(int first, int count) const {
        const uint64_t mask = (uint64_t{1} << count) - 1;
        if (first >= 64) return (high >> (first - 64)) & mask;
        if (first == 0) return low & mask;
        return ((low >> first) | (high << (64 - first))) & mask;
    }
};

/// Puts a zero bit at bit `position`: the highest bit of an anchor's index, which the block leaves out.
constexpr uint64_t insert_zero_bit(uint64_t bits, int position) {
    const uint64_t below = (uint64_t{1} << position) - 1;
    return ((bits & ~below) << 1) | (bits & below);
}

/// The stream with the anchor's index of texel `texel` widened to `index_bits` bits.
constexpr uint64_t widen_anchor(uint64_t stream, int texel, int index_bits) {
    return insert_zero_bit(stream, (texel + 1) * index_bits - 1);
}

}  // namespace rawtexel::texunit
