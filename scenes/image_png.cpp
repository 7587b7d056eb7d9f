#include "scenes/image_png.h"

#include "texunit/texel_source.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace rawtexel::scenes {
namespace {

using Bytes = std::span<const std::byte>;
constexpr size_t kSignatureBytes = 8, kLengthBytes = 4, kTypeBytes = 4, kChecksumBytes = 4;

uint32_t big_endian_32(Bytes bytes) {
    uint32_t value = 0;
    for (const std::byte b : bytes.first(4)) value = value << 8 | uint32_t(b);
    return value;
}

/// CRC-32 of ISO 3309 as PNG uses it (PNG specification, annex D).
uint32_t checksum(Bytes bytes) {
    static const auto table = [] {
        std::array<uint32_t, 256> t{};
        for (uint32_t n = 0; n < 256; ++n) {
            t[n] = n;
            for (int bit = 0; bit < 8; ++bit) t[n] = t[n] & 1 ? 0xedb88320u ^ t[n] >> 1 : t[n] >> 1;
        }
        return t;
    }();
    uint32_t crc = ~0u;
    for (const std::byte b : bytes) crc = table[(crc ^ uint32_t(b)) & 0xff] ^ crc >> 8;
    return ~crc;
}

[[noreturn]] void damaged(const std::string& name, const std::string& what) {
    throw texunit::TextureError(name + ": damaged PNG: " + what);
}

/// What libpng would refuse, and print, on reading IHDR (PNG specification, 11.2.2).
void check_header(const std::string& name, Bytes data) {
    constexpr size_t kHeaderBytes = 13;
    constexpr uint32_t kLibpngLimit = 1000000;  // of each extent
    if (data.size() != kHeaderBytes) damaged(name, "a header of " + std::to_string(data.size()) + " bytes (13 were expected)");
    const uint32_t width = big_endian_32(data), height = big_endian_32(data.subspan(4));
    const auto allowed = [](uint32_t extent) { return extent >= 1 && extent <= kLibpngLimit; };
    if (!allowed(width) || !allowed(height)) damaged(name, "extents of " + std::to_string(width) + " x " + std::to_string(height));

    // Bit depths that go with each colour type.
    const int bits = int(data[8]), colour_type = int(data[9]);
    const bool deep = bits == 8 || bits == 16, shallow = bits == 1 || bits == 2 || bits == 4;
    const bool grey = colour_type == 0 && (deep || shallow), palette = colour_type == 3 && (shallow || bits == 8);
    const bool colour = (colour_type == 2 || colour_type == 4 || colour_type == 6) && deep;
    if (!grey && !palette && !colour) damaged(name, "colour type " + std::to_string(colour_type) + " of " + std::to_string(bits) + " bits");
    if (int(data[10]) != 0 || int(data[11]) != 0 || int(data[12]) > 1) damaged(name, "an unknown compression, filter or interlace method");
}

}  // namespace

std::vector<std::byte> png_without_ancillary_chunks(const std::string& name, Bytes png, PngExtent extent) {
    if (png.size() < kSignatureBytes) damaged(name, "cut off in its signature");
    std::vector<std::byte> kept(png.begin(), png.begin() + kSignatureBytes);
    Bytes rest = png.subspan(kSignatureBytes);
    bool has_header = false, has_pixels = false;
    while (true) {
        if (rest.size() < kLengthBytes + kTypeBytes) damaged(name, "cut off before its IEND chunk");
        const std::string_view type(reinterpret_cast<const char*>(rest.data()) + kLengthBytes, kTypeBytes);
        if (has_header != (type != "IHDR")) damaged(name, has_header ? "a second IHDR chunk" : "its first chunk is not IHDR");
        if (type == "IDAT" && extent == PngExtent::Header) {
            kept.insert(kept.end(), rest.begin(), rest.begin() + kLengthBytes + kTypeBytes);
            return kept;
        }
        const uint64_t chunk_bytes = uint64_t{big_endian_32(rest)} + kLengthBytes + kTypeBytes + kChecksumBytes;
        if (chunk_bytes > rest.size()) damaged(name, "cut off in a chunk of " + std::to_string(chunk_bytes) + " bytes");
        const Bytes chunk = rest.first(chunk_bytes);
        const Bytes summed = chunk.subspan(kLengthBytes, chunk.size() - kLengthBytes - kChecksumBytes);
        if (checksum(summed) != big_endian_32(chunk.last(kChecksumBytes))) damaged(name, "checksum error in a chunk");
        rest = rest.subspan(chunk_bytes);

        if (type == "IHDR") check_header(name, summed.subspan(kTypeBytes));
        has_header = true;
        has_pixels = has_pixels || type == "IDAT";
        const bool decides_pixels = type == "IHDR" || type == "PLTE" || type == "tRNS" || type == "IDAT" || type == "IEND";
        if (decides_pixels) kept.insert(kept.end(), chunk.begin(), chunk.end());
        if (type != "IEND") continue;
        if (!has_pixels) damaged(name, "no IDAT chunk");
        return kept;
    }
}

}  // namespace rawtexel::scenes
