#include "tests/texunit/container_writer.h"

#include "texunit/block_codec.h"
#include "texunit/half.h"
#include "texunit/memory_source.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <random>

namespace rawtexel::texunit::test_files {
namespace {

int slices_of(const Shape& shape, int level) { return shape.depth > 1 ? std::max(1, shape.depth >> level) : shape.layers; }

void append(Bytes& bytes, const Bytes& more) { bytes.insert(bytes.end(), more.begin(), more.end()); }

void put64(Bytes& bytes, size_t at, uint64_t value) {
    put32(bytes, at, uint32_t(value));
    put32(bytes, at + 4, uint32_t(value >> 32));
}

double srgb(double encoded) { return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4); }

Bytes dds_header(const Shape& shape, const DdsPixelFormat& pixel) {
    Bytes bytes(128);
    put32(bytes, 0, four_cc("DDS "));
    put32(bytes, 4, 124);
    put32(bytes, 8, 0x1007 | (shape.depth > 1 ? 0x800000u : 0u));
    put32(bytes, 12, uint32_t(shape.height));
    put32(bytes, 16, uint32_t(shape.width));
    put32(bytes, 24, uint32_t(shape.depth > 1 ? shape.depth : 0));
    put32(bytes, 28, uint32_t(shape.levels));
    put32(bytes, 76, 32);
    put32(bytes, 80, pixel.flags);
    put32(bytes, 84, pixel.four_cc);
    put32(bytes, 88, pixel.bits);
    for (size_t c = 0; c < 4; ++c) put32(bytes, 92 + 4 * c, pixel.mask[c]);
    put32(bytes, 108, 0x1000);
    put32(bytes, 112, shape.cube ? 0xFE00 : shape.depth > 1 ? 0x200000 : 0);
    return bytes;
}

/// Layer-major; a volume is one layer whose levels hold all their slices.
void append_dds_texels(Bytes& bytes, const StoredImage& image) {
    const bool volume = image.shape.depth > 1;
    for (int layer = 0; layer < (volume ? 1 : image.shape.layers); ++layer) {
        for (int level = 0; level < image.shape.levels; ++level) {
            const auto& slices = image.slices[size_t(level)];
            if (!volume)
                append(bytes, slices[size_t(layer)]);
            else
                for (const Bytes& slice : slices) append(bytes, slice);
        }
    }
}

}  // namespace

void put32(Bytes& bytes, size_t at, uint32_t value) { std::memcpy(bytes.data() + at, &value, 4); }

StoredImage random_image(const Shape& shape, int unit_extent, int unit_bytes, uint64_t seed) {
    std::mt19937_64 random(seed);
    StoredImage image{shape, unit_extent, unit_bytes, {}};
    for (int level = 0; level < shape.levels; ++level) {
        const int width = std::max(1, shape.width >> level), height = std::max(1, shape.height >> level);
        const int units = ((width + unit_extent - 1) / unit_extent) * ((height + unit_extent - 1) / unit_extent);
        auto& slices = image.slices.emplace_back();
        for (int s = 0; s < slices_of(shape, level); ++s) {
            Bytes& bytes = slices.emplace_back(size_t(units * unit_bytes));
            for (std::byte& b : bytes) b = std::byte(random() & 0xFF);
        }
    }
    return image;
}

Bytes expected_block(const StoredImage& image, Format format, int level, int slice, int block_x, int block_y) {
    const int width = std::max(1, image.shape.width >> level), height = std::max(1, image.shape.height >> level);
    const Bytes& stored = image.slices[size_t(level)][size_t(slice)];
    const auto texel_bytes = size_t(bytes_per_texel(layout(format).storage));
    Bytes expected(16 * texel_bytes);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 4; ++x) {
            const int column = std::min(4 * block_x + x, width - 1), row = std::min(4 * block_y + y, height - 1);
            std::byte* const out = expected.data() + size_t(4 * y + x) * texel_bytes;
            const int units_x = (width + image.unit_extent - 1) / image.unit_extent;
            const int unit = row / image.unit_extent * units_x + column / image.unit_extent;
            const std::byte* const in = stored.data() + size_t(unit * image.unit_bytes);
            if (image.unit_extent == 1) {
                store_texel(format, in, out);
            } else {
                std::array<std::byte, 256> block;
                decode_block(format, in, block.data());
                std::memcpy(out, block.data() + size_t(4 * (row % 4) + column % 4) * texel_bytes, texel_bytes);
            }
        }
    }
    return expected;
}

Bytes write_dds(const StoredImage& image, uint32_t dxgi_format) {
    Bytes bytes = dds_header(image.shape, {.flags = 4, .four_cc = four_cc("DX10")});
    bytes.resize(148);
    put32(bytes, 128, dxgi_format);
    put32(bytes, 132, image.shape.depth > 1 ? 4 : 3);
    put32(bytes, 136, image.shape.cube ? 4 : 0);
    put32(bytes, 140, uint32_t(image.shape.cube ? image.shape.layers / 6 : image.shape.layers));
    append_dds_texels(bytes, image);
    return bytes;
}

