// Whoever watches the fragments of a frame can account for every bit of it.
#include "shading/fragment_listener.h"

#include "shading/accumulation.h"
#include "shading/light_terms.h"
#include "shading/render.h"
#include "texunit/lookup_trace.h"
#include "texunit/random.h"

#include "tests/shading/frame_bits.h"
#include "tests/shading/scene_parts.h"
#include "tests/texunit/hashed_source.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <functional>
#include <map>
#include <memory>
#include <utility>

namespace rawtexel::shading {
namespace {

using namespace test;

void for_lanes(WaveMask lanes, const std::function<void(int)>& body) {
    for (; lanes != 0; lanes &= lanes - 1) body(std::countr_zero(lanes));
}

/// Pixel and sample.
struct Place {
    int x, y;
    uint32_t sample;
    auto operator<=>(const Place&) const = default;
};
Place place(const WatchedBlock& block, int lane) {
    return {block.x + lane % texunit::kWaveWidth, block.y + lane / texunit::kWaveWidth, block.sample};
}

/// Passes everything on to functions, which ignore it unless they are set.
struct Watcher final : FragmentListener {
    std::function<void(const JudgedFragments&)> on_judged = [](const JudgedFragments&) {};
    std::function<void(const ShadedFragments&)> on_shaded = [](const ShadedFragments&) {};
    std::function<void(const SampledPixels&)> on_sampled = [](const SampledPixels&) {};
    void judged(const JudgedFragments& fragments) override { on_judged(fragments); }
    void shaded(const ShadedFragments& fragments) override { on_shaded(fragments); }
    void sampled(const SampledPixels& pixels) override { on_sampled(pixels); }
};

class FragmentListenerTest : public testing::Test {
  protected:
    FragmentListenerTest() {
        options_.width = 165;
        options_.height = 101;
        options_.camera = busy_camera();
        options_.spp = 3;
    }
    RenderResult watched() {
        RenderOptions options = options_;
        options.fragment_listener = &watcher_;
        return render(scene_, lighting_, options, *one_);
    }

