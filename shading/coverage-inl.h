// Which candidate fragments of MASK and BLEND surfaces cover their samples: the policy that raster::tile_visibility calls.
#if defined(RAWTEXEL_SHADING_COVERAGE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_COVERAGE_INL_H_
#undef RAWTEXEL_SHADING_COVERAGE_INL_H_
#else
#define RAWTEXEL_SHADING_COVERAGE_INL_H_
#endif

#include "raster/visibility.h"
#include "shading/coordinates-inl.h"
#include "shading/derivatives-inl.h"
#include "shading/lookup-inl.h"
#include "shading/pixel_rect.h"
#include "texunit/random-inl.h"

#include <span>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

namespace random = texunit::HWY_NAMESPACE;

/// MASK: alpha >= cutoff. BLEND: a random number of the (pixel, sample, triangle) < alpha, so that the mean over samples is the mix.
/// alpha = texture * factor * vertex colour (glTF 2.0 3.9.4), looked up as the visible fragment's colour will be.
class AlphaCoverage {
  public:
    AlphaCoverage(const raster::Frame& frame, std::span<const DrawState> draws, const PixelRect& visible, uint32_t seed,
                  const DerivativeRule& derivatives = {})
        : frame_(frame), draws_(draws), visible_(visible), seed_(seed), derivatives_(derivatives) {}

    void begin_sample(uint32_t sample) { sample_ = sample; }
    uint32_t cover(const raster::CandidateWave& candidate) {
        const WaveMask mask = candidate.mask & lanes_inside(visible_, candidate.x, candidate.y);
        if (mask == 0) return 0;
        const DrawState& draw = draws_[candidate.triangle->draw];
        find_alpha(draw, candidate, mask);
        const Material& material = *draw.material->material;
        return mask & (material.alpha_mode == AlphaMode::Mask ? at_least(material.alpha_cutoff) : drawn(candidate));
    }

    /// Of the wave asked about last, at the lanes that are inside.
    const WaveFloat& alpha() const { return alpha_; }
    const texunit::WaveCoordinates& coordinates() const { return coordinates_; }

  private:
    /// Fills alpha_.
    void find_alpha(const DrawState& draw, const raster::CandidateWave& candidate, WaveMask mask) {
        const FloatLanes d;
        const MaterialState& material = *draw.material;
        const Mesh& mesh = *draw.mesh;
        const MapState& map = material.maps[kBaseColor];
        const OneTriangle corners{&mesh.indices[size_t(candidate.triangle->primitive) * 3]};
        if (map.texture || !mesh.colors.empty()) {
            alignas(64) uint32_t setup_index[texunit::kWaveLanes];
            for (uint32_t& index : setup_index) index = candidate.setup_index;
            find_barycentrics(derivatives_, {frame_, setup_index, candidate.offset, candidate.x, candidate.y}, mask, weights_);
            clamp_weights(weights_);
        }
        if (map.texture) {
            interpolate_coordinates(material.coordinates[size_t(map.coordinates)], mesh, corners, weights_, coordinates_);
            look_up(map, coordinates_, mask, color_, nullptr);
        }
        for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
            auto alpha = hn::Set(d, material.material->base_color.a);
            if (map.texture) alpha = hn::Mul(alpha, hn::Load(d, color_.channel[3].lane + i));
            if (!mesh.colors.empty()) alpha = hn::Mul(alpha, interpolate<4>(corners, load_weights(weights_, i), &mesh.colors[0].a, i));
            hn::Store(alpha, d, alpha_.lane + i);
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
        const UintLanes du;
        const auto surface = hn::Set(du, 1 + candidate.triangle->triangle_id);
        WaveMask mask = 0;
        for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
            const auto lane = hn::Iota(du, uint32_t(i));
            const auto x = hn::Add(hn::Set(du, uint32_t(candidate.x)), hn::And(lane, hn::Set(du, 7)));
            const auto y = hn::Add(hn::Set(du, uint32_t(candidate.y)), hn::ShiftRight<3>(lane));
            const auto bits = random::random_bits_v(du, seed_, sample_, x, y, surface, texunit::Dimension::Coverage);
            mask |= wave_mask_bits(hn::Lt(random::unit_float_v(du, bits), hn::Load(d, alpha_.lane + i)), i);
        }
        return mask;
    }

    const raster::Frame& frame_;
    std::span<const DrawState> draws_;
    PixelRect visible_;
    uint32_t seed_;
    DerivativeRule derivatives_;
    uint32_t sample_ = 0;
    raster::BarycentricWave weights_{};
    texunit::WaveCoordinates coordinates_{};
    texunit::WaveColor color_{};
    WaveFloat alpha_{};
};

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();
#endif
