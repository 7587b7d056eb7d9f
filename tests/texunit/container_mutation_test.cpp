// Damaged files: whatever the bytes, opening and decoding ends in texels or in a TextureError, with bounded memory.
#include "tests/texunit/container_allocations.h"
#include "tests/texunit/container_writer.h"
#include "tests/stress_scale.h"

#include "texunit/containers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace rawtexel::texunit {
namespace {

using test_files::Bytes;
using test_files::random_image;

std::vector<Bytes> seeds() {
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
        write_legacy_dds(cube, {.flags = 4, .four_cc = test_files::four_cc("DXT5")}),
        write_legacy_dds(texels, {0x41, 0, 32, {0x3FF, 0xFFC00, 0x3FF00000, 0xC0000000}}),
        write_legacy_dds(three, {0x40, 0, 24, {0xFF0000, 0xFF00, 0xFF, 0}}),
        write_ktx2(blocks, 146),
        write_ktx2(small_blocks, 131, 2),
        write_ktx2(texels, 37, 2),
        write_ktx2(volume, 76),
        write_ktx2(cube, 144, 2),
    };
}

/// Damages `bytes` in one to four places, more often in the header than behind it.
void mutate(Bytes& bytes, std::mt19937_64& random) {
    static constexpr uint32_t kInteresting[] = {0,   1,     2,     3,     4,     6,          7,          255,
                                                256, 16384, 16385, 65535, 65536, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF};
    const auto below = [&](size_t limit) { return size_t(random() % limit); };
    for (size_t damages = 1 + below(4); damages > 0 && bytes.size() > 8; --damages) {
        const size_t limit = random() % 4 ? std::min<size_t>(bytes.size(), 200) : bytes.size();
        switch (random() % 6) {
            case 0: bytes[below(limit)] ^= std::byte(1u << below(8)); break;
            case 1: bytes[below(limit)] = std::byte(random()); break;
            case 2: test_files::put32(bytes, below(limit - 4) & ~size_t{3}, kInteresting[below(std::size(kInteresting))]); break;
            case 3: test_files::put32(bytes, below(limit - 4) & ~size_t{3}, uint32_t(random())); break;
            case 4: bytes.resize(below(bytes.size())); break;
            default: bytes.insert(bytes.begin() + std::ptrdiff_t(below(limit)), below(40), std::byte(random())); break;
        }
    }
}

/// Decodes up to `most` blocks, the corners of every level and slice first.
void decode_some(TexelSource& source, int most) {
    Bytes texels(256);
    const Shape shape = source.shape();
    for (int level = 0; level < shape.levels; ++level) {
        const int slices = shape.depth > 1 ? level_extent(shape.depth, level) : shape.layers;
        const int last_x = (level_extent(shape.width, level) - 1) / 4, last_y = (level_extent(shape.height, level) - 1) / 4;
        for (const int slice : {0, slices - 1}) {
            for (const auto& [x, y] : {std::pair{0, 0}, {last_x, last_y}}) {
                if (most-- == 0) return;
                source.decode_block(level, slice, x, y, texels.data());
            }
        }
    }
}

enum class Outcome { Texels, Refused };

/// Opens and decodes; anything but texels or a TextureError escapes and fails the test.
Outcome survive(const std::shared_ptr<const ByteSource>& file, uint64_t& image_bytes) {
    try {
        const auto source = container_kind(*file) == ContainerKind::Ktx2 ? open_ktx2(file) : open_dds(file);
        image_bytes = source->stored_bytes();
        decode_some(*source, 40);
    } catch (const TextureError& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with(file->name() + ": ")) << error.what();
        return Outcome::Refused;
    }
    return Outcome::Texels;
}

TEST(DamagedContainers, EndInTexelsOrInATextureErrorWithBoundedMemory) {
    const std::vector<Bytes> originals = seeds();
    std::mt19937_64 random(2024);
    int texels = 0, refused = 0;
    size_t worst = 0;
    for (int i = 0; i < 12000 * stress_scale(); ++i) {
        Bytes bytes = originals[size_t(i) % originals.size()];
        mutate(bytes, random);
        const size_t file_bytes = bytes.size(), before = test_files::live_bytes();
        uint64_t image_bytes = 0;
        test_files::forget_peak();
        // Some from disk, through the pages; the others from memory.
        std::optional<test_files::TemporaryFile> on_disk;
        if (i % 8 == 0) on_disk.emplace(bytes, "mutated");
        const auto file = on_disk ? open_file(on_disk->path()) : open_memory("mutated", std::move(bytes));
        (survive(file, image_bytes) == Outcome::Texels ? texels : refused) += 1;
        const size_t used = test_files::peak_bytes() - before;
        worst = std::max(worst, used);
        // What a zstd level inflates to is counted against its format and extents.
        ASSERT_LE(used, 2 * file_bytes + 2 * image_bytes + (1 << 20)) << "mutation " << i << " of a file of " << file_bytes << " bytes";
    }
    RecordProperty("texels", texels);
    RecordProperty("refused", refused);
    // Both ways out must be taken, or the mutations test nothing.
    EXPECT_GT(texels, 1000) << "refused " << refused;
    EXPECT_GT(refused, 1000) << "read " << texels;
    std::printf("%d read, %d refused, at most %zu bytes allocated\n", texels, refused, worst);
}

TEST(DamagedContainers, OfHugeExtentsAllocateNothing) {
    // A header of 16384 x 16384 x 2048 layers without its texels.
    Bytes dds = write_dds(random_image({}, 1, 16, 1), 2);
    for (const auto& [at, value] : {std::pair{12, 16384u}, {16, 16384u}, {28, 15u}, {140, 2048u}})
        test_files::put32(dds, size_t(at), value);
    Bytes ktx2 = write_ktx2(random_image({}, 1, 16, 1), 109, 2);
    for (const auto& [at, value] : {std::pair{20, 16384u}, {24, 16384u}, {32, 2048u}}) test_files::put32(ktx2, size_t(at), value);
    for (const Bytes& bytes : {dds, ktx2}) {
        uint64_t image_bytes = 0;
        const size_t before = test_files::live_bytes();
        test_files::forget_peak();
        EXPECT_EQ(survive(open_memory("huge", bytes), image_bytes), Outcome::Refused);
        EXPECT_LT(test_files::peak_bytes() - before, 16384u);
    }
}

}  // namespace
}  // namespace rawtexel::texunit
