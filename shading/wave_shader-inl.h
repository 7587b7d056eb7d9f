// The wave kernel: what is visible in a block of pixels -> interpolation -> lookups -> surface -> radiance.
#if defined(RAWTEXEL_SHADING_WAVE_SHADER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_WAVE_SHADER_INL_H_
#undef RAWTEXEL_SHADING_WAVE_SHADER_INL_H_
#else
#define RAWTEXEL_SHADING_WAVE_SHADER_INL_H_
#endif

#include "shading/alpha-inl.h"
#include "shading/branch_sum-inl.h"
#include "shading/branches-inl.h"
#include "shading/derivatives-inl.h"
#include "shading/environment-inl.h"
#include "shading/fragment-inl.h"
#include "shading/light-inl.h"
#include "shading/lookup-inl.h"
#include "shading/material-inl.h"
#include "shading/material_taps-inl.h"
#include "shading/tap_sum-inl.h"
#include "shading/texture_jitter-inl.h"
#include "shading/tile.h"
#include "shading/wave_draws-inl.h"
#include "shading/wave_planes-inl.h"

#include <algorithm>
#include <array>
#include <bit>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// A block of pixels at one sample.
struct PixelWave {
    int x = 0, y = 0;  ///< upper left pixel, in the frame
    uint32_t sample = 0;
    WaveMask inside = 0;  ///< pixels that are to be rendered
    alignas(64) raster::SampleOffset offset[texunit::kWaveLanes];
    alignas(64) uint32_t setup_index[texunit::kWaveLanes];
    bool same_triangle = false;  ///< all lanes see what the first one sees
    bool has_directions = false;
    WaveVector direction;  ///< unit, from the eye through the sample points; found when first asked for
};

/// Shades the waves of a tile, sample by sample, into its planes.
class WaveShader {
  public:
    /// The tile's upper left pixel is (left, top).
    WaveShader(const TileInputs& inputs, int left, int top, TileScratch& scratch)
        : inputs_(inputs),
          frame_(*inputs.frame),
          scratch_(scratch),
          left_(left),
          top_(top),
          tile_size_(frame_.options().tile_size),
          planes_(inputs, scratch),
          steps_(inputs) {}
    WaveShader(const WaveShader&) = delete;

    /// `offset`: of all pixels, where each has not its own.
    void begin_sample(uint32_t sample, raster::SampleOffset offset) {
        wave_.sample = sample;
        std::fill_n(wave_.offset, texunit::kWaveLanes, offset);
        planes_.begin_sample(sample == inputs_.first_sample);
    }

    /// Wave `index` of the tile, whose upper left pixel is (x, y) of the tile.
    void shade(int x, int y, size_t index) {
        wave_.x = left_ + x;
        wave_.y = top_ + y;
        wave_.inside = lanes_inside(inputs_.visible, wave_.x, wave_.y);
        if (wave_.inside == 0) return;
        load_pixels(x, y);
        planes_.begin_wave(index);
        const WaveMask surface = wave_.inside & ~lanes_that_see_nothing();
        scratch_.totals.samples_shaded += uint64_t(std::popcount(surface));
        if (surface != 0) shade_surfaces(surface);
        if (wave_.inside & ~surface) shade_background(wave_.inside & ~surface);
        if (watched()) tell_sampled(x, y);
    }

  private:
    bool watched() const { return scratch_.fragment_listener != nullptr; }

    void tell_tapped(const DrawState& draw, WaveMask pass, const HeardTap& heard) {
        TappedTexels tapped{.block = {wave_.x, wave_.y, wave_.sample, pass & heard.tap->lanes},
                            .draw = &draw,
                            .plan = heard.plan,
                            .slot = {},
                            .tap = heard.tap,
                            .numbers = heard.numbers,
                            .number = heard.number,
                            .averaged = heard.plan == &draw.material->plans.averaged};
        if (heard.slot >= 0) tapped.slot = MapSlot(heard.slot);
        scratch_.fragment_listener->tapped(tapped);
    }

