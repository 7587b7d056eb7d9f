// Holding one result against the double-precision reference: within the promised bound, or on the other side of a decision that is close.
#pragma once

#include "texunit/sampler.h"
#include "texunit/wave.h"

#include "tests/reference/texunit/sampler_reference.h"
#include "tests/stress/worst_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

namespace rawtexel::texunit {

struct Tally {
    uint64_t lookups = 0, other_decisions = 0;
    double worst = 0;  ///< in units of the bound
    std::string worst_case;

    /// At the end of a test.
    void tell() const {
        tell_tested(lookups, "lookups");
        tell_worst_case("worst_in_bounds", std::to_string(worst) + " of the bound: " + worst_case);
        tell_worst_case("other_decisions", other_decisions);
    }
};

using LaneColour = std::array<float, 4>;

inline LaneColour lane_of(const WaveColor& colour, int i) {
    return {colour.channel[0][i], colour.channel[1][i], colour.channel[2][i], colour.channel[3][i]};
}

/// How far `colour` is from what the reference allows, in units of the bound (texunit/sample.h): at most 1 passes.
inline double excess(const reference::Sample& expected, bool within_taps, const LaneColour& colour) {
    // Kernels whose weights are large are promised no more than the rounding of their terms.
    const double scale = expected.largest * std::max(1.0, expected.magnitude / 3);
    const double bound = (expected.taps + 8) * 0x1p-24 * scale + (expected.mixes_levels ? 0x1p-20 * scale : 0);
    double worst = 0;
    for (size_t c = 0; c < 4; ++c) {
        const double error = std::abs(double(colour[c]) - expected.colour[c]);
        if (!(error <= bound)) return bound > 0 ? std::max(1.001, error / bound) : std::numeric_limits<double>::infinity();
        if (bound > 0) worst = std::max(worst, error / bound);
        if (within_taps && (colour[c] < expected.least[c] || colour[c] > expected.most[c])) return std::numeric_limits<double>::infinity();
    }
    return worst;
}

inline bool is_narrow_kernel(const Kernel& kernel) { return kernel == Kernel::Nearest || kernel == Kernel::Bilinear; }

/// `ask(shift)` is the reference. Thresholds are moved by at most 2^-20.
template <class Ask>
void judge(const Ask& ask, const SamplerState& sampler, const LaneColour& colour, const std::string& what, Tally& tally) {
    const bool within_taps = is_narrow_kernel(sampler.magnify) && is_narrow_kernel(sampler.minify);
    const reference::Sample expected = ask(reference::Shift{});
    double unit = excess(expected, within_taps, colour);
    if (unit > 1) {
        ++tally.other_decisions;
        const bool picks = sampler.precision == Precision::Gpu || axis_taps(sampler.magnify) == 1 || axis_taps(sampler.minify) == 1;
        // One, or both, of two axes at a time.
        const auto steps = [](int n) { return std::array<double, 2>{(n % 3 - 1) * 0x1p-20, (n / 3 - 1) * 0x1p-20}; };
        constexpr int kUnmoved = 4;
        for (const double lambda : {-0x1p-20, 0.0, 0x1p-20}) {
            for (int n = 0; n < 9; ++n) {
                unit = std::min(unit, excess(ask(reference::Shift{.lambda = lambda, .cut = steps(n)}), within_taps, colour));
                if (!picks || n == kUnmoved) continue;
                unit = std::min(unit, excess(ask(reference::Shift{.lambda = lambda, .texel = steps(n)}), within_taps, colour));
            }
        }
    }
    ++tally.lookups;
    if (unit > tally.worst) {
        tally.worst = unit;
        tally.worst_case = what;
    }
    ASSERT_LE(unit, 1) << what << "\n lambda " << expected.lambda << " taps " << expected.taps << " expected " << expected.colour[0] << ' '
                       << expected.colour[1] << ' ' << expected.colour[2] << ' ' << expected.colour[3] << "\n found " << colour[0] << ' '
                       << colour[1] << ' ' << colour[2] << ' ' << colour[3] << "\n between " << expected.least[0] << " and "
                       << expected.most[0] << ", largest " << expected.largest;
}

inline bool same_bits(const WaveColor& a, const WaveColor& b) {
    for (int c = 0; c < 4; ++c) {
        for (int i = 0; i < kWaveLanes; ++i) {
            if (std::bit_cast<uint32_t>(a.channel[c][i]) != std::bit_cast<uint32_t>(b.channel[c][i])) return false;
        }
    }
    return true;
}

}  // namespace rawtexel::texunit
