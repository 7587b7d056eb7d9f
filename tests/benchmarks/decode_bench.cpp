// Pixels per second of decoding, one thread. `decode`: 32 Ki texels from blocks or rows in L1 or L2 into a buffer that stays in L2.
// `ensure`: all of a texture of 512x512 that nobody has looked at yet, with the memory that the system commits for it.
#include "texunit/block_codec.h"
#include "texunit/containers.h"
#include "texunit/memory_source.h"
#include "texunit/texture.h"

#include <benchmark/benchmark.h>

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace rawtexel::texunit;

constexpr size_t kBlocks = 2048;  // at most 32 KiB of blocks and 256 KiB of texels

using Blocks = std::vector<std::byte>;

Blocks random_blocks(int bytes_per_block) {
    std::mt19937_64 random(1);
    Blocks blocks(kBlocks * size_t(bytes_per_block));
    for (std::byte& byte : blocks) byte = std::byte(random());
    return blocks;
}

void set_bc7_mode(std::byte* block, int mode) { block[0] = (block[0] & ~std::byte((2 << mode) - 1)) | std::byte(1 << mode); }

/// Modes drawn in runs of `mean_run` blocks with these weights: neighbours in a picture have much the same mode.
Blocks bc7_blocks(const std::array<double, 8>& weights, double mean_run) {
    std::mt19937_64 random(2);
    std::discrete_distribution<int> draw(weights.begin(), weights.end());
    std::bernoulli_distribution ends(1 / mean_run);
    Blocks blocks = random_blocks(16);
    int mode = draw(random);
    for (size_t i = 0; i < kBlocks; ++i) {
        if (ends(random)) mode = draw(random);
        set_bc7_mode(blocks.data() + 16 * i, mode);
    }
    return blocks;
}

/// Every mode as likely as any other: each block's mode is news to the branch predictor.
Blocks bc7_of_random_modes() { return bc7_blocks({1, 1, 1, 1, 1, 1, 1, 1}, 1); }

/// The modes that encoders choose for photographs, opaque or with alpha, in runs of three blocks.
Blocks bc7_of_an_opaque_photo() { return bc7_blocks({2, 30, 4, 14, 2, 8, 40, 0}, 3); }
Blocks bc7_of_a_photo_with_alpha() { return bc7_blocks({0, 1, 0, 1, 50, 14, 24, 10}, 3); }

/// Modes 0 to 13 of BC6H at random.
Blocks bc6h_blocks() {
    static constexpr std::array<int, 14> kCodes = {0, 1, 2, 6, 10, 14, 18, 22, 26, 30, 3, 7, 11, 15};
    std::mt19937_64 random(3);
    Blocks blocks = random_blocks(16);
    for (size_t i = 0; i < kBlocks; ++i) {
        const int code = kCodes[random() % kCodes.size()];
        std::byte& first = blocks[16 * i];
        first = (first & ~std::byte(code < 2 ? 3 : 31)) | std::byte(code);
    }
    return blocks;
}

void report(benchmark::State& state, size_t blocks) {
    state.counters["Mpixel/s"] = benchmark::Counter(double(state.iterations()) * double(blocks) * 16 / 1e6, benchmark::Counter::kIsRate);
}

/// Room for kBlocks decoded blocks, aligned as a texture's blocks lie.
class DecodedBlocks {
  public:
    explicit DecodedBlocks(size_t block_bytes) : bytes_(kBlocks * block_bytes + 64), block_bytes_(block_bytes) {}
    std::byte* block(size_t i) { return bytes_.data() + (64 - uintptr_t(bytes_.data()) % 64) + i * block_bytes_; }

  private:
    std::vector<std::byte> bytes_;
    size_t block_bytes_;
};

void decode(benchmark::State& state, Format format, BcRounding rounding, const Blocks& blocks) {
    const auto block_bytes = size_t(info(format).bytes_per_block);
    DecodedBlocks texels(16 * size_t(bytes_per_texel(layout(format, rounding).storage)));
    const BlockDecoder decoder = block_decoder(format, rounding);
    for (auto _ : state) {
        for (size_t i = 0; i < kBlocks; ++i) decoder(blocks.data() + i * block_bytes, texels.block(i));
        benchmark::ClobberMemory();
    }
    report(state, kBlocks);
}

void add(const std::string& name, Format format, const Blocks& blocks, BcRounding rounding = BcRounding::Exact) {
    benchmark::RegisterBenchmark(("decode/" + name).c_str(), [=](benchmark::State& state) { decode(state, format, rounding, blocks); });
}

