#include "tests/texunit/container_damage.h"

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace rawtexel::texunit::test_files {

std::vector<Bytes> seed_files() {
    const auto blocks = random_image({.width = 13, .height = 22, .levels = 5}, 4, 16, 1);
    const auto small_blocks = random_image({.width = 8, .height = 8, .layers = 12, .levels = 4, .cube = true}, 4, 8, 2);
    const auto texels = random_image({.width = 9, .height = 7, .levels = 4}, 1, 4, 3);
    const auto volume = random_image({.width = 5, .height = 6, .depth = 7, .levels = 3}, 1, 2, 4);
    const auto cube = random_image({.width = 7, .height = 7, .layers = 6, .levels = 3, .cube = true}, 4, 16, 5);
    const auto three = random_image({.width = 6, .height = 5, .levels = 2}, 1, 3, 6);
    return {
        write_dds(blocks, 98),
        write_dds(blocks, 95),
        write_dds(small_blocks, 71),
        write_dds(volume, 54),
        write_legacy_dds(cube, {.flags = 4, .four_cc = four_cc("DXT5")}),
        write_legacy_dds(texels, {0x41, 0, 32, {0x3FF, 0xFFC00, 0x3FF00000, 0xC0000000}}),
        write_legacy_dds(three, {0x40, 0, 24, {0xFF0000, 0xFF00, 0xFF, 0}}),
        write_ktx2(blocks, 146),
        write_ktx2(small_blocks, 131, 2),
        write_ktx2(texels, 37, 2),
        write_ktx2(volume, 76),
        write_ktx2(cube, 144, 2),
    };
}

void damage(Bytes& bytes, std::mt19937_64& random) {
    static constexpr uint32_t kInteresting[] = {0,   1,     2,     3,     4,     6,          7,          255,
                                                256, 16384, 16385, 65535, 65536, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF};
    const auto below = [&](size_t limit) { return size_t(random() % limit); };
    for (size_t damages = 1 + below(4); damages > 0 && bytes.size() > 8; --damages) {
        const size_t limit = random() % 4 ? std::min<size_t>(bytes.size(), 200) : bytes.size();
        switch (random() % 6) {
            case 0: bytes[below(limit)] ^= std::byte(1u << below(8)); break;
            case 1: bytes[below(limit)] = std::byte(random()); break;
            case 2: put32(bytes, below(limit - 4) & ~size_t{3}, kInteresting[below(std::size(kInteresting))]); break;
            case 3: put32(bytes, below(limit - 4) & ~size_t{3}, uint32_t(random())); break;
            case 4: bytes.resize(below(bytes.size())); break;
            default: bytes.insert(bytes.begin() + std::ptrdiff_t(below(limit)), below(40), std::byte(random())); break;
        }
    }
}

}  // namespace rawtexel::texunit::test_files
