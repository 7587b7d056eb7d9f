// Lanes of a wave as highway vectors: masks, unit vectors, transforms.
#if defined(RAWTEXEL_SHADING_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_LANES_INL_H_
#undef RAWTEXEL_SHADING_LANES_INL_H_
#else
#define RAWTEXEL_SHADING_LANES_INL_H_
#endif

#include "shading/vector3-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

using FloatLanes = hn::ScalableTag<float>;
using IntLanes = hn::RebindToSigned<FloatLanes>;
using UintLanes = hn::RebindToUnsigned<FloatLanes>;
using FloatVector = hn::Vec<FloatLanes>;
using FloatMask = hn::Mask<FloatLanes>;

/// Lanes [i, i + Lanes) of a wave's mask.
HWY_INLINE FloatMask wave_mask_lanes(texunit::WaveMask mask, size_t i) {
    alignas(64) static constexpr uint32_t kLaneBit[32] = {1u << 0,  1u << 1,  1u << 2,  1u << 3,  1u << 4,  1u << 5,  1u << 6,  1u << 7,
                                                          1u << 8,  1u << 9,  1u << 10, 1u << 11, 1u << 12, 1u << 13, 1u << 14, 1u << 15,
                                                          1u << 16, 1u << 17, 1u << 18, 1u << 19, 1u << 20, 1u << 21, 1u << 22, 1u << 23,
                                                          1u << 24, 1u << 25, 1u << 26, 1u << 27, 1u << 28, 1u << 29, 1u << 30, 1u << 31};
    const UintLanes du;
    return hn::RebindMask(FloatLanes(), hn::TestBit(hn::Set(du, mask), hn::Load(du, kLaneBit + i)));
}

/// The bits of a comparison's lanes, at their place in a wave's mask.
HWY_INLINE texunit::WaveMask wave_mask_bits(FloatMask lanes, size_t i) {
    uint8_t bytes[8] = {};
    hn::StoreMaskBits(FloatLanes(), lanes, bytes);
    return texunit::WaveMask(uint32_t(bytes[0]) | uint32_t(bytes[1]) << 8) << i;
}

HWY_INLINE void store_wave(const WaveFloat& value, texunit::WaveMask mask, WaveFloat& out) {
    if (mask == texunit::kWaveFull) {
        out = value;
        return;
    }
    const FloatLanes d;
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d))
        hn::BlendedStore(hn::Load(d, value.lane + i), wave_mask_lanes(mask, i), d, out.lane + i);
}
HWY_INLINE void store_value(float value, texunit::WaveMask mask, WaveFloat& out) {
    const FloatLanes d;
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d))
        hn::BlendedStore(hn::Set(d, value), wave_mask_lanes(mask, i), d, out.lane + i);
}

/// A vector in space per lane.
using SpaceVector = Vector3<FloatVector>;

HWY_INLINE SpaceVector load_rgb(const texunit::WaveColor& color, size_t i) {
    const FloatLanes d;
    return {hn::Load(d, color.channel[0].lane + i), hn::Load(d, color.channel[1].lane + i), hn::Load(d, color.channel[2].lane + i)};
}

/// Unit vector along `a`, or `fallback` where `a` is zero or not finite. No length over- or underflows.
HWY_INLINE SpaceVector unit_or(const SpaceVector& a, const SpaceVector& fallback) {
    const FloatLanes d;
    const FloatVector largest = hn::Max(hn::Max(hn::Abs(a.x), hn::Abs(a.y)), hn::Abs(a.z));
    const SpaceVector scaled = scale(a, hn::Div(hn::Set(d, 1.0f), largest));
    const FloatVector length2 = dot(scaled, scaled);
    const FloatMask good = hn::And(hn::Ge(length2, hn::Set(d, 0.5f)), hn::Le(length2, hn::Set(d, 4.0f)));
    const SpaceVector unit = scale(scaled, hn::Div(hn::Set(d, 1.0f), hn::Sqrt(length2)));
    return {hn::IfThenElse(good, unit.x, fallback.x), hn::IfThenElse(good, unit.y, fallback.y), hn::IfThenElse(good, unit.z, fallback.z)};
}

HWY_INLINE SpaceVector transform(const glm::mat3& m, const SpaceVector& v) {
    const FloatLanes d;
    return add(add(scale(set3(d, m[0]), v.x), scale(set3(d, m[1]), v.y)), scale(set3(d, m[2]), v.z));
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();
#endif
