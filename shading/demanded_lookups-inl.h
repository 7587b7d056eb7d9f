// Which fragments of a tile's sample ask for texels under a fetch model, told to a listener with their coordinates.
#if defined(RAWTEXEL_SHADING_DEMANDED_LOOKUPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_DEMANDED_LOOKUPS_INL_H_
#undef RAWTEXEL_SHADING_DEMANDED_LOOKUPS_INL_H_
#else
#define RAWTEXEL_SHADING_DEMANDED_LOOKUPS_INL_H_
#endif

#include "shading/branches-inl.h"
#include "shading/coordinates-inl.h"
#include "shading/derivatives-inl.h"
#include "shading/fetch_options.h"
#include "shading/lookup_listener.h"
#include "shading/material_taps-inl.h"
#include "shading/texture_jitter-inl.h"
#include "shading/tile.h"
#include "shading/wave_draws-inl.h"

#include <algorithm>
#include <bit>
#include <vector>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// All lanes of the 2x2 quads that have a lane in `mask`.
constexpr WaveMask whole_quads(WaveMask mask) {
    const WaveMask pairs = mask | (mask & 0x55555555u) << 1 | (mask & 0xAAAAAAAAu) >> 1;
    return pairs | (pairs & 0x00FF00FFu) << 8 | (pairs & 0xFF00FF00u) >> 8;
}

/// The pixels of all 2x2 quads that touch `rect`, within the frame.
inline PixelRect whole_quads(const PixelRect& rect, const raster::FrameOptions& frame) {
    return {rect.x0 & ~1, rect.y0 & ~1, std::min((rect.x1 + 1) & ~1, frame.width), std::min((rect.y1 + 1) & ~1, frame.height)};
}

/// Fragments of one draw that ask together.
struct AskingFragments {
    const DrawState* draw = nullptr;
    WaveMask base_color = 0;  ///< lanes that ask for the base colour
    WaveMask others = 0;      ///< lanes that ask for every other map
    WaveMask beyond = 0;      ///< lanes of quads that no fragment covers: their coordinates leave the triangle
    bool one_triangle = false;
    const uint32_t* setup_index = nullptr;  ///< 32; means something for the lanes that ask
};

class DemandedLookups {
  public:
    DemandedLookups(const TileInputs& inputs, int tile_x, int tile_y, TileScratch& scratch)
        : inputs_(inputs),
          frame_(*inputs.frame),
          scratch_(scratch),
          listener_(*scratch.listener),
          tile_size_(frame_.options().tile_size),
          tile_x_(tile_x * tile_size_),
          tile_y_(tile_y * tile_size_),
          steps_(inputs) {
        list_waves();
    }

    /// `offset`: of all pixels, where each has not its own.
    void tell_sample(uint32_t sample, raster::SampleOffset offset) {
        wave_.sample = sample;
        std::fill_n(offset_, texunit::kWaveLanes, offset);
        scratch_.candidates.sort();
        for (const WavePlace& place : waves_) {
            if (scratch_.adaptive && !scratch_.adaptive->takes_samples(place.index)) continue;
            wave_.index = place.index;
            wave_.x = tile_x_ + place.x;
            wave_.y = tile_y_ + place.y;
            load_pixels(place);
            listener_.begin_wave(wave_);
            const bool visible = inputs_.fetch_model == FetchModel::Visible;
            scratch_.candidates.for_each_in_wave(uint32_t(place.index), [&](const LoggedCandidate& candidate) HWY_ATTR {
                visible ? tell_discarded(place, candidate) : tell_drawn(candidate);
            });
            if (visible) tell_surfaces();
            listener_.end_wave();
        }
        listener_.end_sample();
    }

  private:
    struct WavePlace {
        int x, y;  ///< upper left pixel, in the tile
        size_t index;
    };

