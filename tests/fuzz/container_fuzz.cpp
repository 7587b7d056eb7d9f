// What a fuzzer calls: bytes as a texture file. It opens, decodes some blocks and makes some levels, or refuses with a TextureError.
#include "texunit/containers.h"
#include "texunit/texture.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace rawtexel::texunit;

constexpr uint64_t kMostBytes = uint64_t{16} << 20;

std::unique_ptr<TexelSource> open(std::vector<std::byte> bytes) {
    // The last byte, which no header needs, chooses the rounding.
    const auto rounding = kBcRoundings[bytes.empty() ? 0 : size_t(bytes.back()) % kBcRoundings.size()];
    const ContainerOptions options{.max_texture_bytes = kMostBytes, .bc_rounding = rounding};
    auto memory = open_memory("fuzzed", std::move(bytes));
    return container_kind(*memory) == ContainerKind::Ktx2 ? open_ktx2(memory, options) : open_dds(memory, options);
}

/// The corners of the first and last slice of every level.
void decode_corners(TexelSource& source) {
    alignas(64) std::byte texels[256];
    const Shape shape = source.shape();
    for (int level = 0; level < shape.levels; ++level) {
        const int slices = shape.depth > 1 ? level_extent(shape.depth, level) : shape.layers;
        const int last_x = (level_extent(shape.width, level) - 1) / 4, last_y = (level_extent(shape.height, level) - 1) / 4;
        for (const int slice : {0, slices - 1}) {
            source.decode_block(level, slice, 0, 0, texels);
            source.decode_block(level, slice, last_x, last_y, texels);
        }
    }
}

/// The whole pyramid, where it is small.
void sample_all(std::unique_ptr<TexelSource> source) {
    const Shape shape = source->shape();
    if (int64_t{shape.width} * shape.height * shape.depth * shape.layers > 4096) return;
    Texture texture("fuzzed", std::move(source));
    for (int slice = 0; slice < texture.shape().layers; ++slice) texture.texel(texture.shape().levels - 1, slice, 0, 0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const auto* const bytes = reinterpret_cast<const std::byte*>(data);
    try {
        std::unique_ptr<TexelSource> source = open({bytes, bytes + size});
        if (source->stored_bytes() > kMostBytes) std::abort();
        decode_corners(*source);
        sample_all(std::move(source));
    } catch (const TextureError& error) {
        // One line that begins with the file's name.
        const std::string what = error.what();
        if (!what.starts_with("fuzzed: ") || what.find('\n') != std::string::npos) std::abort();
    }
    return 0;
}
