// Every kernel, estimator, wrap, choice of levels and noise: what the tile's own draws pick, over pixels and samples, has the weights of
// the deterministic lookup.
#include "texunit/shared_draw.h"

#include "tests/stress/worst_case.h"
#include "tests/stress_scale.h"
#include "tests/texunit/drawn_places.h"
#include "tests/texunit/hashed_source.h"
#include "tests/texunit/placed_lookup.h"

#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <string>
#include <vector>

namespace rawtexel::texunit {
namespace {

const Kernel kKernels[] = {Kernel::Nearest,           Kernel::Bilinear,       Kernel::Quadratic,        Kernel::BSpline,
                           Kernel::mitchell(),        Kernel::CatmullRom,     Kernel::Lanczos2,         Kernel::Lanczos3,
                           Kernel::gaussian(),        Kernel::gaussian(1.3f), Kernel::gaussian_point(), Kernel::mitchell(0, 0),
                           Kernel::mitchell(1, -0.3f)};
constexpr Wrap kWraps[] = {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge, Wrap::ClampToBorder, Wrap::MirrorOnce};
constexpr Noise kNoises[] = {Noise::White, Noise::Sobol, Noise::R2, Noise::Blue, Noise::Stbn};

/// 2^20 draws: a square of pixels as large as stbn's mask, beyond which its numbers repeat, and eight of its periods.
constexpr uint32_t kPixels = 64, kSamples = 256;
constexpr double kDraws = double(kPixels) * kPixels * kSamples;

/// Deviates beyond this have probability 1e-10 each; there are fewer than 10^4. One-sided: numbers more even than chance pick more evenly
/// too, and their statistic is smaller.
constexpr double kBound = 6.4;

/// The taps of lane 0, by the probe and level that draws choose before the texel.
class GroupedTaps final : public TapSink {
  public:
    struct Tap {
        size_t cell;
        double weight;  ///< within the group
    };
    struct Group {
        double weight;
        std::vector<Tap> taps;
    };
    std::vector<Group> groups;

    explicit GroupedTaps(const Texture& texture) : texture_(texture) {}

    size_t cells() const { return size_t(texture_.levels().texels) + 1; }
    /// The number of a texel; the border's is the last.
    size_t cell(bool border, int level, int slice, int x, int y) const {
        if (border) return cells() - 1;
        return size_t(texel_index(texture_.levels(), texture_.texel_layout().storage, level, slice, x, y));
    }

    void begin_lookup(const Texture&, WaveMask) override {}
    void begin_probe(const WaveFloat& weight) override { probe_ = double(weight[0]); }
    void begin_level(const WaveFloat& fraction, bool coarser) override {
        groups.push_back({probe_ * (coarser ? double(fraction[0]) : 1 - double(fraction[0])), {}});
    }
    void tap(const WaveTap& tap) override {
        if ((tap.lanes & 1) == 0) return;
        if (groups.empty()) groups.push_back({1, {}});
        const int slice = tap.slice == nullptr ? 0 : (*tap.slice)[0];
        groups.back().taps.push_back(
            {cell((tap.border & 1) != 0, (*tap.level)[0], slice, (*tap.x)[0], (*tap.y)[0]), double((*tap.weight)[0])});
    }

