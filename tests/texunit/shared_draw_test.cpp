// Lookups that share their numbers: their joint distribution, listed and drawn.
#include "texunit/shared_draw.h"

#include "tests/texunit/drawn_places.h"
#include "tests/texunit/hashed_source.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <vector>

namespace rawtexel::texunit {
namespace {

using Tuple = std::vector<Place>;

/// Textures, samplers and coordinates of a set, kept together.
struct OwnedSet {
    std::vector<std::unique_ptr<Texture>> textures;
    std::vector<SamplerState> samplers;
    std::vector<LaneCoordinates> places;
    std::vector<WaveCoordinates> waves;

    void add(int width, int height, const SamplerState& sampler, const LaneCoordinates& at) {
        textures.push_back(std::make_unique<Texture>("hashed", make_hashed_pyramid(Format::RGBA8Unorm, width, height)));
        samplers.push_back(sampler);
        places.push_back(at);
        waves.push_back(everywhere(at));
    }
    LookupSet set() const {
        LookupSet set;
        set.mask = kWaveFull;
        for (size_t k = 0; k < textures.size(); ++k) set.lookup[set.count++] = {&textures[k]->levels(), &samplers[k], &waves[k]};
        return set;
    }
};

Tuple tuple_of(const SharedTap& tap, int count, int lane) {
    Tuple tuple;
    for (int k = 0; k < count; ++k) tuple.push_back(place_of(tap.draw[k], lane));
    return tuple;
}

std::map<Tuple, double> enumerated(const LookupSet& set, int lane = 0) {
    std::map<Tuple, double> weights;
    enumerate_shared(set, [&](const SharedTap& tap) {
        if ((tap.lanes >> lane & 1) != 0) weights[tuple_of(tap, set.count, lane)] += double(tap.weight[lane]);
    });
    return weights;
}

SamplerState sampler_of(const Kernel& kernel, MipMode mip, Wrap wrap, int probes) {
    SamplerState sampler{.magnify = kernel, .minify = kernel, .mip = mip, .probes = probes};
    sampler.wrap_s = wrap;
    return sampler;
}

const Kernel kKernels[] = {Kernel::Nearest,    Kernel::Bilinear, Kernel::Quadratic, Kernel::BSpline,        Kernel::mitchell(),
                           Kernel::CatmullRom, Kernel::Lanczos2, Kernel::Lanczos3,  Kernel::gaussian(0.6f), Kernel::gaussian_point(0.5f)};

/// Every kernel, wrap and choice of levels: the list of what is drawn has the weights of the deterministic lookup.
TEST(SharedDraw, ListsTheWeightsOfALookup) {
    std::mt19937 random(21);
    std::uniform_real_distribution<float> unit(-1, 1);
    double worst = 0;
    int cases = 0;
    for (const Kernel& kernel : kKernels) {
        for (const Wrap wrap : {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge, Wrap::ClampToBorder, Wrap::MirrorOnce}) {
            for (const auto& [mip, probes] :
                 {std::pair{MipMode::None, 1}, {MipMode::Nearest, 1}, {MipMode::Linear, 1}, {MipMode::Linear, 5}}) {
                OwnedSet owned;
                SamplerState sampler = sampler_of(kernel, mip, wrap, probes);
                if (probes > 1 && cases % 2 == 0) sampler.probe_variance = 0.2f;
                owned.add(48, 20, sampler,
                          {1.02f * unit(random), unit(random), 0.04f * unit(random), 0.09f * unit(random), 0.01f, 0.02f * unit(random)});
                std::map<Place, double> weights = weights_of(trace_lookup(*owned.textures[0], sampler, owned.places[0]));
                std::map<Place, double> found;
                for (const auto& [tuple, weight] : enumerated(owned.set())) found[tuple[0]] += weight;
                for (const auto& [place, weight] : found) weights.try_emplace(place, 0.0);
                for (const auto& [place, weight] : weights) {
                    worst = std::max(worst, std::abs(found[place] - weight));
                    EXPECT_NEAR(found[place], weight, 1e-6) << to_string(kernel) << " wrap " << int(wrap) << " probes " << probes;
                }
                ++cases;
            }
        }
    }
    std::printf("%d cases, largest difference %.2e\n", cases, worst);
}

/// Sets whose maps differ in extent, kernel and coordinates.
std::vector<OwnedSet> mixed_sets() {
    std::vector<OwnedSet> sets(5);
    const LaneCoordinates near{0.3101f, 0.7303f, 0.001f, 0.0004f, -0.0003f, 0.002f}, far{0.61f, 0.12f, 0.05f, 0.011f, -0.02f, 0.031f};
    sets[0].add(64, 64, sampler_of(Kernel::Bilinear, MipMode::Linear, Wrap::Repeat, 1), near);
    sets[0].add(24, 40, sampler_of(Kernel::Bilinear, MipMode::Linear, Wrap::Repeat, 1), near);
    sets[1].add(64, 64, sampler_of(Kernel::Bilinear, MipMode::Linear, Wrap::ClampToBorder, 1), far);
    sets[1].add(32, 32, sampler_of(Kernel::BSpline, MipMode::Linear, Wrap::MirroredRepeat, 1), far);
    sets[1].add(32, 32, sampler_of(Kernel::Nearest, MipMode::Nearest, Wrap::Repeat, 1), near);
    sets[2].add(64, 32, sampler_of(Kernel::Bilinear, MipMode::Linear, Wrap::Repeat, 4), far);
    sets[2].add(32, 64, sampler_of(Kernel::Bilinear, MipMode::Linear, Wrap::Repeat, 4), far);
    sets[3].add(64, 64, sampler_of(Kernel::CatmullRom, MipMode::Linear, Wrap::Repeat, 1), far);
    sets[3].add(20, 20, sampler_of(Kernel::CatmullRom, MipMode::Linear, Wrap::Repeat, 1), near);
    sets[4].add(64, 64, sampler_of(Kernel::Lanczos3, MipMode::None, Wrap::Repeat, 1), near);
    sets[4].add(48, 48, sampler_of(Kernel::Bilinear, MipMode::None, Wrap::Repeat, 1), near);
    return sets;
}

TEST(SharedDraw, KeepsEachLookupsOwnWeights) {
    for (const OwnedSet& owned : mixed_sets()) {
        const LookupSet set = owned.set();
        const std::map<Tuple, double> tuples = enumerated(set);
        double total = 0;
        for (const auto& [tuple, weight] : tuples) total += weight;
        EXPECT_NEAR(total, 1, 1e-6);
        for (int k = 0; k < set.count; ++k) {
            std::map<Place, double> weights =
                weights_of(trace_lookup(*owned.textures[size_t(k)], owned.samplers[size_t(k)], owned.places[size_t(k)]));
            std::map<Place, double> found;
            for (const auto& [tuple, weight] : tuples) found[tuple[size_t(k)]] += weight;
            for (const auto& [place, weight] : found) weights.try_emplace(place, 0.0);
            for (const auto& [place, weight] : weights) EXPECT_NEAR(found[place], weight, 2e-6) << "lookup " << k;
        }
    }
}

/// The means of draws of every tuple, of either sign, against the list.
TEST(SharedDraw, DrawsTuplesWithTheirListedWeights) {
    constexpr uint32_t kWaves = 30000;
    int tested = 0;
    double worst = 0;
    for (const OwnedSet& owned : mixed_sets()) {
        const LookupSet set = owned.set();
        const std::map<Tuple, double> listed = enumerated(set);
        struct Sums {
            double sum = 0, squares = 0;
        };
        std::map<Tuple, Sums> drawn;
        for (uint32_t n = 0; n < kWaves; ++n) {
            DrawNumbers positive, negative;
            draw_numbers({.sample = n}, positive);
            negative_draw_numbers({.sample = n}, negative);
            draw_shared(set, positive, negative, [&](const SharedTap& tap) {
                for (WaveMask rest = tap.lanes; rest != 0; rest &= rest - 1) {
                    const int lane = std::countr_zero(rest);
                    Sums& sums = drawn[tuple_of(tap, set.count, lane)];
                    const double weight = double(tap.weight[lane]);
                    sums.sum += weight, sums.squares += weight * weight;
                }
            });
        }
        constexpr double kDraws = double(kWaves) * kWaveLanes;
        for (const auto& [tuple, sums] : drawn) {
            ASSERT_TRUE(listed.contains(tuple));
            const double mean = sums.sum / kDraws, deviation = std::sqrt(sums.squares / kDraws / kDraws);
            const double z = std::abs(mean - listed.at(tuple)) / deviation;
            // Tuples drawn a few times only have no normal deviate.
            if (sums.squares < 50) continue;
            worst = std::max(worst, z);
            EXPECT_LT(z, 6.2) << "weight " << listed.at(tuple) << ", drawn " << mean;
            ++tested;
        }
        for (const auto& [tuple, weight] : listed) EXPECT_TRUE(std::abs(weight) < 1e-3 || drawn.contains(tuple)) << weight;
    }
    std::printf("%d tuples, largest |z| %.2f\n", tested, worst);
    EXPECT_GT(tested, 200);
}

/// Two texels side by side, metal of colour 1 and dielectric of 0.05: F0 = lerp(0.04, colour, metalness) over the edge. Filtered before
/// shading it is that of the mean maps; with numbers of their own the maps draw the product of their means.
TEST(SharedDraw, MakesTheEdgeOfAMetalRight) {
    const auto color = [](int texel) { return texel == 1 ? 1.0 : 0.05; };
    const auto f0 = [](double base, double metal) { return 0.04 + metal * (base - 0.04); };
    double worst_before = 0, worst_per_map = 0, worst_shared = 0, worst_drawn = 0;
    for (int step = 0; step <= 32; ++step) {
        const double t = step / 32.0, truth = f0(0.05, 0) + t * (f0(1, 1) - f0(0.05, 0));
        OwnedSet owned;
        for (int map = 0; map < 2; ++map)
            owned.add(2, 1, sampler_of(Kernel::Bilinear, MipMode::None, Wrap::ClampToEdge, 1), {float(0.25 + 0.5 * t), 0.5f, 0, 0, 0, 0});
        const LookupSet both = owned.set();
        LookupSet one = both, other = both;
        one.count = other.count = 1;
        other.lookup[0] = both.lookup[1];
        double shared = 0, per_map = 0, mean_color = 0, mean_metal = 0;
        for (const auto& [tuple, weight] : enumerated(both)) shared += weight * f0(color(std::get<2>(tuple[0])), std::get<2>(tuple[1]));
        for (const auto& [a, weight_a] : enumerated(one))
            for (const auto& [b, weight_b] : enumerated(other))
                per_map += weight_a * weight_b * f0(color(std::get<2>(a[0])), std::get<2>(b[0]));
        for (const auto& [a, weight] : enumerated(one)) mean_color += weight * color(std::get<2>(a[0]));
        for (const auto& [b, weight] : enumerated(other)) mean_metal += weight * std::get<2>(b[0]);
        constexpr uint32_t kWaves = 1000;
        double drawn = 0;
        for (uint32_t n = 0; n < kWaves; ++n) {
            DrawNumbers positive, negative;
            draw_numbers({.sample = n}, positive);
            negative_draw_numbers({.sample = n}, negative);
            draw_shared(both, positive, negative, [&](const SharedTap& tap) {
                for (int lane = 0; lane < kWaveLanes; ++lane) drawn += f0(color(tap.draw[0].x[lane]), tap.draw[1].x[lane]);
            });
        }
        drawn /= double(kWaves) * kWaveLanes;
        worst_before = std::max(worst_before, std::abs(f0(mean_color, mean_metal) - truth));
        worst_per_map = std::max(worst_per_map, std::abs(per_map - truth));
        worst_shared = std::max(worst_shared, std::abs(shared - truth));
        worst_drawn = std::max(worst_drawn, std::abs(drawn - truth));
    }
    std::printf("worst F0 error: before %.4f, per-map %.4f, shared %.1e, drawn %.4f\n", worst_before, worst_per_map, worst_shared,
                worst_drawn);
    EXPECT_NEAR(worst_before, 0.2375, 1e-6);
    EXPECT_NEAR(worst_per_map, 0.2375, 1e-6);
    EXPECT_LT(worst_shared, 1e-6);
    // 32 000 draws between 0.04 and 1: five standard deviations.
    EXPECT_LT(worst_drawn, 0.0134);
}

TEST(SharedDraw, PicksTheSameTexelInMapsOfTheSameShape) {
    OwnedSet owned;
    for (int k = 0; k < 3; ++k)
        owned.add(64, 64, sampler_of(Kernel::CatmullRom, MipMode::Linear, Wrap::Repeat, 3), {0.4f, 0.7f, 0.03f, 0, 0, 0.08f});
    const LookupSet set = owned.set();
    for (uint32_t n = 0; n < 200; ++n) {
        DrawNumbers positive, negative;
        draw_numbers({.sample = n}, positive);
        negative_draw_numbers({.sample = n}, negative);
        draw_shared(set, positive, negative, [&](const SharedTap& tap) {
            for (int lane = 0; lane < kWaveLanes; ++lane)
                for (int k = 1; k < 3; ++k) EXPECT_EQ(place_of(tap.draw[k], lane), place_of(tap.draw[0], lane));
        });
    }
}

TEST(SharedDraw, GivesEveryLaneItsOwnList) {
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, 40, 40));
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(-1, 1);
    WaveCoordinates at;
    for (int lane = 0; lane < kWaveLanes; ++lane) {
        at.u[lane] = unit(random), at.v[lane] = unit(random);
        at.dudx[lane] = 0.08f * unit(random), at.dvdx[lane] = 0.01f, at.dudy[lane] = 0, at.dvdy[lane] = 0.05f * unit(random);
    }
    const SamplerState sampler = sampler_of(Kernel::BSpline, MipMode::Linear, Wrap::MirroredRepeat, 1);
    LookupSet set{.mask = 0xF0F0FF01u, .count = 1, .lookup = {{&texture.levels(), &sampler, &at}}};
    for (int lane = 0; lane < kWaveLanes; ++lane) {
        const std::map<Tuple, double> found = enumerated(set, lane);
        if ((set.mask >> lane & 1) == 0) {
            EXPECT_TRUE(found.empty());
            continue;
        }
        const LaneCoordinates here{at.u[lane], at.v[lane], at.dudx[lane], at.dvdx[lane], at.dudy[lane], at.dvdy[lane]};
        for (const auto& [place, weight] : weights_of(trace_lookup(texture, sampler, here))) {
            const auto listed = found.find(Tuple{place});
            EXPECT_NEAR(listed == found.end() ? 0 : listed->second, weight, 1e-6) << "lane " << lane;
        }
    }
}

TEST(SharedDraw, ListsAnEllipseThatStandsAlone) {
    OwnedSet owned;
    SamplerState sampler;
    sampler.ellipse = 0.2f;
    owned.add(64, 48, sampler, {0.97f, 0.31f, 0.07f, 0.02f, -0.01f, 0.03f});
    EXPECT_TRUE(can_enumerate(owned.set()));
    const std::map<Tuple, double> found = enumerated(owned.set(), 3);
    for (const auto& [place, weight] : weights_of(trace_lookup(*owned.textures[0], sampler, owned.places[0]))) {
        ASSERT_TRUE(weight < 1e-12 || found.contains(Tuple{place}));
        if (weight >= 1e-12) {
            EXPECT_NEAR(found.at(Tuple{place}), weight, 1e-6);
        }
    }
    owned.add(32, 32, sampler, {0.1f, 0.2f, 0.01f, 0, 0, 0.01f});
    EXPECT_FALSE(can_enumerate(owned.set()));
}

}  // namespace
}  // namespace rawtexel::texunit
