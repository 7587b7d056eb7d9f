// Where texels come from: anything that can answer the value of the texels of one 4x4 block.
#pragma once

#include "texunit/format.h"

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace rawtexel::texunit {

/// Damage found in a texture's data. what() is one line that names the file, what was found and what is allowed.
class TextureError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Extents of level 0 and what else the source holds. Everything is at least 1.
struct Shape {
    int width = 1, height = 1, depth = 1;  ///< texels
    int layers = 1;                        ///< array layers; a cube map has 6 per cube
    int levels = 1;                        ///< of the full pyramid down to 1x1x1 unless the source says otherwise
    bool cube = false;

    constexpr int faces() const { return cube ? 6 : 1; }
    /// Members of the array: whole cubes of cube maps, layers of other textures.
    constexpr int cubes() const { return layers / faces(); }

    bool operator==(const Shape&) const = default;
};

/// Extent of level `level` along one axis: max(1, extent >> level).
constexpr int level_extent(int extent, int level) { return extent >> level > 0 ? extent >> level : 1; }

/// Slices of level `level`: array layers, or the depth of that level.
constexpr int slice_count(const Shape& shape, int level) { return shape.depth > 1 ? level_extent(shape.depth, level) : shape.layers; }

/// Levels of a full pyramid: 1 + floor(log2(largest extent)).
int full_level_count(int width, int height, int depth = 1);

inline constexpr int kMaxExtent = 16384;  ///< texels along any axis; larger is refused
inline constexpr int kMaxLevels = 15;     ///< 1 + log2(kMaxExtent)

/// A lazily read texture image. Construction parses and checks headers only; texels are read when first asked for.
/// `decode_block` is called from many threads, at most once per block at a time.
class TexelSource {
  public:
    virtual ~TexelSource() = default;

    virtual Format format() const = 0;
    /// Extents; `levels` counts the levels the source itself holds (the texture makes the rest).
    virtual Shape shape() const = 0;
    /// Bytes of the stored image, all its levels and layers, as the file or memory holds them.
    virtual uint64_t stored_bytes() const = 0;
    /// The part of them that level `level` takes, all its slices; as many as `format` takes unless the source says otherwise.
    virtual uint64_t level_bytes(int level) const;
    /// How the colours of BC1, BC2 and BC3 are rounded when decoded.
    virtual BcRounding bc_rounding() const { return BcRounding::Exact; }

    /// Decodes the 4x4 texels of block (`block_x`, `block_y`) of slice `slice` (array layer or depth slice) of `level` into
    /// `texels`: 16 texels of layout(format(), bc_rounding()), row by row. Texels outside the level repeat its last column and row.
    /// Throws TextureError when the file is damaged or unreadable.
    virtual void decode_block(int level, int slice, int block_x, int block_y, std::byte* texels) = 0;
};

}  // namespace rawtexel::texunit
