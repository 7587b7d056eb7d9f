// The colour spaces that FLIP goes through, and the tone map under which it looks at HDR images. All of one pixel, in double.
#pragma once

#include <array>
#include <cmath>

namespace rawtexel::cli {

using Triple = std::array<double, 3>;

/// IEC 61966-2-1.
inline double linear_of_srgb(double code) { return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4); }

// Linear sRGB to XYZ with a white of Y = 1, and back; the white is the sum of each row.
inline constexpr std::array<Triple, 3> kXyzOfLinear{{{10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
                                                     {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
                                                     {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}}};

inline constexpr Triple product(const std::array<Triple, 3>& matrix, const Triple& v) {
    Triple out{};
    for (size_t i = 0; i < 3; ++i) out[i] = matrix[i][0] * v[0] + matrix[i][1] * v[1] + matrix[i][2] * v[2];
    return out;
}

inline constexpr std::array<Triple, 3> inverse(const std::array<Triple, 3>& m) {
    std::array<Triple, 3> cofactors{};
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j) {
            const size_t r = (j + 1) % 3, s = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
            cofactors[i][j] = m[r][c] * m[s][d] - m[r][d] * m[s][c];
        }
    const double determinant = m[0][0] * cofactors[0][0] + m[0][1] * cofactors[1][0] + m[0][2] * cofactors[2][0];
    for (Triple& row : cofactors)
        for (double& value : row) value /= determinant;
    return cofactors;
}

inline constexpr std::array<Triple, 3> kLinearOfXyz = inverse(kXyzOfLinear);
inline constexpr Triple kWhite = product(kXyzOfLinear, {1.0, 1.0, 1.0});

/// XYZ over the white's.
inline Triple relative_xyz(const Triple& linear) {
    const Triple xyz = product(kXyzOfLinear, linear);
    return {xyz[0] / kWhite[0], xyz[1] / kWhite[1], xyz[2] / kWhite[2]};
}

/// The opponent space in which contrast is filtered: a linear form of L*a*b*.
inline Triple ycxcz(const Triple& linear) {
    const Triple xyz = relative_xyz(linear);
    return {116.0 * xyz[1] - 16.0, 500.0 * (xyz[0] - xyz[1]), 200.0 * (xyz[1] - xyz[2])};
}

inline Triple linear_of_ycxcz(const Triple& ycc) {
    const double y = (ycc[0] + 16.0) / 116.0, x = y + ycc[1] / 500.0, z = y - ycc[2] / 200.0;
    return product(kLinearOfXyz, {x * kWhite[0], y * kWhite[1], z * kWhite[2]});
}

/// Relative luminance of linear light.
inline double ycxcz_luminance(const Triple& linear) { return product(kXyzOfLinear, linear)[1]; }

/// CIE 1976 L*a*b*.
inline Triple lab(const Triple& linear) {
    constexpr double kDelta = 6.0 / 29.0;
    const auto f = [](double t) { return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0 * kDelta * kDelta) + 4.0 / 29.0; };
    const Triple xyz = relative_xyz(linear);
    const double x = f(xyz[0]), y = f(xyz[1]), z = f(xyz[2]);
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

/// Hunt's effect: colours look the more colourful the brighter they are.
inline Triple hunt_adjusted(const Triple& lab) { return {lab[0], 0.01 * lab[0] * lab[1], 0.01 * lab[0] * lab[2]}; }

/// HyAB, made for large colour differences: city-block in lightness, Euclidean in chroma.
inline double hyab(const Triple& a, const Triple& b) {
    const double da = a[1] - b[1], db = a[2] - b[2];
    return std::abs(a[0] - b[0]) + std::sqrt(da * da + db * db);
}

// ACES as the HDR paper takes it: Narkowicz's fit with its exposure of 0.6 folded in, (k0 x^2 + k1 x) / (k3 x^2 + k4 x + k5).
inline constexpr double kAces[6] = {0.6 * 0.6 * 2.51, 0.6 * 0.03, 0.0, 0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14};

inline double aces(double x) { return (kAces[0] * x + kAces[1]) * x / ((kAces[3] * x + kAces[4]) * x + kAces[5]); }

/// The x >= 0 with aces(x) = `target` in (0, 1): the larger root of a quadratic equation.
inline double inverse_aces(double target) {
    const double a = kAces[0] - target * kAces[3], b = kAces[1] - target * kAces[4], c = kAces[2] - target * kAces[5];
    return (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
}

}  // namespace rawtexel::cli
