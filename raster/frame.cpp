#include "raster/frame.h"

#include "raster/cluster_cull.h"
#include "raster/cluster_setup.h"
#include "raster/frame_memory.h"
#include "raster/occlusion.h"
#include "raster/tile_grid.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cassert>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace rawtexel::raster {

namespace {

constexpr uint64_t kMaxBinRanges = 64;    ///< bounds the bins' counters, one per range and tile
constexpr uint32_t kSeenClusters = 1024;  ///< looked at by one task
constexpr size_t kFewestHideable = 128;   ///< clusters in view that make looking for occluders pay
constexpr size_t kMostOccluders = 256;
constexpr int kLeastShare = 8;              ///< an occluder has at least this part of the largest one's cells
constexpr int64_t kLeastCover = 6;          ///< all of them have at least this part of the frame's
constexpr int kFewestCells = 16;            ///< of an occluder
constexpr uint64_t kMostBlocks = 1u << 20;  ///< that setup indices can name, but for the last

std::atomic<uint64_t> last_serial{0};

uint64_t divide_up(uint64_t a, uint64_t b) { return (a + b - 1) / b; }

/// The clusters of the draws that came without, made once for draws of the same triangles.
class MissingClusters {
  public:
    void complete(std::vector<Draw>& draws) {
        for (Draw& draw : draws) {
            if (draw.clusters != nullptr) continue;
            MeshClusters& mesh = made_[{draw.positions, draw.vertex_count, draw.indices, draw.triangle_count}];
            if (mesh.clusters.empty())
                mesh = make_clusters({draw.positions, draw.vertex_count}, {draw.indices, 3 * size_t{draw.triangle_count}});
            draw.clusters = &mesh;
        }
    }

  private:
    std::map<std::tuple<const glm::vec3*, uint32_t, const uint32_t*, uint32_t>, MeshClusters> made_;
};

/// The draws in the order of their setup indices, opaque first, each class in scene order, as one long run of clusters.
class ClusterRun {
  public:
    explicit ClusterRun(std::span<const Draw> draws) : order_(draws.size()), start_(draws.size() + 1) {
        std::iota(order_.begin(), order_.end(), 0u);
        const auto key = [&](uint32_t i) { return std::tuple(draws[i].coverage, draws[i].first_triangle_id, i); };
        std::sort(order_.begin(), order_.end(), [&](uint32_t i, uint32_t j) { return key(i) < key(j); });
        for (size_t i = 0; i < order_.size(); ++i) start_[i + 1] = start_[i] + draws[order_[i]].clusters->clusters.size();
    }

    uint64_t size() const { return start_.back(); }

    /// Calls visit(draw index, cluster) for [begin, end) of the run.
    template <class Visit>
    void for_each(uint64_t begin, uint64_t end, Visit&& visit) const {
        size_t i = size_t(std::upper_bound(start_.begin(), start_.end(), begin) - start_.begin()) - 1;
        for (uint64_t at = begin; at < end; ++i) {
            for (const uint64_t stop = std::min(end, start_[i + 1]); at < stop; ++at) visit(order_[i], uint32_t(at - start_[i]));
        }
    }

