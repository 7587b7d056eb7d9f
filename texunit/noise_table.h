// The masks behind the noises `blue` and `stbn`, from the project's one binary file, texunit/noise/masks.bin, which is part of the library.
//
// The file is made by our own void-and-cluster program (texunit/noise/void_and_cluster.h) in some ten seconds, the same bytes everywhere:
//     cmake --build build/release --target rawtexel_make_noise && build/release/rawtexel_make_noise texunit/noise/masks.bin
// It holds four masks one after the other: that of stbn and its companion, that of blue and its companion. A mask is the ranks of its
// entries, x fastest, y, then slices, in as few bits as hold the largest (17 and 14), lowest bit first, without padding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace rawtexel::texunit {

inline constexpr int kStbnExtent = 64, kStbnDepth = 32;  ///< pixels and slices
inline constexpr int kBlueExtent = 128;

/// Ranks 0..size-1 of a torus of extent x extent x depth entries; entry (x, y, z) lies at x + extent*(y + extent*z).
struct NoiseMask {
    int extent_bits, rank_bits;  ///< extent = 2^extent_bits, size = 2^rank_bits
    std::span<const uint32_t> first;
    std::span<const uint32_t> second;  ///< of pairs
};

/// Unpacked by the first call of either, by one thread.
const NoiseMask& stbn_mask();
const NoiseMask& blue_mask();

/// The file.
std::span<const std::byte> noise_mask_file();

}  // namespace rawtexel::texunit
