// Test textures of any format, extent and shape whose texels are a hash of their address: nothing is stored, every block can be asked for.
#pragma once

#include "texunit/half.h"
#include "texunit/random.h"
#include "texunit/texel_source.h"

#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <utility>

namespace rawtexel::texunit {

/// Fills one decoded texel of `layout` with values drawn from `bits`: every field a decoder can produce, every finite half, floats of both
/// signs over 40 binades.
inline void store_random_texel(const TexelLayout& layout, uint64_t bits, std::byte* texel) {
    uint32_t draw[4];
    for (uint32_t c = 0; c < 4; ++c) draw[c] = mix_bits(uint32_t(bits) + mix_bits(uint32_t(bits >> 32) + c * kRandomStart));
    if (layout.storage == StorageClass::Float4) {
        float values[4];
        for (int c = 0; c < 4; ++c) values[c] = std::ldexp(float(int32_t(draw[c])), int(draw[c] % 41) - 20 - 31);
        std::memcpy(texel, values, sizeof(values));
    } else if (layout.storage == StorageClass::Half4) {
        uint16_t values[4];
        for (int c = 0; c < 4; ++c) values[c] = uint16_t((draw[c] >> 16 & 0x8000u) | (draw[c] & 0x7FFFu) % 0x7C00u);
        std::memcpy(texel, values, sizeof(values));
    } else {
        uint64_t word = 0;
        for (int c = 0; c < 4; ++c) {
            if (layout.mask[c] == 0) continue;
            const auto range = uint32_t(layout.denominator[c]);
            const int64_t field = layout.is_signed ? int64_t(draw[c] % (2 * range + 1)) - range : int64_t(draw[c] % (range + 1));
            word |= (uint64_t(field) & layout.mask[c]) << layout.shift[c];
        }
        std::memcpy(texel, &word, size_t(bytes_per_texel(layout.storage)));
    }
}

class HashedSource final : public TexelSource {
  public:
    /// `on_decode` is called for every block before it is filled; it may count, sleep or throw.
    using OnDecode = std::function<void(int level, int slice, int block_x, int block_y)>;
    HashedSource(Format format, const Shape& shape, uint32_t seed = 0, OnDecode on_decode = {})
        : format_(format), shape_(shape), seed_(seed), on_decode_(std::move(on_decode)) {}

    Format format() const override { return format_; }
    Shape shape() const override { return shape_; }
    uint64_t stored_bytes() const override { return texunit::stored_bytes(format_, shape_.width, shape_.height); }

    void decode_block(int level, int slice, int block_x, int block_y, std::byte* texels) override {
        if (on_decode_) on_decode_(level, slice, block_x, block_y);
        const TexelLayout& stored = layout(format_);
        const int last_x = level_extent(shape_.width, level) - 1, last_y = level_extent(shape_.height, level) - 1;
        for (int j = 0; j < 4; ++j) {
            for (int i = 0; i < 4; ++i, texels += bytes_per_texel(stored.storage)) {
                store_random_texel(stored, address(level, slice, std::min(4 * block_x + i, last_x), std::min(4 * block_y + j, last_y)),
                                   texels);
            }
        }
    }

  private:
    uint64_t address(int level, int slice, int x, int y) const {
        const uint32_t place = mix_bits(seed_ + mix_bits(uint32_t(level) * 64 + uint32_t(slice)));
        return uint64_t{place} << 32 | (uint32_t(y) << 16 | uint32_t(x));
    }

    Format format_;
    Shape shape_;
    uint32_t seed_;
    OnDecode on_decode_;
};

/// A source that holds the full pyramid.
inline std::unique_ptr<HashedSource> make_hashed_pyramid(Format format, int width, int height, uint32_t seed = 0) {
    return std::make_unique<HashedSource>(format, Shape{.width = width, .height = height, .levels = full_level_count(width, height)}, seed);
}

}  // namespace rawtexel::texunit
