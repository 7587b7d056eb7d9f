#include "tests/reference/cli/flip_reference.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace rawtexel::reference {
namespace {

const double kPi = std::acos(-1.0);

struct Colour {
    double r, g, b;
};
struct Point {  // of whatever space
    double x, y, z;
};

/// An image that repeats its border.
template <class T>
struct Picture {
    int width, height;
    std::vector<T> pixels;
    const T& at(int x, int y) const {
        return pixels[size_t(std::clamp(y, 0, height - 1)) * size_t(width) + size_t(std::clamp(x, 0, width - 1))];
    }
};

template <class T, class F>
auto map_pixels(const Picture<T>& in, F f) {
    Picture<decltype(f(in.pixels[0]))> out{in.width, in.height, {}};
    for (const T& pixel : in.pixels) out.pixels.push_back(f(pixel));
    return out;
}

using Weight = std::function<double(int x, int y)>;

double sum_of(int radius, const Weight& weight) {
    double sum = 0;
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x) sum += weight(x, y);
    return sum;
}

/// The sum of weight(i, j) * in(x + i, y + j).
Picture<double> filtered(const Picture<double>& in, int radius, const Weight& weight) {
    const int size = 2 * radius + 1;
    std::vector<double> table;
    for (int j = -radius; j <= radius; ++j)
        for (int i = -radius; i <= radius; ++i) table.push_back(weight(i, j));
    Picture<double> out{in.width, in.height, {}};
    for (int y = 0; y < in.height; ++y)
        for (int x = 0; x < in.width; ++x) {
            double sum = 0;
            for (int j = 0; j < size; ++j)
                for (int i = 0; i < size; ++i) sum += table[size_t(j * size + i)] * in.at(x + i - radius, y + j - radius);
            out.pixels.push_back(sum);
        }
    return out;
}

// --- Colour spaces ---

double linear_of_code(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }

Point xyz_of_linear(const Colour& c) {
    return {(10135552.0 * c.r + 8788810.0 * c.g + 4435075.0 * c.b) / 24577794.0,
            (2613072.0 * c.r + 8788810.0 * c.g + 887015.0 * c.b) / 12288897.0,
            (1425312.0 * c.r + 8788810.0 * c.g + 70074185.0 * c.b) / 73733382.0};
}

// Cramer's rule on the three equations above.
Colour linear_of_xyz(const Point& p) {
    const double a[3][3] = {{10135552.0, 8788810.0, 4435075.0}, {2613072.0, 8788810.0, 887015.0}, {1425312.0, 8788810.0, 70074185.0}};
    const double right[3] = {p.x * 24577794.0, p.y * 12288897.0, p.z * 73733382.0};
    const auto determinant = [](const double m[3][3]) {
        return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    };
    double solution[3];
    for (int column = 0; column < 3; ++column) {
        double replaced[3][3];
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) replaced[i][j] = j == column ? right[i] : a[i][j];
        solution[column] = determinant(replaced) / determinant(a);
    }
    return {solution[0], solution[1], solution[2]};
}

const Point kWhite = xyz_of_linear({1, 1, 1});

