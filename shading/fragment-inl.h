// Interpolation: from the corners of the visible triangles to the geometry of a wave.
#if defined(RAWTEXEL_SHADING_FRAGMENT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_FRAGMENT_INL_H_
#undef RAWTEXEL_SHADING_FRAGMENT_INL_H_
#else
#define RAWTEXEL_SHADING_FRAGMENT_INL_H_
#endif

#include "shading/coordinates-inl.h"
#include "shading/fragment.h"
#include "shading/planes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// Position and normals.
template <class Corners>
HWY_INLINE void interpolate_geometry(const DrawState& draw, const Corners& corners, const raster::BarycentricWave& weights,
                                     FragmentWave& out) {
    const FloatLanes d;
    const Mesh& mesh = *draw.mesh;
    const glm::mat3 linear(draw.world_from_object);
    const glm::vec3 origin(draw.world_from_object[3]);
    const float* positions = &mesh.positions[0].x;
    const float* normals = mesh.normals.empty() ? nullptr : &mesh.normals[0].x;
    const SpaceVector nowhere = set3(d, glm::vec3(0.0f));
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
        const CornerWeights w = load_weights(weights, i);
        const SpaceVector p0 = corner_vector<3>(corners, 0, positions, i);
        const SpaceVector e1 = sub(corner_vector<3>(corners, 1, positions, i), p0),
                          e2 = sub(corner_vector<3>(corners, 2, positions, i), p0);
        const SpaceVector position = add(p0, add(scale(e1, w.b1), scale(e2, w.b2)));
        store3(d, add(transform(linear, position), set3(d, origin)), out.position, i);
        const SpaceVector geometric = unit_or(transform(draw.world_from_normal, cross(e1, e2)), nowhere);
        store3(d, geometric, out.geometric_normal, i);
        if (normals) {
            const SpaceVector normal = transform(draw.world_from_normal, interpolate_vector<3>(corners, w, normals, i));
            store3(d, unit_or(normal, geometric), out.normal, i);
        } else {
            store3(d, geometric, out.normal, i);
        }
    }
}

/// Tangents of the mesh. A mirroring transform turns the bitangent, which goes along with the object, against cross(normal, tangent).
template <class Corners>
HWY_INLINE void interpolate_tangents(const DrawState& draw, const Corners& corners, const raster::BarycentricWave& weights,
                                     FragmentWave& out) {
    const FloatLanes d;
    const glm::mat3 linear(draw.world_from_object);
    const float* tangents = &draw.mesh->tangents[0].x;
    const SpaceVector none = set3(d, glm::vec3(0.0f));
    const FloatVector handedness = hn::Set(d, draw.handedness);
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
        const CornerWeights w = load_weights(weights, i);
        store3(d, unit_or(transform(linear, interpolate_vector<4>(corners, w, tangents, i)), none), out.tangent, i);
        FloatVector sign[1];
        corners.template load<4>(0, tangents + 3, i, sign);
        hn::Store(hn::Mul(handedness, sign[0]), d, out.bitangent_sign.lane + i);
    }
}

/// Tangents of a mesh that has none, from the gradient of the normal map's own u over the triangle. The bitangent points against v,
/// as glTF's normal maps have +Y up and v down.
template <class Corners>
HWY_INLINE void derive_tangents(const DrawState& draw, const CoordinateState& state, const Corners& corners, FragmentWave& out) {
    const FloatLanes d;
    const glm::mat3 linear(draw.world_from_object);
    const float* positions = &draw.mesh->positions[0].x;
    const SpaceVector none = set3(d, glm::vec3(0.0f));
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
        const SpaceVector p0 = corner_vector<3>(corners, 0, positions, i);
        const SpaceVector e1 = sub(corner_vector<3>(corners, 1, positions, i), p0),
                          e2 = sub(corner_vector<3>(corners, 2, positions, i), p0);
        CornerCoordinate u, v;
        corner_coordinates(state, *draw.mesh, corners, i, u, v);
        const auto du1 = hn::Sub(u.f1, u.f0), du2 = hn::Sub(u.f2, u.f0), dv1 = hn::Sub(v.f1, v.f0), dv2 = hn::Sub(v.f2, v.f0);
        const auto area = hn::Sub(hn::Mul(du1, dv2), hn::Mul(du2, dv1));
        const auto orientation = hn::CopySign(hn::Set(d, 1.0f), area);
        const SpaceVector along_u = scale(transform(linear, sub(scale(e1, dv2), scale(e2, dv1))), orientation);
        const SpaceVector normal = load3(d, out.normal, i);
        const SpaceVector tangent = unit_or(sub(along_u, scale(normal, dot(normal, along_u))), none);
        const auto usable = hn::Ne(area, hn::Zero(d));
        store3(d, {hn::IfThenElseZero(usable, tangent.x), hn::IfThenElseZero(usable, tangent.y), hn::IfThenElseZero(usable, tangent.z)},
               out.tangent, i);
        hn::Store(hn::Mul(orientation, hn::Set(d, -draw.handedness)), d, out.bitangent_sign.lane + i);
    }
}

template <class Corners>
HWY_INLINE void interpolate_colors(const Mesh& mesh, const Corners& corners, const raster::BarycentricWave& weights,
                                   texunit::WaveColor& out) {
    const FloatLanes d;
    const float* colors = &mesh.colors[0].x;
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
        const CornerWeights w = load_weights(weights, i);
        FloatVector color[4];
        interpolate<4>(corners, w, colors, i, color);
        for (int c = 0; c < 4; ++c) hn::Store(color[c], d, out.channel[c].lane + i);
    }
}

/// All that the draw's material reads, on the planes of a triplanar one; without `shapes` no position and normals. `out.facing` is the
/// caller's.
template <class Corners>
HWY_INLINE void interpolate_fragment(const DrawState& draw, const Corners& corners, const raster::BarycentricWave& weights, bool shapes,
                                     FragmentWave& out, const PlaneLanes* planes = nullptr) {
    const MaterialState& material = *draw.material;
    const Mesh& mesh = *draw.mesh;
    if (shapes) interpolate_geometry(draw, corners, weights, out);
    if (!mesh.colors.empty()) interpolate_colors(mesh, corners, weights, out.color);
    interpolate_map_coordinates(material, mesh, corners, weights, planes, out.coordinates);
    const MapState& normal_map = material.maps[kNormal];
    if (!normal_map.texture) return;
    if (planes) {
        find_plane_tangents(draw, material.coordinates[size_t(normal_map.coordinates)], *planes, out);
    } else if (mesh.tangents.empty()) {
        derive_tangents(draw, material.coordinates[size_t(normal_map.coordinates)], corners, out);
    } else {
        interpolate_tangents(draw, corners, weights, out);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();
#endif