    /// What of a surface was shaded: by itself, one tap of it, or not lit.
    struct ShadedPart {
        const WaveFloat* weight = nullptr;
        const WaveFloat* alpha = nullptr;
        bool lit = true;
    };
    void tell_shaded(const DrawState& draw, WaveMask pass, const ShadedPart& part) {
        scratch_.fragment_listener->shaded({.block = {wave_.x, wave_.y, wave_.sample, pass},
                                            .draw = &draw,
                                            .frame = &frame_,
                                            .setup_index = wave_.setup_index,
                                            .weights = &weights_,
                                            .fragment = &fragment_,
                                            .maps = maps_.slot,
                                            .surface = &surface_,
                                            .radiance = radiance_,
                                            .weight = part.weight,
                                            .alpha = part.alpha,
                                            .branch = in_branch_,
                                            .lit = part.lit});
    }

    /// Of the wave at pixel (x, y) of the tile.
    void tell_sampled(int x, int y) {
        alignas(64) float depth[texunit::kWaveLanes];
        load_wave(&scratch_.visibility.depth[size_t(y * tile_size_ + x)], tile_size_, depth);
        const std::array<const WaveFloat*, 3> radiance = planes_.radiance();
        scratch_.fragment_listener->sampled(
            {.block = {wave_.x, wave_.y, wave_.sample, wave_.inside}, .radiance = {radiance[0], radiance[1], radiance[2]}, .depth = depth});
    }

    WaveMask lanes_that_see_nothing() const {
        if (!wave_.same_triangle) return lanes_that_see(wave_.setup_index, raster::kNoTriangle);
        return wave_.setup_index[0] == raster::kNoTriangle ? texunit::kWaveFull : 0;
    }

    /// What the tile's arrays hold for the wave's pixels.
    void load_pixels(int x, int y) {
        wave_.has_directions = false;
        const size_t pixel = size_t(y * tile_size_ + x);
        const raster::TileVisibility::Block& block = scratch_.visibility.block_of(x, y);
        wave_.same_triangle = !block.written;
        if (block.written) {
            load_wave(&scratch_.visibility.triangle[pixel], tile_size_, wave_.setup_index);
        } else {
            std::fill_n(wave_.setup_index, texunit::kWaveLanes, block.shown);
        }
        if (inputs_.pixel_jitter == PixelJitter::Pixel) load_wave(&scratch_.offsets[pixel], tile_size_, wave_.offset);
    }