Point ycxcz_of_linear(const Colour& c) {
    const Point p = xyz_of_linear(c);
    const double x = p.x / kWhite.x, y = p.y / kWhite.y, z = p.z / kWhite.z;
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Colour linear_of_ycxcz(const Point& p) {
    const double y = (p.x + 16) / 116, x = p.y / 500 + y, z = y - p.z / 200;
    return linear_of_xyz({x * kWhite.x, y * kWhite.y, z * kWhite.z});
}

Point lab_of_linear(const Colour& c) {
    const Point p = xyz_of_linear(c);
    const auto f = [](double t) {
        const double d = 6.0 / 29.0;
        return t > d * d * d ? std::pow(t, 1.0 / 3.0) : t / (3 * d * d) + 4.0 / 29.0;
    };
    const double x = f(p.x / kWhite.x), y = f(p.y / kWhite.y), z = f(p.z / kWhite.z);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Point with_hunt(const Point& lab) { return {lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z}; }

double hyab(const Point& a, const Point& b) { return std::fabs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

// --- The colour pipeline ---

/// Contrast sensitivity at `z2` squared degrees from the centre: sums of a * sqrt(pi / b) * exp(-pi^2 z2 / b).
double sensitivity(char channel, double z2) {
    const auto term = [&](double a, double b) { return a * std::sqrt(kPi / b) * std::exp(-kPi * kPi * z2 / b); };
    if (channel == 'Y') return term(1, 0.0047);
    if (channel == 'x') return term(1, 0.0053);
    return term(34.1, 0.04) + term(13.5, 0.025);
}

Picture<double> contrast_filtered(const Picture<double>& in, char channel, double pixels_per_degree) {
    const int radius = int(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * pixels_per_degree));
    const Weight weight = [&](int x, int y) {
        return sensitivity(channel, (double(x) * x + double(y) * y) / (pixels_per_degree * pixels_per_degree));
    };
    const double sum = sum_of(radius, weight);
    return filtered(in, radius, [&](int x, int y) { return weight(x, y) / sum; });
}

Picture<Point> perceived(const Picture<Colour>& linear, double pixels_per_degree) {
    const Picture<Point> opponent = map_pixels(linear, ycxcz_of_linear);
    const Picture<double> y = contrast_filtered(map_pixels(opponent, [](const Point& p) { return p.x; }), 'Y', pixels_per_degree);
    const Picture<double> cx = contrast_filtered(map_pixels(opponent, [](const Point& p) { return p.y; }), 'x', pixels_per_degree);
    const Picture<double> cz = contrast_filtered(map_pixels(opponent, [](const Point& p) { return p.z; }), 'z', pixels_per_degree);
    Picture<Point> out{linear.width, linear.height, {}};
    for (size_t i = 0; i < y.pixels.size(); ++i) {
        const Colour c = linear_of_ycxcz({y.pixels[i], cx.pixels[i], cz.pixels[i]});
        const auto clamped = [](double v) { return std::fmin(std::fmax(v, 0.0), 1.0); };
        out.pixels.push_back(with_hunt(lab_of_linear({clamped(c.r), clamped(c.g), clamped(c.b)})));
    }
    return out;
}

double redistributed(double hyab_distance) {
    const double most = std::pow(hyab(with_hunt(lab_of_linear({0, 1, 0})), with_hunt(lab_of_linear({0, 0, 1}))), 0.7);
    const double e = std::pow(hyab_distance, 0.7), knee = 0.4 * most;
    return e < knee ? 0.95 * e / knee : 0.95 + 0.05 * (e - knee) / (most - knee);
}

// --- The feature pipeline ---

/// The strength of edges (first derivative of a Gaussian) or points (second derivative): the length of the responses along both axes.
Picture<double> features(const Picture<Colour>& linear, bool points, double pixels_per_degree) {
    const double deviation = 0.5 * 0.082 * pixels_per_degree;
    const int radius = int(std::ceil(3 * deviation));
    const Picture<double> grey = map_pixels(linear, [](const Colour& c) { return (ycxcz_of_linear(c).x + 16) / 116; });
    const Weight along_x = [&](int x, int y) {
        const double g = std::exp(-(double(x) * x + double(y) * y) / (2 * deviation * deviation));
        return points ? (double(x) * x / (deviation * deviation) - 1) * g : -double(x) * g;
    };
    const double positive = sum_of(radius, [&](int x, int y) { return std::fmax(along_x(x, y), 0.0); });
    const double negative = sum_of(radius, [&](int x, int y) { return std::fmax(-along_x(x, y), 0.0); });
    const Weight balanced = [&](int x, int y) { return along_x(x, y) / (along_x(x, y) > 0 ? positive : negative); };
    const Picture<double> x = filtered(grey, radius, balanced);
    const Picture<double> y = filtered(grey, radius, [&](int i, int j) { return balanced(j, i); });
    Picture<double> strength{linear.width, linear.height, {}};
    for (size_t i = 0; i < x.pixels.size(); ++i) strength.pixels.push_back(std::hypot(x.pixels[i], y.pixels[i]));
    return strength;
}

std::vector<double> flip_of_linear(const Picture<Colour>& test, const Picture<Colour>& reference, double pixels_per_degree) {
    const Picture<Point> t = perceived(test, pixels_per_degree), r = perceived(reference, pixels_per_degree);
    const Picture<double> te = features(test, false, pixels_per_degree), re = features(reference, false, pixels_per_degree);
    const Picture<double> tp = features(test, true, pixels_per_degree), rp = features(reference, true, pixels_per_degree);
    std::vector<double> errors;
    for (size_t i = 0; i < t.pixels.size(); ++i) {
        const double colour = redistributed(hyab(t.pixels[i], r.pixels[i]));
        const double stronger = std::fmax(std::fabs(re.pixels[i] - te.pixels[i]), std::fabs(rp.pixels[i] - tp.pixels[i]));
        const double feature = std::sqrt(stronger / std::sqrt(2.0));
        errors.push_back(std::pow(colour, 1 - feature));
    }
    return errors;
}

Picture<Colour> picture(std::span<const float> values, int width, int height, const std::function<double(double)>& to_linear) {
    Picture<Colour> out{width, height, {}};
    for (size_t i = 0; i < values.size(); i += 3)
        out.pixels.push_back({to_linear(double(values[i])), to_linear(double(values[i + 1])), to_linear(double(values[i + 2]))});
    return out;
}

double aces(double x) { return x * (0.9036 * x + 0.018) / (x * (0.8748 * x + 0.354) + 0.14); }

}  // namespace

std::vector<double> ldr_flip(std::span<const float> test, std::span<const float> reference, int width, int height,
                             double pixels_per_degree) {
    return flip_of_linear(picture(test, width, height, linear_of_code), picture(reference, width, height, linear_of_code),
                          pixels_per_degree);
}

Exposures exposures(std::span<const float> reference) {
    std::vector<double> luminances;
    for (size_t i = 0; i < reference.size(); i += 3)
        luminances.push_back(xyz_of_linear({double(reference[i]), double(reference[i + 1]), double(reference[i + 2])}).y);
    std::sort(luminances.begin(), luminances.end());
    // Where the tone map reaches 0.85, by halving.
    double low = 0, high = 10;
    for (int i = 0; i < 200; ++i) (aces((low + high) / 2) < 0.85 ? low : high) = (low + high) / 2;
    const double start = std::log2(low / luminances.back()), stop = std::log2(low / luminances[luminances.size() / 2]);
    return {start, stop, int(std::fmax(2, std::ceil(stop - start)))};
}

std::vector<double> hdr_flip(std::span<const float> test, std::span<const float> reference, int width, int height,
                             double pixels_per_degree) {
    const Exposures range = exposures(reference);
    std::vector<double> largest(size_t(width) * size_t(height), 0.0);
    for (int i = 0; i < range.count; ++i) {
        const double exposure = range.start + i * (range.stop - range.start) / (range.count - 1);
        const auto shown = [&](double v) { return std::fmin(std::fmax(aces(std::pow(2.0, exposure) * v), 0.0), 1.0); };
        const std::vector<double> errors =
            flip_of_linear(picture(test, width, height, shown), picture(reference, width, height, shown), pixels_per_degree);
        for (size_t p = 0; p < errors.size(); ++p) largest[p] = std::fmax(largest[p], errors[p]);
    }
    return largest;
}

double weighted_percentile(std::span<const double> errors, double share) {
    double whole = 0, best = std::numeric_limits<double>::infinity();
    for (const double e : errors) whole += e;
    for (const double candidate : errors) {
        double below = 0;
        for (const double e : errors) below += e <= candidate ? e : 0;
        if (below >= share * whole) best = std::fmin(best, candidate);
    }
    return best;
}

}  // namespace rawtexel::reference
