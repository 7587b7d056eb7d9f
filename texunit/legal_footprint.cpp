#include "texunit/legal_footprint.h"

#include "texunit/probe_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace rawtexel::texunit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// What exceeds a whole number of probes by less than this share of itself is none.
constexpr double kProbeRounding = 0x1p-20;

/// Smallest and largest magnitude in a range.
Range magnitude(Range r) {
    const double low = std::abs(r.low), high = std::abs(r.high);
    return {r.low <= 0 && r.high >= 0 ? 0 : std::min(low, high), std::max(low, high)};
}

using Derivative = std::array<Range, 3>;

Range length(const Derivative& d) {
    const Range s = magnitude(d[0]), t = magnitude(d[1]), r = magnitude(d[2]);
    return {std::hypot(s.low, t.low, r.low), std::hypot(s.high, t.high, r.high)};
}

/// What may pass for the length of a derivative (Vulkan "Scale Factor Operation").
Range scale_factor(const Derivative& d, const LegalPrecision& precision) {
    if (!precision.approximate_scale) return length(d);
    const Range s = magnitude(d[0]), t = magnitude(d[1]), r = magnitude(d[2]);
    return {std::max({s.low, t.low, r.low}), std::numbers::sqrt2 * (s.high + t.high + r.high)};
}

/// Factors of the isotropic level: the longer derivative's, or the largest singular value, which is at least that and at most that of the
/// magnitudes.
Range largest_scale(const SamplerState& sampler, const LegalPlace& place, const LegalPrecision& precision) {
    const Range x = scale_factor(place.dx, precision), y = scale_factor(place.dy, precision);
    if (precision.approximate_scale) {
        double sum = 0;
        for (size_t axis = 0; axis < 3; ++axis) sum += std::max(magnitude(place.dx[axis]).high, magnitude(place.dy[axis]).high);
        return {std::max(x.low, y.low), std::numbers::sqrt2 * sum};
    }
    if (sampler.lod_rule == LodRule::D3d) return {std::max(x.low, y.low), std::max(x.high, y.high)};
    double mixed = 0;
    for (size_t axis = 0; axis < 3; ++axis) mixed += magnitude(place.dx[axis]).high * magnitude(place.dy[axis]).high;
    const double half_sum = (x.high * x.high + y.high * y.high) / 2, half_difference = (x.high * x.high - y.high * y.high) / 2;
    return {std::max(x.low, y.low), std::sqrt(half_sum + std::hypot(half_difference, mixed))};
}

/// Bias, bounds and the level of detail's bits, which the bounds have too.
Range bounded(Range lod, const SamplerState& sampler, const LegalPrecision& precision) {
    const double step = std::ldexp(1.0, -precision.lod_bits), bias = double(sampler.lod_bias);
    const Range own{lod.low - step + bias, lod.high + step + bias};
    const Range least{std::floor(double(sampler.min_lod) / step) * step, std::ceil(double(sampler.min_lod) / step) * step};
    const Range most{std::floor(double(sampler.max_lod) / step) * step, std::ceil(double(sampler.max_lod) / step) * step};
    return {std::max(std::min(own.low, most.low), least.low), std::max(std::min(own.high, most.high), least.high)};
}
Range lods_of_lengths(Range scale, const SamplerState& sampler, const LegalPrecision& precision) {
    return bounded({std::log2(scale.low), std::log2(scale.high)}, sampler, precision);
}

/// The ellipse of a footprint: lengths of its axes in texels of level 0, and the longer one.
struct Axes {
    Range major, minor;
    std::array<Range, 2> along;
};

/// A Jacobian in texels of level 0: d(s, t)/dx, d(s, t)/dy.
struct Jacobian {
    double sx, tx, sy, ty;
};
struct Singular {
    double major = 0, minor = 0;
    std::array<double, 2> along{};
};

Singular singular_values(const Jacobian& j) {
    const double p = j.sx * j.sx + j.sy * j.sy, r = j.tx * j.tx + j.ty * j.ty, q = j.sx * j.tx + j.sy * j.ty;
    Singular found;
    found.major = std::sqrt((p + r) / 2 + std::hypot((p - r) / 2, q));
    if (found.major == 0) return found;
    found.minor = std::min(std::abs(j.sx * j.ty - j.tx * j.sy) / found.major, found.major);
    const double angle = std::atan2(2 * q, p - r) / 2;
    found.along = {found.major * std::cos(angle), found.major * std::sin(angle)};
    return found;
}

/// The Jacobian with each component at either end of its range, and in the middle of all.
std::vector<Jacobian> jacobians(const LegalPlace& place) {
    const auto middle = [](Range r) { return (r.low + r.high) / 2; };
    std::vector<Jacobian> all{{middle(place.dx[0]), middle(place.dx[1]), middle(place.dy[0]), middle(place.dy[1])}};
    const auto end = [](Range r, bool high) { return high ? r.high : r.low; };
    for (int n = 0; n < 16; ++n)
        all.push_back({end(place.dx[0], n & 1), end(place.dx[1], n & 2), end(place.dy[0], n & 4), end(place.dy[1], n & 8)});
    return all;
}

