// Suites about data: compressed blocks, sRGB codes, random numbers, noises.
#include "cli/vectors/suite_builder.h"
#include "texunit/noise.h"
#include "texunit/noise_table.h"
#include "texunit/srgb.h"

#include <algorithm>
#include <cstring>

namespace rawtexel::cli {
namespace {

using texunit::Format;
using texunit::Shape;

constexpr int kBlockColumns = 16, kBlockRows = 16;

std::vector<std::byte> random_bytes(SuiteBuilder& builder, size_t count) {
    std::vector<std::byte> bytes(count);
    for (std::byte& byte : bytes) byte = std::byte(builder.bits() >> 24);
    return bytes;
}

/// Blocks that random ones hardly hit: equal and ordered end points, codes at the ends of their range, every mode of BC6H and BC7.
void set_corner_cases(SuiteBuilder& builder, Format format, std::vector<std::byte>& bytes) {
    const auto unit = size_t(texunit::info(format).bytes_per_block);
    const size_t blocks = size_t(kBlockColumns) * kBlockRows;
    const auto at = [&](size_t block) { return bytes.data() + unit * block; };
    const auto set16 = [&](std::byte* to, uint32_t value) { to[0] = std::byte(value), to[1] = std::byte(value >> 8); };
    const bool is_bc1 = format == Format::BC1RgbUnorm || format == Format::BC1RgbaUnorm;
    const bool is_bc3 = format == Format::BC3Unorm, is_bc2 = format == Format::BC2Unorm;
    const bool has_ramp =
        is_bc3 || format == Format::BC4Unorm || format == Format::BC4Snorm || format == Format::BC5Unorm || format == Format::BC5Snorm;
    for (size_t block = 0; block < blocks; block += 4) {
        const uint32_t a = builder.bits() >> 16, b = block % 8 == 0 ? a : 0xFFFF - a;
        if (is_bc1 || is_bc2 || is_bc3) {
            std::byte* const colours = at(block) + (is_bc1 ? 0 : 8);
            set16(colours, std::min(a, b)), set16(colours + 2, std::max(a, b));
        }
        if (has_ramp) {
            static constexpr uint8_t kEnds[][2] = {{0, 255}, {255, 0}, {128, 127}, {127, 128}, {129, 128}, {7, 7}, {128, 128}, {0, 1}};
            const auto& ends = kEnds[block / 4 % 8];
            at(block)[0] = std::byte(ends[0]), at(block)[1] = std::byte(ends[1]);
        }
    }
    if (format == Format::BC7Unorm) {
        for (size_t block = 0; block < blocks; ++block) {
            // Modes 0 to 7 in turn, and the reserved one.
            const size_t mode = block % 9;
            const auto low = uint32_t(at(block)[0]);
            at(block)[0] = std::byte(mode < 8 ? (low & ~((2u << mode) - 1)) | 1u << mode : 0);
        }
    }
    if (format == Format::BC6HUfloat || format == Format::BC6HSfloat) {
        for (size_t block = 0; block < blocks; ++block) {
            static constexpr uint32_t kCodes[] = {2, 6, 10, 14, 18, 22, 26, 30, 3, 7, 11, 15, 19, 23, 27, 31};
            const size_t mode = block % 18;
            const auto low = uint32_t(at(block)[0]);
            at(block)[0] = std::byte(mode < 2 ? (low & ~3u) | uint32_t(mode) : (low & ~31u) | kCodes[mode - 2]);
        }
    }
}

}  // namespace

uint32_t add_block_texture(SuiteBuilder& builder, Format format) {
    Shape shape{.width = 4 * kBlockColumns, .height = 4 * kBlockRows};
    shape.levels = texunit::full_level_count(shape.width, shape.height);
    size_t bytes = 0;
    for (int level = 0; level < shape.levels; ++level)
        bytes +=
            size_t(texunit::stored_bytes(format, texunit::level_extent(shape.width, level), texunit::level_extent(shape.height, level)));
    std::vector<std::byte> blocks = random_bytes(builder, bytes);
    set_corner_cases(builder, format, blocks);
    return builder.add_texture({std::string(texunit::info(format).name), format, shape, std::move(blocks)});
}

Suite make_bc_decode_suite() {
    SuiteBuilder builder("bc-decode", "texels of compressed blocks, random ones and those at the ends of their codes");
    for (const Format format :
         {Format::BC1RgbUnorm, Format::BC1RgbaUnorm, Format::BC2Unorm, Format::BC3Unorm, Format::BC4Unorm, Format::BC4Snorm,
          Format::BC5Unorm, Format::BC5Snorm, Format::BC6HUfloat, Format::BC6HSfloat, Format::BC7Unorm}) {
        const texunit::FormatInfo& known = texunit::info(format);
        builder.begin_group(std::string(known.name), "exact interpolation: " + std::string(known.description));
        const uint32_t texture = add_block_texture(builder, format);
        for (int block = 0; block < kBlockColumns * kBlockRows; ++block) {
            for (int n = 0; n < 4; ++n) {
                CaseRecord record;
                record.op = PortOp::BlockTexel;
                record.texture = texture;
                const int texel = n == 0 ? 0 : builder.below(16);
                record.index = 4 * (block % kBlockColumns) + texel % 4;
                record.extent = 4 * (block / kBlockColumns) + texel / 4;
                builder.add(record);
            }
        }
    }
    return builder.take();
}

Suite make_srgb_suite() {
    SuiteBuilder builder("srgb", "codes to linear values and back, and filtering of what was decoded");
    builder.begin_group("decode", "(c + 0.055)/1.055 to the 2.4, and c/12.92 up to 0.04045");
    for (int code = 0; code < 256; ++code) {
        CaseRecord record;
        record.op = PortOp::SrgbDecode;
        record.index = code;
        builder.add(record);
    }
    builder.begin_group("encode", "the nearest code; outside of 0 to 1 the ends, not a number is 0");
    CaseRecord encode;
    encode.op = PortOp::SrgbEncode;
    for (int code = 0; code < 256; ++code) {
        // Within the code's interval, away from its ends by a sixteenth.
        for (const double place : {-0.4375, 0.0, 0.4375}) {
            encode.at[0] = float(texunit::srgb_to_linear(std::clamp((code + place) / 255, 0.0, 1.0)));
            builder.add(encode);
        }
    }
    for (const float value : {-1.0f, -0.0f, 2.0f, std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
                              std::numeric_limits<float>::quiet_NaN()})
        encode.at[0] = value, builder.add(encode);
    Shape shape{.width = 8, .height = 8, .levels = 4};
    const uint32_t texture = builder.add_texture({"codes 8x8", Format::RGBA8Srgb, shape, random_bytes(builder, 4 * (64 + 16 + 4 + 1))});
    builder.begin_group("filter", "texels are decoded one by one, before they are weighed; alpha has no transfer function");
    builder.add_some(64, [&] {
        CaseRecord record;
        record.op = PortOp::Sample;
        record.texture = texture;
        record.mip = 2;
        record.at = {builder.between(-1, 2), builder.between(-1, 2), 0};
        builder.draw_footprint(record, builder.between(0.5f, 6), 1.5f);
        return record;
    });
    return builder.take();
}

Suite make_random_numbers_suite() {
    SuiteBuilder builder("random-numbers", "hashes of an address: pixel, sample, surface, dimension, seed");
    const auto address = [&](uint32_t most) {
        CaseRecord record;
        record.op = PortOp::Random;
        record.pixel_x = builder.bits() % most, record.pixel_y = builder.bits() % most, record.sample = builder.bits() % most;
        record.surface = builder.chance(0.5f) ? 0 : builder.bits() % most, record.dimension = uint32_t(builder.below(19));
        record.seed = builder.bits() % most;
        return record;
    };
    builder.begin_group("small addresses", "a float is the top 24 bits times 2^-24: never 1", true);
    builder.add_some(256, [&] { return address(64); });
    builder.begin_group("large addresses", "all 32 bits of every word count", true);
    builder.add_some(256, [&] { return address(0xFFFFFFFFu); });
    builder.begin_group("dimensions", "every role has numbers of its own", true);
    for (uint32_t dimension = 0; dimension < 19; ++dimension) {
        CaseRecord record;
        record.op = PortOp::Random;
        record.dimension = dimension;
        builder.add(record);
    }
    return builder.take();
}

Suite make_noise_suite() {
    SuiteBuilder builder("noise", "numbers of pairs of dimensions under every noise; words hold the masks (docs/porting.md)");
    for (const texunit::NoiseMask* mask : {&texunit::stbn_mask(), &texunit::blue_mask()}) {
        for (const auto& ranks : {mask->first, mask->second})
            builder.suite().words.insert(builder.suite().words.end(), ranks.begin(), ranks.end());
    }
    static constexpr uint32_t kPairs[][2] = {{2, 3}, {0, 1}, {12, 13}, {5, 6}, {17, 18}};
    for (const texunit::NoiseInfo& noise : texunit::all_noises()) {
        builder.begin_group(std::string(noise.name), std::string(noise.description), true);
        builder.add_some(128, [&] {
            CaseRecord record;
            record.op = PortOp::NoisePair;
            record.noise = uint32_t(noise.noise);
            const auto& pair = kPairs[builder.below(5)];
            record.dimension = pair[0], record.second_dimension = pair[1];
            record.pixel_x = builder.bits() % 2000, record.pixel_y = builder.bits() % 2000, record.sample = builder.bits() % 100;
            record.surface = builder.chance(0.7f) ? 0 : builder.bits() % 100;
            record.seed = builder.chance(0.5f) ? 0 : builder.bits();
            return record;
        });
    }
    return builder.take();
}

}  // namespace rawtexel::cli
