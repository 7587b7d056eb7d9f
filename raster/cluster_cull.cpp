#include "raster/cluster_cull.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rawtexel::raster {

namespace {

// Relative to the magnitude of a form's terms: thousands of times what a handful of roundings in double come to.
constexpr double kRounding = 1e-12;

// Snapping moves a vertex by at most half of 1/256 pixel along each axis. A triangle can turn over only if its narrowest height is at most
// twice the distance sqrt(2)/512; the height is more than twice the radius of its inscribed circle. Twice that again.
constexpr double kTurningRadius = 2 * 1.4142135623730951 / (2 * kSubpixelOne);

}  // namespace

ClusterCull::Form ClusterCull::combine(double p, const Form& f, double q, const Form& g) {
    return {p * f.slope + q * g.slope, p * f.constant + q * g.constant};
}

ClusterCull::ClusterCull(const Draw& draw, const FrameOptions& options, const TileGrid& grid)
    : front_is_clockwise_(draw.front_is_clockwise) {
    const auto row = [&](int r) {
        const glm::mat4& m = draw.clip_from_object;
        return Form{{m[0][r], m[1][r], m[2][r]}, m[3][r]};
    };
    const Form x = row(0), y = row(1);
    z_ = row(2);
    w_ = row(3);
    x_ = combine(0.5 * options.width, w_, 0.5 * options.width, x);
    y_ = combine(0.5 * options.height, w_, -0.5 * options.height, y);

    // Positive where a vertex lies beside every sample point, as TriangleSetup::outside_samples has it.
    constexpr double slack = 1.0 / kSubpixelOne;
    const SampleBox& box = grid.sample_box();
    beyond_samples_ = {
        combine(double(box.x_min) / kSampleOne - slack, w_, -1, x_), combine(1, x_, -double(box.x_max) / kSampleOne - slack, w_),
        combine(double(box.y_min) / kSampleOne - slack, w_, -1, y_), combine(1, y_, -double(box.y_max) / kSampleOne - slack, w_)};
    guard_ = {combine(kGuardBand, w_, 1, x_), combine(kGuardBand, w_, -1, x_), combine(kGuardBand, w_, 1, y_),
              combine(kGuardBand, w_, -1, y_)};

    // The generalised cross product of the three rows: for the corners p of a triangle, det(x, y, w) = (p1-p0)x(p2-p0) . (eye_w*p0 - eye).
    const glm::dvec3 &a = x_.slope, &b = y_.slope, &c = w_.slope;
    const double p = x_.constant, q = y_.constant, r = w_.constant;
    eye_w_ = glm::dot(a, glm::cross(b, c));
    eye_ = -(p * glm::cross(b, c) + q * glm::cross(c, a) + r * glm::cross(a, b));
}

ClusterCull::Range ClusterCull::range_over(const Form& form, const Cluster& cluster) {
    double low = form.constant, high = form.constant, magnitude = std::abs(form.constant);
    for (int i = 0; i < 3; ++i) {
        const double at_lower = form.slope[i] * double(cluster.lower[i]), at_upper = form.slope[i] * double(cluster.upper[i]);
        low += std::min(at_lower, at_upper);
        high += std::max(at_lower, at_upper);
        magnitude += std::max(std::abs(at_lower), std::abs(at_upper));
    }
    return {low - kRounding * magnitude, high + kRounding * magnitude};
}

ClusterView ClusterCull::view(const Cluster& cluster) const {
    ClusterView view;
    if (!cluster.finite) return view;
    const Range z = range_over(z_, cluster), w = range_over(w_, cluster), before_near = range_over(combine(1, w_, -1, z_), cluster);
    view.outside =
        before_near.high < 0 || z.high < 0 || w.high < 0 ||
        std::any_of(beyond_samples_.begin(), beyond_samples_.end(), [&](const Form& f) { return range_over(f, cluster).low > 0; });
    if (view.outside) return view;
    view.unclipped = before_near.low >= 0 && z.low >= 0 && w.low > std::numeric_limits<float>::min() &&
                     std::all_of(guard_.begin(), guard_.end(), [&](const Form& f) { return range_over(f, cluster).low >= 0; });
    if (w.low > 0) view.nearest = float(std::clamp(z.high / w.low * (1 + kRounding), 0.0, 1.0)) * (1 + 0x1p-22f);
    if (!view.unclipped) return view;
    view.box = box_over(range_over(x_, cluster), range_over(y_, cluster), w);
    find_facing(cluster, w, view);
    return view;
}

SampleBox ClusterCull::box_over(const Range& x, const Range& y, const Range& w) {
    // A whole unit of 1/256 pixel covers snapping and the rounding here.
    const auto low = [&](double v) { return int64_t(std::floor(v / (v < 0 ? w.low : w.high) * kSubpixelOne)) - 1; };
    const auto high = [&](double v) { return int64_t(std::ceil(v / (v < 0 ? w.high : w.low) * kSubpixelOne)) + 1; };
    return {2 * low(x.low), 2 * high(x.high), 2 * low(y.low), 2 * high(y.high)};
}

void ClusterCull::find_facing(const Cluster& cluster, const Range& w, ClusterView& view) const {
    if (!(cluster.cone_cosine > 0.0f)) return;
    const double cosine = double(cluster.cone_cosine), sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
    const glm::dvec3 lower = cluster.lower, upper = cluster.upper, middle = 0.5 * (lower + upper);
    const double radius = 0.5 * glm::distance(lower, upper);
    // Least of |det|/(2*area) over all normals of the cone and all places in the box, if the axis looks that way.
    const glm::dvec3 along = eye_w_ * middle - eye_;
    const double across_axis = glm::dot(glm::normalize(glm::dvec3(cluster.cone_axis)), along);
    const double aside = std::sqrt(std::max(glm::dot(along, along) - across_axis * across_axis, 0.0));
    const double least = std::abs(across_axis) * cosine - aside * sine - std::abs(eye_w_) * radius -
                         1e-9 * (std::abs(eye_w_) * (glm::length(middle) + radius) + glm::length(eye_));
    if (!(least > 0.0)) return;

    // The inscribed circle on the screen: doubled area = det/(w0*w1*w2), edges at most the projection's greatest stretch longer.
    const Range x = range_over(x_, cluster), y = range_over(y_, cluster);
    const double screen_x = std::max(std::abs(x.low), std::abs(x.high)) / w.low,
                 screen_y = std::max(std::abs(y.low), std::abs(y.high)) / w.low;
    const double w_slope = glm::length(w_.slope);
    const double stretch = std::hypot(glm::length(x_.slope) + screen_x * w_slope, glm::length(y_.slope) + screen_y * w_slope) / w.low;
    const double inradius = double(cluster.least_inradius) * least / (w.high * w.high * w.high * stretch);
    if (!(inradius > kTurningRadius)) return;
    // A positive determinant turns clockwise on the screen, y down.
    const bool clockwise = across_axis > 0;
    (clockwise == front_is_clockwise_ ? view.facing : view.facing_away) = true;
}

}  // namespace rawtexel::raster
