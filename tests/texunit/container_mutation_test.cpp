// Damaged files: whatever the bytes, opening and decoding ends in texels or in a TextureError, with bounded memory.
#include "tests/texunit/container_allocations.h"
#include "tests/texunit/container_damage.h"
#include "tests/stress/worst_case.h"
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
    const std::vector<Bytes> originals = test_files::seed_files();
    std::mt19937_64 random(2024);
    int texels = 0, refused = 0;
    size_t worst = 0;
    for (int i = 0; i < 12000 * stress_scale(); ++i) {
        Bytes bytes = originals[size_t(i) % originals.size()];
        test_files::damage(bytes, random);
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
    // Both ways out must be taken, or the mutations test nothing.
    EXPECT_GT(texels, 1000) << "refused " << refused;
    EXPECT_GT(refused, 1000) << "read " << texels;
    tell_tested(uint64_t(texels) + uint64_t(refused), "files");
    tell_worst_case("most_bytes_allocated", worst);
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
