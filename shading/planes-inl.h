// Triplanar mapping: which plane a fragment's maps are projected on, and texture coordinates and tangents there.
#if defined(RAWTEXEL_SHADING_PLANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_PLANES_INL_H_
#undef RAWTEXEL_SHADING_PLANES_INL_H_
#else
#define RAWTEXEL_SHADING_PLANES_INL_H_
#endif

#include "shading/coordinates-inl.h"
#include "shading/fragment.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

// In the object's space. Seen from the side that its normal points to, a plane shows its texture upright and unmirrored, +Y up:
//   plane  across  u grows along  v grows along
//     0      x     -side * z      -y
//     1      y      x              side * z
//     2      z      side * x      -y

/// The plane of each lane.
struct PlaneLanes {
    texunit::WaveInt plane;  ///< the axis that it lies across
    WaveFloat side;          ///< 1 where the normal points along the axis, -1 where against it
};

/// Not unit.
template <class Corners>
HWY_INLINE void find_object_normal(const Mesh& mesh, const Corners& corners, const raster::BarycentricWave& weights, WaveVector& out) {
    const float* const positions = &mesh.positions[0].x;
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(FloatLanes())) {
        if (!mesh.normals.empty()) {
            store3(FloatLanes(), interpolate_vector<3>(corners, load_weights(weights, i), &mesh.normals[0].x, i), out, i);
            continue;
        }
        const SpaceVector p0 = corner_vector<3>(corners, 0, positions, i);
        const SpaceVector e1 = sub(corner_vector<3>(corners, 1, positions, i), p0),
                          e2 = sub(corner_vector<3>(corners, 2, positions, i), p0);
        store3(FloatLanes(), cross(e1, e2), out, i);
    }
}

/// By squaring, so that all instruction sets agree.
HWY_INLINE FloatVector whole_power(FloatVector base, int exponent) {
    FloatVector power = hn::Set(FloatLanes(), 1.0f);
    for (; exponent > 0; exponent >>= 1, base = hn::Mul(base, base))
        if (exponent & 1) power = hn::Mul(power, base);
    return power;
}

/// What the planes weigh, the largest 1. Lanes without a normal see plane 2.
HWY_INLINE SpaceVector plane_weights(const SpaceVector& normal, int sharpness) {
    const FloatLanes d;
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const auto x = hn::Abs(normal.x), y = hn::Abs(normal.y), z = hn::Abs(normal.z);
    const auto largest = hn::Max(x, hn::Max(y, z));
    const auto some = hn::And(hn::Gt(largest, zero), hn::Lt(largest, hn::Inf(d)));
    const auto part = [&](FloatVector of, FloatVector otherwise)
                          HWY_ATTR { return hn::IfThenElse(some, whole_power(hn::Div(of, largest), sharpness), otherwise); };
    return {part(x, zero), part(y, zero), part(z, one)};
}

/// Puts lanes [i, i + Lanes) on `plane`.
HWY_INLINE void store_plane(hn::Vec<IntLanes> plane, const SpaceVector& normal, size_t i, PlaneLanes& out) {
    const FloatLanes d;
    const IntLanes di;
    const auto is = [&](int axis) HWY_ATTR { return hn::RebindMask(d, hn::Eq(plane, hn::Set(di, axis))); };
    const auto along = hn::IfThenElse(is(0), normal.x, hn::IfThenElse(is(1), normal.y, normal.z));
    hn::Store(plane, di, out.plane.lane + i);
    hn::Store(hn::IfThenElse(hn::Lt(along, hn::Zero(d)), hn::Set(d, -1.0f), hn::Set(d, 1.0f)), d, out.side.lane + i);
}

/// All lanes on plane `axis`, and its share of the weights.
HWY_INLINE void take_plane(const WaveVector& normals, int sharpness, int axis, PlaneLanes& out, WaveFloat& share) {
    const FloatLanes d;
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
        const SpaceVector normal = load3(d, normals, i), w = plane_weights(normal, sharpness);
        const auto own = axis == 0 ? w.x : axis == 1 ? w.y : w.z;
        store_plane(hn::Set(IntLanes(), axis), normal, i, out);
        hn::Store(hn::Div(own, hn::Add(hn::Add(w.x, w.y), w.z)), d, share.lane + i);
    }
}

/// Each lane on the plane that its number draws. A number below 1 times the sum stays below it, so no plane without weight is drawn.
HWY_INLINE void draw_planes(const WaveVector& normals, int sharpness, const WaveFloat& numbers, PlaneLanes& out) {
    const FloatLanes d;
    const IntLanes di;
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
        const SpaceVector normal = load3(d, normals, i), w = plane_weights(normal, sharpness);
        const auto two = hn::Add(w.x, w.y);
        const auto at = hn::Mul(hn::Load(d, numbers.lane + i), hn::Add(two, w.z));
        const auto one_of_two = hn::IfThenElse(hn::RebindMask(di, hn::Lt(at, w.x)), hn::Zero(di), hn::Set(di, 1));
        store_plane(hn::IfThenElse(hn::RebindMask(di, hn::Lt(at, two)), one_of_two, hn::Set(di, 2)), normal, i, out);
    }
}

