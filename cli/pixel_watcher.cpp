#include "cli/pixel_watcher.h"

#include "texunit/noise.h"
#include "texunit/random.h"

#include <algorithm>
#include <span>
#include <utility>

namespace rawtexel::cli {
namespace {

using shading::AlphaMode;
using shading::DrawState;
using shading::MapState;
using texunit::WaveCoordinates;

glm::vec3 at_lane(const shading::WaveVector& wave, int lane) { return {wave.x[lane], wave.y[lane], wave.z[lane]}; }

ExplainedTriangle explain_triangle(const DrawState& draw, const raster::SetupTriangle& triangle) {
    return {.id = triangle.triangle_id,
            .instance = triangle.draw,
            .primitive = triangle.primitive,
            .mesh = draw.mesh,
            .material_index = draw.material->index,
            .material = draw.material->material,
            .front = triangle.front_facing};
}

ExplainedLookup explain_lookup(shading::MapSlot slot, const MapState& map, const WaveCoordinates& at, int lane) {
    return {.slot = slot,
            .texture = map.texture,
            .sampler = map.sampler,
            .at = {at.u[lane], at.v[lane], at.dudx[lane], at.dvdx[lane], at.dudy[lane], at.dvdy[lane]}};
}

std::vector<ExplainedLookup> explain_lookups(const shading::ShadedFragments& fragments, int lane) {
    std::vector<ExplainedLookup> lookups;
    for (int slot = 0; slot < shading::kMapSlots; ++slot) {
        const MapState& map = fragments.draw->material->maps[size_t(slot)];
        if (!map.texture) continue;
        lookups.push_back(explain_lookup(shading::MapSlot(slot), map, fragments.fragment->coordinates[map.coordinates], lane));
        const shading::TapPlans& plans = fragments.draw->material->plans;
        lookups.back().drawn = plans.averaged.holds(slot) || plans.shaded.holds(slot);
    }
    return lookups;
}

ExplainedTexel explain_texel(shading::MapSlot slot, const MapState& map, const texunit::TexelDraw& draw, float weight, int lane) {
    ExplainedTexel texel{
        .slot = slot, .level = draw.level[lane], .x = draw.x[lane], .y = draw.y[lane], .border = false, .value = {}, .weight = weight};
    texel.border = (draw.border >> lane & 1) != 0;
    const std::array<float, 4> value = texel.border ? map.sampler.border : map.texture->texel(texel.level, 0, texel.x, texel.y);
    texel.value = {value[0], value[1], value[2], value[3]};
    return texel;
}

ExplainedReflection explain_reflection(const shading::Lighting& lighting, const shading::SurfaceWave& surface, int lane) {
    return {.metallic = surface.metallic[lane],
            .roughness = surface.roughness[lane],
            .occlusion = surface.occlusion[lane],
            .emission = at_lane(surface.emission, lane),
            .light = light_terms(lighting, surface, lane)};
}

std::optional<glm::vec4> vertex_color(const shading::ShadedFragments& fragments, int lane) {
    if (fragments.draw->mesh->colors.empty()) return std::nullopt;
    const texunit::WaveColor& color = fragments.fragment->color;
    return glm::vec4(color.channel[0][lane], color.channel[1][lane], color.channel[2][lane], color.channel[3][lane]);
}

}  // namespace

PixelWatcher::PixelWatcher(int x, int y, const shading::RenderOptions& options, const shading::Lighting& lighting)
    : x_(x),
      y_(y),
      pixel_filter_(options.pixel_filter),
      pixel_jitter_(options.pixel_jitter),
      seed_(options.seed),
      filtering_(options.filtering),
      rays_(make_view_rays(options.camera, options.width, options.height)),
      lighting_(lighting) {}

int PixelWatcher::lane_of(const shading::WatchedBlock& block) const {
    const int column = x_ - block.x, row = y_ - block.y;
    if (column < 0 || column >= texunit::kWaveWidth || row < 0 || row >= texunit::kWaveHeight) return -1;
    const int lane = row * texunit::kWaveWidth + column;
    return (block.lanes >> lane & 1) != 0 ? lane : -1;
}

AlphaVerdict PixelWatcher::verdict(const shading::JudgedFragments& fragments, int lane) const {
    const shading::Material& material = *fragments.draw->material->material;
    AlphaVerdict verdict{.alpha = (*fragments.alpha)[lane], .covers = (fragments.covered >> lane & 1) != 0};
    // Raw texels decide by the share that covers, against a number.
    if (material.alpha_mode == AlphaMode::Mask && !fragments.draw->material->plans.shaded.holds(shading::kBaseColor)) {
        verdict.threshold = material.alpha_cutoff;
    } else {
        verdict.random_surface = 1 + fragments.triangle->triangle_id;
        verdict.threshold = texunit::random_float({.x = uint32_t(x_),
                                                   .y = uint32_t(y_),
                                                   .sample = fragments.block.sample,
                                                   .surface = verdict.random_surface,
                                                   .dimension = texunit::Dimension::Coverage,
                                                   .seed = seed_});
    }
    return verdict;
}

void PixelWatcher::judged(const shading::JudgedFragments& fragments) {
    const int lane = lane_of(fragments.block);
    if (lane < 0) return;
    ExplainedCandidate candidate{.triangle = explain_triangle(*fragments.draw, *fragments.triangle),
                                 .depth = fragments.depth[lane],
                                 .verdict = verdict(fragments, lane),
                                 .lookup = {}};
    const MapState& map = fragments.draw->material->maps[shading::kBaseColor];
    if (map.texture) candidate.lookup = explain_lookup(shading::kBaseColor, map, *fragments.base_color, lane);
    judged_.push_back({fragments.setup_index, candidate});
}

void PixelWatcher::tapped(const shading::TappedTexels& tapped) {
    const int lane = lane_of(tapped.block);
    if (lane < 0) return;
    const shading::MaterialState& material = *tapped.draw->material;
    const float weight = tapped.tap->weight[lane] / float(material.plans.taps);
    for (int slot = 0; slot < shading::kMapSlots; ++slot) {
        if (!tapped.plan->holds(slot) || (tapped.slot && *tapped.slot != slot)) continue;
        const int lookup = tapped.slot ? 0 : tapped.plan->lookup_of[size_t(slot)];
        (tapped.averaged ? averaged_ : texels_)
            .push_back(explain_texel(shading::MapSlot(slot), material.maps[size_t(slot)], tapped.tap->draw[lookup], weight, lane));
    }
    if (tapped.numbers)
        numbers_ = ExplainedNumbers{tapped.numbers->x[lane], tapped.numbers->y[lane], tapped.numbers->level[lane],
                                    tapped.numbers->probe[lane], tapped.numbers->sign[lane]};
}

void PixelWatcher::masked(const shading::MaskedFragments& masked) {
    const int lane = lane_of(masked.block);
    if (lane >= 0) mask_ = explain_lookup(shading::kLayerMask, *masked.map, *masked.at, lane);
}

void PixelWatcher::branched(const shading::BranchedFragments& branched) {
    const int lane = lane_of(branched.block);
    if (lane < 0) return;
    whole_ = branched.whole;
    if (!branched.weight) return;
    branches_.emplace_back().weight = (*branched.weight)[lane];
    branch_begins_ = true;
}

std::vector<ExplainedNumber> PixelWatcher::numbers_of(const shading::MaterialState& material, const shading::WatchedBlock& block,
                                                      uint32_t surface) const {
    using texunit::Dimension;
    const int lane = (y_ - block.y) * texunit::kWaveWidth + (x_ - block.x);
    texunit::RandomAddress address{.x = uint32_t(block.x), .y = uint32_t(block.y), .sample = block.sample, .seed = seed_};
    std::vector<ExplainedNumber> numbers;
    const auto add = [&](std::string_view name, Dimension dimension) {
        texunit::WaveFloat wave;
        address.dimension = dimension;
        noise_wave(filtering_.noise, address, wave);
        numbers.push_back({name, wave[lane]});
    };
    const auto add_pair = [&](std::string_view first, std::string_view second, Dimension x, Dimension y) {
        texunit::WaveFloat a, b;
        address.dimension = x;
        noise_pair_wave(filtering_.noise, address, y, a, b);
        numbers.insert(numbers.end(), {{first, a[lane]}, {second, b[lane]}});
    };
    const auto projects = [](const shading::MaterialState* of) { return of->material->triplanar.has_value(); };
    const std::span layers(material.layers.data(), size_t(material.layer_count));
    if (material.blend == shading::Blend::Draw && !layers.empty()) add("layer", Dimension::Layer);
    if (material.blend == shading::Blend::Draw && (projects(&material) || std::ranges::any_of(layers, projects)))
        add("plane", Dimension::Plane);
    const bool lit = !(layers.empty() ? material : *layers[0]).material->unlit;
    if (filtering_.shadow_taps == shading::ShadowTaps::One && lit && lighting_.shadow)
        add_pair("light", "light y", Dimension::Light, Dimension::LightY);
    address.surface = surface;
    if (filtering_.texture_jitter != shading::TextureJitter::None)
        add_pair("texture x", "texture y", Dimension::TextureX, Dimension::TextureY);
    address.sample = block.sample * uint32_t(filtering_.taps);
    if (material.draws_level) add("level", Dimension::Level);
    return numbers;
}

void PixelWatcher::add_tap(const shading::ShadedFragments& fragments, int lane, ExplainedSurface& surface) {
    ExplainedTap& tap = surface.taps.emplace_back();
    tap.weight = (*fragments.weight)[lane];
    if (fragments.alpha) tap.alpha = (*fragments.alpha)[lane];
    tap.texels = std::exchange(texels_, {});
    tap.numbers = std::exchange(numbers_, std::nullopt);
    tap.base_color = at_lane(fragments.surface->base_color, lane);
    tap.normal = at_lane(fragments.surface->normal, lane);
    tap.radiance = at_lane(*fragments.radiance, lane);
    if (!fragments.draw->material->material->unlit) tap.reflection = explain_reflection(lighting_, *fragments.surface, lane);
}

ExplainedSurface PixelWatcher::explain_surface(const shading::ShadedFragments& fragments, int lane) {
    const float b1 = fragments.weights->b1[lane], b2 = fragments.weights->b2[lane];
    const glm::vec3 position = at_lane(fragments.fragment->position, lane);
    const shading::SurfaceWave& surface = *fragments.surface;
    ExplainedSurface explained;
    explained.triangle = explain_triangle(*fragments.draw, fragments.frame->triangle(fragments.setup_index[lane]));
    explained.barycentrics = {1.0f - b1 - b2, b1, b2};
    explained.position = position;
    explained.distance = glm::dot(position - rays_.eye, rays_.forward);
    explained.normal = at_lane(surface.normal, lane);
    explained.geometric_normal = at_lane(surface.geometric_normal, lane);
    explained.vertex_color = vertex_color(fragments, lane);
    explained.base_color = at_lane(surface.base_color, lane);
    explained.averaged = std::exchange(averaged_, {});
    const bool layered = explained.triangle.material->alpha_mode != AlphaMode::Opaque;
    explained.numbers = numbers_of(whole_ ? *whole_ : *fragments.draw->material, fragments.block, layered ? 1 + explained.triangle.id : 0);
    // Of branches together the first one's light is that of the blend.
    const bool unlit = explained.triangle.material->unlit;
    if (fragments.lit && !unlit) explained.reflection = explain_reflection(lighting_, surface, lane);
    return explained;
}

void PixelWatcher::shaded(const shading::ShadedFragments& fragments) {
    const int lane = lane_of(fragments.block);
    if (lane < 0) return;
    if (fragments.branch) {
        ExplainedSurface& branch = branches_.back();
        if (std::exchange(branch_begins_, false)) {
            const float weight = branch.weight;
            branch = explain_surface(fragments, lane);
            branch.weight = weight;
            branch.lookups = explain_lookups(fragments, lane);
        }
        if (fragments.weight) return add_tap(fragments, lane, branch);
        if (fragments.lit) branch.radiance = at_lane(*fragments.radiance, lane);
        return;
    }
    // Further taps of the surface.
    if (surface_ && fragments.weight) return add_tap(fragments, lane, *surface_);
    surface_ = explain_surface(fragments, lane);
    surface_->branches = std::exchange(branches_, {});
    if (mask_) surface_->lookups.push_back(*std::exchange(mask_, std::nullopt));
    if (surface_->branches.empty())
        for (ExplainedLookup& lookup : explain_lookups(fragments, lane)) surface_->lookups.push_back(lookup);
    if (fragments.weight) add_tap(fragments, lane, *surface_);
    const auto asked = std::ranges::find(judged_, fragments.setup_index[lane], &Judged::setup_index);
    if (asked != judged_.end()) surface_->verdict = asked->candidate.verdict;
}

std::vector<ExplainedCandidate> PixelWatcher::take_let_through(float depth) {
    std::vector<ExplainedCandidate> let_through;
    for (const Judged& judged : std::exchange(judged_, {})) {
        const ExplainedCandidate& candidate = judged.candidate;
        const bool tied_before = candidate.depth == depth && surface_ && candidate.triangle.id < surface_->triangle.id;
        const bool before = !surface_ || candidate.depth > depth || tied_before;
        if (before && !candidate.verdict.covers) let_through.push_back(candidate);
    }
    // As raster::tile_visibility orders them.
    std::ranges::stable_sort(let_through, [](const ExplainedCandidate& a, const ExplainedCandidate& b) {
        return a.depth != b.depth ? a.depth > b.depth : a.triangle.id < b.triangle.id;
    });
    return let_through;
}

void PixelWatcher::sampled(const shading::SampledPixels& pixels) {
    const int lane = lane_of(pixels.block);
    if (lane < 0) return;
    const shading::SequenceShift shift = shading::sequence_shift(pixel_jitter_, uint32_t(x_), uint32_t(y_), seed_);
    ExplainedSample& sample = samples_.emplace_back();
    sample.sample = pixels.block.sample;
    sample.shift = shift;
    sample.offset = shading::sample_offset(pixel_filter_, pixel_jitter_, sample.sample, shift);
    sample.let_through = take_let_through(pixels.depth[lane]);
    whole_ = nullptr;
    sample.surface = std::exchange(surface_, std::nullopt);
    sample.radiance = {(*pixels.radiance[0])[lane], (*pixels.radiance[1])[lane], (*pixels.radiance[2])[lane]};
}

std::vector<ExplainedSample> PixelWatcher::take() { return std::exchange(samples_, {}); }

}  // namespace rawtexel::cli