    std::unique_ptr<Executor> one_ = make_executor(ExecutorKind::Threads, 1);
    Scene scene_ = make_busy_scene();
    Lighting lighting_ = busy_lighting(scene_, *one_);
    RenderOptions options_;
    Watcher watcher_;
};

TEST_F(FragmentListenerTest, HearsTheRadianceOfEverySampleWhoseMeanIsTheImage) {
    for (const PixelJitter jitter : {PixelJitter::Frame, PixelJitter::Pixel}) {
        options_.pixel_jitter = jitter;
        std::map<std::pair<int, int>, SampleTree> sums;
        watcher_.on_sampled = [&](const SampledPixels& pixels) {
            for_lanes(pixels.block.lanes, [&](int lane) {
                const Place at = place(pixels.block, lane);
                const float radiance[] = {(*pixels.radiance[0])[lane], (*pixels.radiance[1])[lane], (*pixels.radiance[2])[lane]};
                sums.try_emplace({at.x, at.y}, 3).first->second.add(at.sample, radiance);
            });
        };
        const Image image = watched().radiance;
        ASSERT_EQ(sums.size(), size_t(165 * 101));
        Image means(image.width, image.height, 3);
        for (const auto& [pixel, sum] : sums) {
            ASSERT_EQ(sum.samples(), 3u);
            sum.mean(0, {means.pixel(pixel.first, pixel.second), 3});
        }
        EXPECT_TRUE(same_bits(means, image));
        EXPECT_TRUE(same_bits(render(scene_, lighting_, options_, *one_).radiance, image)) << "watching changed the image";
    }
}

TEST_F(FragmentListenerTest, HearsLookupsThatTracesRepeatBitForBit) {
    options_.spp = 1;
    for (const auto precision : {texunit::Precision::Exact, texunit::Precision::Gpu}) {
        options_.precision = precision;
        options_.footprint.probes = precision == texunit::Precision::Gpu ? 8 : 1;
        int lookups = 0, differing = 0;
        watcher_.on_shaded = [&](const ShadedFragments& fragments) {
            for (int slot = 0; slot < kMapSlots; ++slot) {
                const MapState& map = fragments.draw->material->maps[size_t(slot)];
                if (!map.texture) continue;
                const texunit::WaveCoordinates& at = fragments.fragment->coordinates[map.coordinates];
                for_lanes(fragments.block.lanes & 0x10400421u, [&](int lane) {
                    const texunit::LaneCoordinates lane_at{at.u[lane],    at.v[lane],    at.dudx[lane],
                                                           at.dvdx[lane], at.dudy[lane], at.dvdy[lane]};
                    const texunit::LookupTrace trace = trace_lookup(*map.texture, map.sampler, lane_at);
                    for (size_t c = 0; c < 4; ++c) differing += trace.result[c] != fragments.maps[slot].channel[c][lane];
                    ++lookups;
                });
            }
        };
        watched();
        EXPECT_GT(lookups, 1000);
        EXPECT_EQ(differing, 0) << "channels of " << lookups << " lookups, precision " << to_string(precision);
    }
}

/// Maps that differ in their texels alone are looked up together; those of another wrap, extent or place are not.
TEST_F(FragmentListenerTest, HearsLookupsOfAlikeMapsAndOfOthersThatTracesRepeat) {
    const auto add_words = [&](int extent) {
        SceneTexture texture;
        texture.texture = std::make_shared<texunit::Texture>(
            "words", texunit::make_hashed_pyramid(texunit::Format::RGBA8Unorm, extent, 32, uint32_t(scene_.textures.size())));
        scene_.textures.push_back(texture);
        return int(scene_.textures.size()) - 1;
    };
    scene_ = {};
    Material material;
    for (int slot = 0; slot < kMapSlots; ++slot) material.maps[size_t(slot)].texture = add_words(slot == kOcclusion ? 32 : 64);
    material.emission = glm::vec3(1.0f);
    material.maps[kNormal].sampler.wrap_t = texunit::Wrap::ClampToEdge;
    material.maps[kEmissive].uv_from_vertex = glm::mat3x2{3, 0, 0, 3, 0.25f, 0};
    add_object(scene_, make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, -9}, {7, 5}), material);
    options_.camera = square_camera();
    lighting_.ambient = 1.0f;
    for (const bool base_color : {true, false}) {
        // Without one of the two that are alike, the other stands alone.
        if (!base_color) scene_.materials.back().maps[kBaseColor].texture = -1;
        std::array<int, kMapSlots> lookups{};
        int differing = 0;
        watcher_.on_shaded = [&](const ShadedFragments& fragments) {
            const auto& maps = fragments.draw->material->maps;
            EXPECT_EQ(maps[kMetallicRoughness].alike, base_color ? kBaseColor : kMetallicRoughness);
            for (int slot = 0; slot < kMapSlots; ++slot) {
                const MapState& map = maps[size_t(slot)];
                if (!map.texture) continue;
                const texunit::WaveCoordinates& at = fragments.fragment->coordinates[map.coordinates];
                for_lanes(fragments.block.lanes & 0x10400421u, [&](int lane) {
                    const texunit::LaneCoordinates lane_at{at.u[lane],    at.v[lane],    at.dudx[lane],
                                                           at.dvdx[lane], at.dudy[lane], at.dvdy[lane]};
                    const texunit::LookupTrace trace = trace_lookup(*map.texture, map.sampler, lane_at);
                    for (size_t c = 0; c < 4; ++c) differing += trace.result[c] != fragments.maps[slot].channel[c][lane];
                    ++lookups[size_t(slot)];
                });
            }
        };
        watched();
        for (int slot = 0; slot < kMapSlots; ++slot) {
            EXPECT_EQ(lookups[size_t(slot)] > 1000, base_color || slot != kBaseColor) << "map " << slot;
        }
        EXPECT_EQ(differing, 0);
    }
}

TEST_F(FragmentListenerTest, HearsLightWhoseTermsAddUpToTheRadiance) {
    std::map<Place, glm::vec3> expected;
    size_t differing = 0;
    watcher_.on_shaded = [&](const ShadedFragments& fragments) {
        for_lanes(fragments.block.lanes & 0x40081002u, [&](int lane) {
            const std::vector<LightTerm> terms = light_terms(lighting_, *fragments.surface, lane);
            ASSERT_EQ(terms.size(), lighting_.lights.size() + 3);
            glm::vec3 sum = terms[0].radiance;
            for (size_t i = 1; i < terms.size(); ++i) sum += terms[i].radiance;
            expected[place(fragments.block, lane)] = sum;
        });
    };
    watcher_.on_sampled = [&](const SampledPixels& pixels) {
        for_lanes(pixels.block.lanes, [&](int lane) {
            const auto sum = expected.find(place(pixels.block, lane));
            if (sum == expected.end()) return;
            for (int c = 0; c < 3; ++c) differing += sum->second[c] != (*pixels.radiance[c])[lane];
        });
    };
    watched();
    EXPECT_GT(expected.size(), 2000u);
    EXPECT_EQ(differing, 0u) << "channels of " << expected.size() << " surfaces";
}

