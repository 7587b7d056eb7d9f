#include "cli/vectors/suite.h"

#include "texunit/block_codec.h"
#include "texunit/memory_source.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace rawtexel::cli {
namespace {

using texunit::Format;
using texunit::Shape;

size_t bytes_of_slice(Format format, const Shape& shape, int level) {
    return size_t(texunit::stored_bytes(format, texunit::level_extent(shape.width, level), texunit::level_extent(shape.height, level)));
}

[[maybe_unused]] size_t bytes_of(Format format, const Shape& shape) {
    size_t bytes = 0;
    for (int level = 0; level < shape.levels; ++level) bytes += bytes_of_slice(format, shape, level) * size_t(slice_count(shape, level));
    return bytes;
}

/// Texels and blocks as they lie in a SuiteTexture.
class PackedSource final : public texunit::TexelSource {
  public:
    PackedSource(Format format, const Shape& shape, std::shared_ptr<const std::vector<std::byte>> bytes)
        : format_(format), shape_(shape), bytes_(std::move(bytes)) {}
    Format format() const override { return format_; }
    Shape shape() const override { return shape_; }
    uint64_t stored_bytes() const override { return bytes_->size(); }
    void decode_block(int level, int slice, int block_x, int block_y, std::byte* texels) override {
        size_t at = 0;
        for (int l = 0; l < level; ++l) at += bytes_of_slice(format_, shape_, l) * size_t(slice_count(shape_, l));
        at += bytes_of_slice(format_, shape_, level) * size_t(slice);
        const int width = texunit::level_extent(shape_.width, level), height = texunit::level_extent(shape_.height, level);
        const auto unit = size_t(texunit::info(format_).bytes_per_block);
        const std::byte* const from = bytes_->data() + at;
        if (!texunit::info(format_).block_compressed)
            return store_block(format_, from, width, height, size_t(width) * unit, block_x, block_y, texels);
        const int columns = (width + 3) / 4;
        texunit::decode_block(format_, from + unit * size_t(block_x + columns * block_y), texels);
        repeat_edges(width - 4 * block_x, height - 4 * block_y, texels);
    }

  private:
    /// Texels outside the level repeat its last column and row.
    void repeat_edges(int columns, int rows, std::byte* texels) const {
        const auto size = size_t(bytes_per_texel(texunit::layout(format_).storage));
        for (int i = 0; i < 16; ++i) {
            const int from = std::min(i % 4, columns - 1) + 4 * std::min(i / 4, rows - 1);
            if (from != i) std::memcpy(texels + size * size_t(i), texels + size * size_t(from), size);
        }
    }

    Format format_;
    Shape shape_;
    std::shared_ptr<const std::vector<std::byte>> bytes_;
};

}  // namespace

size_t texels_of_level(const Shape& shape, int level) {
    return size_t(texunit::level_extent(shape.width, level)) * size_t(texunit::level_extent(shape.height, level)) *
           size_t(slice_count(shape, level));
}

size_t texels_of(const Shape& shape) {
    size_t texels = 0;
    for (int level = 0; level < shape.levels; ++level) texels += texels_of_level(shape, level);
    return texels;
}

SuiteTexture::SuiteTexture(std::string name, Format format, const Shape& shape, std::vector<std::byte> bytes)
    : bytes_(std::make_shared<const std::vector<std::byte>>(std::move(bytes))) {
    assert(bytes_->size() == bytes_of(format, shape));
    // A pyramid that stops early would be completed; suites hold whole ones or a single level of a single-level shape.
    texture_ = std::make_shared<texunit::Texture>(std::move(name), std::make_unique<PackedSource>(format, shape, bytes_));
}

void SuiteTexture::append_texels(std::vector<float>& all) const {
    if (format() == Format::RGBA32Float) {
        const size_t before = all.size();
        all.resize(before + bytes_->size() / 4);
        std::memcpy(all.data() + before, bytes_->data(), bytes_->size());
        return;
    }
    for (int level = 0; level < shape().levels; ++level) {
        for (int slice = 0; slice < slice_count(shape(), level); ++slice) {
            for (int y = 0; y < texunit::level_extent(shape().height, level); ++y) {
                for (int x = 0; x < texunit::level_extent(shape().width, level); ++x) {
                    const std::array<float, 4> texel = texture_->texel(level, slice, x, y);
                    all.insert(all.end(), texel.begin(), texel.end());
                }
            }
        }
    }
}

const CaseGroup& Suite::group_of(size_t index) const {
    const auto after = std::ranges::upper_bound(groups, index, {}, [](const CaseGroup& group) { return size_t(group.first); });
    return *(after - 1);
}

TextureTables texture_tables(const Suite& suite) {
    TextureTables tables;
    tables.words = suite.words;
    size_t next = 0, texels = 0;
    for (const SuiteTexture& texture : suite.textures) texels += texels_of(texture.shape());
    tables.texels.reserve(4 * texels);
    for (const SuiteTexture& texture : suite.textures) {
        const Shape& shape = texture.shape();
        TextureRecord record{.width = uint32_t(shape.width),
                             .height = uint32_t(shape.height),
                             .depth = uint32_t(shape.depth),
                             .layers = uint32_t(shape.layers),
                             .levels = uint32_t(shape.levels),
                             .cube = shape.cube,
                             .format = uint32_t(texture.format()),
                             .first_word = uint32_t(tables.words.size())};
        for (int level = 0; level < shape.levels; ++level) {
            record.first_texel[size_t(level)] = uint32_t(next);
            next += texels_of_level(shape, level);
        }
        texture.append_texels(tables.texels);
        if (texture.format() != Format::RGBA32Float) {
            const size_t first = tables.words.size();
            tables.words.resize(first + (texture.bytes().size() + 3) / 4);
            std::memcpy(tables.words.data() + first, texture.bytes().data(), texture.bytes().size());
        }
        tables.records.push_back(record);
    }
    return tables;
}

}  // namespace rawtexel::cli
