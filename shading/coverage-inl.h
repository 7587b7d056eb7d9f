// Which candidate fragments of MASK and BLEND surfaces cover their samples: the policy that raster::tile_visibility calls.
#if defined(RAWTEXEL_SHADING_COVERAGE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_COVERAGE_INL_H_
#undef RAWTEXEL_SHADING_COVERAGE_INL_H_
#else
#define RAWTEXEL_SHADING_COVERAGE_INL_H_
#endif

#include "raster/visibility.h"
#include "shading/alpha-inl.h"
#include "shading/coordinates-inl.h"
#include "shading/derivatives-inl.h"
#include "shading/lookup-inl.h"
#include "shading/material_taps-inl.h"
#include "shading/pixel_rect.h"
#include "shading/texture_jitter-inl.h"
#include "texunit/random-inl.h"

#include <span>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

namespace random = texunit::HWY_NAMESPACE;

/// MASK: alpha >= cutoff. BLEND: a random number of the (pixel, sample, triangle) < alpha, so that the mean over samples is the mix.
/// alpha is looked up as the visible fragment's colour will be. Where raw texels are shaded it is they that cover or do not, and a random
/// number is held against the share of those that do: with one draw, the texel that will be shaded decides.
class AlphaCoverage {
  public:
    /// Judges fragments inside `visible`.
    AlphaCoverage(const TileInputs& inputs, const PixelRect& visible)
        : frame_(*inputs.frame),
          draws_(inputs.draws),
          visible_(visible),
          seed_(inputs.seed),
          derivatives_(inputs.derivatives),
          steps_(inputs) {}

    void begin_sample(uint32_t sample) { sample_ = sample; }
    uint32_t cover(const raster::CandidateWave& candidate) {
        const WaveMask mask = candidate.mask & lanes_inside(visible_, candidate.x, candidate.y);
        if (mask == 0) return 0;
        const DrawState& draw = draws_[candidate.triangle->draw];
        find_alpha(draw, candidate, mask);
        const Material& material = *draw.material->material;
        const bool tests = material.alpha_mode == AlphaMode::Mask && !draw.material->plans.shaded.holds(kBaseColor);
        return mask & (tests ? at_least(material.alpha_cutoff) : drawn(candidate));
    }

    /// Of the wave asked about last, at the lanes that are inside.
    /// Of raw texels the share that covers.
    const WaveFloat& alpha() const { return alpha_; }
    /// Of the material's base colour.
    const texunit::WaveCoordinates& coordinates(const MaterialState& material) const {
        return coordinates_[material.maps[kBaseColor].coordinates];
    }

  private:
    /// Fills alpha_.
    void find_alpha(const DrawState& draw, const raster::CandidateWave& candidate, WaveMask mask) {
        const MaterialState& material = *draw.material;
        const Mesh& mesh = *draw.mesh;
        const MapState& map = material.maps[kBaseColor];
        const OneTriangle corners{&mesh.indices[size_t(candidate.triangle->primitive) * 3]};
        const bool colored = !mesh.colors.empty();
        if (map.texture || colored) {
            alignas(64) uint32_t setup_index[texunit::kWaveLanes];
            for (uint32_t& index : setup_index) index = candidate.setup_index;
            const SampleBlock block{frame_, setup_index, {candidate.x, candidate.y, candidate.offset}, latest_anchors_};
            find_barycentrics(derivatives_, block, mask, weights_);
            clamp_weights(weights_);
            if (steps_.taken()) steps_.find(block, mask, sample_, true);
        }
        if (colored) find_vertex_alpha(mesh, corners);
        vertex_ = colored ? &vertex_alpha_ : nullptr;
        if (map.texture) {
            texunit::WaveCoordinates& at = coordinates_[map.coordinates];
            interpolate_coordinates(material.coordinates[size_t(map.coordinates)], mesh, corners, weights_, at);
            if (steps_.taken()) steps_.take(&at, 1);
            if (draws(material)) return find_drawn_alpha(material, candidate, mask);
            if (material.draws_level) draw_level(material, candidate, mask, at);
            look_up(map, at, mask, maps_[kBaseColor], nullptr);
        }
        HWY_NAMESPACE::find_alpha(*material.material, map.texture ? &maps_[kBaseColor].channel[3] : nullptr, vertex_, alpha_);
    }

    static bool draws(const MaterialState& material) {
        return material.plans.shaded.holds(kBaseColor) || material.plans.averaged.holds(kBaseColor);
    }