    /// Waves with pixels to count, in Morton order: bits of column and row alternate, column first. A tile has twice as many rows of waves
    /// as columns, so the code's top bit is the row's.
    void list_waves() {
        const int waves_x = tile_size_ / texunit::kWaveWidth, squares = waves_x * waves_x;
        for (int code = 0; code < 2 * squares; ++code) {
            int column = 0, row = code / squares * waves_x;
            for (int bit = 0; 1 << bit < waves_x; ++bit) {
                column |= (code >> (2 * bit) & 1) << bit;
                row |= (code >> (2 * bit + 1) & 1) << bit;
            }
            const WavePlace place{column * texunit::kWaveWidth, row * texunit::kWaveHeight, size_t(row * waves_x + column)};
            if (lanes_inside(inputs_.visible, tile_x_ + place.x, tile_y_ + place.y) != 0) waves_.push_back(place);
        }
    }

    /// Of the wave's upper left pixel, in the tile's arrays.
    size_t pixel(const WavePlace& place) const { return size_t(place.y * tile_size_ + place.x); }

    void load_pixels(const WavePlace& place) {
        load_wave(&scratch_.visibility.triangle[pixel(place)], tile_size_, surface_);
        if (inputs_.pixel_jitter == PixelJitter::Pixel) load_wave(&scratch_.offsets[pixel(place)], tile_size_, offset_);
        wave_.surface = lanes_inside(inputs_.visible, wave_.x, wave_.y) & ~lanes_that_see(surface_, raster::kNoTriangle);
    }

    // --- visible

    void tell_discarded(const WavePlace& place, const LoggedCandidate& candidate) {
        asking_ = {};
        asking_.base_color = discarded_before_surface(place, candidate);
        set_triangle(candidate.setup_index);
        tell(true);
    }

    void tell_surfaces() {
        for (WaveMask rest = wave_.surface; rest != 0;) rest &= ~tell_surface(rest);
    }

    /// Lanes that the candidate let through, and in which it lies before the surface that is seen.
    WaveMask discarded_before_surface(const WavePlace& place, const LoggedCandidate& candidate) const {
        alignas(64) float depths[texunit::kWaveLanes];
        load_wave(&scratch_.visibility.depth[pixel(place)], tile_size_, depths);
        WaveMask before = 0;
        for (WaveMask rest = candidate.lanes & ~candidate.covered; rest != 0; rest &= rest - 1) {
            const int lane = std::countr_zero(rest);
            const uint32_t surface = surface_[lane];
            const float depth = depths[lane];
            const bool first = surface == raster::kNoTriangle || candidate.depth[lane] > depth ||
                               (candidate.depth[lane] == depth &&
                                frame_.triangle(candidate.setup_index).triangle_id < frame_.triangle(surface).triangle_id);
            before |= WaveMask{first} << lane;
        }
        return before;
    }

    /// Tells of the lanes of `rest` that see the draw which its first lane sees; returns them.
    WaveMask tell_surface(WaveMask rest) {
        const DrawLanes seen = first_draw(frame_, surface_, rest);
        asking_ = {};
        asking_.draw = &inputs_.draws[seen.draw];
        asking_.base_color = asking_.others = seen.lanes;
        asking_.one_triangle = seen.one_triangle;
        asking_.setup_index = surface_;
        tell(false);
        return seen.lanes;
    }

    // --- forward and quad

    void tell_drawn(const LoggedCandidate& candidate) {
        asking_ = {};
        asking_.base_color = candidate.lanes;
        asking_.others = candidate.covered;
        if (inputs_.fetch_model == FetchModel::Quad) {
            // A lookup belongs to a pixel, so only those inside are told.
            const WaveMask inside = lanes_inside(inputs_.visible, wave_.x, wave_.y);
            asking_.base_color = whole_quads(candidate.lanes) & inside;
            asking_.others = whole_quads(candidate.covered) & inside;
            asking_.beyond = asking_.base_color & ~candidate.lanes;
        }
        set_triangle(candidate.setup_index);
        tell(candidate.covered == 0);
    }

