// A texture: a mip pyramid in 4x4 blocks, each decoded or made on first touch into memory the system commits only when touched.
#pragma once

#include "texunit/format.h"
#include "texunit/texel_source.h"
#include "texunit/wave.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

namespace rawtexel::texunit {

/// How levels that the source lacks are stored: rounded to the image's own format as drivers do, or kept in float.
enum class MipStorage { Source, Float };

struct TextureOptions {
    MipStorage mip_storage = MipStorage::Source;
};

/// What select and gather need to know of every level, as arrays for vector look-ups.
/// The texel (x, y) of slice s lies at texel index  offset[l] + s*slice_stride[l] + column(x) + row(y, l),  where
/// column(x) = (x >> page_shift_x) * page_texels + spread of the low bits and row likewise: see texunit/address-inl.h.
struct LevelTable {
    alignas(64) std::array<int32_t, 16> width{}, height{}, depth{};   ///< texels
    alignas(64) std::array<int32_t, 16> offset{};                     ///< texels from the base of the storage
    alignas(64) std::array<int32_t, 16> pages_x{};                    ///< 4 KiB pages along x
    alignas(64) std::array<int32_t, 16> slice_stride{};               ///< texels
    int32_t levels = 1;
};

/// What was done, as opposed to asked for. Read when no thread samples.
struct TextureWork {
    uint64_t blocks_decoded = 0;        ///< from the source
    uint64_t blocks_decoded_mips = 0;   ///< made from their parents
    uint64_t bytes_decoded = 0;         ///< of both
};

/// Thread-safe for sampling. The shape and the format are fixed at construction; texels appear as they are asked for.
class Texture {
  public:
    /// Reserves address space for the full pyramid; reads nothing. Throws TextureError when an extent exceeds kMaxExtent.
    Texture(std::string name, std::unique_ptr<TexelSource> source, const TextureOptions& options = {});
    ~Texture();
    Texture(const Texture&) = delete;
    Texture& operator=(const Texture&) = delete;

    const std::string& name() const;
    Format format() const;              ///< of the source
    const Shape& shape() const;         ///< with all levels, those of the file and those made here
    int source_levels() const;          ///< levels the file holds
    uint64_t stored_bytes() const;      ///< of the source
    uint64_t blocks_total() const;      ///< 4x4 blocks over all levels and slices
    TextureWork work() const;

    const TexelLayout& texel_layout() const;
    const LevelTable& levels() const;
    /// Base of the decoded texels. Only blocks that `ensure` returned for may be read.
    const std::byte* texels() const;

    /// True once every block of every level is there; `ensure` need not be called then.
    bool complete() const;

    /// Makes sure that the block holding texel (x, y) of `slice` in `level` is decoded; 0 <= x < width of that level, and so on.
    /// One thread decodes, the others wait without running other tasks. Rethrows the TextureError of a damaged source, in every caller.
    void ensure(int level, int slice, int x, int y);

    /// `ensure` for the lanes of `mask`.
    void ensure_wave(const WaveInt& level, const WaveInt& slice, const WaveInt& x, const WaveInt& y, WaveMask mask);

    /// The texel as linear RGBA, decoding it if need be. For tools and tests: one texel at a time.
    std::array<float, 4> texel(int level, int slice, int x, int y);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rawtexel::texunit
