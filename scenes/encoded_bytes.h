// The bytes of encoded images that a scene refers to, read when they are asked for.
#pragma once

#include "texunit/containers.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rawtexel::scenes {

using EncodedBytes = std::shared_ptr<const texunit::ByteSource>;

/// A regular file, opened anew by every read, since a scene may name more files than a process may hold open. `name` stands for it in
/// messages. Throws TextureError when it cannot be opened; so do reads of a file that is gone or whose size has changed.
EncodedBytes bytes_of_file(std::string name, std::string path);

/// `size` bytes of `whole` at `offset`, which must lie within it, under a name of their own.
EncodedBytes part_of(std::string name, EncodedBytes whole, uint64_t offset, uint64_t size);

/// The first bytes, at most `count` of them. Throws TextureError.
std::vector<std::byte> leading_bytes(const texunit::ByteSource& bytes, uint64_t count);
std::vector<std::byte> all_bytes(const texunit::ByteSource& bytes);

}  // namespace rawtexel::scenes
