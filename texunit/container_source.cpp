#include "texunit/container_source.h"

#include "texunit/memory_source.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

namespace rawtexel::texunit {
namespace {

constexpr int kMaxLayers = kMaxExtent;

/// Overwrites the texels of a decoded block at and beyond `width` x `height` with the last column and row before.
void repeat_edges(std::byte* texels, int width, int height, size_t texel_bytes) {
    for (int y = 0; y < height; ++y) {
        std::byte* const row = texels + size_t(4 * y) * texel_bytes;
        for (int x = width; x < 4; ++x) std::memcpy(row + size_t(x) * texel_bytes, row + size_t(width - 1) * texel_bytes, texel_bytes);
    }
    const size_t row_bytes = 4 * texel_bytes;
    for (int y = height; y < 4; ++y) std::memcpy(texels + size_t(y) * row_bytes, texels + size_t(height - 1) * row_bytes, row_bytes);
}

class ContainerSource final : public TexelSource {
  public:
    ContainerSource(const FileTexel& texel, const Shape& shape, std::vector<LevelPlace> levels)
        : texel_(texel), shape_(shape), levels_(std::move(levels)) {
        assert(levels_.size() == size_t(shape.levels));
    }

    Format format() const override { return texel_.format; }
    Shape shape() const override { return shape_; }
    uint64_t stored_bytes() const override { return image_bytes(texel_, shape_); }
    uint64_t level_bytes(int level) const override { return texunit::level_bytes(texel_, shape_, level); }
    BcRounding bc_rounding() const override { return texel_.rounding; }

    void decode_block(int level, int slice, int block_x, int block_y, std::byte* texels) override {
        assert(level >= 0 && level < shape_.levels && slice >= 0 && slice < slice_count(shape_, level));
        const int width = level_extent(shape_.width, level), height = level_extent(shape_.height, level);
        assert(block_x >= 0 && 4 * block_x < width && block_y >= 0 && 4 * block_y < height);
        const LevelPlace& place = levels_[size_t(level)];
        const uint64_t slice_at = place.offset + uint64_t(slice) * place.slice_stride;
        const int columns = std::min(4, width - 4 * block_x), rows = std::min(4, height - 4 * block_y);
        if (texel_.decode) {
            const uint64_t blocks_x = uint64_t(width + 3) / 4;
            decode_file_block(place, slice_at + (uint64_t(block_y) * blocks_x + uint64_t(block_x)) * uint64_t(texel_.file_bytes), texels);
            if (columns < 4 || rows < 4) repeat_edges(texels, columns, rows, size_t(bytes_per_texel(layout(texel_.format).storage)));
        } else {
            const uint64_t stride = uint64_t(width) * uint64_t(texel_.file_bytes);
            gather_texels(place, slice_at + uint64_t(4 * block_y) * stride + uint64_t(4 * block_x) * uint64_t(texel_.file_bytes), stride,
                          columns, rows, texels);
        }
    }

  private:
    void decode_file_block(const LevelPlace& place, uint64_t at, std::byte* texels) const {
        std::byte block[16];
        place.bytes->read(at, {block, size_t(texel_.file_bytes)});
        texel_.decode(block, texels);
    }

    void gather_texels(const LevelPlace& place, uint64_t at, uint64_t stride, int columns, int rows, std::byte* texels) const {
        constexpr size_t kLargestTexel = 16;
        std::byte file_row[4 * kLargestTexel], own[16 * kLargestTexel];
        const auto file_bytes = size_t(texel_.file_bytes), own_bytes = size_t(info(texel_.format).bytes_per_block);
        std::byte* next = own;
        for (int y = 0; y < rows; ++y, at += stride) {
            place.bytes->read(at, {file_row, size_t(columns) * file_bytes});
            for (int x = 0; x < columns; ++x, next += own_bytes) {
                const std::byte* const in = file_row + size_t(x) * file_bytes;
                if (texel_.expand)
                    texel_.expand(texel_, in, next);
                else
                    std::memcpy(next, in, own_bytes);
            }
        }
        store_block(texel_.format, own, columns, rows, size_t(columns) * own_bytes, 0, 0, texels);
    }

