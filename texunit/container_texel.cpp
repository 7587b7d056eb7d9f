#include "texunit/container_texel.h"

#include "texunit/half.h"
#include "texunit/little_endian.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

namespace rawtexel::texunit {
namespace {

template <class T>
void store(std::byte* out, int i, T value) {
    std::memcpy(out + size_t(i) * sizeof(T), &value, sizeof(T));
}

/// n * to / from, rounded to nearest.
constexpr uint32_t rescale(uint32_t n, uint32_t from, uint32_t to) { return uint32_t((uint64_t{n} * to + from / 2) / from); }

uint32_t load_word(const std::byte* in, int bytes) {
    uint32_t word = 0;
    std::memcpy(&word, in, size_t(bytes));
    return word;
}

template <class Code>
void expand_fields(const FileTexel& texel, const std::byte* in, std::byte* out) {
    constexpr uint32_t maximum = Code(~Code{0});
    const uint32_t word = load_word(in, texel.file_bytes);
    for (int c = 0; c < info(texel.format).channels; ++c) {
        const uint32_t mask = texel.mask[size_t(c)];
        uint32_t code = c == 3 ? maximum : 0;
        if (mask != 0) code = rescale((word & mask) >> std::countr_zero(mask), mask >> std::countr_zero(mask), maximum);
        store(out, c, Code(code));
    }
}

/// -32768 means -1, as -32767 does.
void expand_snorm16(const FileTexel& texel, const std::byte* in, std::byte* out) {
    const int stored = texel.file_bytes / 2;
    for (int c = 0; c < info(texel.format).channels; ++c) {
        const float value = c < stored ? float(std::max(load<int16_t>(in + 2 * c) / 32767.0, -1.0)) : c == 3 ? 1.0f : 0.0f;
        store(out, c, value);
    }
}

template <class T>
void expand_three(std::byte* out, const std::byte* in, T one) {
    std::memcpy(out, in, 3 * sizeof(T));
    store(out, 3, one);
}

void expand_three_unorm8(const FileTexel&, const std::byte* in, std::byte* out) { expand_three<uint8_t>(out, in, 0xFF); }
void expand_three_snorm8(const FileTexel&, const std::byte* in, std::byte* out) { expand_three<uint8_t>(out, in, 0x7F); }
void expand_three_unorm16(const FileTexel&, const std::byte* in, std::byte* out) { expand_three<uint16_t>(out, in, 0xFFFF); }
void expand_three_half(const FileTexel&, const std::byte* in, std::byte* out) { expand_three<uint16_t>(out, in, 0x3C00); }
void expand_three_float(const FileTexel&, const std::byte* in, std::byte* out) { expand_three<float>(out, in, 1.0f); }

/// The small floats have a half's exponent and fewer mantissa bits, so they are halves with the low bits missing.
void expand_r11g11b10(const FileTexel&, const std::byte* in, std::byte* out) {
    const uint32_t word = load<uint32_t>(in);
    store(out, 0, uint16_t((word & 0x7FF) << 4));
    store(out, 1, uint16_t(((word >> 11) & 0x7FF) << 4));
    store(out, 2, uint16_t((word >> 22) << 5));
    store(out, 3, uint16_t(0x3C00));
}

/// mantissa * 2^(exponent - 15 - 9): at most nine significant bits from 2^-24 up to 65408, all of them halves.
void expand_rgb9e5(const FileTexel&, const std::byte* in, std::byte* out) {
    const uint32_t word = load<uint32_t>(in);
    const float scale = std::bit_cast<float>(((word >> 27) + 127 - 24) << 23);
    for (int c = 0; c < 3; ++c) store(out, c, float_to_half(float((word >> (9 * c)) & 0x1FF) * scale));
    store(out, 3, uint16_t(0x3C00));
}

template <BcRounding rounding>
void decode_rxgb(const std::byte* block, std::byte* texels) {
    decode_block(Format::BC3Unorm, block, texels, rounding);
    const TexelLayout& from = layout(Format::BC3Unorm, rounding);
    for (int i = 0; i < 16; ++i) {
        const auto word = load<uint64_t>(texels + 8 * i);
        const auto code = [&](int c) {
            return uint64_t{rescale(uint32_t(word >> from.shift[c]) & from.mask[c], uint32_t(from.denominator[c]), 0xFFFF)};
        };
        store(texels, i, code(3) | (code(1) << 16) | (code(2) << 32) | (uint64_t{0xFFFF} << 48));
    }
}

BlockDecoder rxgb_decoder(BcRounding rounding) {
    switch (rounding) {
        case BcRounding::Ideal8: return decode_rxgb<BcRounding::Ideal8>;
        case BcRounding::Nvidia: return decode_rxgb<BcRounding::Nvidia>;
        case BcRounding::Amd: return decode_rxgb<BcRounding::Amd>;
        default: return decode_rxgb<BcRounding::Exact>;
    }
}

/// Whether codes of `bits` bits are 8-bit codes exactly: 255 is a multiple of 2^bits - 1.
constexpr bool fits_8_bits(int bits) { return bits == 0 || bits == 1 || bits == 2 || bits == 4 || bits == 8; }

bool contiguous(uint32_t mask) { return mask == 0 || std::has_single_bit((mask >> std::countr_zero(mask)) + uint64_t{1}); }

}  // namespace

FileTexel plain_texel(Format format) {
    const FormatInfo& about = info(format);
    return {.format = format, .extent = about.block_extent, .file_bytes = about.bytes_per_block, .decode = block_decoder(format)};
}

bool valid_field_masks(const std::array<uint32_t, 4>& mask, int file_bytes) {
    uint32_t all = 0;
    for (const uint32_t m : mask) {
        if (!contiguous(m) || std::popcount(m) > 16) return false;
        all |= m;
    }
    return file_bytes >= 1 && file_bytes <= 4 && all != 0 && (uint64_t{all} >> (8 * file_bytes)) == 0;
}

FileTexel field_texel(const std::array<uint32_t, 4>& mask, int file_bytes) {
    assert(valid_field_masks(mask, file_bytes));
    const bool short_codes = std::ranges::all_of(mask, [](uint32_t m) { return fits_8_bits(std::popcount(m)); });
    const int channels = mask[3] != 0 || mask[2] != 0 ? 4 : mask[1] != 0 ? 2 : 1;
    FileTexel texel{.file_bytes = file_bytes, .mask = mask};
    texel.expand = short_codes ? expand_fields<uint8_t> : expand_fields<uint16_t>;
    if (channels == 4) texel.format = short_codes ? Format::RGBA8Unorm : Format::RGBA16Unorm;
    if (channels == 2) texel.format = short_codes ? Format::RG8Unorm : Format::RG16Unorm;
    if (channels == 1) texel.format = short_codes ? Format::R8Unorm : Format::R16Unorm;
    return texel;
}

FileTexel srgb_texel(FileTexel texel) {
    texel.format = with_srgb(texel.format, true);
    return texel;
}

FileTexel rounded_texel(FileTexel texel, BcRounding rounding) {
    if (has_bc_rounding(texel.format)) {
        texel.decode = block_decoder(texel.format, rounding);
        texel.rounding = rounding;
    } else if (texel.decode == rxgb_decoder(BcRounding::Exact)) {
        texel.decode = rxgb_decoder(rounding);
    }
    return texel;
}

FileTexel snorm16_texel(int channels) {
    assert(channels >= 1 && channels <= 4);
    const Format format = channels == 1 ? Format::R32Float : channels == 2 ? Format::RG32Float : Format::RGBA32Float;
    return {.format = format, .file_bytes = 2 * channels, .expand = expand_snorm16};
}

FileTexel three_channel_texel(Format format_with_alpha) {
    FileTexel texel{.format = format_with_alpha, .file_bytes = info(format_with_alpha).bytes_per_block / 4 * 3};
    switch (format_with_alpha) {
        case Format::RGBA8Unorm:
        case Format::RGBA8Srgb: texel.expand = expand_three_unorm8; break;
        case Format::RGBA8Snorm: texel.expand = expand_three_snorm8; break;
        case Format::RGBA16Unorm: texel.expand = expand_three_unorm16; break;
        case Format::RGBA16Half: texel.expand = expand_three_half; break;
        case Format::RGBA32Float: texel.expand = expand_three_float; break;
        default: assert(false && "not a four-channel format of plain texels");
    }
    return texel;
}

FileTexel r11g11b10_float_texel() { return {.format = Format::RGBA16Half, .file_bytes = 4, .expand = expand_r11g11b10}; }

FileTexel rgb9e5_texel() { return {.format = Format::RGBA16Half, .file_bytes = 4, .expand = expand_rgb9e5}; }

FileTexel rxgb_block() { return {.format = Format::RGBA16Unorm, .extent = 4, .file_bytes = 16, .decode = rxgb_decoder(BcRounding::Exact)}; }

}  // namespace rawtexel::texunit
