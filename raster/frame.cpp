#include "raster/frame.h"

#include "raster/screen_vertex.h"
#include "raster/tile_grid.h"
#include "raster/triangle_setup.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace rawtexel::raster {

namespace {

constexpr uint64_t kBatchTriangles = 4096;  ///< set up by one task; enough to outweigh starting it
constexpr uint64_t kMaxBinRanges = 64;      ///< bounds the bins' counters, one per range and tile

/// The draws in the order of their setup indices, opaque first, each class in scene order, as one long run of triangles.
class TriangleRun {
  public:
    explicit TriangleRun(std::span<const Draw> draws) : draws_(draws), order_(draws.size()), start_(draws.size() + 1) {
        std::iota(order_.begin(), order_.end(), 0u);
        const auto key = [&](uint32_t i) { return std::tuple(draws[i].coverage, draws[i].first_triangle_id, i); };
        std::sort(order_.begin(), order_.end(), [&](uint32_t i, uint32_t j) { return key(i) < key(j); });
        for (size_t i = 0; i < order_.size(); ++i) start_[i + 1] = start_[i] + draws[order_[i]].triangle_count;
    }

    uint64_t size() const { return start_.back(); }

    /// Calls visit(draw index, first triangle, last triangle + 1) for the parts of draws that make up [begin, end) of the run.
    template <class Visit>
    void for_each_part(uint64_t begin, uint64_t end, Visit&& visit) const {
        size_t i = size_t(std::upper_bound(start_.begin(), start_.end(), begin) - start_.begin()) - 1;
        for (uint64_t at = begin; at < end; ++i) {
            const uint64_t stop = std::min(end, start_[i + 1]);
            if (at < stop) visit(order_[i], uint32_t(at - start_[i]), uint32_t(stop - start_[i]));
            at = stop;
        }
    }

  private:
    std::span<const Draw> draws_;
    std::vector<uint32_t> order_;
    std::vector<uint64_t> start_;
};

void set_up_part(const Draw& draw, uint32_t draw_index, uint32_t first, uint32_t last, const FrameOptions& options, TriangleSetup& setup) {
    const VertexTransform transform(draw, options);
    VertexCache vertices(transform);
    for (uint32_t t = first; t < last; ++t) {
        const uint32_t* index = draw.indices + 3 * size_t{t};
        assert(index[0] < draw.vertex_count && index[1] < draw.vertex_count && index[2] < draw.vertex_count);
        // Copied one by one: the next look-up may push an earlier vertex out of the cache.
        std::array<ScreenVertex, 3> corners;
        for (size_t i = 0; i < 3; ++i) corners[i] = vertices[index[i]];
        setup.add(corners, {draw.first_triangle_id + t, draw_index, t, draw.coverage, draw.cull, draw.front_is_clockwise});
    }
}

uint64_t divide_up(uint64_t a, uint64_t b) { return (a + b - 1) / b; }

/// Appends the batches in their order: the sizes first, then all copies in parallel.
void join(std::vector<SetupBatch>& batches, const ParallelFor& parallel_for, std::vector<SetupTriangle>& triangles,
          std::vector<std::array<Plane, 3>>& piece_planes) {
    std::vector<size_t> first_triangle(batches.size() + 1), first_planes(batches.size() + 1);
    for (size_t i = 0; i < batches.size(); ++i) {
        first_triangle[i + 1] = first_triangle[i] + batches[i].triangles.size();
        first_planes[i + 1] = first_planes[i] + batches[i].piece_planes.size();
    }
    if (first_triangle.back() >= kNoTriangle) throw std::length_error("more triangles in view than a frame can number (2^32 - 2)");
    triangles.resize(first_triangle.back());
    piece_planes.resize(first_planes.back());
    parallel_for(int64_t(batches.size()), [&](int64_t i) {
        SetupBatch& batch = batches[size_t(i)];
        SetupTriangle* const out = triangles.data() + first_triangle[size_t(i)];
        std::copy(batch.triangles.begin(), batch.triangles.end(), out);
        std::array<Plane, 3>* const planes = piece_planes.data() + first_planes[size_t(i)];
        std::copy(batch.piece_planes.begin(), batch.piece_planes.end(), planes);
        for (const SetupBatch::PlaneLink& link : batch.links) out[link.triangle].bary_over_w = planes + link.planes;
        batch = {};
    });
}

}  // namespace

void serial_for(int64_t count, const std::function<void(int64_t)>& body) {
    for (int64_t i = 0; i < count; ++i) body(i);
}