    void find_directions() {
        if (wave_.has_directions) return;
        wave_.has_directions = true;
        const FloatLanes d;
        WaveFloat px, py;
        for (int lane = 0; lane < texunit::kWaveLanes; ++lane) {
            px[lane] = float(wave_.x + lane % texunit::kWaveWidth) + float(wave_.offset[lane].x) * (1.0f / raster::kSampleOne);
            py[lane] = float(wave_.y + lane / texunit::kWaveWidth) + float(wave_.offset[lane].y) * (1.0f / raster::kSampleOne);
        }
        const SpaceVector corner = set3(d, inputs_.rays.corner), right = set3(d, inputs_.rays.right), down = set3(d, inputs_.rays.down);
        for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
            const SpaceVector along = add(add(corner, scale(right, hn::Load(d, px.lane + i))), scale(down, hn::Load(d, py.lane + i)));
            store3(d, scale(along, hn::Div(hn::Set(d, 1.0f), hn::Sqrt(dot(along, along)))), wave_.direction, i);
        }
    }

    /// What blocks in a row that one triangle fills have in common.
    struct FillingTriangle {
        uint32_t index = raster::kNoTriangle;
        const DrawState* draw = nullptr;
        bool has_coordinates_alone = false;  ///< shading interpolates nothing else
        CornerPair corners{};                ///< where there are such
    };
    const FillingTriangle& filling_triangle(uint32_t index) {
        if (filling_.index != index) find_filling_triangle(index);
        return filling_;
    }

    HWY_NOINLINE void find_filling_triangle(uint32_t index) {
        const raster::SetupTriangle& triangle = frame_.triangle(index);
        const DrawState& draw = inputs_.draws[triangle.draw];
        const MaterialState& material = *draw.material;
        const bool plain = !inputs_.derivatives.quad && inputs_.derivatives.scale == 1.0f && !steps_.taken();
        filling_.index = index;
        filling_.draw = &draw;
        filling_.has_coordinates_alone = plain && material.interpolates_coordinates_alone() && draw.mesh->colors.empty() &&
                                         !triangle.compact && !wants_shape(*material.material);
        if (!filling_.has_coordinates_alone || material.coordinate_count == 0) return;
        const OneTriangle corners{&draw.mesh->indices[size_t(triangle.primitive) * 3]};
        filling_.corners = corner_pair(material.coordinates[0], *draw.mesh, corners, 0);
    }

    /// A pass for such a triangle, whose weights are not kept.
    void shade_coordinates_alone(const FillingTriangle& filling, WaveMask pass) {
        shapes_ = false;
        if (filling.draw->material->coordinate_count > 0) {
            const raster::Anchor& anchor = latest_anchors_.of(filling.index, wave_.x, wave_.y);
            interpolate_coordinates(filling.corners, anchor, sample_block().points, fragment_.coordinates[0]);
        }
        shade_pass(*filling.draw, pass);
    }

    /// One masked pass per draw that the wave sees.
    void shade_surfaces(WaveMask surface) {
        if (wave_.same_triangle) {
            const FillingTriangle& filling = filling_triangle(wave_.setup_index[0]);
            if (filling.has_coordinates_alone) return shade_coordinates_alone(filling, surface);
        }
        find_barycentrics(inputs_.derivatives, sample_block(), surface, weights_);
        if (inputs_.shadow_taps == ShadowTaps::One) find_shadow_numbers();
        clamp_weights(weights_);
        for (WaveMask rest = surface; rest != 0;) {
            const DrawLanes seen = wave_.same_triangle ? DrawLanes{frame_.triangle(wave_.setup_index[0]).draw, rest, true}
                                                       : first_draw(frame_, wave_.setup_index, rest);
            const DrawState& draw = inputs_.draws[seen.draw];
            rest &= ~seen.lanes;
            shapes_ = draw.material->branches() || wants_shape(*draw.material->material);
            if (shapes_) find_facing(seen);
            if (steps_.taken())
                steps_.find(sample_block(), seen.lanes, wave_.sample, draw.material->material->alpha_mode != AlphaMode::Opaque);
            if (draw.material->branches()) {
                shade_branches(draw, seen);
                continue;
            }
            find_fragment(draw, seen);
            shade_pass(draw, seen.lanes);
        }
    }

    /// Whether anything asks for a plain surface's position, normals and side.
    bool wants_shape(const Material& material) const { return !material.unlit || planes_.keeps_layers() || watched(); }

    SampleBlock sample_block() {
        const bool same_offset = inputs_.pixel_jitter == PixelJitter::Frame;
        return {frame_, wave_.setup_index, {wave_.x, wave_.y, wave_.offset, same_offset, wave_.same_triangle}, latest_anchors_};
    }

    void find_fragment(const DrawState& draw, const DrawLanes& seen, const PlaneLanes* planes = nullptr) {
        with_corners(frame_, *draw.mesh, wave_.setup_index, seen,
                     [&](const auto& corners) HWY_ATTR { interpolate_fragment(draw, corners, weights_, shapes_, fragment_, planes); });
        if (steps_.taken()) steps_.take(fragment_.coordinates, draw.material->coordinate_count);
    }

    void find_shadow_numbers() {
        texunit::RandomAddress address = wave_address();
        address.dimension = texunit::Dimension::Light;
        noise_pair_wave(inputs_.noise, address, texunit::Dimension::LightY, light_numbers_.x, light_numbers_.y);
    }

    void find_facing(const DrawLanes& seen) {
        const auto facing = [&](WaveMask lanes) {
            return frame_.triangle(wave_.setup_index[std::countr_zero(lanes)]).front_facing ? 1.0f : -1.0f;
        };
        store_value(facing(seen.lanes), texunit::kWaveFull, fragment_.facing);
        if (seen.one_triangle) return;
        for (WaveMask lanes = seen.lanes; lanes != 0; lanes &= lanes - 1) fragment_.facing[std::countr_zero(lanes)] = facing(lanes);
    }

    /// A material that blends planes or layers: a pass for each that a lane sees.
    HWY_NOINLINE void shade_branches(const DrawState& draw, const DrawLanes& seen) {
        const MaterialState& material = *draw.material;
        with_corners(frame_, *draw.mesh, wave_.setup_index, seen,
                     [&](const auto& corners) HWY_ATTR { branches_.prepare(draw, corners, weights_, steps_); });
        branch_sum_.clear();
        branches_.for_each(
            draw, seen.lanes, wave_address(), [&](const MaskLookup& mask) { tell_masked(mask); },
            [&](const Branch& branch) { shade_branch(draw, seen, branch); });
        in_branch_ = false;
        if (material.blend == Blend::Draw) return;
        if (material.blends_light) {
            branch_sum_.light(light_, surface_);
            radiance_ = &light_;
        } else {
            branch_sum_.surface(surface_);
            const MaterialState& lit = material.layer_count > 0 ? *material.layers[0] : material;
            light_surface(*lit.material, seen.lanes);
        }
        if (watched()) tell_shaded(draw, seen.lanes, {.lit = !material.blends_light});
        store_pass(draw, seen.lanes);
    }

    void tell_masked(const MaskLookup& mask) {
        if (watched()) scratch_.fragment_listener->masked({{wave_.x, wave_.y, wave_.sample, mask.lanes}, mask.map, mask.at});
    }

    /// Stored where it was drawn, else added to branch_sum_.
    HWY_NOINLINE void shade_branch(const DrawState& draw, const DrawLanes& seen, const Branch& branch) {
        find_fragment(*branch.draw, seen, branch.planes);
        in_branch_ = branch.weight != nullptr;
        if (watched()) scratch_.fragment_listener->branched({{wave_.x, wave_.y, wave_.sample, branch.lanes}, draw.material, branch.weight});
        if (!branch.weight) {
            shade_fragments(*branch.draw, branch.lanes);
            store_pass(draw, branch.lanes);
        } else if (draw.material->blends_light) {
            shade_fragments(*branch.draw, branch.lanes);
            // Its taps have been told of one by one.
            if (watched() && branch.draw->material->plans.draws()) tell_shaded(*branch.draw, branch.lanes, {});
            branch_sum_.add_light(*branch.weight, branch.lanes, *radiance_, surface_);
        } else {
            find_branch_surface(*branch.draw, branch.lanes);
            branch_sum_.add_surface(*branch.weight, branch.lanes, branch.draw->material->material->unlit, surface_);
        }
    }

    texunit::RandomAddress wave_address() const {
        return {.x = uint32_t(wave_.x), .y = uint32_t(wave_.y), .sample = wave_.sample, .seed = inputs_.seed};
    }

    void shade_pass(const DrawState& draw, WaveMask pass) {
        shade_fragments(draw, pass);
        store_pass(draw, pass);
    }

    /// From fragment_ to radiance_ and surface_.
    void shade_fragments(const DrawState& draw, WaveMask pass) {
        const MaterialState& material = *draw.material;
        WaveFloat lod = {};
        const bool wants_lod = planes_.wants_lod();
        if (material.draws_level) draw_levels_of(draw, pass);
        look_up_maps(material, fragment_, pass, maps_, wants_lod ? &lod : nullptr);
        if (material.plans.draws()) {
            shade_taps(draw, pass);
            if (wants_lod) find_lod(material.maps[kBaseColor], pass, lod);
        } else {
            shade_maps(draw, pass);
            if (watched()) tell_shaded(draw, pass, {});
        }
        if (wants_lod) planes_.store_lod(lod, pass);
    }

    void store_pass(const DrawState& draw, WaveMask pass) {
        planes_.store_radiance(*radiance_, pass);
        if (planes_.keeps_layers()) planes_.store_layers({draw, wave_.setup_index, weights_, fragment_, surface_}, pass);
        planes_.store_material(draw.material->index, pass);
    }

    /// Of a branch that is blended with others before it is lit.
    void find_branch_surface(const DrawState& draw, WaveMask pass) {
        const MaterialState& material = *draw.material;
        WaveFloat lod = {};
        const bool wants_lod = planes_.wants_lod();
        look_up_maps(material, fragment_, pass, maps_, wants_lod ? &lod : nullptr);
        if (!material.plans.averaged.empty()) {
            taps_.begin({&material, fragment_.coordinates, pass, wave_.x, wave_.y, wave_.sample, inputs_.seed, nullptr});
            average_taps(taps_, material.plans.averaged, maps_.slot);
            if (wants_lod) find_lod(material.maps[kBaseColor], pass, lod);
        }
        if (wants_lod) planes_.store_lod(lod, pass);
        find_surface(draw, fragment_, maps_, true, surface_);
        if (watched()) tell_shaded(draw, pass, {.lit = false});
    }

    /// From surface_ to radiance_.
    void light_surface(const Material& material, WaveMask lanes) {
        if (material.unlit) {
            radiance_ = &surface_.base_color;
        } else {
            turn_to_viewer();
            radiance_ = &light_;
            shade_lanes(*inputs_.lighting, surface_, lanes, light_, inputs_.shadow_taps == ShadowTaps::One ? &light_numbers_ : nullptr,
                        inputs_.skip_zero_weights);
        }
    }

    /// From the maps' values to radiance_.
    void shade_maps(const DrawState& draw, WaveMask lanes) {
        find_surface(draw, fragment_, maps_, shapes_, surface_);
        light_surface(*draw.material->material, lanes);
    }

    /// Begins the taps of lanes that see one draw; `surface` has room for 32.
    HWY_NOINLINE void begin_taps(const DrawState& draw, WaveMask pass, uint32_t* surface) {
        const MaterialState& material = *draw.material;
        const bool layered = material.material->alpha_mode != AlphaMode::Opaque;
        for (WaveMask lanes = layered ? pass : 0; lanes != 0; lanes &= lanes - 1) {
            const int lane = std::countr_zero(lanes);
            surface[lane] = 1 + frame_.triangle(wave_.setup_index[lane]).triangle_id;
        }
        taps_.begin({&material, fragment_.coordinates, pass, wave_.x, wave_.y, wave_.sample, inputs_.seed, layered ? surface : nullptr});
    }

    HWY_NOINLINE void draw_levels_of(const DrawState& draw, WaveMask pass) {
        alignas(64) uint32_t surface[texunit::kWaveLanes];
        begin_taps(draw, pass, surface);
        draw_levels(taps_, fragment_.coordinates, draw.material->coordinate_count);
    }

    /// Draws of maps that are averaged before shading; raw texels of the others, shaded and then added up.
    HWY_NOINLINE void shade_taps(const DrawState& draw, WaveMask pass) {
        const MaterialState& material = *draw.material;
        alignas(64) uint32_t surface[texunit::kWaveLanes];
        const bool layered = material.material->alpha_mode != AlphaMode::Opaque;
        begin_taps(draw, pass, surface);
        if (watched()) taps_.hear = [&](const HeardTap& heard) { tell_tapped(draw, pass, heard); };
        if (!material.plans.averaged.empty()) average_taps(taps_, material.plans.averaged, maps_.slot);
        if (material.plans.shaded.empty()) {
            shade_maps(draw, pass);
            if (watched()) tell_shaded(draw, pass, {});
            return;
        }

        const bool covers = layered && material.plans.shaded.holds(kBaseColor);
        if (!covers && !planes_.keeps_layers() && is_one_tap(material)) {
            for_each_shaded_tap(taps_, material.plans.shaded, maps_.slot, [&](const WaveFloat& weight, WaveMask lanes) HWY_ATTR {
                shade_maps(draw, lanes);
                if (watched()) tell_shaded(draw, lanes, {&weight, nullptr});
            });
            return;
        }
        tap_sum_.clear();
        const WaveFloat* const vertex = draw.mesh->colors.empty() ? nullptr : &fragment_.color.channel[3];
        WaveFloat alpha;
        for_each_shaded_tap(taps_, material.plans.shaded, maps_.slot, [&](const WaveFloat& weight, WaveMask lanes) HWY_ATTR {
            shade_maps(draw, lanes);
            if (covers) find_alpha(*material.material, &maps_.slot[kBaseColor].channel[3], vertex, alpha);
            if (watched()) tell_shaded(draw, lanes, {&weight, covers ? &alpha : nullptr});
            tap_sum_.add(*material.material, {radiance_, &surface_, &weight, covers ? &alpha : nullptr, lanes});
        });
        tap_sum_.radiance(light_);
        radiance_ = &light_;
        if (planes_.keeps_layers()) tap_sum_.layers(surface_);
    }

    /// Whether what is seen is one tap of weight 1, so that there is no sum.
    static bool is_one_tap(const MaterialState& material) {
        const TapPlans& plans = material.plans;
        if (plans.enumerates || plans.taps != 1 || plans.roles.sign) return false;
        return std::ranges::none_of(material.maps,
                                    [](const MapState& map) { return map.sampler.estimator == texunit::Estimator::AbsWeight; });
    }

    void find_lod(const MapState& map, WaveMask pass, WaveFloat& lod) {
        if (!map.texture) return;
        texunit::FetchCounts unused;
        texunit::FetchCounter counter{.counts = &unused};
        count_wave(*map.texture, map.sampler, fragment_.coordinates[map.coordinates], pass, counter, &lod);
    }

    void turn_to_viewer() {
        find_directions();
        const FloatLanes d;
        const auto minus = hn::Set(d, -1.0f);
        for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d))
            store3(d, scale(load3(d, wave_.direction, i), minus), surface_.view, i);
    }

    void shade_background(WaveMask mask) {
        if (inputs_.background) {
            planes_.store_radiance(*inputs_.background, mask);
        } else if (inputs_.lighting->environment) {
            find_directions();
            environment_radiance_lanes(*inputs_.lighting->environment, wave_.direction, mask, light_);
            planes_.store_radiance(light_, mask);
        } else {
            planes_.store_radiance(glm::vec3(0.0f), mask);
        }
    }

    const TileInputs& inputs_;
    const raster::Frame& frame_;
    TileScratch& scratch_;
    int left_, top_, tile_size_;
    WavePlanes planes_;
    TextureSteps steps_;
    bool shapes_ = true;      ///< positions and normals are asked for
    bool in_branch_ = false;  ///< what is shaded is blended with other branches
    // Lanes that nobody asked for are computed along with their neighbours, so they hold numbers from the start.
    PixelWave wave_{};
    FillingTriangle filling_;
    raster::LatestAnchors latest_anchors_{frame_};
    raster::BarycentricWave weights_{};
    FragmentWave fragment_{};
    MapColors maps_{};
    SurfaceWave surface_{};
    WaveVector light_{};
    const WaveVector* radiance_ = &light_;  ///< what is seen: light_, or of an unlit surface its base colour
    MaterialTaps taps_;
    TapSum tap_sum_;
    MaterialBranches branches_;
    BranchSum branch_sum_;
    ShadowNumbers light_numbers_{};
};

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();
#endif
