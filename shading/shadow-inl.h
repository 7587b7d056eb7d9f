// Percentage-closer filtering in vectors: shadow_visibility of shadow_map.h, operation by operation, so the bits are the same.
#if defined(RAWTEXEL_SHADING_SHADOW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_SHADOW_INL_H_
#undef RAWTEXEL_SHADING_SHADOW_INL_H_
#else
#define RAWTEXEL_SHADING_SHADOW_INL_H_
#endif

#include "shading/shadow_map.h"
#include "shading/vector3-inl.h"
#include "texunit/gather-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// Integral of a tent of total weight 1 and radius 1.5 from minus infinity to `edge`.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V tent_integral(D d, V edge) {
    const V rest = hn::Sub(hn::Set(d, 1.5f), hn::Abs(edge));
    const V tail = hn::Mul(hn::Mul(rest, rest), hn::Set(d, 1.0f / 4.5f));
    return hn::IfThenElse(hn::Gt(edge, hn::Zero(d)), hn::Sub(hn::Set(d, 1.0f), tail), tail);
}

/// Four taps along one axis: where they begin and what each weighs.
template <class V>
struct TentTaps {
    V first;
    V weight0, weight1, weight2, weight3;
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE TentTaps<V> tent_taps(D d, V at, int size) {
    // Points far outside read no texel; the clamp only keeps their texel numbers small.
    const V held = hn::Min(hn::Max(at, hn::Set(d, -8.0f)), hn::Set(d, float(size) + 8.0f));
    TentTaps<V> taps;
    taps.first = hn::Floor(hn::Sub(held, hn::Set(d, 1.5f)));
    const V edge = hn::Sub(taps.first, at);
    const V sum0 = tent_integral(d, hn::Add(edge, hn::Set(d, 1.0f)));
    const V sum1 = tent_integral(d, hn::Add(edge, hn::Set(d, 2.0f)));
    const V sum2 = tent_integral(d, hn::Add(edge, hn::Set(d, 3.0f)));
    taps.weight0 = sum0;
    taps.weight1 = hn::Sub(sum1, sum0);
    taps.weight2 = hn::Sub(sum2, sum1);
    taps.weight3 = hn::Sub(hn::Set(d, 1.0f), sum2);
    return taps;
}

/// Lanes with a tap inside of the map.
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> within_reach(D d, const TentTaps<V>& taps, int size) {
    return hn::And(hn::Gt(taps.first, hn::Set(d, -4.0f)), hn::Lt(taps.first, hn::Set(d, float(size))));
}

/// A row of the map's matrix times a vector, without the translation.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V row_dot(D d, const glm::mat4& m, int row, const Vector3<V>& v) {
    return dot(set3(d, glm::vec3(m[0][row], m[1][row], m[2][row])), v);
}

/// The receiver's plane as depth over the map, bias included, and the point it passes through.
template <class V>
struct ReceiverPlane {
    V x, y, depth, dz_dx, dz_dy;
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE ReceiverPlane<V> receiver_plane(D d, const ShadowMap& map, const Vector3<V>& position, const Vector3<V>& normal, V cosine) {
    const glm::mat4& m = map.map_from_world;
    const V one = hn::Set(d, 1.0f);
    ReceiverPlane<V> plane;
    plane.x = hn::Add(row_dot(d, m, 0, position), hn::Set(d, m[3][0]));
    plane.y = hn::Add(row_dot(d, m, 1, position), hn::Set(d, m[3][1]));
    const V z = hn::Add(row_dot(d, m, 2, position), hn::Set(d, m[3][2]));

    const V steep = hn::Max(cosine, hn::Set(d, kShadowMinCosine));
    const V slope = hn::Div(hn::Set(d, map.texel_world * map.texel_world), hn::Mul(steep, hn::Set(d, map.depth_world)));
    plane.dz_dx = hn::Neg(hn::Mul(row_dot(d, m, 0, normal), slope));
    plane.dz_dy = hn::Neg(hn::Mul(row_dot(d, m, 1, normal), slope));
    const V tangent = hn::Div(hn::Sqrt(hn::Max(hn::Sub(one, hn::Mul(steep, steep)), hn::Zero(d))), steep);
    const V texels = hn::Add(hn::Mul(tangent, hn::Set(d, kShadowSlopeBias)), hn::Set(d, kShadowConstantBias));
    const V bias = hn::Add(hn::Mul(texels, hn::Set(d, map.texel_world / map.depth_world)), hn::Set(d, kShadowDepthRounding));
    plane.depth = hn::Add(z, bias);
    return plane;
}

/// The tap that a number draws with its weight.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V drawn_tap(D d, const TentTaps<V>& taps, V number) {
    const V one = hn::Set(d, 1.0f);
    const V sum0 = taps.weight0, sum1 = hn::Add(sum0, taps.weight1), sum2 = hn::Add(sum1, taps.weight2);
    const auto beyond = [&](V sum) HWY_ATTR { return hn::IfThenElseZero(hn::Ge(number, sum), one); };
    return hn::Add(taps.first, hn::Add(beyond(sum0), hn::Add(beyond(sum1), beyond(sum2))));
}

