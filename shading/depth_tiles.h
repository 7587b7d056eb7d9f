// Depth alone, of a whole frame: what shadow maps and reprojection need.
#pragma once

#include "raster/frame.h"
#include "raster/visibility.h"
#include "shading/draw_state.h"
#include "shading/executor.h"

#include <functional>
#include <span>

namespace rawtexel::shading {

/// Calls use(tile_x, tile_y, visibility) from any thread for every tile with something in it, drawn as draw_shadow_tile does.
using UseDepthTile = std::function<void(int tile_x, int tile_y, const raster::TileVisibility& visibility)>;
void draw_depth_tiles(const raster::Frame& frame, std::span<const DrawState> draws, Executor& executor, const UseDepthTile& use);

}  // namespace rawtexel::shading
