#include "texunit/colour_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rawtexel::texunit {
namespace {

/// Boxes looked at in one family before it counts as searched, and in all families of a colour. Wrong colours need a handful; right ones
/// are found by descent, for which each family has a box in any case.
constexpr int kMostBoxes = 4096, kMostBoxesInAll = 1 << 16;

Colour colour_in(const ColourPatch& patch, const double* place) {
    const auto bilinear = [&](const Colour* corner, size_t c) {
        const double upper = corner[0][c] + place[0] * (corner[1][c] - corner[0][c]);
        const double lower = corner[2][c] + place[0] * (corner[3][c] - corner[2][c]);
        return upper + place[1] * (lower - upper);
    };
    Colour colour;
    for (size_t c = 0; c < 4; ++c) {
        colour[c] = bilinear(patch.corner.data(), c);
        if (patch.sides == 3) colour[c] += place[2] * (bilinear(patch.corner.data() + 4, c) - colour[c]);
    }
    return colour;
}

/// Solves the symmetric positive definite n*n system a*x = b in place: Gauss without pivots. x is left in b.
template <size_t size>
void solve(std::array<std::array<double, size>, size>& a, std::array<double, size>& b, size_t n) {
    for (size_t i = 0; i < n; ++i) {
        for (size_t row = i + 1; row < n; ++row) {
            const double factor = a[row][i] / a[i][i];
            for (size_t column = i; column < n; ++column) a[row][column] -= factor * a[i][column];
            b[row] -= factor * b[i];
        }
    }
    for (size_t i = n; i-- > 0;) {
        for (size_t column = i + 1; column < n; ++column) b[i] -= a[i][column] * b[column];
        b[i] /= a[i][i];
    }
}

}  // namespace

ColourSearch::ColourSearch(const Colour& wanted, double threshold)
    : wanted_(wanted), threshold_(threshold), boxes_left_in_all_(kMostBoxesInAll), excess_(std::numeric_limits<double>::infinity()) {
    least_.fill(std::numeric_limits<double>::infinity());
    most_.fill(-std::numeric_limits<double>::infinity());
}

void ColourSearch::visit(const ColourPatch& patch) {
    bend_ = patch.bend;
    if (!can_improve(patch.least, patch.most)) return;
    finer_ = &patch;
    coarser_ = nullptr;
    sides_ = patch.sides;
    Box box{};
    std::fill_n(box.begin(), sides_, Range{0, 1});
    search_family(box);
}

void ColourSearch::visit(const ColourPatch& finer, const ColourPatch& coarser, Range share, Effort effort) {
    bend_ = std::max(finer.bend, coarser.bend);
    Colour low, high;
    for (size_t c = 0; c < 4; ++c) {
        const auto mixed = [&](const Colour& a, const Colour& b, double s) { return a[c] + s * (b[c] - a[c]); };
        low[c] = std::min(mixed(finer.least, coarser.least, share.low), mixed(finer.least, coarser.least, share.high));
        high[c] = std::max(mixed(finer.most, coarser.most, share.low), mixed(finer.most, coarser.most, share.high));
    }
    if (!can_improve(low, high)) return;
    finer_ = &finer;
    coarser_ = &coarser;
    sides_ = 2 * finer.sides + 1;
    Box box{};
    std::fill_n(box.begin(), sides_ - 1, Range{0, 1});
    box[sides_ - 1] = share;
    if (effort == Effort::Whole) return search_family(box);
    Place middle{};
    for (size_t side = 0; side < sides_; ++side) middle[side] = (box[side].low + box[side].high) / 2;
    descend(box, middle);
}

void ColourPatch::find_bounds() {
    least = most = corner[0];
    for (size_t n = 1; n < corners(); ++n) {
        for (size_t c = 0; c < 4; ++c) least[c] = std::min(least[c], corner[n][c]), most[c] = std::max(most[c], corner[n][c]);
    }
}

/// Takes note of a family's bounds; false where nothing within them is closer than what has been found.
bool ColourSearch::can_improve(const Colour& least, const Colour& most) {
    double outside = 0;
    for (size_t c = 0; c < 4; ++c) {
        least_[c] = std::min(least_[c], least[c]), most_[c] = std::max(most_[c], most[c]);
        outside = std::max({outside, least[c] - wanted_[c], wanted_[c] - most[c]});
    }
    return excess_ > 1 && outside < excess_ * threshold_ + bend_;
}

Colour ColourSearch::colour_at(const Place& place) const {
    Colour colour = colour_in(*finer_, place.data());
    if (coarser_ == nullptr) return colour;
    const Colour second = colour_in(*coarser_, place.data() + finer_->sides);
    for (size_t c = 0; c < 4; ++c) colour[c] += place[sides_ - 1] * (second[c] - colour[c]);
    return colour;
}

/// Notes a colour and returns how far it is, in thresholds.
double ColourSearch::measure(const Colour& colour) {
    double farthest = 0;
    for (size_t c = 0; c < 4; ++c) farthest = std::max(farthest, std::abs(colour[c] - wanted_[c]));
    const double excess = farthest <= bend_ ? 0 : (farthest - bend_) / threshold_;
    if (excess < excess_) {
        excess_ = excess;
        closest_ = colour;
    }
    return excess;
}