/// The lanes of a wave at [i, i + Lanes), as masks and signs.
struct PlaneVectors {
    FloatMask x, y;  ///< on the planes across those axes
    FloatVector side;
};
HWY_INLINE PlaneVectors load_planes(const PlaneLanes& planes, size_t i) {
    const FloatLanes d;
    const IntLanes di;
    const auto plane = hn::Load(di, planes.plane.lane + i);
    return {hn::RebindMask(d, hn::Eq(plane, hn::Zero(di))), hn::RebindMask(d, hn::Eq(plane, hn::Set(di, 1))),
            hn::Load(d, planes.side.lane + i)};
}

template <class Corners>
HWY_INLINE void interpolate_plane_coordinates(const CoordinateState& state, const Triplanar& triplanar, const Mesh& mesh,
                                              const Corners& corners, const raster::BarycentricWave& weights, const PlaneLanes& planes,
                                              texunit::WaveCoordinates& out) {
    const FloatLanes d;
    const auto scale = hn::Set(d, triplanar.scale);
    const float* const positions = &mesh.positions[0].x;
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
        const PlaneVectors on = load_planes(planes, i);
        const auto u_of = [&](const SpaceVector& p) HWY_ATTR {
            const auto along_x = hn::IfThenElse(on.y, p.x, hn::Mul(on.side, p.x));
            return hn::Mul(scale, hn::IfThenElse(on.x, hn::Neg(hn::Mul(on.side, p.z)), along_x));
        };
        const auto v_of = [&](const SpaceVector& p)
                              HWY_ATTR { return hn::Mul(scale, hn::IfThenElse(on.y, hn::Mul(on.side, p.z), hn::Neg(p.y))); };
        const SpaceVector p0 = corner_vector<3>(corners, 0, positions, i), p1 = corner_vector<3>(corners, 1, positions, i),
                          p2 = corner_vector<3>(corners, 2, positions, i);
        CornerCoordinate u{u_of(p0), u_of(p1), u_of(p2)}, v{v_of(p0), v_of(p1), v_of(p2)};
        transform_corners(state, u, v);
        interpolate_pair(reduce_ranges(state, {u, v}), load_lanes(weights, i), i, out);
    }
}

/// Coordinates of all maps; `planes` null: those of the mesh.
template <class Corners>
HWY_INLINE void interpolate_map_coordinates(const MaterialState& material, const Mesh& mesh, const Corners& corners,
                                            const raster::BarycentricWave& weights, const PlaneLanes* planes,
                                            texunit::WaveCoordinates* out) {
    for (int k = 0; k < material.coordinate_count; ++k) {
        const CoordinateState& state = material.coordinates[size_t(k)];
        if (planes) {
            interpolate_plane_coordinates(state, *material.material->triplanar, mesh, corners, weights, *planes, out[k]);
        } else {
            interpolate_coordinates(state, mesh, corners, weights, out[k]);
        }
    }
}

/// The plane's own axes, u's turned into the plane of the vertex normal: a flat normal map leaves the vertex normal as it is.
HWY_INLINE void find_plane_tangents(const DrawState& draw, const CoordinateState& state, const PlaneLanes& planes, FragmentWave& out) {
    const FloatLanes d;
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const glm::mat3 linear(draw.world_from_object);
    const glm::mat3x2& m = state.uv_from_vertex;
    const float orientation = m[0][0] * m[1][1] - m[1][0] * m[0][1] < 0.0f ? -1.0f : 1.0f;
    const auto along_u = hn::Set(d, orientation * m[1][1]), along_v = hn::Set(d, -orientation * m[0][1]);
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
        const PlaneVectors on = load_planes(planes, i);
        const SpaceVector u{hn::IfThenElse(on.x, zero, hn::IfThenElse(on.y, one, on.side)), zero,
                            hn::IfThenElseZero(on.x, hn::Neg(on.side))};
        const SpaceVector v{zero, hn::IfThenElse(on.y, zero, hn::Neg(one)), hn::IfThenElseZero(on.y, on.side)};
        const SpaceVector direction = transform(linear, add(scale(u, along_u), scale(v, along_v)));
        const SpaceVector normal = load3(d, out.normal, i);
        store3(d, unit_or(sub(direction, scale(normal, dot(normal, direction))), {zero, zero, zero}), out.tangent, i);
        hn::Store(hn::Set(d, orientation * draw.handedness), d, out.bitangent_sign.lane + i);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();
#endif