/// Rows of an uncompressed format, whose texels any bytes are.
std::unique_ptr<TexelSource> random_rows(Format format, int width, int height) {
    const size_t texels = size_t(width) * size_t(height), bytes = texels * size_t(info(format).bytes_per_block);
    Blocks rows = random_blocks(int((bytes + kBlocks - 1) / kBlocks));
    rows.resize(bytes);
    return make_memory_source(format, width, height, std::move(rows));
}

void convert(benchmark::State& state, Format format) {
    constexpr int kColumns = 128, kRows = 16;
    static_assert(kColumns * kRows == kBlocks);
    const std::unique_ptr<TexelSource> source = random_rows(format, 4 * kColumns, 4 * kRows);
    DecodedBlocks texels(16 * size_t(bytes_per_texel(layout(format).storage)));
    for (auto _ : state) {
        for (size_t i = 0; i < kBlocks; ++i) source->decode_block(0, 0, int(i) % kColumns, int(i) / kColumns, texels.block(i));
        benchmark::ClobberMemory();
    }
    report(state, kBlocks);
}

/// The same blocks again and again, as a texture.
class RepeatedBlocks final : public TexelSource {
  public:
    RepeatedBlocks(Format format, int extent, const Blocks& blocks)
        : format_(format), extent_(extent), blocks_(blocks), decoder_(block_decoder(format)) {}
    Format format() const override { return format_; }
    Shape shape() const override { return {.width = extent_, .height = extent_}; }
    uint64_t stored_bytes() const override { return rawtexel::texunit::stored_bytes(format_, extent_, extent_); }
    void decode_block(int, int, int block_x, int block_y, std::byte* texels) override {
        const size_t block = size_t(block_y * extent_ / 4 + block_x) % kBlocks;
        decoder_(blocks_.data() + block * size_t(info(format_).bytes_per_block), texels);
    }

  private:
    Format format_;
    int extent_;
    const Blocks& blocks_;
    BlockDecoder decoder_;
};

void ensure(benchmark::State& state, Format format) {
    constexpr int kExtent = 512;
    const FormatInfo& about = info(format);
    const Blocks blocks = about.block_compressed ? random_blocks(about.bytes_per_block) : Blocks{};
    for (auto _ : state) {
        state.PauseTiming();
        std::unique_ptr<TexelSource> source;
        if (about.block_compressed) {
            source = std::make_unique<RepeatedBlocks>(format, kExtent, blocks);
        } else {
            source = random_rows(format, kExtent, kExtent);
        }
        auto texture = std::make_unique<Texture>("bench", std::move(source));
        state.ResumeTiming();
        for (int y = 0; y < kExtent; y += 4) {
            for (int x = 0; x < kExtent; x += 4) texture->ensure(0, 0, x, y);
        }
        state.PauseTiming();
        texture.reset();
        state.ResumeTiming();
    }
    report(state, size_t(kExtent) * kExtent / 16);
}

[[maybe_unused]] const bool added = [] {
    for (const FormatInfo& about : all_formats()) {
        if (about.srgb) continue;  // decoded as linear is
        const std::string name(about.name);
        benchmark::RegisterBenchmark(("ensure/" + name).c_str(), [=](benchmark::State& state) { ensure(state, about.format); });
        if (!about.block_compressed)
            benchmark::RegisterBenchmark(("decode/" + name).c_str(), [=](benchmark::State& state) { convert(state, about.format); });
    }
    for (const Format format : {Format::BC1RgbUnorm, Format::BC2Unorm, Format::BC3Unorm}) {
        for (const BcRounding rounding : kBcRoundings) {
            if (rounding == BcRounding::Exact) continue;
            const FormatInfo& about = info(format);
            add(std::string(about.name) + "/" + std::string(to_string(rounding)), format, random_blocks(about.bytes_per_block), rounding);
        }
    }
    for (const FormatInfo& about : all_formats()) {
        if (!about.block_compressed || about.srgb) continue;
        const bool bc6h = about.format == Format::BC6HUfloat || about.format == Format::BC6HSfloat;
        if (about.format == Format::BC7Unorm) continue;
        add(std::string(about.name), about.format, bc6h ? bc6h_blocks() : random_blocks(about.bytes_per_block));
    }
    add("bc7-unorm/random modes", Format::BC7Unorm, bc7_of_random_modes());
    add("bc7-unorm/opaque photo", Format::BC7Unorm, bc7_of_an_opaque_photo());
    add("bc7-unorm/photo with alpha", Format::BC7Unorm, bc7_of_a_photo_with_alpha());
    for (int mode = 0; mode < 8; ++mode) {
        std::array<double, 8> one{};
        one[size_t(mode)] = 1;
        add("bc7-unorm/mode " + std::to_string(mode), Format::BC7Unorm, bc7_blocks(one, 1));
    }
    return true;
}();

}  // namespace
