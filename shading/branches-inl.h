// What a material blends at a point, planes or layers: each with its weight, or the one that is drawn. The one place that tells which, so
// that what is shaded and what is counted agree.
#if defined(RAWTEXEL_SHADING_BRANCHES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_BRANCHES_INL_H_
#undef RAWTEXEL_SHADING_BRANCHES_INL_H_
#else
#define RAWTEXEL_SHADING_BRANCHES_INL_H_
#endif

#include "shading/lookup-inl.h"
#include "shading/planes-inl.h"
#include "shading/texture_jitter-inl.h"
#include "texunit/noise.h"

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// One branch of a material for some lanes.
struct Branch {
    const DrawState* draw = nullptr;     ///< with the material of the layer
    const PlaneLanes* planes = nullptr;  ///< null: the mesh's texture coordinates
    const WaveFloat* weight = nullptr;   ///< null: 1, it was drawn
    WaveMask lanes = 0;                  ///< not 0
};

/// The mask of layers, looked up.
struct MaskLookup {
    const MapState* map;
    const texunit::WaveCoordinates* at;
    WaveMask lanes;
};

class MaterialBranches {
  public:
    /// What the weights follow from, of a material that branches. `steps` have been found for its lanes.
    template <class Corners>
    HWY_INLINE void prepare(const DrawState& draw, const Corners& corners, const raster::BarycentricWave& weights,
                            const TextureSteps& steps) {
        find_object_normal(*draw.mesh, corners, weights, normals_);
        const MaterialState& material = *draw.material;
        if (material.mask.texture) {
            interpolate_coordinates(material.coordinates[size_t(material.mask.coordinates)], *draw.mesh, corners, weights, mask_at_);
            if (steps.taken()) steps.take(&mask_at_, 1);
        } else if (draw.colors_weigh && !draw.mesh->colors.empty()) {
            interpolate_weights(*draw.mesh, corners, weights);
        } else {
            mask_ = {};
        }
    }

    /// use(branch) for all branches of the lanes of `lanes`, or those drawn with the numbers of `address`; before it look(mask) where there
    /// is one. The weights of a lane sum to 1.
    template <class Look, class Use>
    HWY_INLINE void for_each(const DrawState& draw, WaveMask lanes, const texunit::RandomAddress& address, const Look& look,
                             const Use& use) {
        const MaterialState& material = *draw.material;
        if (material.layer_count == 0) return for_each_plane({&draw, nullptr, nullptr, lanes}, address, use);
        if (material.mask.texture) {
            look_up(material.mask, mask_at_, lanes, mask_, nullptr);
            look(MaskLookup{&material.mask, &mask_at_, lanes});
        }
        normalize_mask(material.layer_count);
        if (material.blend == Blend::Draw) draw_layers(material, address);
        DrawState layer = draw;
        for (int k = 0; k < material.layer_count; ++k) {
            const WaveMask seen = lanes & lanes_above_zero(mask_.channel[k]);
            layer.material = material.layers[size_t(k)];
            const WaveFloat* const weight = material.blend == Blend::Draw ? nullptr : &mask_.channel[k];
            if (seen != 0) for_each_plane({&layer, nullptr, weight, seen}, address, use);
        }
    }

  private:
    template <class Corners>
    HWY_INLINE void interpolate_weights(const Mesh& mesh, const Corners& corners, const raster::BarycentricWave& weights) {
        const FloatLanes d;
        for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
            FloatVector color[4];
            interpolate<4>(corners, load_weights(weights, i), &mesh.colors[0].x, i, color);
            for (int c = 0; c < 4; ++c) hn::Store(color[c], d, mask_.channel[c].lane + i);
        }
    }

    static WaveMask lanes_above_zero(const WaveFloat& values) {
        const FloatLanes d;
        WaveMask mask = 0;
        for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d))
            mask |= wave_mask_bits(hn::Gt(hn::Load(d, values.lane + i), hn::Zero(d)), i);
        return mask;
    }

    /// Channels of mask_ to weights of sum 1.
    HWY_NOINLINE void normalize_mask(int layers) {
        const FloatLanes d;
        const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
        for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
            auto sum = zero;
            // NaN counts as nothing.
            const auto held = [&](int k) HWY_ATTR {
                const auto w = hn::Load(d, mask_.channel[k].lane + i);
                return hn::IfThenElseZero(hn::Gt(w, zero), hn::Min(w, hn::Set(d, 1e9f)));
            };
            for (int k = 0; k < layers; ++k) sum = hn::Add(sum, held(k));
            const auto some = hn::Gt(sum, zero);
            for (int k = 0; k < layers; ++k)
                hn::Store(hn::IfThenElse(some, hn::Div(held(k), sum), k == 0 ? one : zero), d, mask_.channel[k].lane + i);
        }
    }

    /// Weights to 1 for the layer that each lane draws, 0 for others.
    HWY_NOINLINE void draw_layers(const MaterialState& material, texunit::RandomAddress address) {
        address.dimension = texunit::Dimension::Layer;
        noise_wave(material.plans.noise, address, numbers_);
        for (int lane = 0; lane < texunit::kWaveLanes; ++lane) {
            // Weights sum to 1 but for rounding: a number beyond them draws the last layer that weighs.
            int drawn = 0;
            float below = 0;
            for (int k = 0; k < material.layer_count; ++k) {
                if (!(mask_.channel[k][lane] > 0)) continue;
                drawn = k;
                below += mask_.channel[k][lane];
                if (numbers_[lane] < below) break;
            }
            for (int k = 0; k < material.layer_count; ++k) mask_.channel[k][lane] = k == drawn ? 1.0f : 0.0f;
        }
    }

    template <class Use>
    HWY_INLINE void for_each_plane(Branch branch, texunit::RandomAddress address, const Use& use) {
        const MaterialState& material = *branch.draw->material;
        if (!material.material->triplanar) return use(branch);
        const int sharpness = material.material->triplanar->sharpness;
        branch.planes = &planes_;
        if (material.blend == Blend::Draw) {
            address.dimension = texunit::Dimension::Plane;
            noise_wave(material.plans.noise, address, numbers_);
            draw_planes(normals_, sharpness, numbers_, planes_);
            return use(branch);
        }
        const WaveFloat* const outer = branch.weight;
        branch.weight = &share_;
        for (int axis = 0; axis < 3; ++axis) {
            take_plane(normals_, sharpness, axis, planes_, share_);
            if (outer) multiply(*outer, share_);
            use(branch);
        }
    }

    static void multiply(const WaveFloat& by, WaveFloat& values) {
        const FloatLanes d;
        for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d))
            hn::Store(hn::Mul(hn::Load(d, by.lane + i), hn::Load(d, values.lane + i)), d, values.lane + i);
    }

    WaveVector normals_{};  ///< of the object's space
    texunit::WaveCoordinates mask_at_{};
    texunit::WaveColor mask_{};
    WaveFloat numbers_{}, share_{};
    PlaneLanes planes_{};
};

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();
#endif
