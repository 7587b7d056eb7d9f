// From the clusters that may be seen to triangles ready for coverage: transform, cull, clip, snap, planes, in batches.
#pragma once

#include "raster/frame.h"
#include "raster/frame_memory.h"
#include "raster/occlusion.h"
#include "raster/tile_grid.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace rawtexel::raster {

/// A cluster that no test has left out.
struct VisibleCluster {
    uint32_t draw, cluster;
    float nearest;    ///< no depth of it is greater
    bool unclipped;   ///< ClusterView::unclipped
    CellRange cells;  ///< that it may be seen in; of those that are not clipped
};

inline constexpr uint32_t kBatchClusters = 32;  ///< 2048 triangles: enough to outweigh starting a task, and half of a block

/// Tile `tile` is to draw triangle `triangle` of the batch.
struct BinEntry {
    uint32_t tile, triangle;
};

/// What one batch of clusters became.
struct SetupBatch {
    SetupTriangle* triangles = nullptr;   ///< one block: whole triangles, then pieces
    uint32_t count = 0;                   ///< in the block
    std::vector<SetupTriangle> overflow;  ///< pieces beyond the block, numbered on from `capacity`
    std::vector<std::array<Plane, 3>> piece_planes;
    std::vector<BinEntry> entries;
    FrameCounts counts;
};

struct SetupInputs {
    const FrameOptions& options;
    const TileGrid& grid;
    std::span<const Draw> draws;  ///< all with clusters
};

/// Sets the clusters up in their order. The batch's block has room for `capacity` triangles, no fewer than the clusters'.
void set_up_clusters(const SetupInputs& inputs, std::span<const VisibleCluster> clusters, uint32_t capacity, SetupBatch& batch);

}  // namespace rawtexel::raster
