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

}  // namespace

std::vector<std::byte> png_without_ancillary_chunks(const std::string& name, Bytes png, PngExtent extent) {
    if (png.size() < kSignatureBytes) damaged(name, "cut off in its signature");
    std::vector<std::byte> kept(png.begin(), png.begin() + kSignatureBytes);
    Bytes rest = png.subspan(kSignatureBytes);
    while (true) {
        if (rest.size() < kLengthBytes + kTypeBytes) damaged(name, "cut off before its IEND chunk");
        const std::string_view type(reinterpret_cast<const char*>(rest.data()) + kLengthBytes, kTypeBytes);
        if (type == "IDAT" && extent == PngExtent::Header) {
            kept.insert(kept.end(), rest.begin(), rest.begin() + kLengthBytes + kTypeBytes);
            return kept;
        }
        const uint64_t chunk_bytes = uint64_t{big_endian_32(rest)} + kLengthBytes + kTypeBytes + kChecksumBytes;
        if (chunk_bytes > rest.size()) damaged(name, "cut off in a chunk of " + std::to_string(chunk_bytes) + " bytes");
        const Bytes chunk = rest.first(chunk_bytes);
        rest = rest.subspan(chunk_bytes);

        const bool decides_pixels = type == "IHDR" || type == "PLTE" || type == "tRNS" || type == "IDAT" || type == "IEND";
        if (!decides_pixels) continue;
        const Bytes summed = chunk.subspan(kLengthBytes, chunk.size() - kLengthBytes - kChecksumBytes);
        if (checksum(summed) != big_endian_32(chunk.last(kChecksumBytes))) damaged(name, "checksum error in chunk " + std::string(type));
        kept.insert(kept.end(), chunk.begin(), chunk.end());
        if (type == "IEND") return kept;
    }
}

}  // namespace rawtexel::scenes
