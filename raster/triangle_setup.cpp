#include "raster/triangle_setup.h"

#include "raster/interpolation_planes.h"

#include <algorithm>
#include <tuple>

namespace rawtexel::raster {

namespace {

/// Twice the signed area, in (1/256 pixel)^2: positive where the vertices turn clockwise on the screen (y down). Exact.
int64_t doubled_area(const SnappedPosition& p, const SnappedPosition& q, const SnappedPosition& r) {
    return (int64_t{q.x} - p.x) * (int64_t{r.y} - p.y) - (int64_t{r.x} - p.x) * (int64_t{q.y} - p.y);
}

double depth_of(const ScreenVertex& v) {
    // Adding zero turns -0 into 0.
    return std::clamp(v.z / v.w, 0.0, 1.0) + 0.0;
}

SampleBox bounds_of(std::span<const SnappedPosition> positions) {
    SampleBox box{2 * int64_t{positions[0].x}, 2 * int64_t{positions[0].x}, 2 * int64_t{positions[0].y}, 2 * int64_t{positions[0].y}};
    for (const SnappedPosition& p : positions) {
        box.x_min = std::min(box.x_min, 2 * int64_t{p.x});
        box.x_max = std::max(box.x_max, 2 * int64_t{p.x});
        box.y_min = std::min(box.y_min, 2 * int64_t{p.y});
        box.y_max = std::max(box.y_max, 2 * int64_t{p.y});
    }
    return box;
}

bool disjoint(const SampleBox& a, const SampleBox& b) {
    return a.x_max < b.x_min || b.x_max < a.x_min || a.y_max < b.y_min || b.y_max < a.y_min;
}

/// Gradient of the depth from the snapped positions, so that it is exact at the first vertex and as good as double allows elsewhere.
void set_depth_plane(SetupTriangle& triangle, const std::array<double, 3>& depth) {
    const double dx1 = triangle.x[1] - triangle.x[0], dy1 = triangle.y[1] - triangle.y[0];
    const double dx2 = triangle.x[2] - triangle.x[0], dy2 = triangle.y[2] - triangle.y[0];
    const double dz1 = depth[1] - depth[0], dz2 = depth[2] - depth[0];
    const double area = dx1 * dy2 - dx2 * dy1;
    triangle.depth_at_origin = depth[0];
    triangle.depth_dx = (dz1 * dy2 - dz2 * dy1) / area * kSubpixelOne;
    triangle.depth_dy = (dz2 * dx1 - dz1 * dx2) / area * kSubpixelOne;
}

void set_depth_range(SetupTriangle& triangle, const std::array<double, 3>& depth) {
    const auto [low, high] = std::minmax({depth[0], depth[1], depth[2]});
    triangle.depth_min = float(low);
    triangle.depth_max = float(high);
}

/// Positions and everything else that whole triangles and pieces have in common.
SetupTriangle make_triangle(const std::array<SnappedPosition, 3>& position, const TriangleOrigin& origin, bool front_facing) {
    SetupTriangle triangle{};
    for (size_t i = 0; i < 3; ++i) {
        triangle.x[i] = position[i].x;
        triangle.y[i] = position[i].y;
    }
    triangle.triangle_id = origin.triangle_id;
    triangle.draw = origin.draw;
    triangle.primitive = origin.primitive;
    triangle.coverage = origin.coverage;
    triangle.front_facing = front_facing;
    return triangle;
}

}  // namespace

void TriangleSetup::add(const std::array<ScreenVertex, 3>& corners, const TriangleOrigin& origin) {
    ++batch_.counts.triangles;
    count(classify(corners, origin));
}

void TriangleSetup::count(Fate fate) {
    FrameCounts& counts = batch_.counts;
    switch (fate) {
        case Fate::Frustum: ++counts.culled_frustum; break;
        case Fate::Backface: ++counts.culled_backface; break;
        case Fate::Degenerate: ++counts.culled_degenerate; break;
        case Fate::Small: ++counts.culled_small; break;
        case Fate::Nonfinite: ++counts.culled_nonfinite; break;
        case Fate::Binned: ++counts.binned; break;
    }
}

TriangleSetup::Fate TriangleSetup::classify(const std::array<ScreenVertex, 3>& corners, const TriangleOrigin& origin) {
    if (!std::all_of(corners.begin(), corners.end(), is_finite)) return Fate::Nonfinite;
    const uint32_t outside[3] = {outside_planes(corners[0]), outside_planes(corners[1]), outside_planes(corners[2])};
    if ((outside[0] & outside[1] & outside[2]) != 0 || outside_samples(corners)) return Fate::Frustum;

    const Ordered ordered = order(corners);
    const uint32_t crossing = outside[0] | outside[1] | outside[2];
    if (crossing == 0) return add_polygon(ordered.vertex, ordered, origin, true);
    ClipPolygon polygon(ordered.vertex);
    polygon.clip(crossing);
    if (polygon.vertices().empty()) return Fate::Frustum;
    ++batch_.counts.clipped;
    return add_polygon(polygon.vertices(), ordered, origin, false);
}

bool TriangleSetup::outside_samples(const std::array<ScreenVertex, 3>& corners) const {
    // Snapping moves a vertex by at most half of 1/256 pixel; a whole one also covers the rounding here.
    constexpr double slack = 1.0 / kSubpixelOne;
    const SampleBox& box = grid_.sample_box();
    const double left = double(box.x_min) / kSampleOne - slack, right = double(box.x_max) / kSampleOne + slack;
    const double top = double(box.y_min) / kSampleOne - slack, bottom = double(box.y_max) / kSampleOne + slack;
    const auto all = [&](auto beyond) { return std::all_of(corners.begin(), corners.end(), beyond); };
    return all([&](const ScreenVertex& v) { return v.x < left * v.w; }) || all([&](const ScreenVertex& v) { return v.x > right * v.w; }) ||
           all([&](const ScreenVertex& v) { return v.y < top * v.w; }) || all([&](const ScreenVertex& v) { return v.y > bottom * v.w; });
}

TriangleSetup::Ordered TriangleSetup::order(const std::array<ScreenVertex, 3>& corners) {
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

TriangleSetup::Fate TriangleSetup::add_polygon(std::span<const ScreenVertex> polygon, const Ordered& ordered, const TriangleOrigin& origin,
                                               bool whole) {
    std::array<SnappedPosition, ClipPolygon::kCapacity> snapped_storage;
    const std::span<SnappedPosition> snapped(snapped_storage.data(), polygon.size());
    std::transform(polygon.begin(), polygon.end(), snapped.begin(), snap);

    // The polygon's own area decides facing; pieces that snapping has turned over lie doubled on others and are left out.
    int64_t area = 0;
    for (size_t i = 1; i + 1 < snapped.size(); ++i) area += doubled_area(snapped[0], snapped[i], snapped[i + 1]);
    if (area == 0) return Fate::Degenerate;
    const bool clockwise = (area > 0) != ordered.odd;
    const bool front_facing = clockwise == origin.front_is_clockwise;
    if (!front_facing && origin.cull == CullMode::Back) return Fate::Backface;
    const SampleBox box = bounds_of(snapped);
    if (disjoint(box, grid_.sample_box())) return Fate::Frustum;
    if (!grid_.may_hold_sample(box)) return Fate::Small;

    HomogeneousPlanes planes{};
    if (!whole) planes = homogeneous_planes(ordered.vertex, depth_of(polygon[0]));
    bool reaches_a_tile = false;
    const size_t first = batch_.triangles.size();
    for (size_t i = 1; i + 1 < snapped.size(); ++i) {
        const int64_t piece_area = doubled_area(snapped[0], snapped[i], snapped[i + 1]);
        if (piece_area == 0 || (piece_area > 0) != (area > 0)) continue;
        // Positive winding; the canonical order of equal triangles turns the same way, so they stay equal.
        const size_t second = area > 0 ? i : i + 1, third = area > 0 ? i + 1 : i;
        SetupTriangle triangle = make_triangle({snapped[0], snapped[second], snapped[third]}, origin, front_facing);
        const std::array<double, 3> depth = {depth_of(polygon[0]), depth_of(polygon[second]), depth_of(polygon[third])};
        set_depth_range(triangle, depth);
        if (whole) {
            set_depth_plane(triangle, depth);
            const size_t index[3] = {0, second, third};
            for (size_t k = 0; k < 3; ++k) {
                triangle.inverse_w[k] = 1.0 / polygon[index[k]].w;
                triangle.corner[k] = ordered.corner[index[k]];
            }
        } else {
            triangle.depth_dx = planes.depth.a;
            triangle.depth_dy = planes.depth.b;
            triangle.depth_at_origin = planes.depth.at(double(triangle.x[0]) / kSubpixelOne, double(triangle.y[0]) / kSubpixelOne);
        }
        grid_.for_each_touched(triangle, [&](size_t) { return !(reaches_a_tile = true); });
        batch_.triangles.push_back(triangle);
    }
    if (!reaches_a_tile) {
        batch_.triangles.resize(first);
        return Fate::Frustum;
    }
    if (!whole) {
        std::array<Plane, 3> by_corner;
        for (size_t k = 0; k < 3; ++k) by_corner[ordered.corner[k]] = planes.bary_over_w[k];
        for (size_t t = first; t < batch_.triangles.size(); ++t) {
            batch_.links.push_back({uint32_t(t), uint32_t(batch_.piece_planes.size())});
        }
        batch_.piece_planes.push_back(by_corner);
    }
    return Fate::Binned;
}

}  // namespace rawtexel::raster