Bytes write_legacy_dds(const StoredImage& image, const DdsPixelFormat& pixel) {
    Bytes bytes = dds_header(image.shape, pixel);
    append_dds_texels(bytes, image);
    return bytes;
}

Bytes write_ktx2(const StoredImage& image, uint32_t vk_format, uint32_t scheme) {
    static constexpr unsigned char magic[] = {0xAB, 'K', 'T', 'X', ' ', '2', '0', 0xBB, '\r', '\n', 0x1A, '\n'};
    const Shape& shape = image.shape;
    const int faces = shape.cube ? 6 : 1;
    Bytes bytes(80 + 24 * size_t(shape.levels));
    std::memcpy(bytes.data(), magic, 12);
    put32(bytes, 12, vk_format);
    put32(bytes, 16, 1);
    put32(bytes, 20, uint32_t(shape.width));
    put32(bytes, 24, uint32_t(shape.height));
    put32(bytes, 28, uint32_t(shape.depth > 1 ? shape.depth : 0));
    put32(bytes, 32, uint32_t(shape.layers > faces ? shape.layers / faces : 0));
    put32(bytes, 36, uint32_t(faces));
    put32(bytes, 40, uint32_t(shape.levels));
    put32(bytes, 44, scheme);
    // The smallest level comes first in the file.
    for (int level = shape.levels - 1; level >= 0; --level) {
        Bytes texels;
        for (const Bytes& slice : image.slices[size_t(level)]) append(texels, slice);
        const size_t inflated = texels.size();
        if (scheme == 2) {
            Bytes frame(ZSTD_compressBound(inflated));
            frame.resize(ZSTD_compress(frame.data(), frame.size(), texels.data(), inflated, 3));
            texels = std::move(frame);
        }
        bytes.resize((bytes.size() + 15) / 16 * 16);
        put64(bytes, 80 + 24 * size_t(level), bytes.size());
        put64(bytes, 88 + 24 * size_t(level), texels.size());
        put64(bytes, 96 + 24 * size_t(level), inflated);
        append(bytes, texels);
    }
    return bytes;
}

std::array<double, 4> decoded_value(Format format, const std::byte* texels, int texel) {
    const TexelLayout& l = layout(format);
    const std::byte* const at = texels + texel * bytes_per_texel(l.storage);
    std::array<double, 4> value;
    if (l.storage == StorageClass::Half4) {
        uint16_t half[4];
        std::memcpy(half, at, 8);
        for (size_t c = 0; c < 4; ++c) value[c] = half_to_float(half[c]);
        return value;
    }
    if (l.storage == StorageClass::Float4) {
        float single[4];
        std::memcpy(single, at, 16);
        for (size_t c = 0; c < 4; ++c) value[c] = single[c];
        return value;
    }
    uint64_t word = 0;
    std::memcpy(&word, at, size_t(bytes_per_texel(l.storage)));
    for (size_t c = 0; c < 4; ++c) {
        double field = double((word >> l.shift[c]) & l.mask[c]);
        if (l.is_signed && field > l.mask[c] / 2) field -= double(l.mask[c]) + 1;
        value[c] = l.mask[c] == 0 ? l.bias[c] : std::max(field / l.denominator[c], -1.0);
        if (l.table[c]) value[c] = srgb(value[c]);
    }
    return value;
}

void expect_same_texels(TexelSource& source, const StoredImage& image, Format format) {
    ASSERT_EQ(info(source.format()).name, info(format).name);
    ASSERT_EQ(source.shape(), image.shape);
    uint64_t stored = 0;
    for (int level = 0; level < image.shape.levels; ++level) {
        const int width = std::max(1, image.shape.width >> level), height = std::max(1, image.shape.height >> level);
        for (int slice = 0; slice < slices_of(image.shape, level); ++slice) {
            stored += image.slices[size_t(level)][size_t(slice)].size();
            for (int y = 0; 4 * y < height; ++y) {
                for (int x = 0; 4 * x < width; ++x) {
                    const Bytes expected = expected_block(image, format, level, slice, x, y);
                    Bytes got(expected.size());
                    source.decode_block(level, slice, x, y, got.data());
                    ASSERT_TRUE(got == expected)
                        << info(format).name << ' ' << image.shape.width << 'x' << image.shape.height << 'x' << image.shape.depth
                        << " level " << level << " slice " << slice << " block " << x << ", " << y;
                }
            }
        }
    }
    EXPECT_EQ(source.stored_bytes(), stored);
}

TemporaryFile::TemporaryFile(const Bytes& bytes, const char* name)
    : path_(::testing::TempDir() + "rawtexel_" + name + "_" + std::to_string(getpid())) {
    std::ofstream file(path_, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
}

TemporaryFile::~TemporaryFile() { std::remove(path_.c_str()); }

}  // namespace rawtexel::texunit::test_files