    void set_triangle(uint32_t setup_index) {
        asking_.draw = &inputs_.draws[frame_.triangle(setup_index).draw];
        asking_.one_triangle = true;
        std::fill_n(triangle_, texunit::kWaveLanes, setup_index);
        asking_.setup_index = triangle_;
    }

    // --- all of them

    void tell(bool let_through) {
        const MaterialState& material = *asking_.draw->material;
        if (asking_.base_color == 0) return;
        listener_.fragments({asking_.draw, asking_.base_color, asking_.setup_index, let_through});
        if (material.branches()) return tell_branches();
        find_coordinates(material);
        tell_maps(material);
    }

    /// Of each plane and layer that is looked up.
    HWY_NOINLINE void tell_branches() {
        find_weights();
        const AskingFragments all = asking_;
        const Mesh& mesh = *all.draw->mesh;
        const auto with_all = [&](const auto& act) HWY_ATTR {
            with_corners(frame_, mesh, all.setup_index, {0, all.base_color, all.one_triangle}, act);
        };
        with_all([&](const auto& corners) HWY_ATTR { branches_.prepare(*all.draw, corners, weights_, steps_); });
        const texunit::RandomAddress address{.x = uint32_t(wave_.x), .y = uint32_t(wave_.y), .sample = wave_.sample, .seed = inputs_.seed};
        const auto tell_mask = [&](const MaskLookup& mask) { listener_.lookup({kLayerMask, mask.map, mask.lanes, mask.at}); };
        branches_.for_each(*all.draw, all.base_color, address, tell_mask, [&](const Branch& branch) HWY_ATTR {
            const MaterialState& material = *branch.draw->material;
            with_all([&](const auto& corners)
                         HWY_ATTR { interpolate_map_coordinates(material, mesh, corners, weights_, branch.planes, coordinates_); });
            if (steps_.taken()) steps_.take(coordinates_, material.coordinate_count);
            asking_.base_color = all.base_color & branch.lanes;
            asking_.others = all.others & branch.lanes;
            tell_maps(material);
        });
        asking_ = all;
    }

    void tell_maps(const MaterialState& material) {
        if (material.draws_level) draw_levels_of(material);
        for (int slot = 0; slot < kMapSlots; ++slot) {
            const MapState& map = material.maps[size_t(slot)];
            if (map.texture && lanes_of(slot) != 0 && !draws(material, slot)) listener_.lookup(lookup_of(map, slot));
        }
        if (material.plans.draws()) tell_draws(material);
    }

    WaveMask lanes_of(int slot) const { return slot == kBaseColor ? asking_.base_color : asking_.others; }
    ListenedLookup lookup_of(const MapState& map, int slot) const {
        return {MapSlot(slot), &map, lanes_of(slot), &coordinates_[map.coordinates]};
    }

    /// Where all taps are shaded every map asks for what it would ask for to filter them.
    static bool draws(const MaterialState& material, int slot) {
        return material.plans.averaged.holds(slot) || (material.plans.shaded.holds(slot) && !material.plans.enumerates);
    }

    /// Begins the taps of the asking fragments; `surface` has room for 32.
    void begin_taps(const MaterialState& material, uint32_t* surface) {
        const bool layered = material.material->alpha_mode != AlphaMode::Opaque;
        for (WaveMask lanes = layered ? asking_.base_color : 0; lanes != 0; lanes &= lanes - 1) {
            const int lane = std::countr_zero(lanes);
            surface[lane] = 1 + frame_.triangle(asking_.setup_index[lane]).triangle_id;
        }
        taps_.begin(
            {&material, coordinates_, asking_.base_color, wave_.x, wave_.y, wave_.sample, inputs_.seed, layered ? surface : nullptr});
    }

    HWY_NOINLINE void draw_levels_of(const MaterialState& material) {
        alignas(64) uint32_t surface[texunit::kWaveLanes];
        begin_taps(material, surface);
        draw_levels(taps_, coordinates_, material.coordinate_count);
    }

