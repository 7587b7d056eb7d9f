#include "texunit/colour_hull.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rawtexel::texunit {
namespace {

struct Direction {
    std::array<int, 4> sign;
    int length = 0;  ///< sum of magnitudes
};

/// The four pairs along channels first: positive at 2*c, negative at 2*c + 1.
const std::array<Direction, kHullDirections>& directions() {
    static const std::array<Direction, kHullDirections> all = [] {
        std::array<Direction, kHullDirections> made{};
        size_t count = 8;
        for (int n = 0; n < 81; ++n) {
            Direction direction{{n % 3 - 1, n / 3 % 3 - 1, n / 9 % 3 - 1, n / 27 - 1}};
            for (const int sign : direction.sign) direction.length += std::abs(sign);
            if (direction.length > 1) made[count++] = direction;
        }
        for (size_t c = 0; c < 4; ++c) {
            made[2 * c].sign[c] = 1, made[2 * c + 1].sign[c] = -1;
            made[2 * c].length = made[2 * c + 1].length = 1;
        }
        return made;
    }();
    return all;
}

double dot(const std::array<int, 4>& sign, const Colour& colour) {
    return sign[0] * colour[0] + sign[1] * colour[1] + sign[2] * colour[2] + sign[3] * colour[3];
}

}  // namespace

void ColourHull::add(double weight, std::span<const ColourPatch> patches) {
    for (size_t i = 0; i < kHullDirections; ++i) {
        double reach = -std::numeric_limits<double>::infinity();
        for (const ColourPatch& patch : patches) {
            for (size_t n = 0; n < patch.corners(); ++n)
                reach = std::max(reach, dot(directions()[i].sign, patch.corner[n]) + patch.bend * directions()[i].length);
        }
        reach_[i] += weight * reach;
    }
}

double ColourHull::excess(const ColourHull& finer, const ColourHull& coarser, Range share, const Colour& colour, double threshold) {
    const auto beyond = [&](double s) {
        double farthest = 0;
        for (size_t i = 0; i < kHullDirections; ++i) {
            const Direction& direction = directions()[i];
            const double reach = finer.reach_[i] + s * (coarser.reach_[i] - finer.reach_[i]);
            farthest = std::max(farthest, (dot(direction.sign, colour) - reach) / direction.length);
        }
        return farthest;
    };
    // The largest of linear functions is convex: thirds close in on its least value.
    constexpr int kSteps = 40;
    double low = share.low, high = share.high;
    double least = std::min(beyond(low), beyond(high));
    for (int step = 0; step < kSteps && low < high && least > 0; ++step) {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        const double at_a = beyond(a), at_b = beyond(b);
        least = std::min({least, at_a, at_b});
        (at_a < at_b ? high : low) = at_a < at_b ? b : a;
    }
    return least == 0 ? 0 : least / threshold;
}

Colour ColourHull::least() const { return {-reach_[1], -reach_[3], -reach_[5], -reach_[7]}; }
Colour ColourHull::most() const { return {reach_[0], reach_[2], reach_[4], reach_[6]}; }

}  // namespace rawtexel::texunit