void ColourSearch::search_family(const Box& box) {
    const int boxes = std::clamp(boxes_left_in_all_, 2, kMostBoxes);
    boxes_left_ = boxes;
    search(box);
    boxes_left_in_all_ -= boxes - boxes_left_;
}

/// Branch and bound: a multilinear function over a box lies between its values at the corners, so that most boxes are ruled out whole.
void ColourSearch::search(const Box& box) {
    std::array<Colour, size_t{1} << kMostSides> colours;
    Colour least, most;
    const size_t corners = size_t{1} << sides_;
    for (size_t n = 0; n < corners; ++n) {
        Place place{};
        for (size_t side = 0; side < sides_; ++side) place[side] = (n >> side & 1) != 0 ? box[side].high : box[side].low;
        colours[n] = colour_at(place);
        measure(colours[n]);
        for (size_t c = 0; c < 4; ++c) {
            least[c] = n == 0 ? colours[n][c] : std::min(least[c], colours[n][c]);
            most[c] = n == 0 ? colours[n][c] : std::max(most[c], colours[n][c]);
        }
    }
    if (excess_ <= 1) return;

    bool reachable = true;
    double spread = 0;
    for (size_t c = 0; c < 4; ++c) {
        const double near = threshold_ + bend_;
        reachable = reachable && least[c] - near <= wanted_[c] && wanted_[c] <= most[c] + near;
        spread = std::max(spread, most[c] - least[c]);
    }
    // Corners this close together leave nothing to find between them.
    if (!reachable || spread <= threshold_ * 1e-3 || --boxes_left_ <= 0) return;
    Place middle{};
    for (size_t side = 0; side < sides_; ++side) middle[side] = (box[side].low + box[side].high) / 2;
    descend(box, middle);
    if (excess_ <= 1) return;

    // Halve the side along which colours change most.
    size_t widest = 0;
    double most_change = -1;
    for (size_t side = 0; side < sides_; ++side) {
        double change = 0;
        for (size_t n = 0; n < corners; ++n) {
            if ((n >> side & 1) != 0) continue;
            for (size_t c = 0; c < 4; ++c) change = std::max(change, std::abs(colours[n][c] - colours[n | size_t{1} << side][c]));
        }
        if (change > most_change) most_change = change, widest = side;
    }
    Box lower = box, upper = box;
    lower[widest].high = upper[widest].low = middle[widest];
    search(lower);
    if (excess_ > 1) search(upper);
}

/// Change of the colour along each side.
std::array<Colour, ColourSearch::kMostSides> ColourSearch::slopes(const Place& place) const {
    std::array<Colour, kMostSides> slopes{};
    for (size_t side = 0; side < sides_; ++side) {
        // Linear along each side by itself, and defined beyond the ends.
        Place low = place, high = place;
        low[side] = 0, high[side] = 1;
        const Colour from = colour_at(low), to = colour_at(high);
        for (size_t c = 0; c < 4; ++c) slopes[side][c] = to[c] - from[c];
    }
    return slopes;
}

/// Levenberg and Marquardt's steps towards the wanted colour, kept inside the box: finds it quickly where it is there to be found.
void ColourSearch::descend(const Box& box, Place place) {
    constexpr int kMostSteps = 12;
    for (int step = 0; step < kMostSteps; ++step) {
        const Colour here = colour_at(place);
        if (measure(here) <= 1) return;
        const auto slope = slopes(place);
        // Sides on a wall that the gradient pushes against stay.
        std::array<size_t, kMostSides> free_sides;
        size_t count = 0;
        for (size_t side = 0; side < sides_; ++side) {
            double pull = 0;
            for (size_t c = 0; c < 4; ++c) pull += slope[side][c] * (wanted_[c] - here[c]);
            const bool stuck = (place[side] <= box[side].low && pull < 0) || (place[side] >= box[side].high && pull > 0);
            if (!stuck && pull != 0) free_sides[count++] = side;
        }
        if (count == 0) return;

        std::array<std::array<double, kMostSides>, kMostSides> normal{};
        std::array<double, kMostSides> move{};
        double trace = 0;
        for (size_t i = 0; i < count; ++i) {
            for (size_t c = 0; c < 4; ++c) {
                move[i] += slope[free_sides[i]][c] * (wanted_[c] - here[c]);
                for (size_t j = 0; j < count; ++j) normal[i][j] += slope[free_sides[i]][c] * slope[free_sides[j]][c];
            }
            trace += normal[i][i];
        }
        for (size_t i = 0; i < count; ++i) normal[i][i] += 1e-9 * trace;
        solve(normal, move, count);
        for (size_t i = 0; i < count; ++i) {
            const size_t side = free_sides[i];
            place[side] = std::clamp(place[side] + move[i], box[side].low, box[side].high);
        }
    }
}

}  // namespace rawtexel::texunit
