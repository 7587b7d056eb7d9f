#include "texunit/texel_addresses.h"

namespace rawtexel::texunit {
namespace {

constexpr uint64_t kTextureAlignment = 64 * 1024;  // bytes

uint64_t align(uint64_t bytes) { return (bytes + kTextureAlignment - 1) / kTextureAlignment * kTextureAlignment; }

}  // namespace

TexelAddresses::TexelAddresses(std::span<const Texture* const> textures) {
    uint64_t stored_end = 0;
    for (const Texture* texture : textures) {
        const FormatInfo& format = info(texture->format());
        const LevelTable& table = texture->levels();
        Entry entry{texture,
                    uint32_t(texunit::bytes_per_texel(texture->texel_layout().storage)),
                    uint32_t(format.bytes_per_block),
                    format.block_extent,
                    decoded_end_,
                    {}};
        decoded_end_ = align(decoded_end_ + table.texels * entry.bytes_per_texel);
        const auto units = [&](int extent) { return (extent + format.block_extent - 1) / format.block_extent; };
        for (int level = 0; level < table.levels; ++level) {
            const auto l = size_t(level);
            entry.stored.push_back(
                {stored_end, SliceAddresses(AddressLayout::Linear, units(table.width[l]), units(table.height[l]), format.bytes_per_block)});
            stored_end += entry.stored.back().slice.bytes() * uint64_t(texture->shape().layers) * uint64_t(table.depth[l]);
        }
        stored_end = align(stored_end);
        entries_.push_back(std::move(entry));
    }
}

TexelAddresses::Position TexelAddresses::position(TexelFetch fetch) const {
    const Texture& texture = *entries_[fetch.texture()].texture;
    const int32_t texel = fetch.texel();
    const BlockPosition block = locate_block(texture.levels(), texture.texel_layout().storage, texel / kTexelsPerBlock);
    return {block.slice, 4 * block.x + texel % 4, 4 * block.y + texel / 4 % 4};
}

uint64_t TexelAddresses::stored(TexelFetch fetch, const Position& at) const {
    const Entry& entry = entries_[fetch.texture()];
    const Level& level = entry.stored[size_t(fetch.level())];
    return level.base + uint64_t(at.slice) * level.slice.bytes() + level.slice.offset(at.x / entry.unit_extent, at.y / entry.unit_extent);
}

}  // namespace rawtexel::texunit
