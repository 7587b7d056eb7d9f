#include "texunit/container_format_codes.h"

#include <array>
#include <string_view>

namespace rawtexel::texunit {
namespace {

using enum Format;

// Masks of red, green, blue, alpha in a little-endian word.
constexpr std::array<uint32_t, 4> kBgra8 = {0x00FF0000, 0x0000FF00, 0x000000FF, 0xFF000000};
constexpr std::array<uint32_t, 4> kBgrx8 = {0x00FF0000, 0x0000FF00, 0x000000FF, 0};
constexpr std::array<uint32_t, 4> kRgb10a2 = {0x000003FF, 0x000FFC00, 0x3FF00000, 0xC0000000};
constexpr std::array<uint32_t, 4> kBgr10a2 = {0x3FF00000, 0x000FFC00, 0x000003FF, 0xC0000000};
constexpr std::array<uint32_t, 4> kR5g6b5 = {0xF800, 0x07E0, 0x001F, 0};
constexpr std::array<uint32_t, 4> kB5g6r5 = {0x001F, 0x07E0, 0xF800, 0};
constexpr std::array<uint32_t, 4> kA1r5g5b5 = {0x7C00, 0x03E0, 0x001F, 0x8000};
constexpr std::array<uint32_t, 4> kR5g5b5a1 = {0xF800, 0x07C0, 0x003E, 0x0001};
constexpr std::array<uint32_t, 4> kB5g5r5a1 = {0x003E, 0x07C0, 0xF800, 0x0001};
constexpr std::array<uint32_t, 4> kA4r4g4b4 = {0x0F00, 0x00F0, 0x000F, 0xF000};
constexpr std::array<uint32_t, 4> kR4g4b4a4 = {0xF000, 0x0F00, 0x00F0, 0x000F};
constexpr std::array<uint32_t, 4> kB4g4r4a4 = {0x00F0, 0x0F00, 0xF000, 0x000F};

struct Named {
    uint32_t code;
    std::string_view name;
};

constexpr Named kDxgiTypeless[] = {
    {1, "R32G32B32A32_TYPELESS"}, {5, "R32G32B32_TYPELESS"},    {9, "R16G16B16A16_TYPELESS"}, {15, "R32G32_TYPELESS"},
    {19, "R32G8X24_TYPELESS"},    {23, "R10G10B10A2_TYPELESS"}, {27, "R8G8B8A8_TYPELESS"},    {33, "R16G16_TYPELESS"},
    {39, "R32_TYPELESS"},         {44, "R24G8_TYPELESS"},       {48, "R8G8_TYPELESS"},        {53, "R16_TYPELESS"},
    {60, "R8_TYPELESS"},          {70, "BC1_TYPELESS"},         {73, "BC2_TYPELESS"},         {76, "BC3_TYPELESS"},
    {79, "BC4_TYPELESS"},         {82, "BC5_TYPELESS"},         {90, "B8G8R8A8_TYPELESS"},    {92, "B8G8R8X8_TYPELESS"},
    {94, "BC6H_TYPELESS"},        {97, "BC7_TYPELESS"},
};

struct NamedRange {
    uint32_t first, last;
    std::string_view name;
};

constexpr NamedRange kVulkanUnsupported[] = {
    {0, 0, "VK_FORMAT_UNDEFINED: Basis Universal or another format that needs transcoding"},
    {124, 130, "depth or stencil"},
    {147, 156, "ETC2 or EAC"},
    {157, 184, "ASTC"},
    {1000054000, 1000054007, "PVRTC"},
    {1000066000, 1000066013, "ASTC HDR"},
};

}  // namespace

std::optional<FileTexel> dxgi_texel(uint32_t dxgi_format) {
    switch (dxgi_format) {
        case 2: return plain_texel(RGBA32Float);
        case 6: return three_channel_texel(RGBA32Float);
        case 10: return plain_texel(RGBA16Half);
        case 11: return plain_texel(RGBA16Unorm);
        case 13: return snorm16_texel(4);
        case 16: return plain_texel(RG32Float);
        case 24: return field_texel(kRgb10a2, 4);
        case 26: return r11g11b10_float_texel();
        case 28: return plain_texel(RGBA8Unorm);
        case 29: return plain_texel(RGBA8Srgb);
        case 31: return plain_texel(RGBA8Snorm);
        case 34: return plain_texel(RG16Half);
        case 35: return plain_texel(RG16Unorm);
        case 37: return snorm16_texel(2);
        case 41: return plain_texel(R32Float);
        case 49: return plain_texel(RG8Unorm);
        case 51: return plain_texel(RG8Snorm);
        case 54: return plain_texel(R16Half);
        case 56: return plain_texel(R16Unorm);
        case 58: return snorm16_texel(1);
        case 61: return plain_texel(R8Unorm);
        case 63: return plain_texel(R8Snorm);
        case 65: return field_texel({0, 0, 0, 0xFF}, 1);
        case 67: return rgb9e5_texel();
        case 71: return plain_texel(BC1RgbaUnorm);
        case 72: return plain_texel(BC1RgbaSrgb);
        case 74: return plain_texel(BC2Unorm);
        case 75: return plain_texel(BC2Srgb);
        case 77: return plain_texel(BC3Unorm);
        case 78: return plain_texel(BC3Srgb);
        case 80: return plain_texel(BC4Unorm);
        case 81: return plain_texel(BC4Snorm);
        case 83: return plain_texel(BC5Unorm);
        case 84: return plain_texel(BC5Snorm);
        case 85: return field_texel(kR5g6b5, 2);
        case 86: return field_texel(kA1r5g5b5, 2);
        case 87: return field_texel(kBgra8, 4);
        case 88: return field_texel(kBgrx8, 4);
        case 91: return srgb_texel(field_texel(kBgra8, 4));
        case 93: return srgb_texel(field_texel(kBgrx8, 4));
        case 95: return plain_texel(BC6HUfloat);
        case 96: return plain_texel(BC6HSfloat);
        case 98: return plain_texel(BC7Unorm);
        case 99: return plain_texel(BC7Srgb);
        case 115: return field_texel(kA4r4g4b4, 2);
        default: return std::nullopt;
    }
}

std::optional<FileTexel> vulkan_texel(uint32_t vk_format) {
    switch (vk_format) {
        case 1: return field_texel({0xF0, 0x0F, 0, 0}, 1);
        case 2: return field_texel(kR4g4b4a4, 2);
        case 3: return field_texel(kB4g4r4a4, 2);
        case 4: return field_texel(kR5g6b5, 2);
        case 5: return field_texel(kB5g6r5, 2);
        case 6: return field_texel(kR5g5b5a1, 2);
        case 7: return field_texel(kB5g5r5a1, 2);
        case 8: return field_texel(kA1r5g5b5, 2);
        case 9: return plain_texel(R8Unorm);
        case 10: return plain_texel(R8Snorm);
        case 15: return plain_texel(R8Srgb);
        case 16: return plain_texel(RG8Unorm);
        case 17: return plain_texel(RG8Snorm);
        case 22: return plain_texel(RG8Srgb);
        case 23: return three_channel_texel(RGBA8Unorm);
        case 24: return three_channel_texel(RGBA8Snorm);
        case 29: return three_channel_texel(RGBA8Srgb);
        case 30: return field_texel(kBgrx8, 3);
        case 36: return srgb_texel(field_texel(kBgrx8, 3));
        case 37:
        case 51: return plain_texel(RGBA8Unorm);  // 51 to 57 are the same bytes, as words of 32 bits
        case 38:
        case 52: return plain_texel(RGBA8Snorm);
        case 43:
        case 57: return plain_texel(RGBA8Srgb);
        case 44: return field_texel(kBgra8, 4);
        case 50: return srgb_texel(field_texel(kBgra8, 4));
        case 58: return field_texel(kBgr10a2, 4);
        case 64: return field_texel(kRgb10a2, 4);
        case 70: return plain_texel(R16Unorm);
        case 71: return snorm16_texel(1);
        case 76: return plain_texel(R16Half);
        case 77: return plain_texel(RG16Unorm);
        case 78: return snorm16_texel(2);
        case 83: return plain_texel(RG16Half);
        case 84: return three_channel_texel(RGBA16Unorm);
        case 85: return snorm16_texel(3);
        case 90: return three_channel_texel(RGBA16Half);
        case 91: return plain_texel(RGBA16Unorm);
        case 92: return snorm16_texel(4);
        case 97: return plain_texel(RGBA16Half);
        case 100: return plain_texel(R32Float);
        case 103: return plain_texel(RG32Float);
        case 106: return three_channel_texel(RGBA32Float);
        case 109: return plain_texel(RGBA32Float);
        case 122: return r11g11b10_float_texel();
        case 123: return rgb9e5_texel();
        case 131: return plain_texel(BC1RgbUnorm);
        case 132: return plain_texel(BC1RgbSrgb);
        case 133: return plain_texel(BC1RgbaUnorm);
        case 134: return plain_texel(BC1RgbaSrgb);
        case 135: return plain_texel(BC2Unorm);
        case 136: return plain_texel(BC2Srgb);
        case 137: return plain_texel(BC3Unorm);
        case 138: return plain_texel(BC3Srgb);
        case 139: return plain_texel(BC4Unorm);
        case 140: return plain_texel(BC4Snorm);
        case 141: return plain_texel(BC5Unorm);
        case 142: return plain_texel(BC5Snorm);
        case 143: return plain_texel(BC6HUfloat);
        case 144: return plain_texel(BC6HSfloat);
        case 145: return plain_texel(BC7Unorm);
        case 146: return plain_texel(BC7Srgb);
        case 1000340000: return field_texel(kA4r4g4b4, 2);
        default: return std::nullopt;
    }
}

std::string describe_dxgi(uint32_t dxgi_format) {
    const std::string text = "DXGI format " + std::to_string(dxgi_format);
    for (const Named& typeless : kDxgiTypeless) {
        if (typeless.code == dxgi_format) return text + " (" + std::string(typeless.name) + ": its codes have no defined meaning)";
    }
    return text;
}

std::string describe_vulkan(uint32_t vk_format) {
    const std::string text = "VkFormat " + std::to_string(vk_format);
    for (const NamedRange& range : kVulkanUnsupported) {
        if (range.first <= vk_format && vk_format <= range.last) return text + " (" + std::string(range.name) + ")";
    }
    return text;
}

}  // namespace rawtexel::texunit
