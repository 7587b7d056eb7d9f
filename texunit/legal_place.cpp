#include "texunit/legal_place.h"

#include "texunit/cube_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rawtexel::texunit {
namespace {

double finite_or_zero(double value) { return std::isfinite(value) ? value : 0; }

Range with_error(double value, double error) { return {value - error, value + error}; }
Range operator+(Range a, Range b) { return {a.low + b.low, a.high + b.high}; }
Range operator-(Range a) { return {-a.high, -a.low}; }
Range operator*(Range a, Range b) {
    const auto [low, high] = std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
    return {low, high};
}
Range scaled(Range a, double factor) { return a * Range{factor, factor}; }

bool is_finite(const std::array<double, 3>& v) { return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]); }

bool is_finite(Range r) { return std::isfinite(r.low) && std::isfinite(r.high); }

/// Members of an array that `layer` may mean: rounded to the nearest, either one half-way (Vulkan "Layer Selection").
std::vector<int> legal_layers(double layer, int count, const LegalPrecision& precision) {
    const double number = std::isnan(layer) ? 0 : std::clamp(layer, 0.0, double(count - 1));
    const double error = float_error(number, precision.coordinate_bits);
    std::vector<int> layers;
    for (auto n = int(std::ceil(number - error - 0.5)); n <= int(std::floor(number + error + 0.5)); ++n)
        if (n >= 0 && n < count) layers.push_back(n);
    return layers;
}

Range with_float_error(double value, int bits) { return with_error(value, float_error(value, bits)); }

double along(const std::array<int, 3>& axis, const std::array<double, 3>& v) { return axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2]; }

/// The direction on one face (Vulkan "Cube Map Coordinate Transformation" and "Cube Map Derivative Transformation"): coordinate (q + 1)/2
/// with q the quotient of two components, its change by the quotient rule.
LegalPlace on_face(int face, int extent, const std::array<double, 3>& direction, const JudgedLookup& lookup,
                   const LegalPrecision& precision) {
    const CubeFace& axes = kCubeFaces[size_t(face)];
    const double length = along(axes.outward, direction);
    LegalPlace place;
    place.slice = face;
    if (!(length > 0)) {
        // No direction: the middle of the face, and no derivatives.
        place.at[0] = place.at[1] = {0.5, 0};
        place.finite_derivatives = false;
        return place;
    }
    const Range inverse = {1 / (length + float_error(length, precision.coordinate_bits)),
                           1 / (length - float_error(length, precision.coordinate_bits))};
    const std::array<const std::array<int, 3>*, 2> sides = {&axes.right, &axes.down};
    for (size_t side = 0; side < 2; ++side) {
        const double part = along(*sides[side], direction), q = part / length;
        const double error = std::abs(q) * 3 * std::ldexp(1.0, -precision.coordinate_bits);
        place.at[side] = {(q + 1) / 2, error / 2};
        const auto change = [&](const std::array<double, 3>& derivative) {
            const Range grows = with_float_error(along(axes.outward, derivative), precision.derivative_bits);
            const Range moves = with_float_error(along(*sides[side], derivative), precision.derivative_bits);
            return scaled((moves + -(with_error(q, error) * grows)) * inverse, extent / 2.0);
        };
        place.dx[side] = change(lookup.dx), place.dy[side] = change(lookup.dy);
    }
    place.finite_derivatives = is_finite(lookup.dx) && is_finite(lookup.dy);
    for (size_t side = 0; side < 2; ++side)
        place.finite_derivatives = place.finite_derivatives && is_finite(place.dx[side]) && is_finite(place.dy[side]);
    return place;
}

/// Every face whose component is the largest within the precision; where some are equal, each.
std::vector<LegalPlace> places_on_faces(int extent, const JudgedLookup& lookup, const LegalPrecision& precision) {
    const std::array<double, 3> direction{finite_or_zero(lookup.at[0]), finite_or_zero(lookup.at[1]), finite_or_zero(lookup.at[2])};
    const double largest = std::max({std::abs(direction[0]), std::abs(direction[1]), std::abs(direction[2])});
    const double least = largest - 2 * float_error(largest, precision.coordinate_bits);
    std::vector<LegalPlace> places;
    constexpr int kPositiveZ = 4;
    if (largest == 0) return {on_face(kPositiveZ, extent, direction, lookup, precision)};
    for (int face = 0; face < 6; ++face)
        if (along(kCubeFaces[size_t(face)].outward, direction) >= least)
            places.push_back(on_face(face, extent, direction, lookup, precision));
    return places;
}

LegalPlace flat_place(const Shape& shape, const JudgedLookup& lookup, const LegalPrecision& precision) {
    LegalPlace place;
    const std::array<int, 3> extents{shape.width, shape.height, shape.depth};
    const size_t axes = shape.depth > 1 ? 3 : 2;
    for (size_t axis = 0; axis < axes; ++axis) {
        const double u = finite_or_zero(lookup.at[axis]);
        place.at[axis] = {u, float_error(u, precision.coordinate_bits)};
        place.dx[axis] = scaled(with_float_error(lookup.dx[axis], precision.derivative_bits), extents[axis]);
        place.dy[axis] = scaled(with_float_error(lookup.dy[axis], precision.derivative_bits), extents[axis]);
        place.finite_derivatives = place.finite_derivatives && std::isfinite(lookup.dx[axis]) && std::isfinite(lookup.dy[axis]);
    }
    return place;
}

}  // namespace

double float_error(double value, int bits) {
    if (!std::isfinite(value)) return std::numeric_limits<double>::infinity();
    return value == 0 ? 0 : std::ldexp(1.0, std::ilogb(value) - bits);
}

std::vector<LegalPlace> legal_places(const Shape& shape, const JudgedLookup& lookup, const LegalPrecision& precision) {
    const std::vector<LegalPlace> on_one =
        shape.cube ? places_on_faces(shape.width, lookup, precision) : std::vector{flat_place(shape, lookup, precision)};
    std::vector<LegalPlace> places;
    for (const int member : legal_layers(lookup.layer, shape.cubes(), precision)) {
        for (LegalPlace place : on_one) {
            place.slice += member * shape.faces();
            places.push_back(place);
        }
    }
    return places;
}

}  // namespace rawtexel::texunit
