// Planes or layers of a material blended: what they look like, or what they are.
#if defined(RAWTEXEL_SHADING_BRANCH_SUM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_BRANCH_SUM_INL_H_
#undef RAWTEXEL_SHADING_BRANCH_SUM_INL_H_
#else
#define RAWTEXEL_SHADING_BRANCH_SUM_INL_H_
#endif

#include "shading/lanes-inl.h"
#include "shading/surface.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

class BranchSum {
  public:
    void clear() { *this = {}; }

    HWY_INLINE void add_light(const WaveFloat& weight, WaveMask lanes, const WaveVector& radiance, const SurfaceWave& surface) {
        const FloatLanes d;
        for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
            const Weight w = load_weight(weight, lanes, i);
            add_to(radiance_, w, radiance, i);
            add_to(normal_, w, surface.normal, i);
            add_to(base_color_, w, surface.base_color, i);
        }
    }

    /// An unlit surface is its base colour.
    HWY_INLINE void add_surface(const WaveFloat& weight, WaveMask lanes, bool unlit, const SurfaceWave& surface) {
        const FloatLanes d;
        for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
            const Weight w = load_weight(weight, lanes, i);
            add_to(normal_, w, surface.normal, i);
            add_to(base_color_, w, surface.base_color, i);
            if (unlit) continue;
            add_to(emission_, w, surface.emission, i);
            add_to(metallic_, w, surface.metallic, i);
            add_to(roughness_, w, surface.roughness, i);
            add_to(occlusion_, w, surface.occlusion, i);
        }
    }

    /// Means for layers: of the normals a direction, of base colours a colour.
    HWY_INLINE void light(WaveVector& radiance, SurfaceWave& out) const {
        radiance = radiance_;
        find_layers(out);
    }

    /// Positions, geometric normals and views, which branches have in common, stay.
    HWY_INLINE void surface(SurfaceWave& out) const {
        find_layers(out);
        out.emission = emission_;
        out.metallic = metallic_;
        out.roughness = roughness_;
        out.occlusion = occlusion_;
    }

  private:
    struct Weight {
        FloatMask used;
        FloatVector value;
    };
    static HWY_INLINE Weight load_weight(const WaveFloat& weight, WaveMask lanes, size_t i) {
        const FloatLanes d;
        const auto value = hn::IfThenElseZero(wave_mask_lanes(lanes, i), hn::Load(d, weight.lane + i));
        return {hn::Gt(value, hn::Zero(d)), value};
    }

    /// Lanes that are not weighed may hold anything, infinities too.
    static HWY_INLINE void add_to(WaveFloat& sum, const Weight& w, const WaveFloat& value, size_t i) {
        const FloatLanes d;
        const auto term = hn::IfThenElseZero(w.used, hn::Mul(w.value, hn::Load(d, value.lane + i)));
        hn::Store(hn::Add(hn::Load(d, sum.lane + i), term), d, sum.lane + i);
    }
    static HWY_INLINE void add_to(WaveVector& sum, const Weight& w, const WaveVector& value, size_t i) {
        add_to(sum.x, w, value.x, i);
        add_to(sum.y, w, value.y, i);
        add_to(sum.z, w, value.z, i);
    }

    HWY_INLINE void find_layers(SurfaceWave& out) const {
        const FloatLanes d;
        for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d))
            store3(d, unit_or(load3(d, normal_, i), load3(d, out.geometric_normal, i)), out.normal, i);
        out.base_color = base_color_;
    }

    WaveVector radiance_{}, normal_{}, base_color_{}, emission_{};
    WaveFloat metallic_{}, roughness_{}, occlusion_{};
};

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();
#endif
