// Which texels draws pick, how often, and how that compares with the weights of a lookup.
#pragma once

#include "texunit/draw.h"
#include "texunit/lookup_trace.h"

#include <cmath>
#include <map>
#include <tuple>

namespace rawtexel::texunit {

/// level, slice, x, y; a border is level -1.
using Place = std::tuple<int, int, int, int>;

inline WaveCoordinates everywhere(const LaneCoordinates& at) {
    WaveCoordinates wave;
    for (int lane = 0; lane < kWaveLanes; ++lane) {
        wave.u[lane] = at.u, wave.v[lane] = at.v;
        wave.dudx[lane] = at.dudx, wave.dvdx[lane] = at.dvdx, wave.dudy[lane] = at.dudy, wave.dvdy[lane] = at.dvdy;
    }
    return wave;
}

inline Place place_of(const TexelDraw& draw, int lane) {
    if ((draw.border >> lane & 1) != 0) return {-1, 0, 0, 0};
    return {draw.level[lane], draw.slice[lane], draw.x[lane], draw.y[lane]};
}

/// Chi-square against the weights of the deterministic lookup, as a normal deviate (Wilson and Hilferty 1931); cells of few draws are
/// joined.
inline double chi_square_deviate(const std::map<Place, double>& weights, const std::map<Place, double>& drawn, double draws) {
    double statistic = 0, joined_expected = 0, joined_drawn = 0;
    int cells = 0;
    const auto add = [&](double expected, double found) {
        statistic += (found - expected) * (found - expected) / expected;
        ++cells;
    };
    for (const auto& [place, weight] : weights) {
        const auto found = drawn.find(place);
        const double count = found == drawn.end() ? 0 : found->second;
        if (weight * draws < 20) {
            joined_expected += weight * draws, joined_drawn += count;
        } else {
            add(weight * draws, count);
        }
    }
    if (joined_expected > 5) add(joined_expected, joined_drawn);
    const double freedom = std::max(cells - 1, 1), share = 2 / (9 * freedom);
    return (std::cbrt(statistic / freedom) - (1 - share)) / std::sqrt(share);
}

inline Place place_of(const TracedTap& tap) { return tap.border ? Place{-1, 0, 0, 0} : Place{tap.level, tap.slice, tap.x, tap.y}; }

/// Weights of the deterministic lookup by place: wraps may name a texel more than once.
inline std::map<Place, double> weights_of(const LookupTrace& trace) {
    std::map<Place, double> weights;
    for (const TracedTap& tap : trace.taps) weights[place_of(tap)] += tap.weight;
    return weights;
}

/// Variance of a lookup over uniform texels and phases: half the mean square difference of two that differ in their numbers alone.
/// value(at, first) is the lookup of a wave at `at` with the numbers of `first`.
template <class Value>
double variance_over_places(uint32_t waves, const Value& value) {
    double squares = 0;
    for (uint32_t n = 0; n < waves; ++n) {
        WaveCoordinates at{};
        for (uint32_t lane = 0; lane < kWaveLanes; ++lane) {
            at.u[int(lane)] = random_float({.x = lane, .y = 100, .sample = n});
            at.v[int(lane)] = random_float({.x = lane, .y = 101, .sample = n});
        }
        const WaveFloat one = value(at, RandomAddress{.sample = n}), other = value(at, RandomAddress{.y = 4, .sample = n});
        for (int lane = 0; lane < kWaveLanes; ++lane) squares += std::pow(double(one[lane] - other[lane]), 2) / 2;
    }
    return squares / (double(waves) * kWaveLanes);
}

}  // namespace rawtexel::texunit
