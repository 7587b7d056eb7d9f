// A texture: a mip pyramid in 4x4 blocks, each decoded or made on first touch into memory the system commits only when touched.
#pragma once

#include "texunit/block_states.h"
#include "texunit/format.h"
#include "texunit/level_table.h"
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

/// What was done, as opposed to asked for. Read when no thread samples.
struct TextureWork {
    uint64_t blocks_decoded = 0;       ///< from the source
    uint64_t blocks_decoded_mips = 0;  ///< made from their parents
    uint64_t bytes_decoded = 0;        ///< of both
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
    Format format() const;          ///< of the source
    const Shape& shape() const;     ///< with all levels, those of the file and those made here
    int source_levels() const;      ///< levels the file holds
    uint64_t stored_bytes() const;  ///< of the source
    uint64_t blocks_total() const;  ///< 4x4 blocks over all levels and slices
    TextureWork work() const;

    const TexelLayout& texel_layout() const;
    const LevelTable& levels() const { return levels_; }
    /// Base of the decoded texels, addressed as texunit/level_table.h says. Only blocks that are ready may be read.
    const std::byte* texels() const { return texels_; }

    /// True once every block of every level is there; `ensure` need not be called then.
    bool complete() const { return ready_levels() == all_levels(); }

    /// Makes sure that the block holding texel (x, y) of `slice` in `level` is decoded; 0 <= x < width of that level, and so on.
    /// One thread decodes, the others wait without running other tasks. Rethrows the TextureError of a damaged source, in every caller.
    void ensure(int level, int slice, int x, int y);

    /// `ensure` for the lanes of `mask`.
    void ensure_wave(const WaveInt& level, const WaveInt& slice, const WaveInt& x, const WaveInt& y, WaveMask mask);

    /// Whether all texels of all levels are one finite colour: of textures of a single block and a single stored level, so that asking
    /// decodes no more than any lookup does; false for all others. Throws as `ensure` does.
    bool is_one_colour();
    /// Makes every block of a level, and those of finer ones that it needs. Throws as `ensure` does.
    void make_level(int level);

    /// The texel as linear RGBA, decoding it if need be. For tools and tests: one texel at a time.
    std::array<float, 4> texel(int level, int slice, int x, int y);

    // What the vector form of `ensure` (texunit/fetch-inl.h) is made of.

    /// Bit l: every block of level l is ready.
    uint32_t ready_levels() const { return ready_levels_.load(std::memory_order_acquire); }
    uint32_t all_levels() const { return (1u << levels_.levels) - 1; }
    /// Bit b: block 64*group + b is ready. The number of a texel's block is its index / 16.
    uint64_t ready_blocks(int32_t group) const { return states_->ready(group); }
    /// Returns once the blocks of `missing`, bits of that group, are ready; makes those that nobody else is making.
    void make_blocks(int32_t group, uint64_t missing);

  private:
    struct Maker;  // whatever is needed to make blocks, and not to read them
    std::unique_ptr<Maker> maker_;
    LevelTable levels_;
    std::unique_ptr<BlockStates> states_;
    const std::byte* texels_ = nullptr;
    std::atomic<uint32_t> ready_levels_{0};
    enum class Colours : uint8_t { Unknown, One, Several };
    std::atomic<Colours> colours_{Colours::Unknown};
};

}  // namespace rawtexel::texunit
