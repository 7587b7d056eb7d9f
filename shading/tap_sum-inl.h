// Filtering after shading: the weighted sum of what a material's taps look like.
#if defined(RAWTEXEL_SHADING_TAP_SUM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_TAP_SUM_INL_H_
#undef RAWTEXEL_SHADING_TAP_SUM_INL_H_
#else
#define RAWTEXEL_SHADING_TAP_SUM_INL_H_
#endif

#include "shading/alpha-inl.h"
#include "shading/fragment.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// One tap, shaded.
struct ShadedTap {
    const WaveVector* radiance;
    const SurfaceWave* surface;
    const WaveFloat* weight;
    const WaveFloat* alpha;  ///< of MASK and BLEND surfaces whose base colour is drawn; else null
    WaveMask lanes;
};

/// MASK and BLEND surfaces that are seen were let stand with the probability C = sum of w*c over taps of positive weight, c being the share
/// that a tap covers, so what they show is the mean over what covers: sum of w*c*S / C. Taps of negative weight do not take part in the
/// decision and are added as they are.
class TapSum {
  public:
    void clear() { *this = {}; }

    HWY_INLINE void add(const Material& material, const ShadedTap& tap) {
        const FloatLanes d;
        const auto zero = hn::Zero(d);
        for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
            const auto weight = hn::IfThenElseZero(wave_mask_lanes(tap.lanes, i), hn::Load(d, tap.weight->lane + i));
            const auto positive = hn::Max(weight, zero), negative = hn::Min(weight, zero);
            auto covered = positive;
            if (tap.alpha) covered = hn::Mul(positive, covered_share(material, hn::Load(d, tap.alpha->lane + i)));
            add_to(positive_weight_, positive, i);
            add_to(covered_weight_, covered, i);
            add_to(positive_, covered, *tap.radiance, i);
            add_to(negative_, negative, *tap.radiance, i);
            add_to(normal_, weight, tap.surface->normal, i);
            add_to(base_color_, weight, tap.surface->base_color, i);
        }
    }

    HWY_INLINE void radiance(WaveVector& out) const {
        const FloatLanes d;
        const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
        for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
            const auto covered = hn::Load(d, covered_weight_.lane + i);
            const auto scale_up = hn::IfThenElse(covered > zero, hn::Div(hn::Load(d, positive_weight_.lane + i), covered), one);
            store3(d, shading::HWY_NAMESPACE::add(scale(load3(d, positive_, i), scale_up), load3(d, negative_, i)), out, i);
        }
    }

    /// Means for layers: of the normals a direction, of base colours a colour.
    HWY_INLINE void layers(SurfaceWave& out) const {
        const FloatLanes d;
        for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d))
            store3(d, unit_or(load3(d, normal_, i), load3(d, out.geometric_normal, i)), out.normal, i);
        out.base_color = base_color_;
    }

  private:
    static HWY_INLINE void add_to(WaveFloat& sum, FloatVector value, size_t i) {
        const FloatLanes d;
        hn::Store(hn::Add(hn::Load(d, sum.lane + i), value), d, sum.lane + i);
    }
    static HWY_INLINE void add_to(WaveVector& sum, FloatVector weight, const WaveVector& value, size_t i) {
        const FloatLanes d;
        // Lanes that no tap weighs may hold anything, infinities too.
        const auto used = hn::Ne(weight, hn::Zero(d));
        const SpaceVector v = load3(d, value, i);
        const auto term = [&](FloatVector x) HWY_ATTR { return hn::IfThenElseZero(used, hn::Mul(weight, x)); };
        store3(d, shading::HWY_NAMESPACE::add(load3(d, sum, i), SpaceVector{term(v.x), term(v.y), term(v.z)}), sum, i);
    }

    WaveVector positive_{}, negative_{}, normal_{}, base_color_{};
    WaveFloat positive_weight_{}, covered_weight_{};
};

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();
#endif
