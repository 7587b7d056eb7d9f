#include "raster/triangle_setup.h"

#include <algorithm>
#include <tuple>

namespace rawtexel::raster {

namespace {

/// Twice the signed area, in (1/256 pixel)^2: positive where the vertices turn clockwise on the screen (y down). Exact.
int64_t doubled_area(const SnappedPosition& p, const SnappedPosition& q, const SnappedPosition& r) {
    return (int64_t{q.x} - p.x) * (int64_t{r.y} - p.y) - (int64_t{r.x} - p.x) * (int64_t{q.y} - p.y);
}

bool disjoint(const SampleBox& a, const SampleBox& b) {
    return a.x_max < b.x_min || b.x_max < a.x_min || a.y_max < b.y_min || b.y_max < a.y_min;
}

void set_depth_range(SetupTriangle& triangle, const std::array<double, 3>& depth) {
    const auto [low, high] = std::minmax({depth[0], depth[1], depth[2]});
    triangle.depth_min = float(low);
    triangle.depth_max = float(high);
}

/// What the pieces of a triangle have in common.
SetupTriangle make_triangle(const TriangleOrigin& origin, bool front_facing) {
    SetupTriangle triangle{};
    triangle.triangle_id = origin.triangle_id;
    triangle.draw = origin.draw;
    triangle.primitive = origin.primitive;
    triangle.coverage = origin.coverage;
    triangle.front_facing = front_facing;
    return triangle;
}

void set_positions(SetupTriangle& triangle, const SnappedPolygon& snapped, const std::array<size_t, 3>& index) {
    for (size_t i = 0; i < 3; ++i) {
        triangle.x[i] = snapped.position[index[i]].x;
        triangle.y[i] = snapped.position[index[i]].y;
    }
}

}  // namespace

SnappedPolygon::SnappedPolygon(std::span<const ScreenVertex> vertices) : size(vertices.size()) {
    std::transform(vertices.begin(), vertices.end(), position.begin(), snap);
    for (size_t i = 1; i + 1 < size; ++i) doubled_area += rawtexel::raster::doubled_area(position[0], position[i], position[i + 1]);
    const auto [x_min, x_max] = std::minmax_element(position.begin(), position.begin() + size, [](auto& p, auto& q) { return p.x < q.x; });
    const auto [y_min, y_max] = std::minmax_element(position.begin(), position.begin() + size, [](auto& p, auto& q) { return p.y < q.y; });
    box = {2 * int64_t{x_min->x}, 2 * int64_t{x_max->x}, 2 * int64_t{y_min->y}, 2 * int64_t{y_max->y}};
}

void ClippedSetup::add(const std::array<ScreenVertex, 3>& corners, uint32_t planes, const TriangleOrigin& origin) {
    ++(counts_.*classify(corners, planes, origin));
}

ClippedSetup::Fate ClippedSetup::classify(const std::array<ScreenVertex, 3>& corners, uint32_t planes, const TriangleOrigin& origin) {
    if (early_ && outside_samples(corners)) return &FrameCounts::culled_frustum;
    const Ordered ordered = order(corners);
    ClipPolygon polygon(ordered.vertex);
    polygon.clip(planes);
    if (polygon.vertices().empty()) return &FrameCounts::culled_frustum;
    ++counts_.clipped;
    return add_polygon(polygon.vertices(), ordered, origin);
}

bool ClippedSetup::outside_samples(const std::array<ScreenVertex, 3>& corners) const {
    // Snapping moves a vertex by at most half of 1/256 pixel; a whole one also covers the rounding here.
    constexpr double slack = 1.0 / kSubpixelOne;
    const SampleBox& box = grid_.sample_box();
    const double left = double(box.x_min) / kSampleOne - slack, right = double(box.x_max) / kSampleOne + slack;
    const double top = double(box.y_min) / kSampleOne - slack, bottom = double(box.y_max) / kSampleOne + slack;
    const auto all = [&](auto beyond) { return std::all_of(corners.begin(), corners.end(), beyond); };
    return all([&](const ScreenVertex& v) { return v.x < left * v.w; }) || all([&](const ScreenVertex& v) { return v.x > right * v.w; }) ||
           all([&](const ScreenVertex& v) { return v.y < top * v.w; }) || all([&](const ScreenVertex& v) { return v.y > bottom * v.w; });
}

ClippedSetup::Ordered ClippedSetup::order(const std::array<ScreenVertex, 3>& corners) {
    Ordered ordered{corners, {0, 1, 2}, false};
    const auto sort_pair = [&](size_t i, size_t j) {
        const ScreenVertex &p = ordered.vertex[i], &q = ordered.vertex[j];
        if (std::tie(q.x, q.y, q.z, q.w) < std::tie(p.x, p.y, p.z, p.w)) {
            std::swap(ordered.vertex[i], ordered.vertex[j]);
            std::swap(ordered.corner[i], ordered.corner[j]);
            ordered.odd = !ordered.odd;
        }
    };
    sort_pair(0, 1);
    sort_pair(1, 2);
    sort_pair(0, 1);
    return ordered;
}

ClippedSetup::Fate ClippedSetup::add_polygon(std::span<const ScreenVertex> polygon, const Ordered& ordered, const TriangleOrigin& origin) {
    const SnappedPolygon snapped(polygon);
    if (snapped.doubled_area == 0) return &FrameCounts::culled_degenerate;
    const bool clockwise = (snapped.doubled_area > 0) != ordered.odd;
    const bool front_facing = clockwise == origin.front_is_clockwise;
    if (!front_facing && origin.cull == CullMode::Back) return &FrameCounts::culled_backface;
    if (disjoint(snapped.box, grid_.sample_box())) return &FrameCounts::culled_frustum;
    if (!TileGrid::may_hold_sample(snapped.box, grid_.support())) return &FrameCounts::culled_small;
    if (!TileGrid::may_hold_sample(snapped.box, grid_.reach())) return &FrameCounts::culled_unsampled;

    const size_t first = pieces_.size();
    const HomogeneousPlanes planes = homogeneous_planes(ordered.vertex, depth_of(polygon[0]));
    add_pieces(polygon, snapped, planes, make_triangle(origin, front_facing));
    if (!reaches_a_tile(first)) {
        pieces_.resize(first);
        return &FrameCounts::culled_frustum;
    }
    keep_planes(planes, ordered);
    return &FrameCounts::binned;
}

void ClippedSetup::add_pieces(std::span<const ScreenVertex> polygon, const SnappedPolygon& snapped, const HomogeneousPlanes& planes,
                              const SetupTriangle& common) {
    const bool positive = snapped.doubled_area > 0;
    for (size_t i = 1; i + 1 < snapped.size; ++i) {
        const int64_t area = doubled_area(snapped.position[0], snapped.position[i], snapped.position[i + 1]);
        // A piece that snapping has turned over lies doubled on the others.
        if (area == 0 || (area > 0) != positive) continue;
        const std::array<size_t, 3> index = positive ? std::array<size_t, 3>{0, i, i + 1} : std::array<size_t, 3>{0, i + 1, i};
        SetupTriangle& piece = pieces_.emplace_back(common);
        set_positions(piece, snapped, index);
        set_depth_range(piece, {depth_of(polygon[index[0]]), depth_of(polygon[index[1]]), depth_of(polygon[index[2]])});
        piece.depth_dx = planes.depth.a;
        piece.depth_dy = planes.depth.b;
        piece.depth_at_origin = planes.depth.at(double(piece.x[0]) / kSubpixelOne, double(piece.y[0]) / kSubpixelOne);
    }
}

void ClippedSetup::keep_planes(const HomogeneousPlanes& planes, const Ordered& ordered) {
    plane_of_piece_.resize(pieces_.size(), uint32_t(planes_.size()));
    std::array<Plane, 3>& by_corner = planes_.emplace_back();
    for (size_t i = 0; i < 3; ++i) by_corner[ordered.corner[i]] = planes.bary_over_w[i];
}

bool ClippedSetup::reaches_a_tile(size_t first_piece) const {
    bool reached = false;
    for (size_t i = first_piece; i < pieces_.size() && !reached; ++i) {
        grid_.for_each_touched(pieces_[i], [&](size_t) {
            reached = true;
            return false;
        });
    }
    return reached;
}

}  // namespace rawtexel::raster
