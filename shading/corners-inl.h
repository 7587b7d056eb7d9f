// The corners of the triangles behind a wave's lanes, and what is interpolated between them.
#if defined(RAWTEXEL_SHADING_CORNERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_CORNERS_INL_H_
#undef RAWTEXEL_SHADING_CORNERS_INL_H_
#else
#define RAWTEXEL_SHADING_CORNERS_INL_H_
#endif

#include "raster/anchor-inl.h"
#include "shading/lanes-inl.h"
#include "texunit/gather-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// All lanes lie on one triangle: corner values are loaded once.
struct OneTriangle {
    const uint32_t* vertex;  ///< 3 indices

    /// Components of attribute `values` (`kStride` floats a vertex) at corner `k`.
    template <int kStride, int kCount>
    HWY_INLINE void load(int k, const float* values, size_t, FloatVector (&out)[kCount]) const {
        for (int c = 0; c < kCount; ++c) out[c] = hn::Set(FloatLanes(), values[size_t(vertex[k]) * kStride + size_t(c)]);
    }
};

/// Each lane has its own triangle: corner values are gathered.
struct TrianglePerLane {
    texunit::WaveInt vertex[3];  ///< lanes without a triangle hold a valid index

    template <int kStride, int kCount>
    HWY_INLINE void load(int k, const float* values, size_t i, FloatVector (&out)[kCount]) const {
        const IntLanes di;
        const auto index = hn::Mul(hn::Load(di, vertex[k].lane + i), hn::Set(di, kStride));
        texunit::HWY_NAMESPACE::gather_records<kCount>(values, index, out);
    }
};

/// Weights of corners 1 and 2.
struct CornerWeights {
    FloatVector b1, b2;
};

HWY_INLINE CornerWeights load_weights(const raster::BarycentricWave& weights, size_t i) {
    const FloatLanes d;
    return {hn::Load(d, weights.b1 + i), hn::Load(d, weights.b2 + i)};
}

/// Plain products and sums: texels are picked by what comes out.
HWY_INLINE FloatVector interpolate(const CornerWeights& w, FloatVector f0, FloatVector f1, FloatVector f2) {
    return hn::Add(f0, hn::Add(hn::Mul(w.b1, hn::Sub(f1, f0)), hn::Mul(w.b2, hn::Sub(f2, f0))));
}

/// The first kCount components of attribute `values`.
template <int kStride, int kCount, class Corners>
HWY_INLINE void interpolate(const Corners& corners, const CornerWeights& w, const float* values, size_t i, FloatVector (&out)[kCount]) {
    FloatVector f0[kCount], f1[kCount], f2[kCount];
    corners.template load<kStride>(0, values, i, f0);
    corners.template load<kStride>(1, values, i, f1);
    corners.template load<kStride>(2, values, i, f2);
    for (int c = 0; c < kCount; ++c) out[c] = interpolate(w, f0[c], f1[c], f2[c]);
}

/// Its first component.
template <int kStride, class Corners>
HWY_INLINE FloatVector interpolate(const Corners& corners, const CornerWeights& w, const float* values, size_t i) {
    FloatVector out[1];
    interpolate<kStride>(corners, w, values, i, out);
    return out[0];
}

/// Three consecutive components.
template <int kStride, class Corners>
HWY_INLINE SpaceVector interpolate_vector(const Corners& corners, const CornerWeights& w, const float* values, size_t i) {
    FloatVector out[3];
    interpolate<kStride>(corners, w, values, i, out);
    return {out[0], out[1], out[2]};
}

template <int kStride, class Corners>
HWY_INLINE SpaceVector corner_vector(const Corners& corners, int k, const float* values, size_t i) {
    FloatVector out[3];
    corners.template load<kStride>(k, values, i, out);
    return {out[0], out[1], out[2]};
}

/// Snapping to 1/256 pixel can put a covered sample slightly outside its triangle, and far outside a sliver: attributes stay between
/// their corners' values.
HWY_INLINE CornerWeights clamped(const CornerWeights& w) {
    const FloatLanes d;
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const auto b1 = hn::Min(hn::Max(w.b1, zero), one);
    return {b1, hn::Min(hn::Max(w.b2, zero), hn::Sub(one, b1))};
}

HWY_INLINE void clamp_weights(raster::BarycentricWave& weights) {
    const FloatLanes d;
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
        const CornerWeights w = clamped(load_weights(weights, i));
        hn::Store(w.b1, d, weights.b1 + i);
        hn::Store(w.b2, d, weights.b2 + i);
    }
}

/// Weights and their derivatives.
using WeightLanes = raster::HWY_NAMESPACE::BarycentricLanes;
HWY_INLINE WeightLanes load_lanes(const raster::BarycentricWave& weights, size_t i) {
    const FloatLanes d;
    return {hn::Load(d, weights.b1 + i),     hn::Load(d, weights.b2 + i),     hn::Load(d, weights.db1_dx + i),
            hn::Load(d, weights.db2_dx + i), hn::Load(d, weights.db1_dy + i), hn::Load(d, weights.db2_dy + i)};
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();
#endif