    HWY_NOINLINE void tell_draws(const MaterialState& material) {
        alignas(64) uint32_t surface[texunit::kWaveLanes];
        begin_taps(material, surface);
        begun_ = 0;
        for (const TapPlan* plan : {&material.plans.averaged, &material.plans.shaded}) {
            if (plan->empty() || (plan == &material.plans.shaded && material.plans.enumerates)) continue;
            if (material.sharing == NumberSharing::PerMap) {
                for (int n = 0; n < material.plans.taps; ++n)
                    taps_.for_each_map(*plan, n, [&](MapSlot slot, const texunit::SharedTap& tap, int) { tell_draw(slot, tap, 0); });
                continue;
            }
            taps_.for_each(*plan, false, [&](const texunit::SharedTap& tap, int) {
                for (int slot = 0; slot < kMapSlots; ++slot)
                    if (plan->holds(slot)) tell_draw(slot, tap, plan->lookup_of[size_t(slot)]);
            });
        }
    }

    /// A lookup begins with its first draw; texels of negative weights come later, and to some lanes only.
    void tell_draw(int slot, const texunit::SharedTap& tap, int number_in_tap) {
        ListenedLookup lookup = lookup_of(taps_.material().maps[size_t(slot)], slot);
        const bool first = (begun_ >> slot & 1) == 0;
        begun_ |= 1u << slot;
        lookup.lanes &= tap.lanes;
        if (lookup.lanes != 0) listener_.drawn({lookup, &tap.draw[number_in_tap], first});
    }

    void find_coordinates(const MaterialState& material) {
        if (material.coordinate_count == 0) return;
        find_weights();
        const Mesh& mesh = *asking_.draw->mesh;
        with_corners(frame_, mesh, asking_.setup_index, {0, asking_.base_color, asking_.one_triangle}, [&](const auto& corners) HWY_ATTR {
            interpolate_map_coordinates(material, mesh, corners, weights_, nullptr, coordinates_);
        });
        if (steps_.taken()) steps_.take(coordinates_, material.coordinate_count);
    }

    void find_weights() {
        const SampleBlock block{frame_, asking_.setup_index, {wave_.x, wave_.y, offset_}, latest_anchors_};
        find_barycentrics(inputs_.derivatives, block, asking_.base_color, weights_);
        const bool layered = asking_.draw->material->material->alpha_mode != AlphaMode::Opaque;
        if (steps_.taken()) steps_.find(block, asking_.base_color, wave_.sample, layered);
        const raster::BarycentricWave unclamped = weights_;
        clamp_weights(weights_);
        for (WaveMask lanes = asking_.beyond; lanes != 0; lanes &= lanes - 1) {
            const int lane = std::countr_zero(lanes);
            weights_.b1[lane] = unclamped.b1[lane];
            weights_.b2[lane] = unclamped.b2[lane];
        }
    }

    const TileInputs& inputs_;
    const raster::Frame& frame_;
    TileScratch& scratch_;
    LookupListener& listener_;
    int tile_size_, tile_x_, tile_y_;
    TextureSteps steps_;
    std::vector<WavePlace> waves_;
    ListenedWave wave_;
    AskingFragments asking_;
    alignas(64) uint32_t surface_[texunit::kWaveLanes];   ///< setup indices of what is seen
    alignas(64) uint32_t triangle_[texunit::kWaveLanes];  ///< one of them, for all lanes
    alignas(64) raster::SampleOffset offset_[texunit::kWaveLanes];
    raster::BarycentricWave weights_{};
    raster::LatestAnchors latest_anchors_{frame_};
    texunit::WaveCoordinates coordinates_[kMapSlots]{};
    MaterialTaps taps_;
    uint32_t begun_ = 0;  ///< one bit a map whose draws have begun
    MaterialBranches branches_;
};

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();
#endif