TEST_F(FragmentListenerTest, HearsWhyAlphaCovers) {
    int covered[3] = {}, let_through[3] = {};
    std::map<std::pair<Place, uint32_t>, bool> verdicts;
    watcher_.on_judged = [&](const JudgedFragments& fragments) {
        const Material& material = *fragments.draw->material->material;
        for_lanes(fragments.block.lanes, [&](int lane) {
            const Place at = place(fragments.block, lane);
            const float alpha = (*fragments.alpha)[lane];
            const bool covers = (fragments.covered >> lane & 1) != 0;
            const float number = texunit::random_float({.x = uint32_t(at.x),
                                                        .y = uint32_t(at.y),
                                                        .sample = at.sample,
                                                        .surface = 1 + fragments.triangle->triangle_id,
                                                        .dimension = texunit::Dimension::Coverage,
                                                        .seed = options_.seed});
            const bool expected = material.alpha_mode == AlphaMode::Mask ? alpha >= material.alpha_cutoff : number < alpha;
            EXPECT_EQ(covers, expected) << alpha << ' ' << number;
            ++(covers ? covered : let_through)[size_t(material.alpha_mode)];
            EXPECT_TRUE(verdicts.emplace(std::pair(at, fragments.setup_index), covers).second) << "asked twice";
        });
    };
    int seen = 0;
    watcher_.on_shaded = [&](const ShadedFragments& fragments) {
        for_lanes(fragments.block.lanes, [&](int lane) {
            const auto verdict = verdicts.find({place(fragments.block, lane), fragments.setup_index[lane]});
            const bool opaque = fragments.draw->material->material->alpha_mode == AlphaMode::Opaque;
            EXPECT_EQ(verdict == verdicts.end(), opaque);
            if (verdict == verdicts.end()) return;
            EXPECT_TRUE(verdict->second);
            ++seen;
        });
    };
    options_.seed = 5;
    watched();
    for (const AlphaMode mode : {AlphaMode::Mask, AlphaMode::Blend}) {
        EXPECT_GT(covered[size_t(mode)], 100) << int(mode);
        EXPECT_GT(let_through[size_t(mode)], 100) << int(mode);
    }
    EXPECT_GT(seen, 100);
}

TEST_F(FragmentListenerTest, HearsTheBaseColourLookupThatAlphaCameFrom) {
    options_.spp = 1;
    int alphas = 0, differing = 0;
    watcher_.on_judged = [&](const JudgedFragments& fragments) {
        const MapState& map = fragments.draw->material->maps[kBaseColor];
        if (!map.texture) return;
        const texunit::WaveCoordinates& at = *fragments.base_color;
        for_lanes(fragments.block.lanes, [&](int lane) {
            const texunit::LookupTrace trace = trace_lookup(
                *map.texture, map.sampler, {at.u[lane], at.v[lane], at.dudx[lane], at.dvdx[lane], at.dudy[lane], at.dvdy[lane]});
            differing += trace.result[3] * fragments.draw->material->material->base_color.a != (*fragments.alpha)[lane];
            ++alphas;
        });
    };
    watched();
    EXPECT_GT(alphas, 500);
    EXPECT_EQ(differing, 0) << "of " << alphas;
}

TEST_F(FragmentListenerTest, PartsOfAnImageTakeTheFootprintOfTheWhole) {
    options_.footprint.area = FootprintArea::Sample;
    options_.spp = 4;
    const Image whole = render(scene_, lighting_, options_, *one_).radiance;
    Image mean(whole.width, whole.height, 3);
    SampleTree sums(whole.values.size());
    RenderOptions part = options_;
    part.spp = 1;
    part.image_spp = 4;
    for (part.first_sample = 0; part.first_sample < 4; ++part.first_sample)
        sums.add(part.first_sample, render(scene_, lighting_, part, *one_).radiance.values);
    sums.mean(0, mean.values);
    EXPECT_TRUE(same_bits(mean, whole));
    part.first_sample = 0;
    part.image_spp = 0;
    const Image alone = render(scene_, lighting_, part, *one_).radiance;
    part.image_spp = 4;
    EXPECT_FALSE(same_bits(alone, render(scene_, lighting_, part, *one_).radiance)) << "the footprint should have shrunk";
}

}  // namespace
}  // namespace rawtexel::shading
