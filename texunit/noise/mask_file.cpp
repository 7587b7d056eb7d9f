#include "texunit/noise/mask_file.h"

#include "texunit/noise_table.h"

#include <bit>

namespace rawtexel::texunit::noise {
namespace {

/// Appends the lowest `width` bits of each rank.
void append_ranks(const std::vector<uint32_t>& ranks, int width, std::vector<std::byte>& bytes) {
    uint64_t pending = 0;
    int count = 0;
    for (const uint32_t rank : ranks) {
        pending |= uint64_t(rank) << count;
        for (count += width; count >= 8; count -= 8, pending >>= 8) bytes.push_back(std::byte(pending & 255));
    }
    if (count > 0) bytes.push_back(std::byte(pending));
}

void append_mask(int extent, int depth, uint32_t seed, std::vector<std::byte>& bytes) {
    const MaskShape shape{extent, depth};
    const int width = std::countr_zero(shape.size());
    const std::vector<uint32_t> first = make_mask({.shape = shape, .seed = seed});
    append_ranks(first, width, bytes);
    append_ranks(make_companion({.shape = shape, .seed = seed + 1}, first), width, bytes);
}

}  // namespace

std::vector<std::byte> make_mask_file() {
    std::vector<std::byte> bytes;
    append_mask(kStbnExtent, kStbnDepth, 1, bytes);
    append_mask(kBlueExtent, 1, 3, bytes);
    return bytes;
}

}  // namespace rawtexel::texunit::noise
