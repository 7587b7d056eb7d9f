// The texel source behind every container: levels of slices of texels or blocks, wherever the container puts them.
#pragma once

#include "texunit/container_texel.h"
#include "texunit/containers.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rawtexel::texunit {

/// Where a level's texels are: slice s (array layer, face of a cube, or depth slice) begins at offset + s*slice_stride.
struct LevelPlace {
    std::shared_ptr<const ByteSource> bytes;
    uint64_t offset = 0;
    uint64_t slice_stride = 0;
};

/// Bytes of one slice of `width` x `height` texels in the file. At most 2^32 within kMaxExtent.
uint64_t slice_bytes(const FileTexel& texel, int width, int height);

/// Bytes of all slices of one level, and of all levels.
uint64_t level_bytes(const FileTexel& texel, const Shape& shape, int level);
uint64_t image_bytes(const FileTexel& texel, const Shape& shape);

/// `shape.levels` places, all of them inside their bytes.
std::unique_ptr<TexelSource> make_container_source(const FileTexel& texel, const Shape& shape, std::vector<LevelPlace> levels);

// What a header says, checked. `name` is the file's, for the message of the TextureError.
[[noreturn]] void refuse(const std::string& name, const std::string& what);
int checked_extent(const std::string& name, const char* axis, uint32_t extent);
int checked_layers(const std::string& name, uint64_t layers);
int checked_levels(const std::string& name, uint32_t levels, const Shape& shape);
void check_texture_bytes(const std::string& name, uint64_t bytes, const ContainerOptions& options);

}  // namespace rawtexel::texunit