  private:
    const Texture& texture_;
    double probe_ = 1;
};

/// Shares of the draws, or counts of them, by cell: [0] of positive weights, [1] of negative ones.
template <class Number>
struct Picks {
    std::vector<Number> side[2];
    explicit Picks(size_t cells) : side{std::vector<Number>(cells), std::vector<Number>(cells)} {}
};

/// By positivization each draw has a texel of the group's positive weights and, where the group has negative ones, one of those.
Picks<double> expected_picks(const GroupedTaps& taps, const SamplerState& sampler) {
    Picks<double> expected(taps.cells());
    for (const GroupedTaps::Group& group : taps.groups) {
        double sum[2] = {};
        for (const GroupedTaps::Tap& tap : group.taps) sum[tap.weight < 0] += std::abs(tap.weight);
        if (sampler.estimator == Estimator::AbsWeight) sum[0] = sum[1] = sum[0] + sum[1];
        for (const GroupedTaps::Tap& tap : group.taps)
            expected.side[tap.weight < 0][tap.cell] += group.weight * std::abs(tap.weight) / sum[tap.weight < 0];
    }
    return expected;
}

/// What the draws of all pixels and samples pick, with the numbers and through the code of a tile.
Picks<uint32_t> drawn_picks(const PlacedLookup& lookup, const GroupedTaps& taps, Noise noise, uint32_t seed) {
    const LookupSet set = lookup.set();
    const bool absolute = lookup.sampler.estimator == Estimator::AbsWeight;
    const bool one_sign = weighs_as_probability(lookup.sampler.minify);
    Picks<uint32_t> picks(taps.cells());
    const NumberRoles roles = roles_of(lookup.sampler);
    DrawNumbers positive{}, negative{};
    // What a tile leaves as it was decides nothing.
    for (DrawNumbers* numbers : {&positive, &negative})
        for (WaveFloat* role : {&numbers->level, &numbers->probe, &numbers->sign}) std::fill_n(role->lane, kWaveLanes, 0.999f);
    for (uint32_t sample = 0; sample < kSamples; ++sample) {
        for (uint32_t y = 0; y < kPixels; y += kWaveHeight) {
            for (uint32_t x = 0; x < kPixels; x += kWaveWidth) {
                const RandomAddress first{.x = x, .y = y, .sample = sample, .seed = seed};
                draw_numbers(first, positive, noise, roles);
                if (!one_sign) negative_draw_numbers(first, negative, noise, roles);
                if (lookup.is_solid()) draw_depth_numbers(first, positive, noise), negative_draw_depth_numbers(first, negative, noise);
                int side = 0;
                draw_shared(set, positive, negative, [&](const SharedTap& tap) {
                    const TexelDraw& draw = tap.draw[0];
                    for (int lane = 0; lane < kWaveLanes; ++lane) {
                        if ((tap.lanes >> lane & 1) == 0) continue;
                        const size_t cell =
                            taps.cell((draw.border >> lane & 1) != 0, draw.level[lane], draw.slice[lane], draw.x[lane], draw.y[lane]);
                        ++picks.side[absolute ? tap.weight[lane] < 0 : side][cell];
                    }
                    ++side;
                });
            }
        }
    }
    return picks;
}

struct Judgement {
    double deviate;   ///< of chi-square, as a normal deviate (Wilson and Hilferty 1931)
    uint32_t strays;  ///< picks of what weighs nothing
};

/// Cells of few draws are joined; what is missing of kDraws, draws without a negative texel, is a cell too.
Judgement judge(const Picks<double>& expected, const Picks<uint32_t>& drawn, std::vector<int> sides) {
    double statistic = 0, joined_expected = 0, joined_drawn = 0, rest_expected = kDraws, rest_drawn = kDraws;
    int cells = 0;
    uint32_t strays = 0;
    const auto add = [&](double wanted, double found) {
        statistic += (found - wanted) * (found - wanted) / wanted;
        ++cells;
    };
    for (const int side : sides) {
        for (size_t cell = 0; cell < expected.side[side].size(); ++cell) {
            const double wanted = expected.side[side][cell] * kDraws, found = drawn.side[side][cell];
            if (wanted == 0) strays += drawn.side[side][cell];
            if (wanted >= 20) {
                add(wanted, found);
            } else {
                joined_expected += wanted, joined_drawn += found;
            }
            rest_expected -= wanted, rest_drawn -= found;
        }
    }
    if (joined_expected > 5) add(joined_expected, joined_drawn);
    if (rest_expected > 20) add(rest_expected, rest_drawn);
    const double freedom = std::max(cells - 1, 1), share = 2 / (9 * freedom);
    return {(std::cbrt(statistic / freedom) - (1 - share)) / std::sqrt(share), strays};
}

/// Runs cases and keeps the worst.
class Matrix {
  public:
    void run(const PlacedLookup& lookup, Noise noise, const std::string& what) {
        const SamplerState& sampler = lookup.sampler;
        GroupedTaps taps(*lookup.texture);
        lookup.listen(taps);
        const Picks<double> expected = expected_picks(taps, sampler);
        const Picks<uint32_t> drawn = drawn_picks(lookup, taps, noise, uint32_t(cases_));
        const bool absolute = sampler.estimator == Estimator::AbsWeight;
        for (const std::vector<int>& sides : absolute ? std::vector<std::vector<int>>{{0, 1}} : std::vector<std::vector<int>>{{0}, {1}}) {
            const auto [deviate, strays] = judge(expected, drawn, sides);
            const auto name = [&] {
                return to_string(sampler.minify) + ' ' + std::string(to_string(sampler.estimator)) + ' ' + std::string(to_string(noise)) +
                       ' ' + what + (sides[0] == 1 ? ", negative weights" : "");
            };
            EXPECT_LT(deviate, kBound) << name();
            // Offsets and weights round apart: a number within rounding of the last step may jitter to a texel that weighs nothing. Those
            // of ellipses know no cut.
            const uint32_t allowed = sampler.estimator != Estimator::Jitter ? 0 : sampler.ellipse > 0 ? 30 : 3;
            EXPECT_LE(strays, allowed) << name();
            if (deviate > worst_) worst_ = deviate, worst_name_ = name();
        }
        ++cases_;
    }
    ~Matrix() {
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start_;
        std::printf("%d cases of %.0f draws, largest deviate %.2f (%s), %.1f million draws a second\n", cases_, kDraws, worst_,
                    worst_name_.c_str(), cases_ * kDraws / 1e6 / seconds.count());
        tell_tested(uint64_t(cases_ * kDraws), "draws");
        tell_worst_case("largest_deviate", std::to_string(worst_) + " of " + worst_name_);
    }
    int cases() const { return cases_; }

