#include "texunit/memory_source.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

namespace rawtexel::texunit {
namespace {

class MemorySource final : public TexelSource {
  public:
    MemorySource(Format format, int width, int height, std::vector<std::byte> texels)
        : format_(format), width_(width), height_(height), texels_(std::move(texels)) {
        assert(!info(format).block_compressed);
        assert(texels_.size() == texunit::stored_bytes(format, width, height));
    }

    Format format() const override { return format_; }
    Shape shape() const override { return {.width = width_, .height = height_}; }
    uint64_t stored_bytes() const override { return texels_.size(); }

    void decode_block(int level, int slice, int block_x, int block_y, std::byte* texels) override {
        assert(level == 0 && slice == 0);
        (void)level, (void)slice;
        const size_t row_stride = size_t(width_) * size_t(info(format_).bytes_per_block);
        store_block(format_, texels_.data(), width_, height_, row_stride, block_x, block_y, texels);
    }

  private:
    Format format_;
    int width_, height_;
    std::vector<std::byte> texels_;
};

/// Writes `channels` values of type T, a missing alpha as `one` and other missing channels as zero.
template <class T>
void store_four(const std::byte* file_texel, int channels, T one, std::byte* decoded) {
    T values[4] = {0, 0, 0, one};
    std::memcpy(values, file_texel, size_t(channels) * sizeof(T));
    std::memcpy(decoded, values, sizeof(values));
}

constexpr uint16_t kHalfOne = 0x3C00;

}  // namespace

std::unique_ptr<TexelSource> make_memory_source(Format format, int width, int height, std::vector<std::byte> texels) {
    return std::make_unique<MemorySource>(format, width, height, std::move(texels));
}

void store_texel(Format format, const std::byte* file_texel, std::byte* decoded) {
    const FormatInfo& about = info(format);
    assert(!about.block_compressed);
    const StorageClass storage = layout(format).storage;
    switch (storage) {
        case StorageClass::Float4: return store_four<float>(file_texel, about.channels, 1.0f, decoded);
        case StorageClass::Half4: return store_four<uint16_t>(file_texel, about.channels, kHalfOne, decoded);
        default: break;
    }
    // Uncompressed packed formats keep their codes, channel after channel from the lowest byte on.
    std::memset(decoded, 0, size_t(bytes_per_texel(storage)));
    std::memcpy(decoded, file_texel, size_t(about.bytes_per_block));
}

void store_block(Format format, const std::byte* rows, int width, int height, size_t row_stride, int block_x, int block_y,
                 std::byte* decoded) {
    const auto file_bytes = size_t(info(format).bytes_per_block);
    const auto texel_bytes = size_t(bytes_per_texel(layout(format).storage));
    for (int j = 0; j < 4; ++j) {
        const std::byte* const row = rows + size_t(std::min(4 * block_y + j, height - 1)) * row_stride;
        for (int i = 0; i < 4; ++i, decoded += texel_bytes) {
            store_texel(format, row + size_t(std::min(4 * block_x + i, width - 1)) * file_bytes, decoded);
        }
    }
}

}  // namespace rawtexel::texunit
