// Random lookups that are hard on the arithmetic more often than not, and the samplers to try them with.
#pragma once

#include "texunit/sample.h"

#include "tests/reference/texunit/sampler_reference.h"

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace rawtexel::texunit {

/// For one texture of the given extents; a flat one has depth 1.
class LookupDraw {
  public:
    LookupDraw(std::array<int, 3> extents, int levels, uint32_t seed) : extents_(extents), levels_(levels), random_(seed) {}

    reference::Lookup next() {
        const float scale = level_scale();
        reference::Lookup at{coordinate(0), coordinate(1), 0, 0, 0, 0};
        at.dudx = derivative(scale, 0), at.dvdx = derivative(scale, 1);
        at.dudy = derivative(scale, 0), at.dvdy = derivative(scale, 1);
        return at;
    }

    reference::Lookup3 next_in_volume() {
        const float scale = level_scale();
        reference::Lookup3 at;
        for (size_t axis = 0; axis < 3; ++axis) {
            at.position[axis] = coordinate(axis);
            at.dx[axis] = derivative(scale, axis), at.dy[axis] = derivative(scale, axis);
        }
        return at;
    }

    /// Towards anywhere, and more often than not towards edges, corners, axes and texel boundaries of the cube.
    reference::Lookup3 next_direction() {
        reference::Lookup3 at;
        const auto extent = float(extents_[0]);
        for (float& p : at.position) {
            switch (below(6)) {
                case 0: p = float(below(3) - 1); break;
                case 1: p = (2 * float(below(extents_[0] + 1)) / extent - 1) * (below(2) ? 1.0f : 0.5f); break;
                case 2: p = std::nextafter(float(below(3) - 1), uniform(-2, 2)); break;
                default: p = uniform(-1, 1); break;
            }
        }
        const float length = below(8) == 0 ? std::ldexp(1.0f, below(200) - 100) : 1.0f;
        const float scale = level_scale() / extent;
        for (size_t axis = 0; axis < 3; ++axis) {
            at.position[axis] *= length;
            at.dx[axis] = uniform(-2, 2) * scale * length, at.dy[axis] = uniform(-2, 2) * scale * length;
        }
        if (below(50) == 0) at.position[size_t(below(3))] = awkward();
        if (below(50) == 0) at.dx[size_t(below(3))] = awkward();
        return at;
    }

    std::mt19937& bits() { return random_; }
    int below(int n) { return int(random_() % uint32_t(n)); }
    float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }

  private:
    float awkward() {
        constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();
        static constexpr float kAwkward[] = {0.0f,       -0.0f,       1.0f,         -1.0f,        0.5f,   -1e-9f,       1e-9f,
                                             0x1p-149f,  -0x1p-149f,  1 - 0x1p-24f, 1 + 0x1p-23f, 2.0f,   -2.0f,        1e6f,
                                             -1e6f,      1234567.5f,  -98765.25f,   3e38f,        -3e38f, kNan,         kInfinity,
                                             -kInfinity, 16777215.0f, 0.25f,        10.0f,        -10.0f, 3 - 0x1p-22f, 1e-40f};
        return kAwkward[below(int(std::size(kAwkward)))];
    }

    float coordinate(size_t axis) {
        switch (below(8)) {
            case 0: return awkward();
            case 1: {
                // Beside a texel's edge or centre.
                const int extent = extents_[axis];
                float u = (float(below(3 * extent) - extent) + 0.5f * float(below(2))) / float(extent);
                for (int steps = below(4); steps > 0; --steps) u = std::nextafter(u, below(2) ? 4.0f : -4.0f);
                return u;
            }
            case 2: return uniform(-1000, 1000);
            default: return uniform(-2.5f, 2.5f);
        }
    }

    /// Texels a pixel.
    float level_scale() {
        switch (below(6)) {
            case 0: return std::ldexp(1.0f, below(levels_ + 2) - 1);
            case 1: return std::ldexp(1.41421356f, below(levels_ + 2) - 1);
            case 2: return 0.25f;
            default: return std::exp2(uniform(-1, float(levels_)));
        }
    }

    float derivative(float scale, size_t axis) {
        switch (below(40)) {
            case 0: return std::numeric_limits<float>::quiet_NaN();
            case 1: return -std::numeric_limits<float>::infinity();
            case 2: return below(2) ? 1e30f : 1e-30f;
            case 3: return -0.0f;
            default: break;
        }
        const auto extent = float(extents_[axis]);
        switch (below(4)) {
            case 0: return 0;
            case 1: return scale / extent;
            default: return uniform(-1, 1) * scale / extent;
        }
    }

    std::array<int, 3> extents_;
    int levels_;
    std::mt19937 random_;
};

