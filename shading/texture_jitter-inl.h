// Texture coordinates at a point of the pixel of their own, drawn from the pixel filter.
#if defined(RAWTEXEL_SHADING_TEXTURE_JITTER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_TEXTURE_JITTER_INL_H_
#undef RAWTEXEL_SHADING_TEXTURE_JITTER_INL_H_
#else
#define RAWTEXEL_SHADING_TEXTURE_JITTER_INL_H_
#endif

#include "raster/interpolate.h"
#include "shading/derivatives-inl.h"
#include "shading/lanes-inl.h"
#include "shading/tile.h"

#include <algorithm>
#include <bit>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

class TextureSteps {
  public:
    explicit TextureSteps(const TileInputs& inputs)
        : mode_(inputs.texture_jitter), filter_(inputs.pixel_filter), noise_(inputs.noise), seed_(inputs.seed) {}

    bool taken() const { return mode_ != TextureJitter::None; }

    /// Finds the steps from the sample points of `lanes`, which are not empty. `layered`: every triangle has numbers of its own.
    HWY_NOINLINE void find(const SampleBlock& block, WaveMask lanes, uint32_t sample, bool layered) {
        texunit::RandomAddress address{.x = uint32_t(block.points.x),
                                       .y = uint32_t(block.points.y),
                                       .sample = sample,
                                       .dimension = texunit::Dimension::TextureX,
                                       .seed = seed_};
        const auto surface_of = [&](int lane) { return layered ? 1 + block.frame.triangle(block.setup_index[lane]).triangle_id : 0; };
        for (WaveMask rest = lanes; rest != 0;) {
            address.surface = surface_of(std::countr_zero(rest));
            WaveFloat x, y;
            noise_pair_wave(noise_, address, texunit::Dimension::TextureY, x, y);
            for (WaveMask others = rest; others != 0; others &= others - 1) {
                const int lane = std::countr_zero(others);
                if (surface_of(lane) != address.surface) continue;
                rest &= ~(WaveMask{1} << lane);
                find_lane(block, lane, filtered_offset(filter_, x[lane], y[lane]));
            }
        }
    }

    /// Steps the coordinates, whose derivatives are the sample points' per pixel.
    HWY_INLINE void take(texunit::WaveCoordinates* coordinates, int count) const {
        const FloatLanes d;
        for (int k = 0; k < count; ++k) {
            texunit::WaveCoordinates& at = coordinates[k];
            for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
                const auto x = hn::Load(d, x_.lane + i), y = hn::Load(d, y_.lane + i);
                const auto stepped = [&](WaveFloat& value, const WaveFloat& ddx, const WaveFloat& ddy) HWY_ATTR {
                    const auto step = hn::Add(hn::Mul(x, hn::Load(d, ddx.lane + i)), hn::Mul(y, hn::Load(d, ddy.lane + i)));
                    hn::Store(hn::Add(hn::Load(d, value.lane + i), step), d, value.lane + i);
                };
                stepped(at.u, at.dudx, at.dudy);
                stepped(at.v, at.dvdx, at.dvdy);
            }
        }
    }

  private:
    /// Towards and past the horizon of a plane a step in perspective grows without bound; the truth has no texture there, and no step is
    /// longer than this many of the derivatives'.
    static constexpr double kLongest = 16.0;

    void find_lane(const SampleBlock& block, int lane, raster::SampleOffset offset) {
        const raster::SampleOffset from = block.points.offset[lane];
        const double x = double(offset.x - from.x) / raster::kSampleOne, y = double(offset.y - from.y) / raster::kSampleOne;
        double longer = 1.0;
        if (mode_ == TextureJitter::Perspective) {
            const raster::PerspectiveSlope slope =
                perspective_slope(block.frame.triangle(block.setup_index[lane]),
                                  block.points.x + lane % texunit::kWaveWidth + double(from.x) / raster::kSampleOne,
                                  block.points.y + lane / texunit::kWaveWidth + double(from.y) / raster::kSampleOne);
            const double depth = 1.0 + slope.dx * x + slope.dy * y;
            longer = depth > 1.0 / kLongest ? 1.0 / depth : kLongest;
        }
        x_[lane] = float(x * longer);
        y_[lane] = float(y * longer);
    }

    TextureJitter mode_;
    PixelFilter filter_;
    texunit::Noise noise_;
    uint32_t seed_;
    WaveFloat x_{}, y_{};  ///< pixels
};

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();
#endif
