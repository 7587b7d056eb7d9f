#include "tests/reference/texunit/texture_file.h"

#include "tests/reference/texunit/bc_bc1_to_5.h"
#include "tests/reference/texunit/bc_bc6h.h"
#include "tests/reference/texunit/bc_bc7.h"

#include <cmath>
#include <cstring>
#include <utility>

#include <zstd.h>

namespace rawtexel::reference {
namespace {

double half_value(int half) {
    const int exponent = half >> 10 & 31, mantissa = half & 1023;
    const double magnitude = exponent == 31  ? (mantissa ? NAN : INFINITY)
                             : exponent == 0 ? std::ldexp(mantissa, -24)
                                             : std::ldexp(1024 + mantissa, exponent - 25);
    return half & 0x8000 ? -magnitude : magnitude;
}

double to_linear(double encoded) { return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4); }

/// A field of a word as a share of its largest code.
double field(uint32_t word, uint32_t mask) {
    int shift = 0;
    while (!(mask >> shift & 1)) ++shift;
    return double((word & mask) >> shift) / double(mask >> shift);
}

using Rgba = std::array<double, 4>;

Rgba colour(const std::byte* block, ColourRule rule, int texel) {
    Rgba value;
    for (int c = 0; c < 4; ++c) value[size_t(c)] = evaluate_colour(block, rule, c, texel).value();
    return value;
}

Rgba bc6h(const Block16& block, bool is_signed, int texel) {
    const auto halves = evaluate_bc6h(take_apart_bc6h(block), is_signed)[size_t(texel)];
    return {half_value(halves[0]), half_value(halves[1]), half_value(halves[2]), 1};
}

Rgba bc7(const Block16& block, int texel) {
    const auto codes = evaluate_bc7(take_apart_bc7(block))[size_t(texel)];
    return {codes[0] / 255.0, codes[1] / 255.0, codes[2] / 255.0, codes[3] / 255.0};
}

}  // namespace

