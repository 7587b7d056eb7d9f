#include "shading/pixel_lines.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace rawtexel::shading {
namespace {

/// splitmix64's mixing of bits.
uint64_t mix(uint64_t key) {
    key = (key ^ key >> 30) * 0xBF58476D1CE4E5B9u;
    key = (key ^ key >> 27) * 0x94D049BB133111EBu;
    return key ^ key >> 31;
}

}  // namespace

void PixelLines::clear() {
    std::fill(slots_.begin(), slots_.end(), 0);
    used_ = 0;
}

bool PixelLines::add(uint32_t pixel, uint32_t texture, uint32_t line) {
    assert(pixel < 1u << 14 && texture < 1u << 20 && line < 1u << 27);
    const uint64_t key = (uint64_t{pixel} << 47 | uint64_t{texture} << 27 | line) + 1;
    const size_t mask = slots_.size() - 1;
    size_t slot = mix(key) & mask;
    for (; slots_[slot] != 0; slot = (slot + 1) & mask) {
        if (slots_[slot] == key) return false;
    }
    slots_[slot] = key;
    if (2 * ++used_ > slots_.size()) grow();
    return true;
}

void PixelLines::grow() {
    std::vector<uint64_t> larger(2 * slots_.size());
    for (const uint64_t key : slots_) {
        if (key == 0) continue;
        size_t slot = mix(key) & (larger.size() - 1);
        while (larger[slot] != 0) slot = (slot + 1) & (larger.size() - 1);
        larger[slot] = key;
    }
    slots_ = std::move(larger);
}

}  // namespace rawtexel::shading
