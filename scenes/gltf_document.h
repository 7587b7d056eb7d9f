// A glTF file taken apart: its JSON checked and parsed, its buffers and images as bytes.
#pragma once

#include "scenes/encoded_bytes.h"
#include "scenes/load.h"

#include <tiny_gltf.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace rawtexel::scenes {

/// The bytes of one buffer, at least as many as the document declares; empty when the file says that they come from elsewhere
/// (a compression extension) and nothing may read them.
struct GltfBuffer {
    std::shared_ptr<const void> owner;
    std::span<const std::byte> bytes;
    uint64_t declared_bytes = 0;
    EncodedBytes source;         ///< where `bytes` came from: file or memory,
    uint64_t source_offset = 0;  ///< and at which byte of it
};

/// An image as the file holds it. Its bytes stay where they are.
struct GltfImage {
    std::string name;       ///< for messages and the texture: the image's own name, else its file's, else its number
    std::string mime_type;  ///< as declared; may be empty
    std::string file_name;  ///< empty when it comes from a data URI or a buffer
    EncodedBytes encoded;
};

/// Memory that a file may ask for in all: hostile files can name the same bytes many times over.
class MemoryAllowance {
  public:
    explicit MemoryAllowance(std::string path) : path_(std::move(path)) {}
    void grant(uint64_t file_bytes) { left_ += kPerFileByte * file_bytes; }
    /// Throws InputError when the file has used up what its size allows.
    void spend(uint64_t bytes);

  private:
    static constexpr uint64_t kFree = uint64_t{256} << 20, kPerFileByte = 64;
    std::string path_;
    uint64_t left_ = kFree;
};

struct GltfDocument {
    std::string path;
    /// Without buffers and images, which are below. Types and indices are checked; what they point to is not.
    tinygltf::Model model;
    std::vector<GltfBuffer> buffers;
    std::vector<GltfImage> images;
    std::shared_ptr<MemoryAllowance> memory;

    /// InputError "PATH: what".
    [[noreturn]] void fail(const std::string& what) const;
    /// The bytes of a buffer view; throws InputError when its buffer has none.
    std::span<const std::byte> view(int buffer_view) const;
};

/// Reads the file and every buffer it names, and opens every image. Throws InputError and, where they cannot be read, TextureError.
GltfDocument read_gltf_document(const std::string& path, const LoadOptions& options);

}  // namespace rawtexel::scenes