  private:
    std::vector<uint32_t> order_;
    std::vector<uint64_t> start_;
};

/// What clusters the tests leave, in the order of the run.
struct SeenClusters {
    std::vector<VisibleCluster> list;
    FrameCounts counts;  ///< of the others
};

SeenClusters see_clusters(std::span<const Draw> draws, const FrameOptions& options, const TileGrid& grid, const OcclusionBuffer& occlusion,
                          const ClusterRun& run, const ParallelFor& parallel_for) {
    std::vector<SeenClusters> parts(divide_up(run.size(), kSeenClusters));
    const RasterSkips& skips = options.skips;
    parallel_for(int64_t(parts.size()), [&](int64_t part) {
        SeenClusters& seen = parts[size_t(part)];
        const uint64_t begin = uint64_t(part) * kSeenClusters, end = std::min(begin + kSeenClusters, run.size());
        std::optional<ClusterCull> test;
        uint32_t tested = kNoTriangle;
        run.for_each(begin, end, [&](uint32_t draw_index, uint32_t number) {
            const Draw& draw = draws[draw_index];
            if (std::exchange(tested, draw_index) != draw_index) test.emplace(draw, options, grid);
            const Cluster& cluster = draw.clusters->clusters[number];
            const ClusterView view = skips.clusters ? test->view(cluster, draw.cull == CullMode::Back && skips.backface) : ClusterView{};
            uint64_t FrameCounts::*fate = nullptr;
            if (view.outside && skips.frustum) fate = &FrameCounts::culled_frustum;
            if (view.facing_away) fate = &FrameCounts::culled_backface;
            if (fate == nullptr) {
                const CellRange cells = view.unclipped ? occlusion.cells_of(view.box) : CellRange{};
                seen.list.push_back({draw_index, number, view.nearest, view.unclipped, cells});
            } else {
                seen.counts.triangles += cluster.triangle_count;
                seen.counts.*fate += cluster.triangle_count;
            }
        });
    });
    SeenClusters all;
    for (const SeenClusters& part : parts) {
        all.list.insert(all.list.end(), part.list.begin(), part.list.end());
        all.counts += part.counts;
    }
    return all;
}

/// Leaves out what the largest opaque clusters hide. Nothing that is seen anywhere is: it would have to be strictly behind itself.
void leave_out_occluded(std::span<const Draw> draws, OcclusionBuffer& occlusion, SeenClusters& seen, const ParallelFor& parallel_for) {
    if (seen.list.size() < kFewestHideable) return;
    std::vector<Occluder> occluders;
    for (const VisibleCluster& c : seen.list) {
        if (c.unclipped && c.cells.count() >= kFewestCells && draws[c.draw].coverage == CoverageClass::Opaque)
            occluders.push_back({c.draw, c.cluster, c.cells});
    }
    if (occluders.empty()) return;
    const auto larger = [](const Occluder& a, const Occluder& b) {
        return std::tuple(-a.cells.count(), a.draw, a.cluster) < std::tuple(-b.cells.count(), b.draw, b.cluster);
    };
    const int enough = std::min_element(occluders.begin(), occluders.end(), larger)->cells.count() / kLeastShare;
    std::erase_if(occluders, [&](const Occluder& o) { return o.cells.count() < enough; });
    if (occluders.size() > kMostOccluders) {
        std::nth_element(occluders.begin(), occluders.begin() + kMostOccluders, occluders.end(), larger);
        occluders.resize(kMostOccluders);
    }
    int64_t cells = 0;
    for (const Occluder& o : occluders) cells += o.cells.count();
    if (cells < occlusion.cell_count() / kLeastCover) return;
    occlusion.draw(draws, occluders);

    std::vector<uint8_t> hidden(seen.list.size());
    parallel_for(int64_t(divide_up(hidden.size(), kSeenClusters)), [&](int64_t part) {
        const size_t begin = size_t(part) * kSeenClusters, end = std::min(begin + kSeenClusters, hidden.size());
        for (size_t i = begin; i < end; ++i) hidden[i] = occlusion.hides(seen.list[i].cells, seen.list[i].nearest);
    });
    size_t kept = 0;
    for (size_t i = 0; i < hidden.size(); ++i) {
        const VisibleCluster& c = seen.list[i];
        if (hidden[i] == 0) {
            seen.list[kept++] = c;
            continue;
        }
        const uint8_t triangles = draws[c.draw].clusters->clusters[c.cluster].triangle_count;
        seen.counts.triangles += triangles;
        seen.counts.culled_occluded += triangles;
    }
    seen.list.resize(kept);
}

/// The nearest first; those as near as one another, but for the last bits, in the order that they had.
void sort_by_nearest(std::span<VisibleCluster> clusters) {
    constexpr int kDigitBits = 11;
    // Of floats from 0 to 1 the bits rise with the value and fit 30 bits; the last eight decide nothing.
    const auto key = [](const VisibleCluster& c) { return ~(std::bit_cast<uint32_t>(c.nearest) >> 8); };
    std::vector<VisibleCluster> other(clusters.size());
    std::span<VisibleCluster> from = clusters, to = other;
    for (int shift = 0; shift < 2 * kDigitBits; shift += kDigitBits) {
        std::array<uint32_t, 1 << kDigitBits> start{};
        const auto digit = [&](const VisibleCluster& c) { return size_t(key(c) >> shift & ((1u << kDigitBits) - 1)); };
        for (const VisibleCluster& c : from) ++start[digit(c)];
        uint32_t sum = 0;
        for (uint32_t& first : start) sum += std::exchange(first, sum);
        for (const VisibleCluster& c : from) to[start[digit(c)]++] = c;
        std::swap(from, to);
    }
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
    culled_unsampled += other.culled_unsampled;
    culled_occluded += other.culled_occluded;
    culled_nonfinite += other.culled_nonfinite;
    binned += other.binned;
    clipped += other.clipped;
    tiles += other.tiles;
    tiles_empty += other.tiles_empty;
    hiz_rejected += other.hiz_rejected;
    return *this;
}

Frame::~Frame() = default;
Frame::Frame(Frame&&) noexcept = default;
Frame& Frame::operator=(Frame&&) noexcept = default;

Frame::Frame(const FrameOptions& options, std::span<const Draw> given_draws, const ParallelFor& parallel_for)
    : options_(options), serial_(++last_serial), memory_(std::make_unique<FrameMemory>()) {
    std::vector<Draw> draws(given_draws.begin(), given_draws.end());
    MissingClusters missing;
    missing.complete(draws);
    const TileGrid grid(options_);
    tiles_x_ = grid.tiles_x();
    tiles_y_ = grid.tiles_y();
    counts_.tiles = uint64_t(grid.active_tiles());

    OcclusionBuffer occlusion(options_, grid);
    SeenClusters seen = see_clusters(draws, options_, grid, occlusion, ClusterRun(draws), parallel_for);
    if (options_.skips.clusters && options_.skips.occlusion && !options_.scene_order)
        leave_out_occluded(draws, occlusion, seen, parallel_for);
    counts_ += seen.counts;
    const auto opaque = [&](const VisibleCluster& c) { return draws[c.draw].coverage == CoverageClass::Opaque; };
    const auto layered = std::partition_point(seen.list.begin(), seen.list.end(), opaque);
    if (!options_.scene_order) sort_by_nearest({seen.list.begin(), layered});

    // Batches hold opaque clusters or others, never both.
    const size_t opaque_clusters = size_t(layered - seen.list.begin());
    const size_t opaque_batches = divide_up(opaque_clusters, kBatchClusters);
    std::vector<SetupBatch> batches(opaque_batches + divide_up(seen.list.size() - opaque_clusters, kBatchClusters));
    const SetupInputs inputs{options_, grid, draws};
    parallel_for(int64_t(batches.size()), [&](int64_t i) {
        const bool is_opaque = size_t(i) < opaque_batches;
        const size_t begin = is_opaque ? size_t(i) * kBatchClusters : opaque_clusters + (size_t(i) - opaque_batches) * kBatchClusters;
        const size_t end = std::min(begin + kBatchClusters, is_opaque ? opaque_clusters : seen.list.size());
        SetupBatch& batch = batches[size_t(i)];
        FrameMemory::Slab slab = memory_->take(kBlockTriangles * sizeof(SetupTriangle));
        batch.triangles = reinterpret_cast<SetupTriangle*>(slab.memory);
        set_up_clusters(inputs, {seen.list.data() + begin, end - begin}, kBlockTriangles, batch);
        const size_t used = batch.count * sizeof(SetupTriangle);
        memory_->give({slab.memory + used, slab.bytes - used});
    });

    std::vector<uint32_t> first_block;
    number_blocks(batches, first_block);
    first_layered_ = first_block[opaque_batches] * kBlockTriangles;
    fill_bins(batches, first_block, parallel_for);
    sort_bins(parallel_for);
}

/// first_block[i]: the first block of batch i, whose triangles are numbered from there on; one past the end, the number of blocks.
void Frame::number_blocks(std::vector<SetupBatch>& batches, std::vector<uint32_t>& first_block) {
    for (SetupBatch& batch : batches) {
        first_block.push_back(uint32_t(blocks_.size()));
        counts_ += batch.counts;
        triangle_count_ += batch.count + uint32_t(batch.overflow.size());
        blocks_.push_back(batch.triangles);
        block_size_.push_back(batch.count);
        for (size_t i = 0; i < batch.overflow.size(); i += kBlockTriangles) {
            blocks_.push_back(batch.overflow.data() + i);
            block_size_.push_back(uint32_t(std::min<size_t>(kBlockTriangles, batch.overflow.size() - i)));
        }
        if (blocks_.size() >= kMostBlocks) throw std::length_error("more triangles in view than a frame can number");
        // Vectors that move keep their memory.
        if (!batch.overflow.empty()) overflow_.push_back(std::move(batch.overflow));
        if (!batch.piece_planes.empty()) piece_planes_.push_back(std::move(batch.piece_planes));
    }
    first_block.push_back(uint32_t(blocks_.size()));
}

std::span<const uint32_t> Frame::bin(int tile_x, int tile_y) const {
    assert(tile_x >= 0 && tile_x < tiles_x_ && tile_y >= 0 && tile_y < tiles_y_);
    const size_t tile = size_t(tile_y) * size_t(tiles_x_) + size_t(tile_x);
    return {bin_entries_.data() + bin_start_[tile], bin_start_[tile + 1] - bin_start_[tile]};
}

void Frame::fill_bins(const std::vector<SetupBatch>& batches, const std::vector<uint32_t>& first_block, const ParallelFor& parallel_for) {
    const size_t tiles = size_t(tiles_x_) * size_t(tiles_y_);
    const size_t per_range = std::max<size_t>(1, divide_up(batches.size(), kMaxBinRanges));
    const size_t ranges = divide_up(batches.size(), per_range);
    const auto for_each_batch = [&](int64_t range, auto&& visit) {
        const size_t end = std::min(batches.size(), (size_t(range) + 1) * per_range);
        for (size_t i = size_t(range) * per_range; i < end; ++i) visit(batches[i], first_block[i] * kBlockTriangles);
    };

    // Every range of batches counts for itself; a tile's entries are then laid out range after range, in the order of setup indices.
    std::vector<uint32_t> next(ranges * tiles);
    parallel_for(int64_t(ranges), [&](int64_t range) {
        uint32_t* const counts = next.data() + size_t(range) * tiles;
        for_each_batch(range, [&](const SetupBatch& batch, uint32_t) {
            for (const BinEntry& entry : batch.entries) ++counts[entry.tile];
        });
    });
    bin_start_.assign(tiles + 1, 0);
    uint64_t entries = 0, occupied = 0;
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
    counts_.tiles_empty = counts_.tiles - occupied;

    bin_entries_.resize(entries);
    parallel_for(int64_t(ranges), [&](int64_t range) {
        uint32_t* const at = next.data() + size_t(range) * tiles;
        for_each_batch(range, [&](const SetupBatch& batch, uint32_t first) {
            for (const BinEntry& entry : batch.entries) bin_entries_[at[entry.tile]++] = first + entry.triangle;
        });
    });
}

/// Clusters leave the order of the scene; where it matters, it is had back tile by tile.
void Frame::sort_bins(const ParallelFor& parallel_for) {
    const uint32_t sorted_from = options_.scene_order ? 0 : first_layered_;
    if (size_t{sorted_from} / kBlockTriangles >= blocks_.size()) return;
    const auto before = [&](uint32_t i, uint32_t j) {
        const SetupTriangle &a = triangle(i), &b = triangle(j);
        return std::tuple(a.coverage, a.triangle_id, i) < std::tuple(b.coverage, b.triangle_id, j);
    };
    parallel_for(int64_t{tiles_x_} * tiles_y_, [&](int64_t tile) {
        const auto begin = bin_entries_.begin() + bin_start_[size_t(tile)], end = bin_entries_.begin() + bin_start_[size_t(tile) + 1];
        std::sort(std::lower_bound(begin, end, sorted_from), end, before);
    });
}

}  // namespace rawtexel::raster
