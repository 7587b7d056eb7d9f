#include "raster/occlusion.h"

#include "raster/edge.h"
#include "raster/screen_vertex.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace rawtexel::raster {

namespace {

constexpr double kLeastFilling = 0.25;     // twice the area over that of the box: 1 where a side lies along each axis
constexpr int64_t kMostLayers = 32;        // tests of cells, over the number of cells
constexpr int64_t kFewestTests = 1 << 16;  // that are not worth counting
constexpr int64_t kCellSamples = int64_t{kCellPixels} * kSampleOne;

int64_t floor_divide(int64_t a, int64_t b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

/// How many more triangles go along an edge one way than the other, by its end points.
class EdgeBalance {
  public:
    explicit EdgeBalance(size_t edges) : entries_(std::bit_ceil(2 * edges + 1)) {}

    void add(uint64_t from, uint64_t to) { at(from, to).balance += from < to ? 1 : -1; }
    bool is_even(uint64_t from, uint64_t to) { return at(from, to).balance == 0; }

  private:
    struct Entry {
        uint64_t low = 0, high = 0;  // unused: both alike, as no edge's ends are
        int32_t balance = 0;
    };

    Entry& at(uint64_t from, uint64_t to) {
        const uint64_t low = std::min(from, to), high = std::max(from, to);
        uint64_t hash = (low * 0x9E3779B97F4A7C15u) ^ (high * 0xC2B2AE3D27D4EB4Fu);
        hash ^= hash >> 32;
        for (size_t slot = size_t(hash);; ++slot) {
            Entry& entry = entries_[slot & (entries_.size() - 1)];
            if (entry.low == entry.high) entry = {low, high, 0};
            if (entry.low == low && entry.high == high) return entry;
        }
    }

    std::vector<Entry> entries_;
};

uint64_t key(int32_t x, int32_t y) { return uint64_t{uint32_t(x)} << 32 | uint32_t(y); }

void include(CellRange& range, const CellRange& other) {
    range = {std::min(range.first_x, other.first_x), std::max(range.last_x, other.last_x), std::min(range.first_y, other.first_y),
             std::max(range.last_y, other.last_y)};
}

}  // namespace

OcclusionBuffer::OcclusionBuffer(const FrameOptions& options, const TileGrid& grid) : options_(options), grid_(grid) {
    const int per_tile = options.tile_size / kCellPixels;
    const auto last = [&](int last_tile, int pixels) {
        return int16_t(std::min((last_tile + 1) * per_tile, (pixels + kCellPixels - 1) / kCellPixels) - 1);
    };
    active_ = {int16_t(grid.first_x() * per_tile), last(grid.last_x(), options.width), int16_t(grid.first_y() * per_tile),
               last(grid.last_y(), options.height)};
    depth_.resize(size_t(active_.count()));
    cells_.resize(depth_.size());
}

SampleBox OcclusionBuffer::samples_of(int cell_x, int cell_y) const {
    const SampleBox& reach = grid_.reach();
    const int64_t x = cell_x * kCellSamples, y = cell_y * kCellSamples, last = kCellSamples - kSampleOne;
    return {x + reach.x_min, x + last + reach.x_max, y + reach.y_min, y + last + reach.y_max};
}

CellRange OcclusionBuffer::cells_of(const SampleBox& box) const {
    const SampleBox& reach = grid_.reach();
    const auto first = [](int64_t low, int64_t last_offset, int16_t least) {
        return int16_t(
            std::clamp<int64_t>(-floor_divide(-(low - (kCellSamples - kSampleOne) - last_offset), kCellSamples), least, INT16_MAX));
    };
    const auto last = [](int64_t high, int64_t first_offset, int16_t most) {
        return int16_t(std::clamp<int64_t>(floor_divide(high - first_offset, kCellSamples), -1, most));
    };
    return {first(box.x_min, reach.x_max, active_.first_x), last(box.x_max, reach.x_min, active_.last_x),
            first(box.y_min, reach.y_max, active_.first_y), last(box.y_max, reach.y_min, active_.last_y)};
}

void OcclusionBuffer::draw(std::span<const Draw> draws, std::span<const Occluder> occluders) {
    std::vector<Occluder> by_draw(occluders.begin(), occluders.end());
    std::stable_sort(by_draw.begin(), by_draw.end(), [](const Occluder& a, const Occluder& b) { return a.draw < b.draw; });
    std::vector<Triangle> group;
    for (auto begin = by_draw.begin(); begin != by_draw.end();) {
        const Draw& draw = draws[begin->draw];
        const auto end = std::find_if(begin, by_draw.end(), [&](const Occluder& other) { return other.draw != begin->draw; });
        CellRange cells = begin->cells;
        for (auto i = begin; i != end; ++i) include(cells, i->cells);
        for (const bool clockwise : {false, true}) {
            if (draw.cull == CullMode::Back && clockwise != draw.front_is_clockwise) continue;
            group.clear();
            for (auto i = begin; i != end; ++i) gather(draw, draw.clusters->clusters[i->cluster], clockwise, group);
            find_borders(group);
            draw_group(group, cells);
        }
        begin = end;
    }
}

void OcclusionBuffer::gather(const Draw& draw, const Cluster& cluster, bool clockwise, std::vector<Triangle>& group) {
    const MeshClusters& mesh = *draw.clusters;
    std::array<SnappedPosition, 3 * kClusterTriangles> snapped;
    std::array<double, 3 * kClusterTriangles> depth;
    for (size_t i = 0; i < cluster.vertex_count; ++i) {
        const size_t v = cluster.first_vertex + i;
        const ScreenVertex screen = to_screen(draw.clip_from_object, {mesh.x[v], mesh.y[v], mesh.z[v]}, options_);
        snapped[i] = snap(screen);
        depth[i] = depth_of(screen);
    }
    for (size_t t = cluster.first_triangle; t < cluster.first_triangle + cluster.triangle_count; ++t) {
        size_t v[3] = {mesh.corner[0][t], mesh.corner[1][t], mesh.corner[2][t]};
        const auto delta = [&](size_t i, int32_t SnappedPosition::*axis) { return double(snapped[v[i]].*axis - snapped[v[0]].*axis); };
        const auto area = [&] {
            return delta(1, &SnappedPosition::x) * delta(2, &SnappedPosition::y) -
                   delta(2, &SnappedPosition::x) * delta(1, &SnappedPosition::y);
        };
        if (area() == 0 || (area() > 0) != clockwise) continue;
        // Slivers hide next to nothing and touch many cells.
        const auto extent = [&](int32_t SnappedPosition::*axis) {
            const auto [low, high] = std::minmax({snapped[v[0]].*axis, snapped[v[1]].*axis, snapped[v[2]].*axis});
            return double(high) - double(low);
        };
        if (std::abs(area()) < kLeastFilling * extent(&SnappedPosition::x) * extent(&SnappedPosition::y)) continue;
        if (!clockwise) std::swap(v[1], v[2]);
        Triangle triangle{};
        for (size_t i = 0; i < 3; ++i) {
            triangle.x[i] = snapped[v[i]].x;
            triangle.y[i] = snapped[v[i]].y;
        }
        const double dx1 = delta(1, &SnappedPosition::x), dy1 = delta(1, &SnappedPosition::y), dx2 = delta(2, &SnappedPosition::x),
                     dy2 = delta(2, &SnappedPosition::y);
        const double dz1 = depth[v[1]] - depth[v[0]], dz2 = depth[v[2]] - depth[v[0]];
        triangle.depth = depth[v[0]];
        triangle.depth_dx = (dz1 * dy2 - dz2 * dy1) / area() * kSubpixelOne;
        triangle.depth_dy = (dz2 * dx1 - dz1 * dx2) / area() * kSubpixelOne;
        const double terms = std::abs(dz1 * dy2) + std::abs(dz2 * dy1) + std::abs(dz2 * dx1) + std::abs(dz1 * dx2);
        triangle.slope_error = 0x1p-48 * terms / area() * kSubpixelOne;
        triangle.extent = (std::abs(dx1) + std::abs(dx2) + std::abs(dy1) + std::abs(dy2)) / kSubpixelOne;
        // Many layers hide no more than a few: a bound keeps their cost below that of drawing them.
        const auto [x_low, x_high] = std::minmax({triangle.x[0], triangle.x[1], triangle.x[2]});
        const auto [y_low, y_high] = std::minmax({triangle.y[0], triangle.y[1], triangle.y[2]});
        cells_to_test_ += cells_of({2 * int64_t{x_low}, 2 * int64_t{x_high}, 2 * int64_t{y_low}, 2 * int64_t{y_high}}).count();
        if (cells_to_test_ > std::max(kMostLayers * cell_count(), kFewestTests)) return;
        triangle.depth_min = float(std::min({depth[v[0]], depth[v[1]], depth[v[2]]}));
        group.push_back(triangle);
    }
}

void OcclusionBuffer::find_borders(std::vector<Triangle>& group) {
    EdgeBalance balance(3 * group.size());
    const auto ends = [](const Triangle& t, size_t i) {
        const size_t j = i == 2 ? 0 : i + 1;
        return std::pair(key(t.x[i], t.y[i]), key(t.x[j], t.y[j]));
    };
    for (const Triangle& t : group) {
        for (size_t i = 0; i < 3; ++i) balance.add(ends(t, i).first, ends(t, i).second);
    }
    for (Triangle& t : group) {
        for (size_t i = 0; i < 3; ++i) t.border[i] = !balance.is_even(ends(t, i).first, ends(t, i).second);
    }
}

/// No more than the least depth that the triangle's own plane, set up from whichever corner, gives any of its samples in the box.
float OcclusionBuffer::depth_over(const Triangle& triangle, const SampleBox& samples) {
    const double x0 = double(triangle.x[0]) / kSubpixelOne, y0 = double(triangle.y[0]) / kSubpixelOne;
    const double x = double(triangle.depth_dx > 0 ? samples.x_min : samples.x_max) / kSampleOne - x0;
    const double y = double(triangle.depth_dy > 0 ? samples.y_min : samples.y_max) / kSampleOne - y0;
    const double error = triangle.slope_error * (std::abs(x) + std::abs(y) + triangle.extent) + 0x1p-50;
    const double least = triangle.depth + triangle.depth_dx * x + triangle.depth_dy * y - error;
    return std::max(triangle.depth_min, float(least) * (1.0f - 0x1p-22f));
}

/// The group's triangles all turn the same way. So how many of them cover a sample is the winding number of the edges about it, and changes
/// only across edges that are not gone along as often one way as the other. A cell that none of these crosses is covered everywhere if it
/// is anywhere.
void OcclusionBuffer::draw_group(std::span<const Triangle> group, const CellRange& cells) {
    for (int y = cells.first_y; y <= cells.last_y; ++y) {
        std::fill_n(cells_.begin() + ptrdiff_t(index(cells.first_x, y)), cells.last_x - cells.first_x + 1, Cell{});
    }
    for (const Triangle& triangle : group) {
        SetupTriangle corners;
        std::copy_n(triangle.x, 3, corners.x);
        std::copy_n(triangle.y, 3, corners.y);
        const Edge edges[3] = {edge_of(corners, 0), edge_of(corners, 1), edge_of(corners, 2)};
        const CellRange touched = cells_of(bounds_of(corners));
        for (int y = touched.first_y; y <= touched.last_y; ++y) {
            for (int x = touched.first_x; x <= touched.last_x; ++x) {
                const SampleBox samples = samples_of(x, y);
                bool beside = false, whole = true, border = false, covers_first = true;
                for (int i = 0; i < 3; ++i) {
                    beside |= edges[i].constant + greatest_over(edges[i], samples) < 0;
                    const bool crosses = edges[i].constant + smallest_over(edges[i], samples) < 0;
                    whole &= !crosses;
                    border |= crosses && triangle.border[i];
                    covers_first &= edges[i].at(samples.x_min, samples.y_min) >= 0;
                }
                if (beside) continue;
                Cell& cell = cells_[index(x, y)];
                const float depth = depth_over(triangle, samples);
                if (whole) cell.whole = std::max(cell.whole, depth);
                cell.farthest = std::min(cell.farthest, depth);
                cell.covered |= covers_first;
                cell.border |= border;
            }
        }
    }
    for (int y = cells.first_y; y <= cells.last_y; ++y) {
        for (int x = cells.first_x; x <= cells.last_x; ++x) {
            const Cell& cell = cells_[index(x, y)];
            float& depth = depth_[index(x, y)];
            depth = std::max({depth, cell.whole, cell.covered && !cell.border ? cell.farthest : 0.0f});
        }
    }
}

bool OcclusionBuffer::hides(const CellRange& cells, float nearest) const {
    if (cells.count() == 0) return false;
    for (int y = cells.first_y; y <= cells.last_y; ++y) {
        const float* const row = depth_.data() + index(cells.first_x, y);
        const float* const end = depth_.data() + index(cells.last_x, y) + 1;
        if (!std::all_of(row, end, [&](float depth) { return depth > nearest; })) return false;
    }
    return true;
}

}  // namespace rawtexel::raster
