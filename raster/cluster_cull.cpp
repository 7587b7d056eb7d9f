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
    : sample_box_(grid.sample_box()), front_is_clockwise_(draw.front_is_clockwise) {
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
    before_near_ = combine(1, w_, -1, z_);

    // The generalised cross product of the three rows: for the corners p of a triangle, det(x, y, w) = (p1-p0)x(p2-p0) . (eye_w*p0 - eye).
    const glm::dvec3 &a = x_.slope, &b = y_.slope, &c = w_.slope;
    const double p = x_.constant, q = y_.constant, r = w_.constant;
    eye_w_ = glm::dot(a, glm::cross(b, c));
    eye_ = -(p * glm::cross(b, c) + q * glm::cross(c, a) + r * glm::cross(a, b));
    x_length_ = glm::length(a);
    y_length_ = glm::length(b);
    w_length_ = glm::length(c);
    eye_length_ = glm::length(eye_);
}

ClusterCull::Range ClusterCull::range_over(const Form& form, const Box& box) {
    const glm::dvec3 steep = glm::abs(form.slope);
    const double value = glm::dot(form.slope, box.middle) + form.constant;
    const double radius = glm::dot(steep, box.half);
    const double slack = kRounding * (glm::dot(steep, glm::abs(box.middle)) + radius + std::abs(form.constant));
    return {value - radius - slack, value + radius + slack};
}

SampleBox ClusterCull::box_over(const Range& x, const Range& y, const Range& w) {
    // A whole unit of 1/256 pixel covers snapping and the rounding here. What lies beyond the guard band is as good as on its border.
    constexpr double limit = 2.0 * kGuardBand * kSubpixelOne;
    // In this order of arguments what is not a number takes the far end.
    const auto low = [&](double v) {
        return int64_t(std::floor(std::min(limit, std::max(-limit, v / (v < 0 ? w.low : w.high) * kSubpixelOne)))) - 1;
    };
    const auto high = [&](double v) {
        return int64_t(std::ceil(std::max(-limit, std::min(limit, v / (v < 0 ? w.high : w.low) * kSubpixelOne)))) + 1;
    };
    return {2 * low(x.low), 2 * high(x.high), 2 * low(y.low), 2 * high(y.high)};
}

bool ClusterCull::outside_samples(const Box& box) const {
    return std::any_of(beyond_samples_.begin(), beyond_samples_.end(), [&](const Form& f) { return range_over(f, box).low > 0; });
}

ClusterView ClusterCull::view(const Cluster& cluster, bool back_faces_matter) const {
    ClusterView view;
    if (!cluster.finite) return view;
    const glm::dvec3 lower = cluster.lower, upper = cluster.upper;
    const Box box{0.5 * (lower + upper), 0.5 * (upper - lower)};
    const Range z = range_over(z_, box), w = range_over(w_, box), before_near = range_over(before_near_, box);
    view.outside = before_near.high < 0 || z.high < 0 || w.high < 0;
    if (view.outside) return view;
    if (!(before_near.low >= 0 && z.low >= 0 && w.low > double(std::numeric_limits<float>::min()))) {
        view.outside = outside_samples(box);
        return view;
    }
    const Range x = range_over(x_, box), y = range_over(y_, box);
    view.nearest = float(std::clamp(z.high / w.low * (1 + kRounding), 0.0, 1.0)) * (1 + 0x1p-22f);
    view.box = box_over(x, y, w);
    constexpr int64_t guard = int64_t{kGuardBand} * kSampleOne;
    const auto within = [&](const SampleBox& outer) {
        return outer.x_min <= view.box.x_min && view.box.x_max <= outer.x_max && outer.y_min <= view.box.y_min &&
               view.box.y_max <= outer.y_max;
    };
    view.outside = !within(sample_box_) && outside_samples(box);
    view.unclipped = within({-guard, guard, -guard, guard});
    view.facing_away = back_faces_matter && view.unclipped && !view.outside && faces_away(cluster, box, x, y, w);
    return view;
}

bool ClusterCull::faces_away(const Cluster& cluster, const Box& box, const Range& x, const Range& y, const Range& w) const {
    if (!(cluster.cone_cosine > 0.0f)) return false;
    const glm::dvec3 along = eye_w_ * box.middle - eye_, axis = cluster.cone_axis;
    // A positive determinant turns clockwise on the screen, y down.
    const double across_axis = glm::dot(axis, along) / glm::length(axis);
    if ((across_axis > 0) == front_is_clockwise_) return false;

    // Least of |det|/(2*area) over all normals of the cone and all places in the box.
    const double cosine = double(cluster.cone_cosine), sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
    const double aside = std::sqrt(std::max(glm::dot(along, along) - across_axis * across_axis, 0.0)), radius = glm::length(box.half);
    const double least = std::abs(across_axis) * cosine - aside * sine - std::abs(eye_w_) * radius -
                         1e-9 * (std::abs(eye_w_) * (glm::length(box.middle) + radius) + eye_length_);
    if (!(least > 0.0)) return false;

    // The inscribed circle on the screen: doubled area = det/(w0*w1*w2), edges at most the projection's greatest stretch longer.
    const double screen_x = std::max(std::abs(x.low), std::abs(x.high)) / w.low,
                 screen_y = std::max(std::abs(y.low), std::abs(y.high)) / w.low;
    const double stretch = (x_length_ + y_length_ + (screen_x + screen_y) * w_length_) / w.low;
    return double(cluster.least_inradius) * least > kTurningRadius * (w.high * w.high * w.high * stretch);
}

}  // namespace rawtexel::raster