void widen(Range& range, double value) { range = {std::min(range.low, value), std::max(range.high, value)}; }

/// An axis and its opposite are the same: turned the way of `like`.
std::array<double, 2> turned(const std::array<double, 2>& axis, const std::array<double, 2>& like) {
    const double sign = axis[0] * like[0] + axis[1] * like[1] < 0 ? -1 : 1;
    return {sign * axis[0], sign * axis[1]};
}

Axes singular_axes(const LegalPlace& place) {
    std::optional<Axes> axes;
    Singular first;
    for (const Jacobian& j : jacobians(place)) {
        const Singular s = singular_values(j);
        if (!axes) {
            first = s;
            axes = Axes{{s.major, s.major}, {s.minor, s.minor}, {Range{s.along[0], s.along[0]}, Range{s.along[1], s.along[1]}}};
        }
        const std::array<double, 2> along = turned(s.along, first.along);
        widen(axes->major, s.major), widen(axes->minor, s.minor);
        widen(axes->along[0], along[0]), widen(axes->along[1], along[1]);
    }
    return *axes;
}

/// The longer derivative is the axis; where either may pass for it, both.
std::vector<Axes> legal_axes(const SamplerState& sampler, const LegalPlace& place, const LegalPrecision& precision) {
    if (sampler.lod_rule == LodRule::Exact && !precision.approximate_scale) return {singular_axes(place)};
    const Range x = scale_factor(place.dx, precision), y = scale_factor(place.dy, precision);
    std::vector<Axes> all;
    const auto add = [&](Range longer, Range shorter, const Derivative& along) {
        if (longer.high < shorter.low) return;
        all.push_back(
            {{std::max(longer.low, shorter.low), longer.high}, {shorter.low, std::min(shorter.high, longer.high)}, {along[0], along[1]}});
    };
    add(x, y, place.dx);
    add(y, x, place.dy);
    return all;
}

LegalCoordinate in_coordinates(Range texels, int extent) {
    return {(texels.low + texels.high) / 2 / extent, (texels.high - texels.low) / 2 / extent};
}

LegalLine new_line(const SamplerState& sampler, int probes) {
    LegalLine line;
    line.magnified = &sampler.magnify, line.minified = &sampler.minify;
    line.probes = probes;
    return line;
}

/// Vulkan "Scale Factor Operation" with the probes of texunit/legal_interval.h.
void add_ratio_lines(const Shape& shape, const SamplerState& sampler, const Axes& axes, const std::array<Range, 2>& along,
                     const LegalPrecision& precision, const FootprintSuspicion& suspicion, std::vector<LegalLine>& lines) {
    const double most = sampler.probes;
    const auto ratio = [&](double major, double minor) { return std::clamp(minor > 0 ? major / minor : kInfinity, 1.0, most); };
    const Range eta =
        axes.major.high == 0 ? Range{1, 1} : Range{ratio(axes.major.low, axes.minor.high), ratio(axes.major.high, axes.minor.low)};
    Range level{std::max(axes.minor.low, axes.major.low / most), std::max(axes.minor.high, axes.major.high / most)};
    if (suspicion.level_of_long) level = axes.major;
    if (suspicion.level_of_short) level = axes.minor;
    // eta times the shorter axis is the longer one.
    const Range probes{std::max(1.0, std::min(eta.low, axes.major.low)), std::max(1.0, std::min(eta.high, axes.major.high))};
    const auto first = int(std::ceil(probes.low * (1 - kProbeRounding))), last = int(std::ceil(probes.high));
    for (int n = first; n <= last; ++n) {
        LegalLine line = new_line(sampler, std::clamp(int(std::lround(n * suspicion.probes)), 1, kMostProbes));
        line.lod = lods_of_lengths(level, sampler, precision);
        line.axis = {in_coordinates(along[0], shape.width), in_coordinates(along[1], shape.height)};
        lines.push_back(line);
    }
}

// Probes by variance: what texunit/anisotropy-inl.h says, in double precision.
constexpr double kWidestGap = 2.5, kProbesPerRatio = 2.05;

struct Variances {
    double minor, extra;  ///< of the whole along the shorter axis; how much more along the longer
};
Variances wanted_variances(const Singular& axes, double s2) {
    return {s2 * axes.minor * axes.minor + 1.0 / 6, s2 * (axes.major * axes.major - axes.minor * axes.minor)};
}

double wanted_probes(const Variances& wanted, int most) {
    return std::clamp(kProbesPerRatio * std::sqrt(wanted.extra / wanted.minor), 1.0, double(most));
}