FrameCounts& FrameCounts::operator+=(const FrameCounts& other) {
    triangles += other.triangles;
    culled_frustum += other.culled_frustum;
    culled_backface += other.culled_backface;
    culled_degenerate += other.culled_degenerate;
    culled_small += other.culled_small;
    culled_nonfinite += other.culled_nonfinite;
    binned += other.binned;
    clipped += other.clipped;
    tiles += other.tiles;
    tiles_empty += other.tiles_empty;
    hiz_rejected += other.hiz_rejected;
    return *this;
}

Frame::Frame(const FrameOptions& options, std::span<const Draw> draws, const ParallelFor& parallel_for) : options_(options) {
    set_up(draws, parallel_for);
    fill_bins(parallel_for);
}

std::span<const uint32_t> Frame::bin(int tile_x, int tile_y) const {
    assert(tile_x >= 0 && tile_x < tiles_x_ && tile_y >= 0 && tile_y < tiles_y_);
    const size_t tile = size_t(tile_y) * size_t(tiles_x_) + size_t(tile_x);
    return {bin_entries_.data() + bin_start_[tile], bin_start_[tile + 1] - bin_start_[tile]};
}

void Frame::set_up(std::span<const Draw> draws, const ParallelFor& parallel_for) {
    const TileGrid grid(options_);
    const TriangleRun run(draws);
    std::vector<SetupBatch> batches(divide_up(run.size(), kBatchTriangles));
    parallel_for(int64_t(batches.size()), [&](int64_t i) {
        SetupBatch& batch = batches[size_t(i)];
        TriangleSetup setup(grid, batch);
        const uint64_t begin = uint64_t(i) * kBatchTriangles, end = std::min(begin + kBatchTriangles, run.size());
        batch.triangles.reserve(size_t(end - begin));
        run.for_each_part(begin, end, [&](uint32_t draw, uint32_t first, uint32_t last) {
            set_up_part(draws[draw], draw, first, last, options_, setup);
        });
    });
    for (const SetupBatch& batch : batches) counts_ += batch.counts;
    join(batches, parallel_for, triangles_, piece_planes_);
}

void Frame::fill_bins(const ParallelFor& parallel_for) {
    const TileGrid grid(options_);
    tiles_x_ = grid.tiles_x();
    tiles_y_ = grid.tiles_y();
    const size_t tiles = size_t(tiles_x_) * size_t(tiles_y_);
    const uint64_t per_range = std::max(kBatchTriangles, divide_up(triangles_.size(), kMaxBinRanges));
    const size_t ranges = divide_up(triangles_.size(), per_range);
    const auto for_each_entry = [&](size_t range, auto&& visit) {
        const size_t end = std::min(triangles_.size(), (range + 1) * per_range);
        for (size_t i = range * per_range; i < end; ++i) {
            grid.for_each_touched(triangles_[i], [&](size_t tile) {
                visit(tile, uint32_t(i));
                return true;
            });
        }
    };

    // Every range of triangles counts for itself; a tile's entries are then laid out range after range, in the order of setup indices.
    std::vector<uint32_t> next(ranges * tiles);
    parallel_for(int64_t(ranges), [&](int64_t range) {
        uint32_t* const counts = next.data() + size_t(range) * tiles;
        for_each_entry(size_t(range), [&](size_t tile, uint32_t) { ++counts[tile]; });
    });
    bin_start_.assign(tiles + 1, 0);
    uint64_t entries = 0;
    uint64_t occupied = 0;
    for (size_t tile = 0; tile < tiles; ++tile) {
        const uint64_t first = entries;
        for (size_t range = 0; range < ranges; ++range) {
            const uint32_t count = std::exchange(next[range * tiles + tile], uint32_t(entries));
            entries += count;
        }
        if (entries > 0xFFFFFFFFu) throw std::length_error("more bin entries than a frame can number (2^32 - 1)");
        bin_start_[tile + 1] = uint32_t(entries);
        occupied += entries > first;
    }
    counts_.tiles = uint64_t(grid.active_tiles());
    counts_.tiles_empty = counts_.tiles - occupied;

    bin_entries_.resize(entries);
    parallel_for(int64_t(ranges), [&](int64_t range) {
        uint32_t* const at = next.data() + size_t(range) * tiles;
        for_each_entry(size_t(range), [&](size_t tile, uint32_t index) { bin_entries_[at[tile]++] = index; });
    });
}

}  // namespace rawtexel::raster