  private:
    int cases_ = 0;
    double worst_ = -100;
    std::string worst_name_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Those that draw the kernel; abs-weight where it is another than reservoir.
std::vector<Estimator> estimators_of(const Kernel& kernel) {
    std::vector<Estimator> estimators{Estimator::Reservoir};
    if (refusal(Estimator::Jitter, kernel).empty()) estimators.push_back(Estimator::Jitter);
    if (!weighs_as_probability(kernel)) estimators.push_back(Estimator::AbsWeight);
    return estimators;
}

struct Levels {
    const char* name;
    MipMode mip;
    int probes;
};
constexpr Levels kLevels[] = {
    {"none", MipMode::None, 1}, {"nearest", MipMode::Nearest, 1}, {"linear", MipMode::Linear, 1}, {"six probes", MipMode::Linear, 6}};

/// All cases under stress; else every other combination, and the noises take turns.
bool takes(int turn, Noise noise) {
    if (stress_scale() > 1) return true;
    return (turn + turn / 4) % 2 == 0 && kNoises[size_t(turn) % std::size(kNoises)] == noise;
}

TEST(DrawMatrix, PicksTexelsByTheirWeights) {
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, 48, 20));
    std::mt19937 random(31);
    std::uniform_real_distribution<float> unit(-1, 1);
    Matrix matrix;
    int turn = 0;
    for (const Kernel& kernel : kKernels) {
        for (const Estimator estimator : estimators_of(kernel)) {
            for (const Wrap wrap : kWraps) {
                for (const Levels& levels : kLevels) {
                    PlacedLookup lookup{.texture = &texture, .sampler = {.magnify = kernel, .minify = kernel, .mip = levels.mip}};
                    SamplerState& sampler = lookup.sampler;
                    sampler.estimator = estimator;
                    sampler.wrap_s = wrap, sampler.wrap_t = kWraps[size_t(turn) / 5 % 5];
                    sampler.probes = levels.probes;
                    if (levels.probes > 1 && turn % 2 == 0) sampler.probe_variance = 0.2f;
                    // Near an edge, minified.
                    lookup.at =
                        everywhere({0.06f * unit(random) + float(turn % 3), 0.1f * unit(random) - float(turn % 2),
                                    0.03f + 0.03f * unit(random), 0.09f * unit(random), 0.01f * unit(random), 0.05f * unit(random)});
                    for (const Noise noise : kNoises)
                        if (takes(turn, noise)) matrix.run(lookup, noise, std::string(to_string(wrap)) + ' ' + levels.name);
                    ++turn;
                }
            }
        }
    }
    EXPECT_GE(matrix.cases(), 240);
}

/// Layers of arrays, volumes, and cube maps beside edges and corners, with white noise.
TEST(DrawMatrix, PicksTexelsOfEveryShapeByTheirWeights) {
    const Shape shapes[] = {{.width = 20, .height = 12, .layers = 3, .levels = 3},
                            {.width = 12, .height = 10, .depth = 9, .levels = 3},
                            {.width = 8, .height = 8, .layers = 12, .levels = 3, .cube = true}};
    std::mt19937 random(32);
    std::uniform_real_distribution<float> unit(-1, 1);
    Matrix matrix;
    int turn = 0;
    for (const Shape& shape : shapes) {
        Texture texture("hashed", std::make_unique<HashedSource>(Format::RGBA8Unorm, shape));
        for (const Kernel& kernel : kKernels) {
            for (const Estimator estimator : estimators_of(kernel)) {
                // Elsewhere than under stress, levels take turns.
                const bool all = stress_scale() > 1;
                const size_t first = all ? 0 : size_t(turn) % 3, step = all ? 1 : 3;
                for (size_t level = first; level < 3; level += step) {
                    PlacedLookup lookup{.texture = &texture, .sampler = {.magnify = kernel, .minify = kernel, .mip = kLevels[level].mip}};
                    SamplerState& sampler = lookup.sampler;
                    sampler.estimator = estimator;
                    sampler.wrap_s = kWraps[turn % 5], sampler.wrap_t = kWraps[turn / 2 % 5], sampler.wrap_r = kWraps[turn / 3 % 5];
                    lookup.at = everywhere({0.1f * unit(random), 0.2f * unit(random), 0.1f + 0.03f * unit(random), 0, 0, 0.1f});
                    // In turn towards a corner, an edge and a face, of a volume's outside as of a cube.
                    const float place[3] = {1, turn % 3 == 2 ? 0.3f : 0.98f, turn % 3 == 0 ? -0.95f : 0.4f};
                    for (int axis = 0; axis < 3; ++axis) {
                        const float change = (shape.cube ? 0.3f : 0.1f) * unit(random);
                        for (int lane = 0; lane < kWaveLanes; ++lane) {
                            lookup.solid.position[axis][lane] = place[(axis + turn) % 3];
                            lookup.solid.dx[axis][lane] = change;
                        }
                    }
                    std::fill_n(lookup.layer.lane, kWaveLanes, 1.0f);
                    matrix.run(lookup, Noise::White,
                               (shape.cube        ? "cube map, "
                                : shape.depth > 1 ? "volume, "
                                                  : "array, ") +
                                   std::string(kLevels[level].name) + ", turn " + std::to_string(turn));
                    ++turn;
                }
            }
        }
    }
    EXPECT_GE(matrix.cases(), 60);
}

/// Ellipses, weighed as a stream or jittered: kernels and levels do not enter.
TEST(DrawMatrix, PicksTexelsOfEllipsesByTheirWeights) {
    Texture texture("hashed", make_hashed_pyramid(Format::RGBA8Unorm, 48, 20));
    Matrix matrix;
    int turn = 0;
    for (const Estimator estimator : {Estimator::Reservoir, Estimator::Jitter}) {
        for (const Wrap wrap : kWraps) {
            PlacedLookup lookup{.texture = &texture, .sampler = {.ellipse = 1.0f / 6}};
            lookup.sampler.estimator = estimator;
            lookup.sampler.wrap_s = wrap;
            lookup.at = everywhere({0.98f, 0.31f, 0.05f, 0.02f, -0.01f, 0.03f});
            for (const Noise noise : kNoises)
                if (stress_scale() > 1 || (takes(turn, noise) && turn % 5 < 2)) matrix.run(lookup, noise, std::string(to_string(wrap)));
            ++turn;
        }
    }
    EXPECT_GE(matrix.cases(), 2);
}

}  // namespace
}  // namespace rawtexel::texunit
