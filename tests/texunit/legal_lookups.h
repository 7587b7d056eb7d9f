// Our own textures, lookups and colours as the verifier takes them.
#pragma once

#include "texunit/legal_interval.h"
#include "texunit/sample.h"
#include "texunit/texture.h"

#include "tests/texunit/lookup_draw.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace rawtexel::texunit {

using JudgedColour = std::array<double, 4>;

inline JudgedTexture judged(Texture& texture) {
    return {texture.shape(), [&texture](int level, int slice, int x, int y) {
                const std::array<float, 4> value = texture.texel(level, slice, x, y);
                return JudgedColour{value[0], value[1], value[2], value[3]};
            }};
}

inline JudgedLookup judged(const reference::Lookup& at, double layer = 0) {
    return {{at.u, at.v, 0}, {at.dudx, at.dvdx, 0}, {at.dudy, at.dvdy, 0}, layer};
}

inline JudgedLookup judged(const reference::Lookup3& at, double layer = 0) {
    const auto wide = [](const std::array<float, 3>& v) { return std::array<double, 3>{v[0], v[1], v[2]}; };
    return {wide(at.position), wide(at.dx), wide(at.dy), layer};
}

inline JudgedColour colour_of(const WaveColor& colour, int i) {
    return {colour.channel[0][i], colour.channel[1][i], colour.channel[2][i], colour.channel[3][i]};
}

/// Of lookups with a mistake, those refused, by their likely cause.
struct Refusals {
    int asked = 0, refused = 0;
    std::map<std::string, int> causes;

    /// Looks for the causes of the first twelve alone: each takes many verdicts.
    void count(const JudgedTexture& texture, const SamplerState& sampler, const JudgedLookup& lookup, const JudgedColour& colour,
               const LegalPrecision& precision) {
        ++asked;
        if (judge_lookup(texture, sampler, lookup, colour, precision).legal) return;
        if (++refused <= 12) ++causes[likely_cause(texture, sampler, lookup, colour, precision)];
    }
    std::string all_causes() const {
        std::string all;
        for (const auto& [name, count] : causes) all += " '" + name + "' " + std::to_string(count);
        return all;
    }
    /// How many have this cause, expecting some, and a share of `least` to be refused.
    int expect(double least, const std::string& cause) const {
        EXPECT_GE(refused, least * asked) << cause << ": " << refused << " of " << asked;
        const auto named = causes.find(cause);
        EXPECT_NE(named, causes.end()) << "not named as '" << cause << "':" << all_causes();
        return named == causes.end() ? 0 : named->second;
    }
};

/// The precision we promise ourselves: nothing but the 8 fractional bits, and what float arithmetic and 8-bit texels need.
inline constexpr LegalPrecision kOurs{.coordinate_bits = 23, .derivative_bits = 20, .approximate_scale = false, .colour_threshold = 4e-6};

/// Lookups at ordinary places: half of them on the texture, others a few repeats away, from magnified to the coarsest level.
inline reference::Lookup ordinary_lookup(LookupDraw& draw, int width, int height, int levels) {
    const float reach = draw.below(2) == 0 ? 0.5f : 2.0f;
    const float scale = std::exp2(draw.uniform(-1, float(levels)));
    const auto change = [&](int extent) { return draw.uniform(-1, 1) * scale / float(extent); };
    return {0.5f + draw.uniform(-reach, reach),
            0.5f + draw.uniform(-reach, reach),
            change(width),
            change(height),
            change(width),
            change(height)};
}

/// Kernels whose weights and slopes are moderate, and whose taps are few.
inline bool is_ordinary(const Kernel& kernel) { return axis_taps(kernel) <= 6 && std::abs(kernel.b) < 5 && kernel.b != kLeastSigma; }

}  // namespace rawtexel::texunit
