// Blocks appear once, when first touched, whatever the threads; damage reaches everyone who asks.
#include "texunit/memory_source.h"
#include "texunit/sample.h"
#include "texunit/texture.h"

#include "texunit/block_codec.h"
#include "texunit/random.h"

#include "tests/stress_scale.h"
#include "tests/texunit/hashed_source.h"

#include <sys/mman.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <mutex>
#include <random>
#include <set>
#include <thread>
#include <vector>

namespace rawtexel::texunit {
namespace {

constexpr int kThreads = 8;

template <class Body>
void on_threads(const Body& body) {
    std::vector<std::thread> threads;
    for (int t = 0; t < kThreads; ++t) threads.emplace_back([&body, t] { body(t); });
    for (std::thread& thread : threads) thread.join();
}

/// How often each block was asked of a source.
class DecodeCount {
  public:
    void operator()(int level, int slice, int x, int y) {
        const std::lock_guard lock(mutex_);
        ++counts_[{level, slice, x, y}];
    }
    size_t blocks() const { return counts_.size(); }
    int most() const {
        int most = 0;
        for (const auto& [block, count] : counts_) most = std::max(most, count);
        return most;
    }

  private:
    std::mutex mutex_;
    std::map<std::array<int, 4>, int> counts_;
};

WaveCoordinates wave_at(std::mt19937& random, int extent) {
    std::uniform_real_distribution<float> place(0, 1), log_scale(-1, std::log2(float(extent)));
    const float u = place(random), v = place(random), step = std::exp2(log_scale(random)) / float(extent);
    WaveCoordinates at;
    for (int i = 0; i < kWaveLanes; ++i) {
        at.u[i] = u + float(i % kWaveWidth) * step, at.v[i] = v + float(i / kWaveWidth) * step;
        at.dudx[i] = at.dvdy[i] = step;
        at.dvdx[i] = at.dudy[i] = 0;
    }
    return at;
}

TEST(LazyStorage, ReadsNothingBeforeTheFirstTouch) {
    DecodeCount decodes;
    Texture texture("lazy", std::make_unique<HashedSource>(Format::RGBA8Unorm, Shape{.width = 64, .height = 64}, 0, std::ref(decodes)));
    EXPECT_EQ(decodes.blocks(), 0u);
    EXPECT_FALSE(texture.complete());
    texture.ensure(0, 0, 5, 6);
    texture.ensure(0, 0, 7, 7);
    EXPECT_EQ(decodes.blocks(), 1u);
    EXPECT_EQ(texture.work().blocks_decoded, 1u);
    EXPECT_EQ(texture.work().bytes_decoded, 64u);
    // A block of level 1 has four parents, one of which is there.
    texture.ensure(1, 0, 0, 0);
    EXPECT_EQ(texture.work().blocks_decoded, 4u);
    EXPECT_EQ(texture.work().blocks_decoded_mips, 1u);
}

TEST(LazyStorage, IsCompleteOnceEveryBlockIsThere) {
    Texture texture("lazy", std::make_unique<HashedSource>(Format::RGBA16Unorm, Shape{.width = 20, .height = 9}));
    EXPECT_EQ(texture.blocks_total(), 15u + 3 + 2 + 1 + 1);
    texture.ensure(4, 0, 0, 0);
    EXPECT_TRUE(texture.complete()) << "the last level covers everything";
    EXPECT_EQ(texture.ready_levels(), 0b11111u);
    EXPECT_EQ(texture.work().blocks_decoded + texture.work().blocks_decoded_mips, texture.blocks_total());
}

TEST(LazyStorage, DecodesEveryBlockOnceUnderManyThreads) {
    constexpr int kExtent = 256;
    for (const Format format : {Format::RGBA8Srgb, Format::RGBA16Half}) {
        DecodeCount decodes;
        const auto slowly = [&](int level, int slice, int x, int y) {
            decodes(level, slice, x, y);
            // Now and then long enough for the others to arrive and wait.
            if ((x * 7 + y) % 64 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        };
        Texture shared("shared", std::make_unique<HashedSource>(format, Shape{.width = kExtent, .height = kExtent}, 0, slowly));
        Texture alone("alone", std::make_unique<HashedSource>(format, Shape{.width = kExtent, .height = kExtent}));
        constexpr int kWaves = 200;
        std::vector<std::vector<WaveColor>> results(kThreads, std::vector<WaveColor>(kWaves));
        // All threads ask for the same waves in the same order, so that they meet.
        on_threads([&](int t) {
            std::mt19937 random(3);
            for (WaveColor& result : results[size_t(t)]) sample_wave(shared, {}, wave_at(random, kExtent), kWaveFull, result);
        });
        std::mt19937 random(3);
        for (size_t n = 0; n < kWaves; ++n) {
            WaveColor expected;
            sample_wave(alone, {}, wave_at(random, kExtent), kWaveFull, expected);
            for (int t = 0; t < kThreads; ++t) {
                ASSERT_EQ(std::memcmp(&results[size_t(t)][n], &expected, sizeof(expected)), 0) << "thread " << t;
            }
        }
        EXPECT_EQ(decodes.most(), 1);
        EXPECT_EQ(decodes.blocks(), shared.work().blocks_decoded);
        EXPECT_EQ(shared.work().blocks_decoded, alone.work().blocks_decoded);
        EXPECT_EQ(shared.work().blocks_decoded_mips, alone.work().blocks_decoded_mips);
    }
}

TEST(LazyStorage, TellsEveryCallerOfDamageAndReadsTheRest) {
    DecodeCount decodes;
    const auto damaged = [&](int level, int slice, int x, int y) {
        decodes(level, slice, x, y);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        if (x == 2 && y == 1) throw TextureError("bricks.dds: truncated at byte 128");
    };
    Texture texture("bricks.dds", std::make_unique<HashedSource>(Format::RGBA8Unorm, Shape{.width = 32, .height = 32}, 0, damaged));
    std::atomic<int> told{0}, read{0};
    on_threads([&](int) {
        const auto expect_damage = [&](int level, int x, int y) {
            try {
                texture.ensure(level, 0, x, y);
                ADD_FAILURE() << "level " << level << " texel " << x << ',' << y << " should be damaged";
            } catch (const TextureError& error) {
                EXPECT_STREQ(error.what(), "bricks.dds: truncated at byte 128");
                ++told;
            }
        };
        for (int again = 0; again < 3; ++again) expect_damage(0, 9, 5);
        // Whatever is made from the damaged block is damaged; its neighbours are not.
        expect_damage(1, 4, 3);
        expect_damage(5, 0, 0);
        EXPECT_NO_THROW(texture.ensure(0, 0, 0, 0));
        EXPECT_NO_THROW(texture.ensure(1, 0, 15, 15));
        ++read;
    });
    EXPECT_EQ(told, 5 * kThreads);
    EXPECT_EQ(read, kThreads);
    EXPECT_EQ(decodes.most(), 1);
    EXPECT_FALSE(texture.complete());

    // A wave that reaches the damaged block says so too.
    WaveCoordinates at{};
    for (int i = 0; i < kWaveLanes; ++i) at.u[i] = 9.0f / 32, at.v[i] = 5.0f / 32;
    WaveColor colour;
    EXPECT_THROW(sample_wave(texture, {}, at, kWaveFull, colour), TextureError);
}

TEST(LazyStorage, PassesOnWhateverASourceThrows) {
    const auto thrower = [](int, int, int x, int) {
        if (x == 0) throw std::bad_alloc();
        throw 42;
    };
    Texture texture("odd", std::make_unique<HashedSource>(Format::RGBA8Unorm, Shape{.width = 8, .height = 4}, 0, thrower));
    EXPECT_THROW(texture.ensure(0, 0, 0, 0), TextureError);
    EXPECT_THROW(texture.ensure(0, 0, 0, 0), TextureError);
    EXPECT_ANY_THROW(texture.ensure(0, 0, 4, 0));
    EXPECT_THROW(texture.ensure(0, 0, 4, 0), TextureError) << "nobody waits for ever";
}

/// 4 KiB pages of the decoded texels that the system has committed.
uint64_t committed_pages(const Texture& texture) {
    const uint64_t bytes = texture.levels().texels * uint64_t(bytes_per_texel(texture.texel_layout().storage));
    std::vector<unsigned char> resident(bytes / 4096);
    auto* const base = const_cast<std::byte*>(texture.texels());
    EXPECT_EQ(mincore(base, bytes, resident.data()), 0);
    uint64_t pages = 0;
    for (const unsigned char page : resident) pages += page & 1;
    return pages;
}

/// BC7 blocks of any extent, made of their address when asked for.
class Bc7Source final : public TexelSource {
  public:
    explicit Bc7Source(int extent) : extent_(extent) {}
    Format format() const override { return Format::BC7Unorm; }
    Shape shape() const override { return {.width = extent_, .height = extent_}; }
    uint64_t stored_bytes() const override { return texunit::stored_bytes(format(), extent_, extent_); }
    void decode_block(int, int, int block_x, int block_y, std::byte* texels) override {
        uint32_t block[4];
        for (uint32_t i = 0; i < 4; ++i) block[i] = mix_bits(uint32_t(block_y) * 65536 + uint32_t(block_x) + i * kRandomStart);
        texunit::decode_block(format(), reinterpret_cast<const std::byte*>(block), texels);
    }

  private:
    int extent_;
};

/// Bytes of this process that are in memory.
uint64_t resident_bytes() {
    std::ifstream statm("/proc/self/statm");
    uint64_t total = 0, resident = 0;
    statm >> total >> resident;
    return resident * uint64_t(sysconf(_SC_PAGESIZE));
}

TEST(LazyStorage, CommitsAWindowOfAHugeBc7TextureAndLittleMore) {
    constexpr int kExtent = 16384, kWindow = 1638;  // 1 % of the area
    constexpr uint64_t kDecoded = uint64_t{kExtent} * kExtent * 4;
    if (sysconf(_SC_PAGESIZE) != 4096) GTEST_SKIP() << "the layout is made for 4 KiB pages, this system has " << sysconf(_SC_PAGESIZE);
    const uint64_t before = resident_bytes();
    Texture texture("huge", std::make_unique<Bc7Source>(kExtent));
    EXPECT_EQ(committed_pages(texture), 0u);
    for (int y = 1000; y < 1000 + kWindow; y += 4) {
        for (int x = 5000; x < 5000 + kWindow; x += 4) texture.ensure(0, 0, x, y);
    }
    const uint64_t committed = 4096 * committed_pages(texture);
    EXPECT_LE(committed, kDecoded * 15 / 1000);
    // Whatever else the texture keeps, such as the states of its blocks, is within that too. Sanitizers keep as much again and more.
    const uint64_t grown = resident_bytes() - before;
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    EXPECT_LE(grown, kDecoded * 15 / 1000);
#endif
    std::printf("1 %% of the area commits %.3f %% of the decoded size, %.3f %% with all else\n", 100.0 * double(committed) / kDecoded,
                100.0 * double(grown) / kDecoded);
}

TEST(LazyStorage, CommitsOnlyTheDistinctPagesOfAScatteredHundredthOfABc7Texture) {
    const int extent = stress_scale() > 1 ? 16384 : 4096;
    if (sysconf(_SC_PAGESIZE) != 4096) GTEST_SKIP() << "the layout is made for 4 KiB pages, this system has " << sysconf(_SC_PAGESIZE);
    Texture texture("huge", std::make_unique<Bc7Source>(extent));
    std::mt19937 random(2);
    std::set<int32_t> pages;
    const int blocks = extent / 4 * (extent / 4) / 100;
    for (int n = 0; n < blocks; ++n) {
        const int x = int(random() % uint32_t(extent)), y = int(random() % uint32_t(extent));
        texture.ensure(0, 0, x, y);
        pages.insert(texel_index(texture.levels(), StorageClass::Packed32, 0, 0, x, y) >> page_shape(StorageClass::Packed32).log2_texels());
    }
    EXPECT_EQ(committed_pages(texture), pages.size());
    EXPECT_EQ(texture.work().blocks_decoded_mips, 0u);
}

TEST(LazyStorage, CommitsAWindowOfAHugeTextureAndLittleMore) {
    constexpr int kExtent = 16384, kWindow = 1638;  // 1 % of the area
    if (sysconf(_SC_PAGESIZE) != 4096) GTEST_SKIP() << "the layout is made for 4 KiB pages, this system has " << sysconf(_SC_PAGESIZE);
    Texture texture("huge", make_hashed_pyramid(Format::RGBA8Unorm, kExtent, kExtent));
    EXPECT_EQ(committed_pages(texture), 0u);
    for (int y = 1000; y < 1000 + kWindow; y += 4) {
        for (int x = 5000; x < 5000 + kWindow; x += 4) texture.ensure(0, 0, x, y);
    }
    const double decoded_pages = double(kExtent) * kExtent * 4 / 4096;
    EXPECT_LE(double(committed_pages(texture)), 0.015 * decoded_pages);
    EXPECT_GE(texture.work().blocks_decoded, uint64_t{kWindow / 4} * (kWindow / 4));
}

TEST(LazyStorage, CommitsNoMoreThanTheDistinctPagesOfScatteredBlocks) {
    if (sysconf(_SC_PAGESIZE) != 4096) GTEST_SKIP() << "the layout is made for 4 KiB pages, this system has " << sysconf(_SC_PAGESIZE);
    for (const Format format : {Format::RGBA8Unorm, Format::RGBA16Half, Format::RGBA32Float}) {
        Texture texture("huge", make_hashed_pyramid(format, 16384, 16384));
        const StorageClass storage = texture.texel_layout().storage;
        std::mt19937 random(1);
        std::set<int32_t> pages;
        for (int n = 0; n < 2000; ++n) {
            const int x = int(random() % 16384), y = int(random() % 16384);
            texture.ensure(0, 0, x, y);
            pages.insert(texel_index(texture.levels(), storage, 0, 0, x, y) >> page_shape(storage).log2_texels());
        }
        EXPECT_EQ(committed_pages(texture), pages.size()) << info(format).name;
    }
}

TEST(LazyStorage, RefusesExtentsItCannotHold) {
    const auto refusal = [](const Shape& shape) -> std::string {
        try {
            Texture texture("wide.ktx2", std::make_unique<HashedSource>(Format::RGBA32Float, shape));
        } catch (const TextureError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(refusal({.width = 16385, .height = 1}), "wide.ktx2: width of 16385 texels (1 to 16384 are allowed)");
    EXPECT_EQ(refusal({.width = 1, .height = 0}), "wide.ktx2: height of 0 texels (1 to 16384 are allowed)");
    EXPECT_NE(refusal({.width = 16384, .height = 16384, .layers = 6}), "");
    EXPECT_EQ(refusal({.width = 16384, .height = 16384}), "");
}

TEST(MemorySource, RepeatsTheLastColumnAndRowOutsideTheImage) {
    std::vector<std::byte> texels;
    for (int i = 0; i < 15; ++i) texels.push_back(std::byte(i));
    const auto source = make_memory_source(Format::R8Unorm, 5, 3, texels);
    EXPECT_EQ(source->stored_bytes(), 15u);
    uint32_t block[16];
    source->decode_block(0, 0, 1, 0, reinterpret_cast<std::byte*>(block));
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) EXPECT_EQ(block[4 * j + i], uint32_t(5 * std::min(j, 2) + 4)) << i << ',' << j;
    }
}

TEST(MemorySource, FillsMissingChannelsWithBlackAndOpaque) {
    const std::vector<float> one = {0.25f};
    std::vector<std::byte> bytes(4);
    std::memcpy(bytes.data(), one.data(), 4);
    Texture real("r32", make_memory_source(Format::R32Float, 1, 1, bytes));
    EXPECT_EQ(real.texel(0, 0, 0, 0), (std::array<float, 4>{0.25f, 0, 0, 1}));
    Texture half("rg16", make_memory_source(Format::RG16Half, 1, 1, {std::byte(0), std::byte(0x38), std::byte(0), std::byte(0xBC)}));
    EXPECT_EQ(half.texel(0, 0, 0, 0), (std::array<float, 4>{0.5f, -1, 0, 1}));
    Texture code("rg8", make_memory_source(Format::RG8Snorm, 1, 1, {std::byte(0x80), std::byte(0x7F)}));
    EXPECT_EQ(code.texel(0, 0, 0, 0), (std::array<float, 4>{-1, 1, 0, 1}));
}

}  // namespace
}  // namespace rawtexel::texunit