/// Weight of one row of four taps, or the first of them, whose texels are nearer to the light than the receiver.
template <int kTaps = 4, class D, class V = hn::Vec<D>>
HWY_INLINE V hidden_row(D d, const ShadowMap& map, const ReceiverPlane<V>& plane, const TentTaps<V>& columns, V row, V row_weight,
                        V hidden) {
    const hn::RebindToSigned<D> di;
    const V zero = hn::Zero(d), half = hn::Set(d, 0.5f), extent = hn::Set(d, float(map.size));
    const V plane_y = hn::Add(plane.depth, hn::Mul(hn::Sub(hn::Add(row, half), plane.y), plane.dz_dy));
    const auto row_inside = hn::And(hn::Ge(row, zero), hn::Lt(row, extent));
    const auto row_start = hn::Mul(hn::ConvertTo(di, hn::IfThenElseZero(row_inside, row)), hn::Set(di, map.size));

    const auto tap = [&](float offset, V weight) HWY_ATTR {
        const V column = hn::Add(columns.first, hn::Set(d, offset));
        const V plane_xy = hn::Add(plane_y, hn::Mul(hn::Sub(hn::Add(column, half), plane.x), plane.dz_dx));
        const auto inside = hn::And(row_inside, hn::And(hn::Ge(column, zero), hn::Lt(column, extent)));
        const auto index = hn::Add(row_start, hn::ConvertTo(di, hn::IfThenElseZero(inside, column)));
        const V stored = texunit::HWY_NAMESPACE::gather_from(map.depth.data(), index);
        const auto nearer = hn::And(inside, hn::Gt(stored, hn::Max(plane_xy, zero)));
        hidden = hn::Add(hidden, hn::IfThenElseZero(nearer, hn::Mul(weight, row_weight)));
    };
    tap(0.0f, columns.weight0);
    if constexpr (kTaps == 1) return hidden;
    tap(1.0f, columns.weight1);
    tap(2.0f, columns.weight2);
    tap(3.0f, columns.weight3);
    return hidden;
}

/// Share of the map's light that reaches each lane's surface. Any input is safe; non-finite positions are outside the map.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V shadow_visibility_lanes(D d, const ShadowMap& map, const Vector3<V>& position, const Vector3<V>& normal, bool skips) {
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const V cosine = hn::Mul(row_dot(d, map.map_from_world, 2, normal), hn::Set(d, map.depth_world));
    const auto facing = hn::Gt(cosine, zero);
    if (skips && hn::AllFalse(d, facing)) return zero;

    const ReceiverPlane<V> plane = receiver_plane(d, map, position, normal, cosine);
    const TentTaps<V> columns = tent_taps(d, plane.x, map.size), rows = tent_taps(d, plane.y, map.size);
    const auto inside = hn::And(within_reach(d, columns, map.size), within_reach(d, rows, map.size));
    if (skips && hn::AllFalse(d, inside)) return hn::IfThenElseZero(facing, one);
    V hidden = zero;
    hidden = hidden_row(d, map, plane, columns, rows.first, rows.weight0, hidden);
    hidden = hidden_row(d, map, plane, columns, hn::Add(rows.first, hn::Set(d, 1.0f)), rows.weight1, hidden);
    hidden = hidden_row(d, map, plane, columns, hn::Add(rows.first, hn::Set(d, 2.0f)), rows.weight2, hidden);
    hidden = hidden_row(d, map, plane, columns, hn::Add(rows.first, hn::Set(d, 3.0f)), rows.weight3, hidden);
    return hn::IfThenElseZero(facing, hn::Max(hn::Sub(one, hidden), zero));
}

/// One of the 16 tests, drawn with its weight by two numbers in [0, 1): 0 or 1, and in the mean shadow_visibility_lanes.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V drawn_shadow_visibility_lanes(D d, const ShadowMap& map, const Vector3<V>& position, const Vector3<V>& normal, V x, V y,
                                           bool skips) {
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const V cosine = hn::Mul(row_dot(d, map.map_from_world, 2, normal), hn::Set(d, map.depth_world));
    const auto facing = hn::Gt(cosine, zero);
    if (skips && hn::AllFalse(d, facing)) return zero;

    const ReceiverPlane<V> plane = receiver_plane(d, map, position, normal, cosine);
    TentTaps<V> column = tent_taps(d, plane.x, map.size);
    column.first = drawn_tap(d, column, x);
    column.weight0 = one;
    column.weight1 = column.weight2 = column.weight3 = zero;
    const V row = drawn_tap(d, tent_taps(d, plane.y, map.size), y);
    const V hidden = hidden_row<1>(d, map, plane, column, row, one, zero);
    return hn::IfThenElseZero(facing, hn::Sub(one, hidden));
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_SHADING_SHADOW_INL_H_
