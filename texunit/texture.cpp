#include "texunit/texture.h"

#include "texunit/mip_block.h"
#include "texunit/reserved_memory.h"
#include "texunit/texel_value.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <exception>
#include <utility>
#include <vector>

namespace rawtexel::texunit {
namespace {

void check_extents(const std::string& name, const Shape& shape) {
    for (const auto& [axis, extent] : {std::pair{"width", shape.width}, {"height", shape.height}, {"depth", shape.depth}}) {
        if (extent >= 1 && extent <= kMaxExtent) continue;
        const std::string limit = std::to_string(kMaxExtent);
        throw TextureError(name + ": " + axis + " of " + std::to_string(extent) + " texels (1 to " + limit + " are allowed)");
    }
    if (shape.layers < 1) throw TextureError(name + ": " + std::to_string(shape.layers) + " layers (at least 1 is allowed)");
}

/// The pyramid that a source begins, continued down to one texel.
Shape full_pyramid(const std::string& name, Shape held) {
    check_extents(name, held);
    held.levels = full_level_count(held.width, held.height, held.depth);
    return held;
}

LevelTable lay_out(const std::string& name, const Shape& shape, StorageClass storage) {
    LevelTable table;
    if (lay_out_levels(shape, storage, table)) return table;
    throw TextureError(name + ": " + std::to_string(shape.width) + "x" + std::to_string(shape.height) + "x" + std::to_string(shape.depth) +
                       " texels in " + std::to_string(shape.layers) + " layers (8 GiB decoded are the limit)");
}

uint64_t blocks_along(int extent) { return (uint64_t(extent) + 3) / 4; }

}  // namespace

struct Texture::Maker {
    std::string name;
    std::unique_ptr<TexelSource> source;
    TexelLayout source_layout;
    TexelLayout layout;
    TexelEncoder encoder;
    Shape shape;
    int source_levels;
    LevelTable levels;
    ReservedMemory memory;
    std::array<std::atomic<uint64_t>, kMaxLevels> blocks_left;  // per level
    std::atomic<uint64_t> decoded{0}, averaged{0};

    Maker(std::string texture_name, std::unique_ptr<TexelSource> texels, const TexelLayout& stored)
        : name(std::move(texture_name)),
          source(std::move(texels)),
          source_layout(texunit::layout(source->format(), source->bc_rounding())),
          layout(stored),
          encoder(stored),
          shape(full_pyramid(name, source->shape())),
          source_levels(std::min(source->shape().levels, shape.levels)),
          levels(lay_out(name, shape, stored.storage)),
          memory(levels.texels * uint64_t(texel_bytes())) {
        for (int level = 0; level < shape.levels; ++level) blocks_left[size_t(level)] = blocks_in(level);
    }

    int texel_bytes() const { return bytes_per_texel(layout.storage); }
    uint64_t slices(int level) const { return uint64_t(shape.layers) * uint64_t(level_extent(shape.depth, level)); }
    uint64_t blocks_in(int level) const {
        return blocks_along(level_extent(shape.width, level)) * blocks_along(level_extent(shape.height, level)) * slices(level);
    }
    /// Of a level whose blocks are all there.
    void join_pages(int level) {
        const auto l = size_t(level);
        const auto first = uint64_t(levels.offset[l]), last = first + uint64_t(levels.slice_stride[l]) * slices(level);
        memory.join_pages(first * uint64_t(texel_bytes()), last * uint64_t(texel_bytes()));
    }
    std::byte* block_texels(int32_t block) const { return memory.data() + int64_t(block) * kTexelsPerBlock * texel_bytes(); }

