#include "texunit/format.h"

#include "texunit/srgb.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

namespace rawtexel::texunit {
namespace {

using enum Format;

constexpr FormatInfo texel(Format format, std::string_view name, std::string_view description, int channels, int bytes) {
    return {format, name, description, channels, 1, bytes, name.ends_with("srgb"), false};
}

constexpr FormatInfo block(Format format, std::string_view name, std::string_view description, int channels, int bytes) {
    return {format, name, description, channels, 4, bytes, name.ends_with("srgb"), true};
}

constexpr std::array<FormatInfo, kFormatCount> kFormats = {
    texel(R8Unorm, "r8-unorm", "one 8-bit channel, 0 to 1", 1, 1),
    texel(RG8Unorm, "rg8-unorm", "two 8-bit channels, 0 to 1", 2, 2),
    texel(RGBA8Unorm, "rgba8-unorm", "four 8-bit channels, 0 to 1", 4, 4),
    texel(R8Snorm, "r8-snorm", "one 8-bit channel, -1 to 1", 1, 1),
    texel(RG8Snorm, "rg8-snorm", "two 8-bit channels, -1 to 1", 2, 2),
    texel(RGBA8Snorm, "rgba8-snorm", "four 8-bit channels, -1 to 1", 4, 4),
    texel(R8Srgb, "r8-srgb", "one 8-bit channel, sRGB-encoded", 1, 1),
    texel(RG8Srgb, "rg8-srgb", "two 8-bit channels, sRGB-encoded", 2, 2),
    texel(RGBA8Srgb, "rgba8-srgb", "three 8-bit channels, sRGB-encoded, and linear alpha", 4, 4),
    texel(R16Unorm, "r16-unorm", "one 16-bit channel, 0 to 1", 1, 2),
    texel(RG16Unorm, "rg16-unorm", "two 16-bit channels, 0 to 1", 2, 4),
    texel(RGBA16Unorm, "rgba16-unorm", "four 16-bit channels, 0 to 1", 4, 8),
    texel(R16Half, "r16-half", "one half-precision channel", 1, 2),
    texel(RG16Half, "rg16-half", "two half-precision channels", 2, 4),
    texel(RGBA16Half, "rgba16-half", "four half-precision channels", 4, 8),
    texel(R32Float, "r32-float", "one single-precision channel", 1, 4),
    texel(RG32Float, "rg32-float", "two single-precision channels", 2, 8),
    texel(RGBA32Float, "rgba32-float", "four single-precision channels", 4, 16),
    block(BC1RgbUnorm, "bc1-rgb-unorm", "colour in 4 bits a texel", 3, 8),
    block(BC1RgbSrgb, "bc1-rgb-srgb", "sRGB-encoded colour in 4 bits a texel", 3, 8),
    block(BC1RgbaUnorm, "bc1-rgba-unorm", "colour with 1-bit alpha in 4 bits a texel", 4, 8),
    block(BC1RgbaSrgb, "bc1-rgba-srgb", "sRGB-encoded colour with 1-bit alpha in 4 bits a texel", 4, 8),
    block(BC2Unorm, "bc2-unorm", "colour and 4-bit alpha in 8 bits a texel", 4, 16),
    block(BC2Srgb, "bc2-srgb", "sRGB-encoded colour and 4-bit alpha in 8 bits a texel", 4, 16),
    block(BC3Unorm, "bc3-unorm", "colour and interpolated alpha in 8 bits a texel", 4, 16),
    block(BC3Srgb, "bc3-srgb", "sRGB-encoded colour and interpolated alpha in 8 bits a texel", 4, 16),
    block(BC4Unorm, "bc4-unorm", "one channel, 0 to 1, in 4 bits a texel", 1, 8),
    block(BC4Snorm, "bc4-snorm", "one channel, -1 to 1, in 4 bits a texel", 1, 8),
    block(BC5Unorm, "bc5-unorm", "two channels, 0 to 1, in 8 bits a texel", 2, 16),
    block(BC5Snorm, "bc5-snorm", "two channels, -1 to 1, in 8 bits a texel", 2, 16),
    block(BC6HUfloat, "bc6h-ufloat", "non-negative half-precision colour in 8 bits a texel", 3, 16),
    block(BC6HSfloat, "bc6h-sfloat", "signed half-precision colour in 8 bits a texel", 3, 16),
    block(BC7Unorm, "bc7-unorm", "colour and alpha in 8 bits a texel", 4, 16),
    block(BC7Srgb, "bc7-srgb", "sRGB-encoded colour and linear alpha in 8 bits a texel", 4, 16),
};

constexpr bool formats_are_in_order() {
    for (int i = 0; i < kFormatCount; ++i) {
        if (int(kFormats[size_t(i)].format) != i) return false;
    }
    return true;
}
static_assert(formats_are_in_order());

/// Linear values of the fields 0 … mask, where the field `denominator` is 1.0; fields above it, which no decoder makes, read as 1.
template <int mask, int denominator>
const float* srgb_table() {
    static const auto table = [] {
        std::array<float, mask + 1> values;
        for (int i = 0; i <= mask; ++i) values[size_t(i)] = float(srgb_to_linear(i < denominator ? double(i) / denominator : 1.0));
        return values;
    }();
    return table.data();
}

/// 1/denominator in two terms: the first so short that its product with any field of `field_bits` bits is exact.
void set_scale(TexelLayout& layout, int c, int denominator) {
    const int field_bits = std::bit_width(unsigned(denominator));
    const int kept_bits = 24 - field_bits;
    int exponent = 0;
    const double fraction = std::frexp(1.0 / denominator, &exponent);
    layout.scale_hi[c] = float(std::ldexp(std::nearbyint(std::ldexp(fraction, kept_bits)), exponent - kept_bits));
    layout.scale_lo[c] = float(1.0 / denominator - double(layout.scale_hi[c]));
    layout.denominator[c] = denominator;
}

void set_field(TexelLayout& layout, int c, int shift, uint32_t mask, int denominator) {
    layout.shift[c] = uint8_t(shift);
    layout.mask[c] = mask;
    layout.bias[c] = 0;
    set_scale(layout, c, denominator);
}

/// A layout that stores nothing: black, opaque.
TexelLayout empty_layout(StorageClass storage) {
    TexelLayout layout{};
    layout.storage = storage;
    layout.bias[3] = 1;
    return layout;
}

TexelLayout coded_layout(StorageClass storage, int channels, int bits, int denominator) {
    TexelLayout layout = empty_layout(storage);
    for (int c = 0; c < channels; ++c) set_field(layout, c, bits * c, (1u << bits) - 1, denominator);
    return layout;
}

PackedFields fields_of(const TexelLayout& layout) {
    const auto is_byte = [&](int c, const float* table) {
        return layout.mask[c] == 0xFF && layout.shift[c] == 8 * c && layout.denominator[c] == 255 && layout.table[c] == table;
    };
    const auto are_bytes = [&](const float* table) {
        return is_byte(0, table) && is_byte(1, table) && is_byte(2, table) && is_byte(3, nullptr);
    };
    if (layout.storage != StorageClass::Packed32 || layout.is_signed) return PackedFields::Any;
    return are_bytes(nullptr) ? PackedFields::Unorm8 : are_bytes(srgb8_table()) ? PackedFields::Srgb8 : PackedFields::Any;
}

TexelLayout signed_layout(TexelLayout layout) {
    layout.is_signed = true;
    return layout;
}

TexelLayout srgb8_layout(int channels) {
    TexelLayout layout = coded_layout(StorageClass::Packed32, channels, 8, 255);
    for (int c = 0; c < std::min(channels, 3); ++c) layout.table[c] = srgb8_table();
    return layout;
}

// Thirds and halves of 5-bit and of 6-bit endpoints have the common denominators 31*6 and 63*6.
TexelLayout interpolated_colour_layout(StorageClass storage, int green_shift, int blue_shift, bool srgb) {
    TexelLayout layout = empty_layout(storage);
    set_field(layout, 0, 0, 0xFF, 186);
    set_field(layout, 1, green_shift, 0x1FF, 378);
    set_field(layout, 2, blue_shift, 0xFF, 186);
    if (srgb) {
        layout.table[0] = layout.table[2] = srgb_table<0xFF, 186>();
        layout.table[1] = srgb_table<0x1FF, 378>();
    }
    return layout;
}

/// BC1 and BC2; `alpha_maximum` 0: opaque.
TexelLayout bc1_layout(bool srgb, int alpha_maximum) {
    TexelLayout layout = interpolated_colour_layout(StorageClass::Packed32, 8, 17, srgb);
    if (alpha_maximum > 0) set_field(layout, 3, 25, uint32_t(alpha_maximum), alpha_maximum);
    return layout;
}

TexelLayout bc3_layout(bool srgb) {
    TexelLayout layout = interpolated_colour_layout(StorageClass::Packed64, 16, 32, srgb);
    set_field(layout, 3, 48, 0xFFFF, 255 * 35);
    return layout;
}

/// BC1, BC2 and BC3 with colours of 8 bits.
TexelLayout rounded_layout(const FormatInfo& about, StorageClass storage) {
    if (storage == StorageClass::Packed32) return about.srgb ? srgb8_layout(about.channels) : coded_layout(storage, about.channels, 8, 255);
    TexelLayout layout = bc3_layout(false);
    for (int c = 0; c < 3; ++c) set_field(layout, c, 16 * c, 0xFF, 255);
    for (int c = 0; c < 3 && about.srgb; ++c) layout.table[c] = srgb8_table();
    return layout;
}

TexelLayout make_layout(Format format) {
    const FormatInfo& about = info(format);
    switch (format) {
        case R8Unorm:
        case RG8Unorm:
        case RGBA8Unorm:
        case BC7Unorm: return coded_layout(StorageClass::Packed32, about.channels, 8, 255);
        case R8Snorm:
        case RG8Snorm:
        case RGBA8Snorm: return signed_layout(coded_layout(StorageClass::Packed32, about.channels, 8, 127));
        case R8Srgb:
        case RG8Srgb:
        case RGBA8Srgb:
        case BC7Srgb: return srgb8_layout(about.channels);
        case R16Unorm:
        case RG16Unorm:
        case RGBA16Unorm: return coded_layout(StorageClass::Packed64, about.channels, 16, 65535);
        case R16Half:
        case RG16Half:
        case RGBA16Half:
        case BC6HUfloat:
        case BC6HSfloat: return empty_layout(StorageClass::Half4);
        case R32Float:
        case RG32Float:
        case RGBA32Float: return empty_layout(StorageClass::Float4);
        case BC1RgbUnorm:
        case BC1RgbSrgb: return bc1_layout(about.srgb, 0);
        case BC1RgbaUnorm:
        case BC1RgbaSrgb: return bc1_layout(about.srgb, 1);
        case BC2Unorm:
        case BC2Srgb: return bc1_layout(about.srgb, 15);
        case BC3Unorm:
        case BC3Srgb: return bc3_layout(about.srgb);
        case BC4Unorm:
        case BC5Unorm: return coded_layout(StorageClass::Packed64, about.channels, 16, 255 * 35);
        case BC4Snorm:
        case BC5Snorm: return signed_layout(coded_layout(StorageClass::Packed64, about.channels, 16, 127 * 35));
    }
    assert(false && "not a format");
    return {};
}

using Layouts = std::array<TexelLayout, kFormatCount>;

Layouts make_layouts() {
    Layouts layouts;
    for (const FormatInfo& about : kFormats) {
        TexelLayout& layout = layouts[size_t(about.format)];
        layout = make_layout(about.format);
        layout.fields = fields_of(layout);
    }
    return layouts;
}

/// The layouts of all roundings but Exact, which differ in what they store and not in where.
Layouts make_rounded_layouts() {
    Layouts layouts = make_layouts();
    for (const FormatInfo& about : kFormats) {
        TexelLayout& layout = layouts[size_t(about.format)];
        if (has_bc_rounding(about.format)) layout = rounded_layout(about, layout.storage);
        layout.fields = fields_of(layout);
    }
    return layouts;
}

/// Formats that differ only in the transfer function.
constexpr Format kSrgbPairs[][2] = {
    {R8Unorm, R8Srgb},           {RG8Unorm, RG8Srgb}, {RGBA8Unorm, RGBA8Srgb}, {BC1RgbUnorm, BC1RgbSrgb},
    {BC1RgbaUnorm, BC1RgbaSrgb}, {BC2Unorm, BC2Srgb}, {BC3Unorm, BC3Srgb},     {BC7Unorm, BC7Srgb},
};

}  // namespace

const FormatInfo& info(Format format) {
    assert(int(format) < kFormatCount);
    return kFormats[size_t(format)];
}

std::span<const FormatInfo> all_formats() { return kFormats; }

Format with_srgb(Format format, bool srgb) {
    for (const auto& [linear, encoded] : kSrgbPairs) {
        if (format == linear || format == encoded) return srgb ? encoded : linear;
    }
    return format;
}

uint64_t stored_bytes(Format format, int width, int height) {
    assert(width > 0 && height > 0);
    const FormatInfo& about = info(format);
    const auto blocks = [&](int extent) { return (uint64_t(extent) + uint64_t(about.block_extent) - 1) / uint64_t(about.block_extent); };
    return blocks(width) * blocks(height) * uint64_t(about.bytes_per_block);
}

const TexelLayout& layout(Format format, BcRounding rounding) {
    static const Layouts exact = make_layouts(), rounded = make_rounded_layouts();
    assert(int(format) < kFormatCount);
    return (rounding == BcRounding::Exact ? exact : rounded)[size_t(format)];
}

bool has_bc_rounding(Format format) { return format >= BC1RgbUnorm && format <= BC3Srgb; }

}  // namespace rawtexel::texunit
