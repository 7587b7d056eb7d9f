// DDS and KTX2 files made in memory, for the tests of their readers.
#pragma once

#include "texunit/texel_source.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rawtexel::texunit::test_files {

using Bytes = std::vector<std::byte>;

/// Texels or blocks of every slice of every level, as files hold them: slices[level][slice], row by row.
struct StoredImage {
    Shape shape;
    int unit_extent = 1, unit_bytes = 1;
    std::vector<std::vector<Bytes>> slices;
};

/// Random bytes.
StoredImage random_image(const Shape& shape, int unit_extent, int unit_bytes, uint64_t seed);

/// The sixteen decoded texels of a block, gathered texel by texel from the slice; `format` stores its units as the file does.
Bytes expected_block(const StoredImage& image, Format format, int level, int slice, int block_x, int block_y);

/// DDS_PIXELFORMAT.
struct DdsPixelFormat {
    uint32_t flags = 0, four_cc = 0, bits = 0;
    std::array<uint32_t, 4> mask{};
};

Bytes write_dds(const StoredImage& image, uint32_t dxgi_format);
Bytes write_legacy_dds(const StoredImage& image, const DdsPixelFormat& pixel);

/// `scheme` 0: none, 2: Zstandard.
Bytes write_ktx2(const StoredImage& image, uint32_t vk_format, uint32_t scheme = 0);

/// A 32-bit number in a file.
void put32(Bytes& bytes, size_t at, uint32_t value);

constexpr uint32_t four_cc(const char (&text)[5]) {
    return uint32_t(text[0]) | uint32_t(text[1]) << 8 | uint32_t(text[2]) << 16 | uint32_t(text[3]) << 24;
}

/// Red, green, blue, alpha of texel `texel` of a decoded block, in double precision.
std::array<double, 4> decoded_value(Format format, const std::byte* texels, int texel);

/// Every texel of every level and slice: compares a source with what was written. Reports the first difference.
void expect_same_texels(TexelSource& source, const StoredImage& image, Format format);

/// A file of these bytes in the test's temporary folder, removed at the end of the scope.
class TemporaryFile {
  public:
    explicit TemporaryFile(const Bytes& bytes, const char* name = "texture");
    ~TemporaryFile();
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    const std::string& path() const { return path_; }

  private:
    std::string path_;
};

}  // namespace rawtexel::texunit::test_files