inline WaveCoordinates gather(const std::vector<reference::Lookup>& lookups, size_t first) {
    WaveCoordinates at;
    for (int i = 0; i < kWaveLanes; ++i) {
        const reference::Lookup& one = lookups[first + size_t(i)];
        at.u[i] = one.u, at.v[i] = one.v;
        at.dudx[i] = one.dudx, at.dvdx[i] = one.dvdx;
        at.dudy[i] = one.dudy, at.dvdy[i] = one.dvdy;
    }
    return at;
}

inline WaveCoordinates3 gather(const std::vector<reference::Lookup3>& lookups, size_t first) {
    WaveCoordinates3 at;
    for (int i = 0; i < kWaveLanes; ++i) {
        const reference::Lookup3& one = lookups[first + size_t(i)];
        for (size_t axis = 0; axis < 3; ++axis) {
            at.position[axis][i] = one.position[axis];
            at.dx[axis][i] = one.dx[axis], at.dy[axis][i] = one.dy[axis];
        }
    }
    return at;
}

/// Every kind of kernel, those with parameters several times.
inline const std::vector<Kernel>& every_kernel() {
    static const std::vector<Kernel> kernels = {Kernel::Nearest,
                                                Kernel::Bilinear,
                                                Kernel::Quadratic,
                                                Kernel::BSpline,
                                                Kernel::mitchell(),
                                                Kernel::mitchell(0.2f, 0.9f),
                                                Kernel::mitchell(-6.0f, 3.0f),
                                                Kernel::CatmullRom,
                                                Kernel::Lanczos2,
                                                Kernel::Lanczos3,
                                                Kernel::gaussian(),
                                                Kernel::gaussian(kLeastSigma),
                                                Kernel::gaussian(1.3f),
                                                Kernel::gaussian_point(),
                                                Kernel::gaussian_point(kLeastSigma),
                                                Kernel::gaussian_point(0.13f),
                                                Kernel::gaussian_point(1.25f)};
    return kernels;
}

/// A sampler of those kernels, wraps and mip modes; the two kernels differ now and then.
inline SamplerState draw_sampler(LookupDraw& draw, const Kernel& kernel, Wrap wrap) {
    SamplerState sampler;
    sampler.wrap_s = wrap;
    sampler.wrap_t = Wrap(draw.below(5));
    sampler.wrap_r = Wrap(draw.below(5));
    sampler.magnify = sampler.minify = kernel;
    const Kernel& other = every_kernel()[size_t(draw.below(int(every_kernel().size())))];
    if (draw.below(3) == 0) (draw.below(2) == 0 ? sampler.magnify : sampler.minify) = other;
    sampler.mip = MipMode(draw.below(3));
    for (float& channel : sampler.border) channel = draw.uniform(0, 1);
    return sampler;
}

inline std::string describe(const SamplerState& sampler) {
    std::ostringstream text;
    text.precision(9);
    text << to_string(sampler.wrap_s) << ',' << to_string(sampler.wrap_t) << ',' << to_string(sampler.wrap_r) << " magnify "
         << to_string(sampler.magnify) << " minify " << to_string(sampler.minify) << " mip " << to_string(sampler.mip) << " precision "
         << to_string(sampler.precision);
    return text.str();
}

inline std::string describe(const reference::Lookup& at) {
    std::ostringstream text;
    text.precision(9);
    text << " u " << at.u << " v " << at.v << " d/dx " << at.dudx << ',' << at.dvdx << " d/dy " << at.dudy << ',' << at.dvdy;
    return text.str();
}

inline std::string describe(const reference::Lookup3& at) {
    std::ostringstream text;
    text.precision(9);
    const auto put = [&](const char* name, const std::array<float, 3>& v) { text << name << v[0] << ',' << v[1] << ',' << v[2]; };
    put(" at ", at.position);
    put(" d/dx ", at.dx);
    put(" d/dy ", at.dy);
    return text.str();
}

}  // namespace rawtexel::texunit