    FileTexel texel_;
    Shape shape_;
    std::vector<LevelPlace> levels_;
};

/// A source whose codes are read with another transfer function. Both formats of a pair are stored alike.
class ReinterpretedSource final : public TexelSource {
  public:
    ReinterpretedSource(std::unique_ptr<TexelSource> source, Format format) : source_(std::move(source)), format_(format) {}

    Format format() const override { return format_; }
    Shape shape() const override { return source_->shape(); }
    uint64_t stored_bytes() const override { return source_->stored_bytes(); }
    uint64_t level_bytes(int level) const override { return source_->level_bytes(level); }
    BcRounding bc_rounding() const override { return source_->bc_rounding(); }
    void decode_block(int level, int slice, int block_x, int block_y, std::byte* texels) override {
        source_->decode_block(level, slice, block_x, block_y, texels);
    }

  private:
    std::unique_ptr<TexelSource> source_;
    Format format_;
};

}  // namespace

uint64_t slice_bytes(const FileTexel& texel, int width, int height) {
    const auto units = [&](int extent) { return uint64_t(extent + texel.extent - 1) / uint64_t(texel.extent); };
    return units(width) * units(height) * uint64_t(texel.file_bytes);
}

uint64_t level_bytes(const FileTexel& texel, const Shape& shape, int level) {
    const uint64_t slice = slice_bytes(texel, level_extent(shape.width, level), level_extent(shape.height, level));
    return slice * uint64_t(slice_count(shape, level));
}

uint64_t image_bytes(const FileTexel& texel, const Shape& shape) {
    uint64_t bytes = 0;
    for (int level = 0; level < shape.levels; ++level) bytes += level_bytes(texel, shape, level);
    return bytes;
}

std::unique_ptr<TexelSource> make_container_source(const FileTexel& texel, const Shape& shape, std::vector<LevelPlace> levels) {
    return std::make_unique<ContainerSource>(texel, shape, std::move(levels));
}

std::unique_ptr<TexelSource> reinterpret_srgb(std::unique_ptr<TexelSource> source, bool srgb) {
    const Format format = with_srgb(source->format(), srgb);
    if (format == source->format()) return source;
    return std::make_unique<ReinterpretedSource>(std::move(source), format);
}

void refuse(const std::string& name, const std::string& what) { throw TextureError(name + ": " + what); }

int checked_extent(const std::string& name, const char* axis, uint32_t extent) {
    if (extent == 0 || extent > uint32_t(kMaxExtent)) {
        refuse(name, std::string(axis) + " of " + std::to_string(extent) + " texels; 1 to " + std::to_string(kMaxExtent) + " are allowed");
    }
    return int(extent);
}

int checked_layers(const std::string& name, uint64_t layers) {
    if (layers == 0 || layers > uint64_t(kMaxLayers)) {
        refuse(name, std::to_string(layers) + " array layers; 1 to " + std::to_string(kMaxLayers) + " are allowed");
    }
    return int(layers);
}

int checked_levels(const std::string& name, uint32_t levels, const Shape& shape) {
    const int full = full_level_count(shape.width, shape.height, shape.depth);
    if (levels > uint32_t(full)) {
        refuse(name, std::to_string(levels) + " mip levels; its extents allow at most " + std::to_string(full));
    }
    return std::max(1, int(levels));
}

void check_texture_bytes(const std::string& name, uint64_t bytes, const ContainerOptions& options) {
    if (bytes > options.max_texture_bytes) {
        refuse(name, std::to_string(bytes) + " bytes of texels; at most " + std::to_string(options.max_texture_bytes) + " are allowed");
    }
}

}  // namespace rawtexel::texunit
