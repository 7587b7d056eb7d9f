#include "texunit/touched_lines.h"

#include <bit>
#include <memory>
#include <optional>

namespace rawtexel::texunit {
namespace {

constexpr int kSmallestLine = kLineBytes.front();

/// Distinct lines of one level in one layout.
class LineSet {
  public:
    LineSet(AddressLayout layout, int columns, int rows, int slices, int bytes_per_element)
        : addresses_(layout, columns, rows, bytes_per_element), bits_((uint64_t(slices) * addresses_.bytes() / kSmallestLine + 63) / 64) {}

    void add(int slice, int column, int row) {
        const uint64_t line = (uint64_t(slice) * addresses_.bytes() + addresses_.offset(column, row)) / kSmallestLine;
        bits_[line / 64] |= uint64_t{1} << line % 64;
    }

    LineCounts count() const {
        LineCounts counts;
        for (uint64_t lines : bits_) {
            if (lines == 0) continue;
            // A line of twice the size is touched where one of its halves is.
            constexpr std::array<uint64_t, kLineBytes.size()> kFirstOf = {~uint64_t{0}, 0x5555555555555555u, 0x1111111111111111u};
            for (size_t size = 0; size < kLineBytes.size(); ++size) {
                if (size > 0) lines |= lines >> (size_t{1} << (size - 1));
                counts.lines[size] += uint64_t(std::popcount(lines & kFirstOf[size]));
            }
        }
        return counts;
    }

  private:
    SliceAddresses addresses_;
    std::vector<uint64_t> bits_;
};

using LineSets = std::vector<LineSet>;  ///< one for each of kAddressLayouts

/// Gathers the texels of one level.
class LevelGatherer {
  public:
    LevelGatherer(const Texture& texture, int level)
        : bytes_per_texel_(bytes_per_texel(texture.texel_layout().storage)), block_extent_(info(texture.format()).block_extent) {
        const auto l = size_t(level);
        const LevelTable& table = texture.levels();
        const int width = table.width[l], height = table.height[l];
        const int slices = texture.shape().layers * table.depth[l];
        const auto blocks = [&](int extent) { return (extent + block_extent_ - 1) / block_extent_; };
        for (const AddressLayout layout : kAddressLayouts) {
            decoded_.emplace_back(layout, width, height, slices, bytes_per_texel_);
            stored_.emplace_back(layout, blocks(width), blocks(height), slices, info(texture.format()).bytes_per_block);
        }
    }

    /// The texels of a 4x4 block, one bit each, row by row.
    void add_block(const BlockPosition& at, uint32_t texels) {
        for (uint32_t rest = texels; rest != 0; rest &= rest - 1) {
            const int texel = std::countr_zero(rest);
            const int x = 4 * at.x + texel % 4, y = 4 * at.y + texel / 4;
            for (LineSet& lines : decoded_) lines.add(at.slice, x, y);
            if (block_extent_ == 1) add_stored(at.slice, x, y);
        }
        if (block_extent_ == 4) add_stored(at.slice, at.x, at.y);
        ++lines_.blocks_touched;
        lines_.texels_unique += uint64_t(std::popcount(texels));
    }

    /// The same two blocks, side by side in our own storage.
    void add_own_lines(uint32_t texels) {
        for (size_t size = 0; size < kLineBytes.size(); ++size) {
            const int texels_per_line = kLineBytes[size] / bytes_per_texel_;
            const uint32_t line = texels_per_line == 32 ? ~0u : (1u << texels_per_line) - 1;
            for (int first = 0; first < 32; first += texels_per_line) lines_.decoded.lines[size] += (texels >> first & line) != 0;
        }
    }

    TouchedLines take() {
        lines_.texel_bytes = lines_.texels_unique * uint64_t(bytes_per_texel_);
        for (size_t i = 0; i < kAddressLayouts.size(); ++i) {
            lines_.decoded_as[i] = decoded_[i].count();
            lines_.stored_as[i] = stored_[i].count();
        }
        lines_.stored = lines_.stored_as[size_t(AddressLayout::Linear)];
        return lines_;
    }

  private:
    void add_stored(int slice, int column, int row) {
        for (LineSet& lines : stored_) lines.add(slice, column, row);
    }

    int bytes_per_texel_, block_extent_;
    LineSets decoded_, stored_;
    TouchedLines lines_;
};

}  // namespace

LineCounts& LineCounts::operator+=(const LineCounts& other) {
    for (size_t size = 0; size < lines.size(); ++size) lines[size] += other.lines[size];
    return *this;
}

TouchedLines& TouchedLines::operator+=(const TouchedLines& other) {
    texels_unique += other.texels_unique;
    blocks_touched += other.blocks_touched;
    texel_bytes += other.texel_bytes;
    decoded += other.decoded;
    stored += other.stored;
    for (size_t i = 0; i < kAddressLayouts.size(); ++i) {
        decoded_as[i] += other.decoded_as[i];
        stored_as[i] += other.stored_as[i];
    }
    return *this;
}

std::vector<TouchedLines> measure_touched(const Texture& texture, const TouchedTexels& touched, size_t index) {
    std::vector<TouchedLines> levels(size_t(texture.shape().levels));
    // Indices ascend, and so do the levels that they belong to.
    std::optional<LevelGatherer> gatherer;
    int level = -1;
    touched.for_each_group(index, [&](int32_t first, uint32_t texels) {
        constexpr uint32_t kBlock = (1u << kTexelsPerBlock) - 1;
        for (int half = 0; half < 2; ++half) {
            const uint32_t in_block = texels >> (half * kTexelsPerBlock) & kBlock;
            if (in_block == 0) continue;
            const BlockPosition at = locate_block(texture.levels(), texture.texel_layout().storage, first / kTexelsPerBlock + half);
            if (at.level != level) {
                if (gatherer) levels[size_t(level)] = gatherer->take();
                level = at.level;
                gatherer.emplace(texture, level);
            }
            gatherer->add_block(at, in_block);
        }
        gatherer->add_own_lines(texels);
    });
    if (gatherer) levels[size_t(level)] = gatherer->take();
    return levels;
}

}  // namespace rawtexel::texunit