TextureFile::TextureFile(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {
    if (word(0) == 0x20534444)
        read_dds();
    else
        read_ktx2();
}

uint32_t TextureFile::word(size_t at) const {
    uint32_t value;
    std::memcpy(&value, bytes_.data() + at, 4);
    return value;
}

size_t TextureFile::level_bytes(int level) const {
    const auto units = [&](int extent) { return size_t((extent + unit_extent_ - 1) / unit_extent_); };
    return units(width(level)) * units(height(level)) * size_t(unit_bytes_);
}

void TextureFile::set_masks(int unit_bytes, const std::array<uint32_t, 4>& mask) {
    kind_ = Kind::Masks;
    unit_bytes_ = unit_bytes;
    mask_ = mask;
}

void TextureFile::set_dxgi(uint32_t format) {
    switch (format) {
        case 24: return set_masks(4, {0x3FF, 0xFFC00, 0x3FF00000, 0xC0000000});
        case 29: srgb_ = true; return set_masks(4, {0xFF, 0xFF00, 0xFF0000, 0xFF000000});
        case 56: return set_masks(2, {0xFFFF, 0, 0, 0});
        case 91: srgb_ = true; return set_masks(4, {0xFF0000, 0xFF00, 0xFF, 0xFF000000});
        case 93: srgb_ = true; return set_masks(4, {0xFF0000, 0xFF00, 0xFF, 0});
        case 72: kind_ = Kind::Bc1Rgba, srgb_ = true; break;
        case 75: kind_ = Kind::Bc2, srgb_ = true; break;
        case 78: kind_ = Kind::Bc3, srgb_ = true; break;
        case 80: kind_ = Kind::Bc4; break;
        case 83: kind_ = Kind::Bc5; break;
        case 95: kind_ = Kind::Bc6hUfloat; break;
        case 96: kind_ = Kind::Bc6hSfloat; break;
        case 98: kind_ = Kind::Bc7; break;
        case 99: kind_ = Kind::Bc7, srgb_ = true; break;
        default: return;
    }
    unit_extent_ = 4;
    unit_bytes_ = kind_ == Kind::Bc1Rgba || kind_ == Kind::Bc4 ? 8 : 16;
}

/// Layer after layer, each with all its levels.
void TextureFile::read_dds() {
    height_ = int(word(12)), width_ = int(word(16)), levels_ = std::max(1, int(word(28)));
    layers_ = word(112) & 0x200 ? 6 : 1;
    size_t at = 128;
    const uint32_t flags = word(80), code = word(84);
    const auto is = [&](const char* text) { return std::memcmp(&code, text, 4) == 0; };
    if (!(flags & 4)) {
        const bool luminance = flags & 0x20000;
        const uint32_t alpha = flags & 3 ? word(104) : 0;
        set_masks(int(word(88)) / 8, {word(92), word(luminance ? 92 : 96), word(luminance ? 92 : 100), alpha});
    } else if (is("DX10")) {
        set_dxgi(word(128));
        at = 148;
    } else {
        constexpr std::pair<const char*, Kind> kCodes[] = {{"DXT1", Kind::Bc1Rgba}, {"DXT3", Kind::Bc2}, {"DXT5", Kind::Bc3},
                                                           {"RXGB", Kind::Rxgb},    {"ATI1", Kind::Bc4}, {"ATI2", Kind::Bc5}};
        for (const auto& [text, kind] : kCodes) {
            if (is(text)) kind_ = kind;
        }
        unit_extent_ = 4;
        unit_bytes_ = is("DXT1") || is("ATI1") ? 8 : 16;
    }
    level_data_.resize(size_t(levels_));
    for (int layer = 0; known() && layer < layers_; ++layer) {
        for (int level = 0; level < levels_; ++level) {
            auto& data = level_data_[size_t(level)];
            data.insert(data.end(), bytes_.begin() + std::ptrdiff_t(at), bytes_.begin() + std::ptrdiff_t(at + level_bytes(level)));
            at += level_bytes(level);
        }
    }
}

/// Level after level, each with all its layers, perhaps compressed.
void TextureFile::read_ktx2() {
    width_ = int(word(20)), height_ = int(word(24)), levels_ = int(word(40));
    layers_ = std::max(1, int(word(32))) * int(word(36));
    switch (word(12)) {
        case 43: srgb_ = true, set_masks(4, {0xFF, 0xFF00, 0xFF0000, 0xFF000000}); break;
        case 97: kind_ = Kind::Half4, unit_bytes_ = 8; break;
        case 109: kind_ = Kind::Float4, unit_bytes_ = 16; break;
        case 132: kind_ = Kind::Bc1Rgb, srgb_ = true, unit_extent_ = 4, unit_bytes_ = 8; break;
        case 146: kind_ = Kind::Bc7, srgb_ = true, unit_extent_ = 4, unit_bytes_ = 16; break;
        default: break;
    }
    for (int level = 0; known() && level < levels_; ++level) {
        const size_t entry = 80 + 24 * size_t(level);
        const std::byte* const from = bytes_.data() + word(entry);
        std::vector<std::byte> data(from, from + word(entry + 8));
        if (word(44) == 2) {
            std::vector<std::byte> inflated(level_bytes(level) * size_t(layers_));
            ZSTD_decompress(inflated.data(), inflated.size(), data.data(), data.size());
            data = std::move(inflated);
        }
        level_data_.push_back(std::move(data));
    }
}

const std::byte* TextureFile::unit(int level, int layer, int x, int y) const {
    const int across = (width(level) + unit_extent_ - 1) / unit_extent_;
    const auto index = size_t((y / unit_extent_) * across + x / unit_extent_);
    return level_data_[size_t(level)].data() + size_t(layer) * level_bytes(level) + index * size_t(unit_bytes_);
}

std::array<double, 4> TextureFile::encoded(int level, int layer, int x, int y) const {
    const std::byte* const at = unit(level, layer, x, y);
    const int texel = 4 * (y % 4) + x % 4;
    Block16 block{};
    std::memcpy(block.data(), at, size_t(std::min(unit_bytes_, 16)));
    switch (kind_) {
        case Kind::Bc1Rgb: {
            Rgba value = colour(at, ColourRule::Bc1, texel);
            value[3] = 1;
            return value;
        }
        case Kind::Bc1Rgba: return colour(at, ColourRule::Bc1, texel);
        case Kind::Bc2:
        case Kind::Bc3:
        case Kind::Rxgb: {
            Rgba value = colour(at + 8, ColourRule::AlwaysFourColours, texel);
            value[3] = (kind_ == Kind::Bc2 ? evaluate_explicit_alpha(at, texel) : evaluate_unsigned_value(at, texel)).value();
            if (kind_ == Kind::Rxgb) value[0] = std::exchange(value[3], 1);
            return value;
        }
        case Kind::Bc4: return {evaluate_unsigned_value(at, texel).value(), 0, 0, 1};
        case Kind::Bc5: return {evaluate_unsigned_value(at, texel).value(), evaluate_unsigned_value(at + 8, texel).value(), 0, 1};
        case Kind::Bc6hUfloat: return bc6h(block, false, texel);
        case Kind::Bc6hSfloat: return bc6h(block, true, texel);
        case Kind::Bc7: return bc7(block, texel);
        case Kind::Masks: {
            uint32_t bits = 0;
            std::memcpy(&bits, at, size_t(unit_bytes_));
            Rgba value{0, 0, 0, 1};
            for (size_t c = 0; c < 4; ++c) {
                if (mask_[c] != 0) value[c] = field(bits, mask_[c]);
            }
            return value;
        }
        case Kind::Half4: {
            uint16_t halves[4];
            std::memcpy(halves, at, 8);
            return {half_value(halves[0]), half_value(halves[1]), half_value(halves[2]), half_value(halves[3])};
        }
        default: {
            float values[4];
            std::memcpy(values, at, 16);
            return {values[0], values[1], values[2], values[3]};
        }
    }
}

std::array<double, 4> TextureFile::value(int level, int layer, int x, int y) const {
    Rgba value = encoded(level, layer, x, y);
    for (size_t c = 0; srgb_ && c < 3; ++c) value[c] = to_linear(value[c]);
    return value;
}

}  // namespace rawtexel::reference
