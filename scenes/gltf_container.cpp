#include "scenes/gltf_container.h"

#include "scenes/load.h"

#include <cstdint>

namespace rawtexel::scenes {
namespace {

using Bytes = std::span<const std::byte>;
constexpr uint32_t kJsonChunk = 0x4e4f534a, kBinChunk = 0x004e4942;  // "JSON", "BIN\0"
constexpr size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;

uint32_t little_endian_32(Bytes bytes, size_t offset) {
    uint32_t value = 0;
    for (size_t i = 4; i-- > 0;) value = value << 8 | uint32_t(bytes[offset + i]);
    return value;
}

std::string_view text_of(Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

struct Chunk {
    uint32_t type;
    Bytes bytes;
};

/// Takes the next chunk off `rest`.
Chunk next_chunk(const std::string& path, Bytes& rest) {
    if (rest.size() < kChunkHeaderBytes)
        throw InputError(path + ": truncated GLB (" + std::to_string(rest.size()) + " bytes left, a chunk header takes 8)");
    const uint32_t length = little_endian_32(rest, 0);
    const Chunk chunk{little_endian_32(rest, 4), rest.subspan(kChunkHeaderBytes)};
    if (length > chunk.bytes.size())
        throw InputError(path + ": truncated GLB (a chunk of " + std::to_string(length) + " bytes, " + std::to_string(chunk.bytes.size()) +
                         " are left)");
    rest = chunk.bytes.subspan(length);
    return {chunk.type, chunk.bytes.first(length)};
}

GltfContainer split_glb(const std::string& path, Bytes file) {
    if (file.size() < kHeaderBytes)
        throw InputError(path + ": truncated GLB (" + std::to_string(file.size()) + " bytes, its header takes 12)");
    const uint32_t version = little_endian_32(file, 4), length = little_endian_32(file, 8);
    if (version != 2) throw InputError(path + ": GLB version " + std::to_string(version) + " (allowed: 2)");
    if (length > file.size() || length < kHeaderBytes)
        throw InputError(path + ": truncated GLB (it declares " + std::to_string(length) + " bytes, the file has " +
                         std::to_string(file.size()) + ")");
    Bytes rest = file.subspan(kHeaderBytes, length - kHeaderBytes);
    const Chunk json = next_chunk(path, rest);
    if (json.type != kJsonChunk) throw InputError(path + ": GLB without JSON (its first chunk must hold it)");
    GltfContainer container{text_of(json.bytes), std::nullopt};
    // Only the second chunk may be the buffer; chunks of other types are to be ignored (glTF 2.0 4.4.3.1).
    if (!rest.empty())
        if (const Chunk second = next_chunk(path, rest); second.type == kBinChunk) container.binary = second.bytes;
    return container;
}

}  // namespace

GltfContainer split_gltf(const std::string& path, Bytes file) {
    if (file.empty()) throw InputError(path + ": empty (0 bytes, a glTF file was expected)");
    if (text_of(file).starts_with("glTF")) return split_glb(path, file);
    return {text_of(file), std::nullopt};
}

}  // namespace rawtexel::scenes
