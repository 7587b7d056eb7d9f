#include "shading/depth_tiles.h"

#include "shading/tile.h"

#include <vector>

namespace rawtexel::shading {

void draw_depth_tiles(const raster::Frame& frame, std::span<const DrawState> draws, Executor& executor, const UseDepthTile& use) {
    std::vector<raster::TileVisibility> tiles(size_t(executor.threads()));
    executor.parallel_for(int64_t(frame.tiles_x()) * frame.tiles_y(), [&](int64_t index, int worker) {
        const int tile_x = int(index % frame.tiles_x()), tile_y = int(index / frame.tiles_x());
        if (frame.bin(tile_x, tile_y).empty()) return;
        raster::TileVisibility& tile = tiles[size_t(worker)];
        draw_shadow_tile(frame, draws, tile_x, tile_y, tile);
        use(tile_x, tile_y, tile);
    });
}

}  // namespace rawtexel::shading
