// Texture coordinates of a wave and their screen-space derivatives, for one addressing of a material.
#if defined(RAWTEXEL_SHADING_COORDINATES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_COORDINATES_INL_H_
#undef RAWTEXEL_SHADING_COORDINATES_INL_H_
#else
#define RAWTEXEL_SHADING_COORDINATES_INL_H_
#endif

#include "shading/corners-inl.h"
#include "shading/draw_state.h"
#include "texunit/sample.h"

#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// One coordinate at the three corners of each lane's triangle.
struct CornerCoordinate {
    FloatVector f0, f1, f2;
};

/// Texture coordinates repeat, so an integer (an even one where they mirror) may be taken off each triangle: what remains is small
/// and keeps its fraction's bits through interpolation however far from the origin the mesh was mapped.
HWY_INLINE void reduce_range(texunit::Wrap wrap, CornerCoordinate& c) {
    if (wrap == texunit::Wrap::ClampToEdge) return;
    const FloatLanes d;
    const auto least = hn::Min(c.f0, hn::Min(c.f1, c.f2));
    const auto period =
        wrap == texunit::Wrap::MirroredRepeat ? hn::Mul(hn::Set(d, 2.0f), hn::Floor(hn::Mul(least, hn::Set(d, 0.5f)))) : hn::Floor(least);
    c = {hn::Sub(c.f0, period), hn::Sub(c.f1, period), hn::Sub(c.f2, period)};
}

/// The coordinate at corner k after KHR_texture_transform: row `row` of the matrix.
HWY_INLINE FloatVector transformed(const glm::mat3x2& m, int row, FloatVector u, FloatVector v) {
    const FloatLanes d;
    return hn::Add(hn::Add(hn::Mul(hn::Set(d, m[0][row]), u), hn::Mul(hn::Set(d, m[1][row]), v)), hn::Set(d, m[2][row]));
}

HWY_INLINE void transform_corners(const CoordinateState& state, CornerCoordinate& u, CornerCoordinate& v) {
    if (state.identity) return;
    const glm::mat3x2& m = state.uv_from_vertex;
    const CornerCoordinate u_set = u, v_set = v;
    u = {transformed(m, 0, u_set.f0, v_set.f0), transformed(m, 0, u_set.f1, v_set.f1), transformed(m, 0, u_set.f2, v_set.f2)};
    v = {transformed(m, 1, u_set.f0, v_set.f0), transformed(m, 1, u_set.f1, v_set.f1), transformed(m, 1, u_set.f2, v_set.f2)};
}

/// Both coordinates of the three corners, transformed; zero where the mesh lacks the set.
template <class Corners>
HWY_INLINE void corner_coordinates(const CoordinateState& state, const Mesh& mesh, const Corners& corners, size_t i, CornerCoordinate& u,
                                   CornerCoordinate& v) {
    const FloatLanes d;
    u = v = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    const auto& set = mesh.uv[size_t(state.uv_set)];
    if (!set.empty()) {
        const float* values = &set[0].x;
        FloatVector at[3][2];
        for (int k = 0; k < 3; ++k) corners.template load<2>(k, values, i, at[k]);
        u = {at[0][0], at[1][0], at[2][0]};
        v = {at[0][1], at[1][1], at[2][1]};
    }
    transform_corners(state, u, v);
}

/// One coordinate and its derivatives at lanes [i, i + Lanes).
HWY_INLINE void interpolate_coordinate(const CornerCoordinate& c, const WeightLanes& weights, size_t i, WaveFloat& value, WaveFloat& ddx,
                                       WaveFloat& ddy) {
    const FloatLanes d;
    const auto f1 = hn::Sub(c.f1, c.f0), f2 = hn::Sub(c.f2, c.f0);
    hn::Store(interpolate(CornerWeights{weights.b1, weights.b2}, c.f0, c.f1, c.f2), d, value.lane + i);
    hn::Store(hn::Add(hn::Mul(weights.db1_dx, f1), hn::Mul(weights.db2_dx, f2)), d, ddx.lane + i);
    hn::Store(hn::Add(hn::Mul(weights.db1_dy, f1), hn::Mul(weights.db2_dy, f2)), d, ddy.lane + i);
}

/// Both coordinates of the corners of lanes [i, i + Lanes), in the range that their fractions keep their bits in.
struct CornerPair {
    CornerCoordinate u, v;
};
HWY_INLINE CornerPair reduce_ranges(const CoordinateState& state, CornerPair c) {
    reduce_range(state.wrap_s, c.u);
    reduce_range(state.wrap_t, c.v);
    return c;
}

HWY_INLINE void interpolate_pair(const CornerPair& c, const WeightLanes& weights, size_t i, texunit::WaveCoordinates& out) {
    interpolate_coordinate(c.u, weights, i, out.u, out.dudx, out.dudy);
    interpolate_coordinate(c.v, weights, i, out.v, out.dvdx, out.dvdy);
}

/// Both coordinates of the corners of lanes [i, i + Lanes), as lookups see them.
template <class Corners>
HWY_INLINE CornerPair corner_pair(const CoordinateState& state, const Mesh& mesh, const Corners& corners, size_t i) {
    CornerPair c;
    corner_coordinates(state, mesh, corners, i, c.u, c.v);
    return reduce_ranges(state, c);
}

template <class Corners>
HWY_INLINE void interpolate_coordinates(const CoordinateState& state, const Mesh& mesh, const Corners& corners,
                                        const raster::BarycentricWave& weights, texunit::WaveCoordinates& out) {
    constexpr bool one_triangle = std::is_same_v<Corners, OneTriangle>;
    CornerPair pair = corner_pair(state, mesh, corners, 0);
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(FloatLanes())) {
        if (!one_triangle && i > 0) pair = corner_pair(state, mesh, corners, i);
        interpolate_pair(pair, load_lanes(weights, i), i, out);
    }
}

/// The same within one triangle, of these corners, whose weights at `points` nobody else asks for.
HWY_INLINE void interpolate_coordinates(const CornerPair& corners, const raster::Anchor& anchor, const raster::BlockPoints& points,
                                        texunit::WaveCoordinates& out) {
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(FloatLanes())) {
        WeightLanes weights = raster::HWY_NAMESPACE::anchored_lanes(anchor, points, i);
        const CornerWeights w = clamped({weights.b1, weights.b2});
        weights.b1 = w.b1, weights.b2 = w.b2;
        interpolate_pair(corners, weights, i, out);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();
#endif
