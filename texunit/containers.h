// Files that hold texels ready for a texture unit: DDS and KTX2.
#pragma once

#include "texunit/texel_source.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace rawtexel::texunit {

/// Bytes to read from, a file or memory. Sizes come from the actual file, never from a header inside it.
class ByteSource {
  public:
    virtual ~ByteSource() = default;
    virtual uint64_t size() const = 0;
    /// Reads exactly `out.size()` bytes at `offset`; throws TextureError naming the file when they are not there. Thread-safe.
    virtual void read(uint64_t offset, std::span<std::byte> out) const = 0;
    virtual const std::string& name() const = 0;
    /// Whether `read` only copies memory, so that keeping what was read gains nothing.
    virtual bool in_memory() const { return false; }
};

/// A regular file read with pread; directories, devices and pipes are refused with a TextureError.
std::shared_ptr<ByteSource> open_file(const std::string& path);
/// Memory that the caller hands over.
std::shared_ptr<ByteSource> open_memory(std::string name, std::vector<std::byte> bytes);

/// What the first bytes say.
enum class ContainerKind { None, Dds, Ktx2 };
ContainerKind container_kind(const ByteSource& bytes);

/// How a file is opened.
struct ContainerOptions {
    uint64_t max_texture_bytes = uint64_t{4} << 30;  ///< a limit against hostile files: stored bytes after decompression
    BcRounding bc_rounding = BcRounding::Exact;
};

/// Parse and check headers against the bytes that are really there; payload is read in pages when a block is first asked for, and
/// kept. Texels of formats that are not texunit's own are read as the nearest that is: 8-bit and shorter channels exactly, channels of
/// 3, 5, 6, 7 or 9 to 15 bits as 16-bit codes rounded to nearest, 16-bit signed codes as floats, shared-exponent and 10- and 11-bit
/// floats as halves, exactly; luminance is spread over red, green and blue; RXGB's red comes from BC3's alpha.
/// Throw TextureError: not that container, truncated, an extent of zero or above kMaxExtent, more bytes than `options` allows, a format or
/// a supercompression that is not supported (named).
std::unique_ptr<TexelSource> open_dds(std::shared_ptr<const ByteSource> bytes, const ContainerOptions& options = {});
std::unique_ptr<TexelSource> open_ktx2(std::shared_ptr<const ByteSource> bytes, const ContainerOptions& options = {});

/// The same texels read as sRGB or as linear data, whatever the file declares; a source whose format has no such pair is returned as it is.
std::unique_ptr<TexelSource> reinterpret_srgb(std::unique_ptr<TexelSource> source, bool srgb);

}  // namespace rawtexel::texunit
