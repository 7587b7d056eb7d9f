// Cube maps in vectors: the face a direction meets, and the texels beyond a face's edges and corners.
#include "texunit/cube_map.h"
#include "texunit/select-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_CUBE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_CUBE_INL_H_
#undef RAWTEXEL_TEXUNIT_CUBE_INL_H_
#else
#define RAWTEXEL_TEXUNIT_CUBE_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A texel of a cube map. `cube` is 6 times the number of the cube in its array: a slice is cube + face.
template <class V>
struct CubeTexel {
    V cube, face, x, y;
    V slice() const { return hn::Add(cube, face); }
};

template <class V>
HWY_INLINE CubeTexel<V> cube_texel(V slice, V x, V y) {
    const hn::DFromV<V> d;
    const hn::Rebind<float, decltype(d)> df;
    // Slices are far below 2^20, and a quotient that is not whole is at least 1/6 away from a whole one.
    const V cube = hn::Mul(hn::ConvertTo(d, hn::Mul(hn::ConvertTo(df, slice), hn::Set(df, 1.0f / 6 + 0x1p-24f))), hn::Set(d, 6));
    return {cube, hn::Sub(slice, cube), x, y};
}

/// The texel of the neighbouring face where `at` lies beyond one edge of its own (`extent` texels wide); other lanes are unchanged.
template <class V>
HWY_INLINE CubeTexel<V> step_across(const CubeTexel<V>& at, V extent) {
    const hn::DFromV<V> d;
    const V zero = hn::Zero(d), one = hn::Set(d, 1);
    const auto outside_x = beyond_edges(at.x, extent);
    const auto outside = hn::Or(outside_x, beyond_edges(at.y, extent));
    const V across = hn::IfThenElse(outside_x, at.x, at.y), along = hn::IfThenElse(outside_x, at.y, at.x);
    const auto before = across < zero;
    const V depth = hn::IfThenElse(before, hn::Not(across), hn::Sub(across, extent));

    const V edge = hn::Add(hn::IfThenElse(outside_x, zero, hn::Set(d, 2)), hn::IfThenElse(before, zero, one));
    const V beyond = hn::GatherIndex(d, kCubeEdges.data(), hn::Add(hn::ShiftLeft<2>(at.face), edge));
    const auto has = [&](int bit) HWY_ATTR { return hn::TestBit(beyond, hn::Set(d, bit)); };
    const auto x_is_depth = has(CubeEdge::kDepthBit);
    const V x = hn::IfThenElse(x_is_depth, depth, along), y = hn::IfThenElse(x_is_depth, along, depth);
    const V last = hn::Sub(extent, one);
    const V new_x = hn::IfThenElse(has(CubeEdge::kFlipXBit), hn::Sub(last, x), x);
    const V new_y = hn::IfThenElse(has(CubeEdge::kFlipYBit), hn::Sub(last, y), y);
    return {at.cube, hn::IfThenElse(outside, hn::And(beyond, hn::Set(d, CubeEdge::kFaceBits)), at.face),
            hn::IfThenElse(outside, new_x, at.x), hn::IfThenElse(outside, new_y, at.y)};
}

/// The texel that an index beyond the edges of one axis means, across as many faces as it takes; lanes beyond both axes are unspecified.
template <class V>
HWY_INLINE CubeTexel<V> fold_onto_faces(CubeTexel<V> at, V extent) {
    const hn::DFromV<V> d;
    const auto outside = [&] HWY_ATTR {
        return hn::Xor(hn::VecFromMask(d, beyond_edges(at.x, extent)), hn::VecFromMask(d, beyond_edges(at.y, extent)));
    };
    while (!hn::AllFalse(d, hn::MaskFromVec(outside()))) {
        const CubeTexel<V> next = step_across(at, extent);
        const auto moving = hn::MaskFromVec(outside());
        at.face = hn::IfThenElse(moving, next.face, at.face);
        at.x = hn::IfThenElse(moving, next.x, at.x);
        at.y = hn::IfThenElse(moving, next.y, at.y);
    }
    return at;
}

/// What an index of a face means: one texel, or beyond a corner, where there is none, the mean of the three texels that meet there.
template <class V>
struct CubeTap {
    CubeTexel<V> texel[3];  ///< all the same but in the lanes of `corner`
    hn::Mask<hn::DFromV<V>> corner;
};

template <class V>
HWY_NOINLINE CubeTap<V> resolve_cube_tap(V slice, V x, V y, V extent) {
    const hn::DFromV<V> d;
    const V zero = hn::Zero(d), last = hn::Sub(extent, hn::Set(d, 1));
    const auto clamp = [&](V i) HWY_ATTR { return hn::Min(hn::Max(i, zero), last); };
    // One texel beyond the edge at most, for the neighbours of a corner texel.
    const auto just_beyond = [&](V i) HWY_ATTR { return hn::Min(hn::Max(i, hn::Set(d, -1)), extent); };
    CubeTap<V> tap;
    tap.corner = hn::And(beyond_edges(x, extent), beyond_edges(y, extent));
    const auto choose = [&](V corner_x, V corner_y) HWY_ATTR {
        return fold_onto_faces(cube_texel(slice, hn::IfThenElse(tap.corner, corner_x, x), hn::IfThenElse(tap.corner, corner_y, y)), extent);
    };
    tap.texel[0] = choose(clamp(x), clamp(y));
    if (hn::AllFalse(d, tap.corner)) {
        tap.texel[1] = tap.texel[2] = tap.texel[0];
        return tap;
    }
    tap.texel[1] = choose(just_beyond(x), clamp(y));
    tap.texel[2] = choose(clamp(x), just_beyond(y));
    return tap;
}

