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
    if (channels > 0) std::memcpy(values, file_texel, size_t(channels) * sizeof(T));
    std::memcpy(decoded, values, sizeof(values));
}

constexpr uint16_t kHalfOne = 0x3C00;

/// Four texels of a row, `file` bytes each, over what texels without any channel hold.
template <size_t file, size_t decoded>
void store_row(const std::byte* from, const std::byte* empty, std::byte* to) {
    for (size_t i = 0; i < 4; ++i) {
        std::memcpy(to + i * decoded, empty, decoded);
        std::memcpy(to + i * decoded, from + i * file, file);
    }
}
using StoreRow = void (*)(const std::byte* from, const std::byte* empty, std::byte* to);

template <size_t decoded>
StoreRow find_store_row(size_t file_bytes) {
    if (file_bytes == decoded) return store_row<decoded, decoded>;
    return file_bytes == decoded / 2 ? store_row<decoded / 2, decoded> : store_row<decoded / 4, decoded>;
}
/// Files hold one, two or four channels, of which a decoded texel always has four.
StoreRow find_store_row(size_t file_bytes, size_t decoded_bytes) {
    assert(decoded_bytes == file_bytes || decoded_bytes == 2 * file_bytes || decoded_bytes == 4 * file_bytes);
    if (decoded_bytes == 4) return find_store_row<4>(file_bytes);
    return decoded_bytes == 8 ? find_store_row<8>(file_bytes) : find_store_row<16>(file_bytes);
}

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
    const StorageClass storage = layout(format).storage;
    const auto texel_bytes = size_t(bytes_per_texel(storage));
    const auto row_at = [&](int j) { return rows + size_t(std::min(4 * block_y + j, height - 1)) * row_stride; };
    if (4 * block_x + 4 <= width) {
        alignas(16) std::byte empty[16] = {};
        if (storage == StorageClass::Float4) store_four<float>(nullptr, 0, 1.0f, empty);
        if (storage == StorageClass::Half4) store_four<uint16_t>(nullptr, 0, kHalfOne, empty);
        const StoreRow store = find_store_row(file_bytes, texel_bytes);
        for (int j = 0; j < 4; ++j, decoded += 4 * texel_bytes) store(row_at(j) + size_t(4 * block_x) * file_bytes, empty, decoded);
        return;
    }
    for (int j = 0; j < 4; ++j) {
        const std::byte* const row = row_at(j);
        for (int i = 0; i < 4; ++i, decoded += texel_bytes) {
            store_texel(format, row + size_t(std::min(4 * block_x + i, width - 1)) * file_bytes, decoded);
        }
    }
}

}  // namespace rawtexel::texunit
