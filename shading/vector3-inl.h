// Three-component vectors, one register per component. Plain products and sums in a fixed order: the same bits on every instruction set.
#if defined(RAWTEXEL_SHADING_VECTOR3_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_VECTOR3_INL_H_
#undef RAWTEXEL_SHADING_VECTOR3_INL_H_
#else
#define RAWTEXEL_SHADING_VECTOR3_INL_H_
#endif

#include "shading/surface.h"

#include <hwy/highway.h>

#include <glm/glm.hpp>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct Vector3 {
    V x, y, z;
};

template <class D>
using Vector3Of = Vector3<hn::Vec<D>>;

template <class D>
HWY_INLINE Vector3Of<D> load3(D d, const WaveVector& wave, size_t lane) {
    return {hn::Load(d, wave.x.lane + lane), hn::Load(d, wave.y.lane + lane), hn::Load(d, wave.z.lane + lane)};
}

template <class D>
HWY_INLINE void store3(D d, const Vector3Of<D>& a, WaveVector& wave, size_t lane) {
    hn::Store(a.x, d, wave.x.lane + lane);
    hn::Store(a.y, d, wave.y.lane + lane);
    hn::Store(a.z, d, wave.z.lane + lane);
}

template <class D>
HWY_INLINE Vector3Of<D> set3(D d, const glm::vec3& a) {
    return {hn::Set(d, a.x), hn::Set(d, a.y), hn::Set(d, a.z)};
}

template <class V>
HWY_INLINE Vector3<V> add(const Vector3<V>& a, const Vector3<V>& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}

template <class V>
HWY_INLINE Vector3<V> sub(const Vector3<V>& a, const Vector3<V>& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

template <class V>
HWY_INLINE Vector3<V> mul(const Vector3<V>& a, const Vector3<V>& b) {
    return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)};
}

template <class V>
HWY_INLINE Vector3<V> scale(const Vector3<V>& a, V s) {
    return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}

template <class V>
HWY_INLINE V dot(const Vector3<V>& a, const Vector3<V>& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

template <class V>
HWY_INLINE Vector3<V> cross(const Vector3<V>& a, const Vector3<V>& b) {
    return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
            hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

/// Whether any of the `lanes` lanes from `first` on is active.
HWY_INLINE bool any_active(WaveMask mask, size_t first, size_t lanes) {
    return ((uint64_t{mask} >> first) & ((uint64_t{1} << lanes) - 1)) != 0;
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_SHADING_VECTOR3_INL_H_