    void find_vertex_alpha(const Mesh& mesh, const OneTriangle& corners) {
        const FloatLanes d;
        for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d))
            hn::Store(interpolate<4>(corners, load_weights(weights_, i), &mesh.colors[0].a, i), d, vertex_alpha_.lane + i);
    }

    /// The address of the numbers, one surface for all lanes; `surface` has room for 32.
    void begin_taps(const MaterialState& material, const raster::CandidateWave& candidate, WaveMask mask, uint32_t* surface) {
        std::fill_n(surface, texunit::kWaveLanes, 1 + candidate.triangle->triangle_id);
        taps_.begin({&material, coordinates_, mask, candidate.x, candidate.y, sample_, seed_, surface});
    }

    HWY_NOINLINE void draw_level(const MaterialState& material, const raster::CandidateWave& candidate, WaveMask mask,
                                 texunit::WaveCoordinates& at) {
        alignas(64) uint32_t surface[texunit::kWaveLanes];
        begin_taps(material, candidate, mask, surface);
        draw_levels(taps_, &at, 1);
    }

    /// alpha of draws that are averaged, or the share of the raw texels that covers.
    HWY_NOINLINE void find_drawn_alpha(const MaterialState& material, const raster::CandidateWave& candidate, WaveMask mask) {
        const TapPlans& plans = material.plans;
        alignas(64) uint32_t surface[texunit::kWaveLanes];
        begin_taps(material, candidate, mask, surface);
        texunit::WaveFloat& texel = maps_[kBaseColor].channel[3];
        if (plans.averaged.holds(kBaseColor)) {
            average_taps(taps_, MaterialTaps::only(plans.averaged, kBaseColor), maps_);
            return HWY_NAMESPACE::find_alpha(*material.material, &texel, vertex_, alpha_);
        }
        WaveFloat covered{}, total{};
        const FloatLanes d;
        for_each_shaded_tap(
            taps_, MaterialTaps::only(plans.shaded, kBaseColor), maps_, [&](const WaveFloat& weight, WaveMask lanes) HWY_ATTR {
                HWY_NAMESPACE::find_alpha(*material.material, &texel, vertex_, alpha_);
                for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
                    const auto w = hn::IfThenElseZero(wave_mask_lanes(lanes, i), hn::Max(hn::Load(d, weight.lane + i), hn::Zero(d)));
                    const auto share = covered_share(*material.material, hn::Load(d, alpha_.lane + i));
                    hn::Store(hn::Add(hn::Load(d, covered.lane + i), hn::Mul(w, share)), d, covered.lane + i);
                    hn::Store(hn::Add(hn::Load(d, total.lane + i), w), d, total.lane + i);
                }
            });
        for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
            const auto sum = hn::Load(d, total.lane + i);
            const auto share = hn::Div(hn::Load(d, covered.lane + i), sum);
            hn::Store(hn::IfThenElseZero(sum > hn::Zero(d), share), d, alpha_.lane + i);
        }
    }

    WaveMask at_least(float cutoff) const {
        const FloatLanes d;
        WaveMask mask = 0;
        for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d))
            mask |= wave_mask_bits(hn::Ge(hn::Load(d, alpha_.lane + i), hn::Set(d, cutoff)), i);
        return mask;
    }

    WaveMask drawn(const raster::CandidateWave& candidate) const {
        const FloatLanes d;
        const uint32_t surface = 1 + candidate.triangle->triangle_id;
        WaveFloat number;
        random::random_wave(texunit::random_state(seed_, sample_, surface, texunit::Dimension::Coverage), uint32_t(candidate.x),
                            uint32_t(candidate.y), number);
        WaveMask mask = 0;
        for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
            mask |= wave_mask_bits(hn::Lt(hn::Load(d, number.lane + i), hn::Load(d, alpha_.lane + i)), i);
        }
        return mask;
    }

    const raster::Frame& frame_;
    std::span<const DrawState> draws_;
    PixelRect visible_;
    uint32_t seed_;
    DerivativeRule derivatives_;
    TextureSteps steps_;
    uint32_t sample_ = 0;
    raster::BarycentricWave weights_{};
    raster::LatestAnchors latest_anchors_{frame_};
    texunit::WaveCoordinates coordinates_[kMapSlots]{};
    texunit::WaveColor maps_[kMapSlots]{};
    MaterialTaps taps_;
    WaveFloat alpha_{}, vertex_alpha_{};
    const WaveFloat* vertex_ = nullptr;
};

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();
#endif