    void fill(Texture& texture, const BlockPosition& at, std::byte* out);
    void decode(const BlockPosition& at, std::byte* out);
    void average(Texture& texture, const BlockPosition& at, std::byte* out);
};

void Texture::Maker::fill(Texture& texture, const BlockPosition& at, std::byte* out) {
    if (at.level < source_levels) {
        decode(at, out);
        decoded.fetch_add(1, std::memory_order_relaxed);
    } else {
        average(texture, at, out);
        averaged.fetch_add(1, std::memory_order_relaxed);
    }
}

void Texture::Maker::decode(const BlockPosition& at, std::byte* out) {
    if (layout.storage == source_layout.storage) {
        source->decode_block(at.level, at.slice, at.x, at.y, out);
        return;
    }
    // MipStorage::Float: the same texels, widened.
    assert(layout.storage == StorageClass::Float4);
    alignas(16) std::array<std::byte, kTexelsPerBlock * sizeof(float[4])> stored;
    source->decode_block(at.level, at.slice, at.x, at.y, stored.data());
    for (size_t i = 0; i < kTexelsPerBlock; ++i) {
        const std::array<float, 4> value = load_texel(source_layout, stored.data() + i * size_t(bytes_per_texel(source_layout.storage)));
        std::copy_n(reinterpret_cast<const std::byte*>(value.data()), sizeof(value), out + i * sizeof(value));
    }
}

void Texture::Maker::average(Texture& texture, const BlockPosition& at, std::byte* out) {
    const int parent = at.level - 1;
    const FinerLevel finer{level_extent(shape.width, parent), level_extent(shape.height, parent), level_extent(shape.depth, parent)};
    // Slices are depth slices of one volume or independent layers, never both.
    const bool volume = shape.depth > 1;
    const TexelBox box = texels_under(finer, at.x, at.y, volume ? at.slice : 0);

    std::array<std::array<float, 4>, kMostTexelsUnderBlock> under;
    size_t count = 0;
    for (int z = box.z0; z < box.z1; ++z) {
        const int slice = volume ? z : at.slice;
        for (int y = box.y0; y < box.y1; ++y) {
            for (int x = box.x0; x < box.x1; ++x) under[count++] = texture.texel(parent, slice, x, y);
        }
    }
    make_mip_block(finer, at.x, at.y, volume ? at.slice : 0, under.data(), encoder, texel_bytes(), out);
}

Texture::Texture(std::string name, std::unique_ptr<TexelSource> source, const TextureOptions& options) {
    const TexelLayout& stored =
        options.mip_storage == MipStorage::Float ? layout(Format::RGBA32Float) : layout(source->format(), source->bc_rounding());
    try {
        maker_ = std::make_unique<Maker>(name, std::move(source), stored);
        levels_ = maker_->levels;
        states_ = std::make_unique<BlockStates>(levels_.texels / kTexelsPerBlock);
    } catch (const std::bad_alloc&) {
        throw TextureError(name + ": the system refuses the address space for its decoded texels");
    }
    texels_ = maker_->memory.data();
}

Texture::~Texture() = default;

const std::string& Texture::name() const { return maker_->name; }
Format Texture::format() const { return maker_->source->format(); }
const Shape& Texture::shape() const { return maker_->shape; }
int Texture::source_levels() const { return maker_->source_levels; }
uint64_t Texture::stored_bytes() const { return maker_->source->stored_bytes(); }
const TexelLayout& Texture::texel_layout() const { return maker_->layout; }

uint64_t Texture::blocks_total() const {
    uint64_t blocks = 0;
    for (int level = 0; level < maker_->shape.levels; ++level) blocks += maker_->blocks_in(level);
    return blocks;
}

TextureWork Texture::work() const {
    const uint64_t decoded = maker_->decoded, averaged = maker_->averaged;
    return {decoded, averaged, (decoded + averaged) * kTexelsPerBlock * uint64_t(maker_->texel_bytes())};
}

void Texture::make_blocks(int32_t group, uint64_t missing) {
    // Claims are taken one at a time and finished before waiting. While a thread waits for a block of one level it therefore holds claims
    // of coarser levels only, so waiting always points to finer levels and cannot go round in a circle.
    uint64_t others = 0;
    for (uint64_t bits = missing; bits != 0; bits &= bits - 1) {
        const int32_t block = group * BlockStates::kGroup + std::countr_zero(bits);
        if (!states_->claim(block)) {
            others |= bits & -bits;
            continue;
        }
        const BlockPosition at = locate_block(levels_, maker_->layout.storage, block);
        try {
            maker_->fill(*this, at, maker_->block_texels(block));
        } catch (const std::exception& error) {
            states_->fail(block, error.what());
            throw TextureError(error.what());
        } catch (...) {
            // Whatever it was, nobody may wait for this block for ever.
            states_->fail(block, maker_->name + ": unknown failure of its source");
            throw;
        }
        states_->publish(block);
        if (maker_->blocks_left[size_t(at.level)].fetch_sub(1, std::memory_order_acq_rel) == 1) {
            ready_levels_.fetch_or(1u << at.level, std::memory_order_release);
            maker_->join_pages(at.level);
        }
    }
    for (; others != 0; others &= others - 1) states_->wait(group * BlockStates::kGroup + std::countr_zero(others));
}

void Texture::ensure(int level, int slice, int x, int y) {
    assert(level >= 0 && level < levels_.levels);
    assert(x >= 0 && x < levels_.width[size_t(level)] && y >= 0 && y < levels_.height[size_t(level)]);
    assert(slice >= 0 && uint64_t(slice) < maker_->slices(level));
    const int32_t block = texel_index(levels_, maker_->layout.storage, level, slice, x, y) / kTexelsPerBlock;
    const int32_t group = block / BlockStates::kGroup;
    const uint64_t bit = uint64_t{1} << (block % BlockStates::kGroup);
    if ((ready_blocks(group) & bit) == 0) make_blocks(group, bit);
}

void Texture::ensure_wave(const WaveInt& level, const WaveInt& slice, const WaveInt& x, const WaveInt& y, WaveMask mask) {
    for (; mask != 0; mask &= mask - 1) {
        const int i = std::countr_zero(mask);
        ensure(level[i], slice[i], x[i], y[i]);
    }
}

bool Texture::is_one_colour() {
    if (const Colours known = colours_.load(std::memory_order_acquire); known != Colours::Unknown) return known == Colours::One;
    const Shape& shape = maker_->shape;
    bool one = shape.width <= 4 && shape.height <= 4 && shape.depth == 1 && shape.layers == 1 && maker_->source_levels == 1;
    if (one) {
        const std::array<float, 4> first = texel(0, 0, 0, 0);
        one = std::ranges::all_of(first, [](float value) { return std::isfinite(value); });
        for (int y = 0; y < shape.height; ++y)
            for (int x = 0; x < shape.width; ++x) one = one && texel(0, 0, x, y) == first;
    }
    colours_.store(one ? Colours::One : Colours::Several, std::memory_order_release);
    return one;
}

void Texture::make_level(int level) {
    const int width = levels_.width[size_t(level)], height = levels_.height[size_t(level)];
    for (int slice = 0; uint64_t(slice) < maker_->slices(level); ++slice)
        for (int y = 0; y < height; y += 4)
            for (int x = 0; x < width; x += 4) ensure(level, slice, x, y);
}

std::array<float, 4> Texture::texel(int level, int slice, int x, int y) {
    ensure(level, slice, x, y);
    const int32_t index = texel_index(levels_, maker_->layout.storage, level, slice, x, y);
    return load_texel(maker_->layout, texels_ + int64_t(index) * maker_->texel_bytes());
}

}  // namespace rawtexel::texunit