/// The level whose own filter has `variance`: 4^level * (1 + 3*fraction) = 4*variance + 1/3.
double lod_of_variance(double variance) {
    const double quarters = std::max(4 * variance + 1.0 / 3, 1.0);
    const int level = std::ilogb(quarters) / 2;
    return level + (std::ldexp(quarters, -2 * level) - 1) / 3;
}

/// The level's variance where `count` probes are to leave no holes.
double level_variance(const Variances& wanted, int count) {
    const double gap = double(gaussian_probes().gap[size_t(count)]) / kWidestGap;
    const double filled = count == 1 ? wanted.minor + wanted.extra / 2 : gap * gap * wanted.extra;
    return std::max(filled, wanted.minor);
}

void add_variance_lines(const Shape& shape, const SamplerState& sampler, const LegalPlace& place, const LegalPrecision& precision,
                        const FootprintSuspicion& suspicion, std::vector<LegalLine>& lines) {
    const auto s2 = double(sampler.probe_variance);
    std::vector<Singular> axes;
    for (const Jacobian& j : jacobians(place)) axes.push_back(singular_values(j));
    Range count{kInfinity, -kInfinity};
    for (const Singular& one : axes) widen(count, wanted_probes(wanted_variances(one, s2), sampler.probes));
    const Range minor = singular_axes(place).minor;
    const Range shorter = lods_of_lengths(minor, sampler, precision);

    for (int n = int(std::ceil(count.low * (1 - 2 * kProbeRounding))); n <= int(std::ceil(count.high * (1 + kProbeRounding))); ++n) {
        if (n > sampler.probes) break;
        Range lod{kInfinity, -kInfinity};
        std::array<Range, 2> along{Range{kInfinity, -kInfinity}, {kInfinity, -kInfinity}};
        for (const Singular& one : axes) {
            const Variances wanted = wanted_variances(one, s2);
            const double variance = level_variance(wanted, n);
            const double extra = std::max(wanted.extra - (variance - wanted.minor), 0.0);
            const double sigma = one.major > 0 ? std::sqrt(extra) / one.major : 0;
            widen(lod, lod_of_variance(variance));
            const std::array<double, 2> axis = turned(one.along, axes[0].along);
            for (size_t i = 0; i < 2; ++i) widen(along[i], axis[i] * sigma);
        }
        if (suspicion.other_axis) along = {Range{-along[1].high, -along[1].low}, along[0]};
        LegalLine line = new_line(sampler, std::clamp(int(std::lround(n * suspicion.probes)), 1, kMostProbes));
        line.normal = true;
        line.axis = {in_coordinates(along[0], shape.width), in_coordinates(along[1], shape.height)};
        line.lod = bounded(lod, sampler, precision);
        if (suspicion.level_of_long) line.lod = lods_of_lengths(singular_axes(place).major, sampler, precision);
        if (suspicion.level_of_short) line.lod = shorter;
        if (sampler.magnify == sampler.minify) {
            lines.push_back(line);
            continue;
        }
        // With two kernels the shorter axis says which, and the magnified one reads the finest level alone.
        if (shorter.high > 0) {
            lines.push_back(line);
            lines.back().magnified = line.minified;
        }
        if (shorter.low <= 0) {
            lines.push_back(line);
            lines.back().minified = line.magnified;
            lines.back().lod = {0, 0};
        }
    }
}

}  // namespace

std::vector<LegalLine> legal_lines(const Shape& shape, const SamplerState& sampler, const LegalPlace& place,
                                   const LegalPrecision& precision, const FootprintSuspicion& suspicion) {
    const bool isotropic = shape.cube || shape.depth > 1 || (sampler.probes == 1 && sampler.probe_variance <= 0);
    if (isotropic || !place.finite_derivatives) {
        LegalLine line = new_line(sampler, 1);
        line.lod = place.finite_derivatives ? lods_of_lengths(largest_scale(sampler, place, precision), sampler, precision)
                                            : bounded({-kInfinity, kInfinity}, sampler, precision);
        return {line};
    }
    std::vector<LegalLine> lines;
    if (sampler.probe_variance > 0) {
        add_variance_lines(shape, sampler, place, precision, suspicion, lines);
        return lines;
    }
    for (const Axes& axes : legal_axes(sampler, place, precision)) {
        std::array<Range, 2> along = axes.along;
        // Of D3D's rule the other derivative, of the ellipse the perpendicular.
        const auto same = [](Range a, Range b) { return a.low == b.low && a.high == b.high; };
        const bool is_x = same(along[0], place.dx[0]) && same(along[1], place.dx[1]);
        if (suspicion.other_axis && sampler.lod_rule == LodRule::D3d)
            along = is_x ? std::array<Range, 2>{place.dy[0], place.dy[1]} : std::array<Range, 2>{place.dx[0], place.dx[1]};
        else if (suspicion.other_axis)
            along = {Range{-along[1].high, -along[1].low}, along[0]};
        add_ratio_lines(shape, sampler, axes, along, precision, suspicion, lines);
    }
    return lines;
}

}  // namespace rawtexel::texunit
