#include "texunit/noise_table.h"

#include <bit>
#include <cassert>
#include <vector>

// RAWTEXEL_NOISE_MASKS, the path of the file, comes from the build. The symbols are hidden: they are read from this file alone, and where
// position-independent code wants no table of addresses.
asm(".pushsection .rodata\n"
    ".balign 16\n"
    ".global rawtexel_noise_masks, rawtexel_noise_masks_end\n"
    ".hidden rawtexel_noise_masks, rawtexel_noise_masks_end\n"
    "rawtexel_noise_masks:\n"
    ".incbin \"" RAWTEXEL_NOISE_MASKS
    "\"\n"
    "rawtexel_noise_masks_end:\n"
    ".popsection\n");
extern "C" {
extern const std::byte rawtexel_noise_masks[] __attribute__((visibility("hidden")));
extern const std::byte rawtexel_noise_masks_end[] __attribute__((visibility("hidden")));
}

namespace rawtexel::texunit {
namespace {

/// Numbers of `width` bits, lowest bit first.
class BitReader {
  public:
    explicit BitReader(std::span<const std::byte> bytes) : next_(bytes.begin()) {}

    uint32_t read(int width) {
        for (; count_ < width; count_ += 8) pending_ |= uint64_t(*next_++) << count_;
        const auto value = uint32_t(pending_ & ((uint64_t(1) << width) - 1));
        pending_ >>= width;
        count_ -= width;
        return value;
    }

  private:
    std::span<const std::byte>::iterator next_;
    uint64_t pending_ = 0;
    int count_ = 0;
};

constexpr size_t kStbnSize = size_t(kStbnExtent) * kStbnExtent * kStbnDepth, kBlueSize = size_t(kBlueExtent) * kBlueExtent;

/// All masks unpacked.
struct NoiseTable {
    std::vector<uint32_t> ranks;
    NoiseMask stbn, blue;

    NoiseTable() : ranks(2 * (kStbnSize + kBlueSize)) {
        BitReader file(noise_mask_file());
        uint32_t* next = ranks.data();
        stbn = read_mask(file, kStbnExtent, kStbnSize, next);
        blue = read_mask(file, kBlueExtent, kBlueSize, next);
    }

  private:
    static NoiseMask read_mask(BitReader& file, int extent, size_t size, uint32_t*& next) {
        const NoiseMask mask{std::countr_zero(unsigned(extent)), std::countr_zero(size), {next, size}, {next + size, size}};
        for (size_t i = 0; i < 2 * size; ++i) *next++ = file.read(mask.rank_bits);
        return mask;
    }
};

const NoiseTable& table() {
    static const NoiseTable unpacked;
    return unpacked;
}

}  // namespace

const NoiseMask& stbn_mask() { return table().stbn; }
const NoiseMask& blue_mask() { return table().blue; }

std::span<const std::byte> noise_mask_file() {
    constexpr size_t kBytes = 2 * (kStbnSize * std::countr_zero(kStbnSize) + kBlueSize * std::countr_zero(kBlueSize)) / 8;
    const std::span<const std::byte> bytes{rawtexel_noise_masks, rawtexel_noise_masks_end};
    assert(bytes.size() == kBytes);
    return bytes.first(kBytes);
}

}  // namespace rawtexel::texunit