/// Directions into a cube map as coordinates on the face each meets, 0 at its left and top edge and 1 at the others, with derivatives.
struct CubeCoordinates {
    WaveCoordinates face;
    WaveFloat u_rest, v_rest;  ///< what rounding took from face.u and face.v
    WaveInt slice;             ///< the face, 0..5
};

/// Lengths do not matter, the zero vector means +Z. On ties Z beats Y beats X (Vulkan "Cube Map Face Selection", D3D11.3 7.18.12).
/// Derivatives by the quotient rule ("Cube Map Derivative Transformation").
HWY_NOINLINE inline void project_onto_faces(const WaveCoordinates3& at, CubeCoordinates& out) {
    const FloatTag d;
    const IntTag di;
    using V = hn::Vec<FloatTag>;
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f);
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto component = [&](int axis) HWY_ATTR {
            const V p = hn::Load(d, at.position[axis].lane + i);
            return hn::IfThenElseZero(hn::IsFinite(p), p);
        };
        const V x = component(0), y = component(1), z = component(2);
        const V ax = hn::Abs(x), ay = hn::Abs(y), az = hn::Abs(z);
        const auto is_z = hn::And(az >= ax, az >= ay);
        const auto is_y = hn::AndNot(is_z, ay >= ax);
        // Of the three components of anything: the one along the face's normal, its columns and its rows.
        const auto major = [&](V vx, V vy, V vz) HWY_ATTR { return hn::IfThenElse(is_z, vz, hn::IfThenElse(is_y, vy, vx)); };
        const V normal = major(x, y, z);
        const auto negative = normal < zero;
        const auto flip = [&](hn::Mask<FloatTag> mask, V v) HWY_ATTR { return hn::IfThenElse(mask, hn::Neg(v), v); };
        const auto right = [&](V vx, V, V vz) HWY_ATTR {
            const V on_z = flip(negative, vx), on_x = flip(hn::Not(negative), vz);
            return hn::IfThenElse(is_z, on_z, hn::IfThenElse(is_y, vx, on_x));
        };
        const auto down = [&](V, V vy, V vz) HWY_ATTR { return hn::IfThenElse(is_y, flip(negative, vz), hn::Neg(vy)); };

        // A common power of two changes nothing and keeps the remainders of the quotients from underflow.
        const V size = hn::Abs(normal);
        const V scale = hn::IfThenElse(size < hn::Set(d, 0x1p-60f), hn::Set(d, 0x1p60f),
                                       hn::IfThenElse(size > hn::Set(d, 0x1p60f), hn::Set(d, 0x1p-60f), one));
        const V length = hn::Mul(size, scale);
        const auto defined = length > zero;

        // s = (q + 1)/2 with q = component/length in two terms: the rounded quotient and what it lacks.
        const auto project = [&](V part, float* s, float* rest) HWY_ATTR {
            const V scaled = hn::Mul(part, scale);
            const V q = hn::IfThenElseZero(defined, hn::Div(scaled, length));
            const V lack = hn::IfThenElseZero(defined, hn::Div(fused_multiply_add(hn::Neg(q), length, scaled), length));
            const V sum = hn::Add(q, one);
            const V q_part = hn::Sub(sum, one);
            const V error = hn::Add(hn::Sub(q, q_part), hn::Sub(one, hn::Sub(sum, q_part)));
            hn::Store(hn::Mul(sum, half), d, s);
            hn::Store(hn::Mul(hn::Add(error, lack), half), d, rest);
            return q;
        };
        const V qs = project(right(x, y, z), out.face.u.lane + i, out.u_rest.lane + i);
        const V qt = project(down(x, y, z), out.face.v.lane + i, out.v_rest.lane + i);

        const auto derive = [&](const WaveFloat(&change)[3], float* ds, float* dt) HWY_ATTR {
            const auto load = [&](int axis) HWY_ATTR { return hn::Load(d, change[axis].lane + i); };
            const V vx = load(0), vy = load(1), vz = load(2);
            const V growth = flip(negative, major(vx, vy, vz));
            const auto quotient = [&](V part, V q) HWY_ATTR { return hn::Mul(half, hn::Div(hn::Sub(part, hn::Mul(q, growth)), size)); };
            hn::Store(quotient(right(vx, vy, vz), qs), d, ds);
            hn::Store(quotient(down(vx, vy, vz), qt), d, dt);
        };
        derive(at.dx, out.face.dudx.lane + i, out.face.dvdx.lane + i);
        derive(at.dy, out.face.dudy.lane + i, out.face.dvdy.lane + i);

        const auto number = [&](int n) HWY_ATTR { return hn::Set(di, n); };
        const auto axis =
            hn::IfThenElse(hn::RebindMask(di, is_z), number(4), hn::IfThenElse(hn::RebindMask(di, is_y), number(2), number(0)));
        hn::Store(hn::Add(axis, hn::IfThenElseZero(hn::RebindMask(di, negative), number(1))), di, out.slice.lane + i);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_CUBE_INL_H_
