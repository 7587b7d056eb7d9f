// Pixels per second of block decoding, one thread: 32 Ki texels from blocks in L1 or L2 into a buffer that stays in L2.
#include "texunit/block_codec.h"
#include "texunit/containers.h"

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

void decode(benchmark::State& state, Format format, const Blocks& blocks) {
    const size_t block_bytes = size_t(info(format).bytes_per_block), texel_bytes = 16 * size_t(bytes_per_texel(layout(format).storage));
    std::vector<std::byte> texels(kBlocks * texel_bytes + 64);
    std::byte* const out = texels.data() + (64 - uintptr_t(texels.data()) % 64);  // as a texture's blocks lie
    const BlockDecoder decoder = block_decoder(format);
    for (auto _ : state) {
        for (size_t i = 0; i < kBlocks; ++i) decoder(blocks.data() + i * block_bytes, out + i * texel_bytes);
        benchmark::ClobberMemory();
    }
    state.counters["Mpixel/s"] = benchmark::Counter(double(state.iterations()) * double(kBlocks) * 16 / 1e6, benchmark::Counter::kIsRate);
}

void add(const std::string& name, Format format, const Blocks& blocks) {
    benchmark::RegisterBenchmark(("decode/" + name).c_str(), [=](benchmark::State& state) { decode(state, format, blocks); });
}

[[maybe_unused]] const bool added = [] {
    for (const FormatInfo& about : all_formats()) {
        if (!about.block_compressed || about.srgb) continue;  // sRGB is decoded as linear is
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
