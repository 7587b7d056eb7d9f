// What a sample leaves behind of a wave: its entries of the tile's planes (shading/tile_planes.h).
#if defined(RAWTEXEL_SHADING_WAVE_PLANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_WAVE_PLANES_INL_H_
#undef RAWTEXEL_SHADING_WAVE_PLANES_INL_H_
#else
#define RAWTEXEL_SHADING_WAVE_PLANES_INL_H_
#endif

#include "raster/interpolate-inl.h"
#include "shading/draw_state.h"
#include "shading/fragment.h"
#include "shading/lanes-inl.h"
#include "shading/tile.h"
#include "shading/vector3-inl.h"

#include <algorithm>
#include <array>
#include <bit>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// What the layers of a surface are made of.
struct SeenSurface {
    const DrawState& draw;
    const uint32_t* setup_index;  ///< 32
    const raster::BarycentricWave& weights;
    const FragmentWave& fragment;
    const SurfaceWave& surface;
};

class WavePlanes {
  public:
    WavePlanes(const TileInputs& inputs, TileScratch& scratch)
        : inputs_(inputs),
          scratch_(scratch),
          waves_(size_t(inputs.frame->options().tile_size) * size_t(inputs.frame->options().tile_size) / size_t(texunit::kWaveLanes)) {}

    /// `first`: the sample whose level of detail and material are shown.
    void begin_sample(bool first) { first_sample_ = first; }

    /// Wave `wave` of the tile, row by row: what only surfaces write starts at nothing.
    void begin_wave(size_t wave) {
        wave_ = wave;
        for (int p = 3; p < planes().count; ++p) plane(p) = {};
        if (!first_sample_) return;
        if (planes().lod >= 0) first_sample_plane(planes().lod) = {};
        if (planes().material >= 0) std::fill_n(first_sample_plane(planes().material).lane, texunit::kWaveLanes, -1.0f);
    }

    bool wants_lod() const { return first_sample_ && planes().lod >= 0; }
    bool keeps_layers() const { return planes().hits >= 0; }

    void store_lod(const WaveFloat& lod, WaveMask mask) { store_wave(lod, mask, first_sample_plane(planes().lod)); }
    void store_radiance(const WaveVector& radiance, WaveMask mask) { store_vector(radiance, mask, TilePlanes::kRadiance); }
    void store_radiance(const glm::vec3& radiance, WaveMask mask) {
        for (int c = 0; c < 3; ++c) store_value(radiance[c], mask, plane(TilePlanes::kRadiance + c));
    }
    void store_material(uint32_t index, WaveMask mask) {
        if (first_sample_ && planes().material >= 0) store_value(float(index), mask, first_sample_plane(planes().material));
    }

    /// Layers that are means over the samples that saw a surface.
    void store_layers(const SeenSurface& seen, WaveMask mask) {
        store_value(1.0f, mask, plane(planes().hits));
        if (planes().normal >= 0) store_vector(seen.surface.normal, mask, planes().normal);
        if (planes().albedo >= 0) store_vector(seen.surface.base_color, mask, planes().albedo);
        if (planes().depth >= 0) store_depth(seen.fragment, mask);
        if (planes().uv >= 0) store_uv(seen, mask);
    }

    /// The wave's radiance, a plane a channel.
    std::array<const WaveFloat*, 3> radiance() {
        return {&plane(TilePlanes::kRadiance), &plane(TilePlanes::kRadiance + 1), &plane(TilePlanes::kRadiance + 2)};
    }

  private:
    const TilePlanes& planes() const { return inputs_.planes; }
    WaveFloat& plane(int number) { return scratch_.sample[size_t(number) * waves_ + wave_]; }
    WaveFloat& first_sample_plane(int number) { return scratch_.first_sample[size_t(number) * waves_ + wave_]; }

    void store_vector(const WaveVector& value, WaveMask mask, int first_plane) {
        store_wave(value.x, mask, plane(first_plane));
        store_wave(value.y, mask, plane(first_plane + 1));
        store_wave(value.z, mask, plane(first_plane + 2));
    }

    void store_depth(const FragmentWave& fragment, WaveMask mask) {
        const FloatLanes d;
        const SpaceVector eye = set3(d, inputs_.rays.eye), forward = set3(d, inputs_.rays.forward);
        WaveFloat depth;
        for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d))
            hn::Store(dot(sub(load3(d, fragment.position, i), eye), forward), d, depth.lane + i);
        store_wave(depth, mask, plane(planes().depth));
    }

    /// Set 0 as the mesh has it, one lane after the other: a layer that few ask for.
    void store_uv(const SeenSurface& seen, WaveMask mask) {
        const Mesh& mesh = *seen.draw.mesh;
        const auto& uv = mesh.uv[0];
        if (uv.empty()) return;
        for (WaveMask lanes = mask; lanes != 0; lanes &= lanes - 1) {
            const int lane = std::countr_zero(lanes);
            const uint32_t* vertex = &mesh.indices[size_t(inputs_.frame->triangle(seen.setup_index[lane]).primitive) * 3];
            const float b1 = seen.weights.b1[lane], b2 = seen.weights.b2[lane];
            const glm::vec2 value = uv[vertex[0]] + (b1 * (uv[vertex[1]] - uv[vertex[0]]) + b2 * (uv[vertex[2]] - uv[vertex[0]]));
            plane(planes().uv)[lane] = value.x;
            plane(planes().uv + 1)[lane] = value.y;
        }
    }

    const TileInputs& inputs_;
    TileScratch& scratch_;
    const size_t waves_;
    size_t wave_ = 0;
    bool first_sample_ = false;
};

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();
#endif
