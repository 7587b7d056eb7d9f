#include "scenes/procedural_surface.h"

#include "texunit/memory_source.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <mutex>
#include <utility>
#include <vector>

namespace rawtexel::scenes {
namespace {

using texunit::Format;

constexpr int kTile = 64;  // texels along a side
constexpr int kBlock = 4;
constexpr int kBytesPerTexel = 4;
enum Map { kColorMap, kFinishMap, kNormalMap, kMaps };

using Texel = std::array<uint8_t, kBytesPerTexel>;

uint8_t unorm8(float value) { return uint8_t(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f); }

Texel color_texel(const SurfacePoint& point) {
    return {unorm8(point.color.r), unorm8(point.color.g), unorm8(point.color.b), unorm8(point.alpha)};
}

Texel finish_texel(const SurfacePoint& point) { return {unorm8(point.occlusion), unorm8(point.roughness), unorm8(point.metallic), 255}; }

/// `slope`: metres of height per metre towards +x and towards +y of the image (down).
Texel normal_texel(glm::vec2 slope) {
    const glm::vec3 n = glm::normalize(glm::vec3(-slope.x, slope.y, 1.0f)) * 0.5f + 0.5f;
    return {unorm8(n.x), unorm8(n.y), unorm8(n.z), 255};
}

/// The maps of one tile, until every block of it has been handed out.
struct Tile {
    std::mutex mutex;
    std::array<std::vector<Texel>, kMaps> maps;
    int blocks_left = 0;
};

/// Makes tiles on first touch for all maps of a surface and forgets them when they have been read.
class SurfaceSheet {
  public:
    SurfaceSheet(Surface surface, int maps)
        : surface_(std::move(surface)),
          maps_(maps),
          tiles_x_((surface_.width + kTile - 1) / kTile),
          tiles_(size_t(tiles_x_) * size_t((surface_.height + kTile - 1) / kTile)) {}

    int width() const { return surface_.width; }
    int height() const { return surface_.height; }

    /// The 4x4 texels of a block of `map`, rows and columns outside repeated.
    void block(Map map, int block_x, int block_y, std::array<Texel, kBlock * kBlock>& texels) {
        const int x0 = block_x * kBlock, y0 = block_y * kBlock;
        const int tile_x = x0 / kTile, tile_y = y0 / kTile;
        Tile& tile = tiles_[size_t(tile_y) * size_t(tiles_x_) + size_t(tile_x)];
        const std::lock_guard lock(tile.mutex);
        if (tile.blocks_left == 0) {
            paint(tile_x * kTile, tile_y * kTile, tile);
        }
        for (int i = 0; i < kBlock * kBlock; ++i) {
            const int x = std::min(x0 + i % kBlock, width() - 1) % kTile, y = std::min(y0 + i / kBlock, height() - 1) % kTile;
            texels[size_t(i)] = tile.maps[map][size_t(y * kTile + x)];
        }
        if (--tile.blocks_left == 0) {
            tile.maps = {};
        }
    }

  private:
    SurfacePoint sample(int x, int y) const {
        const glm::vec2 p((float(x) + 0.5f) / float(width()), (float(y) + 0.5f) / float(height()));
        return surface_.at(p - glm::floor(p));
    }

    void paint(int x0, int y0, Tile& tile) const {
        const int columns = std::min(kTile, width() - x0), rows = std::min(kTile, height() - y0);
        for (int map = 0; map < maps_; ++map) {
            tile.maps[size_t(map)].resize(size_t(kTile) * kTile);
        }
        // A rim of one texel around the tile gives the slopes at its border.
        constexpr int kRim = kTile + 2;
        std::vector<float> heights(size_t(kRim) * kRim);
        for (int y = -1; y <= rows; ++y) {
            for (int x = -1; x <= columns; ++x) {
                const bool inside = x >= 0 && y >= 0 && x < columns && y < rows;
                if (!inside && maps_ == 1) {
                    continue;
                }
                const SurfacePoint point = sample(x0 + x, y0 + y);
                heights[size_t((y + 1) * kRim + x + 1)] = point.height;
                if (inside) {
                    tile.maps[kColorMap][size_t(y * kTile + x)] = color_texel(point);
                    if (maps_ > kFinishMap) {
                        tile.maps[kFinishMap][size_t(y * kTile + x)] = finish_texel(point);
                    }
                }
            }
        }
        if (maps_ > kNormalMap) {
            paint_normals(heights, kRim, columns, rows, tile.maps[kNormalMap]);
        }
        tile.blocks_left = maps_ * ((columns + kBlock - 1) / kBlock) * ((rows + kBlock - 1) / kBlock);
    }

    void paint_normals(const std::vector<float>& heights, int pitch, int columns, int rows, std::vector<Texel>& normals) const {
        const glm::vec2 two_texels = 2.0f * surface_.extent / glm::vec2(width(), height());
        for (int y = 0; y < rows; ++y) {
            for (int x = 0; x < columns; ++x) {
                const float* h = heights.data() + (y + 1) * pitch + x + 1;
                normals[size_t(y * kTile + x)] = normal_texel(glm::vec2(h[1] - h[-1], h[pitch] - h[-pitch]) / two_texels);
            }
        }
    }

    Surface surface_;
    int maps_;
    int tiles_x_;
    std::vector<Tile> tiles_;
};

class SurfaceSource final : public texunit::TexelSource {
  public:
    SurfaceSource(std::shared_ptr<SurfaceSheet> sheet, Map map) : sheet_(std::move(sheet)), map_(map) {}

    Format format() const override { return map_ == kColorMap ? Format::RGBA8Srgb : Format::RGBA8Unorm; }
    texunit::Shape shape() const override { return {.width = sheet_->width(), .height = sheet_->height()}; }
    uint64_t stored_bytes() const override { return texunit::stored_bytes(format(), sheet_->width(), sheet_->height()); }

    void decode_block(int, int, int block_x, int block_y, std::byte* texels) override {
        std::array<Texel, kBlock * kBlock> block;
        sheet_->block(map_, block_x, block_y, block);
        for (const Texel& texel : block) {
            texunit::store_texel(format(), reinterpret_cast<const std::byte*>(texel.data()), texels);
            texels += kBytesPerTexel;
        }
    }

  private:
    std::shared_ptr<SurfaceSheet> sheet_;
    Map map_;
};

}  // namespace

Surface square_surface(float extent, int texels, std::function<SurfacePoint(glm::vec2 p)> at) {
    return {texels, texels, glm::vec2(extent), std::move(at)};
}

SurfaceMaps make_surface_maps(Surface surface) {
    const auto sheet = std::make_shared<SurfaceSheet>(std::move(surface), int(kMaps));
    return {std::make_unique<SurfaceSource>(sheet, kColorMap), std::make_unique<SurfaceSource>(sheet, kFinishMap),
            std::make_unique<SurfaceSource>(sheet, kNormalMap)};
}

std::unique_ptr<texunit::TexelSource> make_color_map(Surface surface) {
    return std::make_unique<SurfaceSource>(std::make_shared<SurfaceSheet>(std::move(surface), 1), kColorMap);
}

}  // namespace rawtexel::scenes
