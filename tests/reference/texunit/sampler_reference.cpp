#include "tests/reference/texunit/sampler_reference.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace rawtexel::texunit::reference {
namespace {

int extent_of(int base, int level) { return std::max(1, base >> level); }

/// Vulkan "Scale Factor Operation, Level-of-Detail Operation": lambda = log2(rho_max).
double lambda_of(const Image& image, const Lookup& at) {
    for (const float derivative : {at.dudx, at.dvdx, at.dudy, at.dvdy}) {
        if (!std::isfinite(derivative)) return std::numeric_limits<double>::infinity();
    }
    const double rho_x = std::hypot(double(at.dudx) * image.width, double(at.dvdx) * image.height);
    const double rho_y = std::hypot(double(at.dudy) * image.width, double(at.dvdy) * image.height);
    return std::log2(std::max(rho_x, rho_y));
}

constexpr int kBorder = -1;

/// Vulkan "Wrapping Operation".
int wrap_texel(Wrap wrap, long long i, int size) {
    const auto mod = [](long long a, long long n) { return ((a % n) + n) % n; };
    switch (wrap) {
        case Wrap::Repeat: return int(mod(i, size));
        case Wrap::MirroredRepeat: {
            const long long n = mod(i, 2LL * size) - size;
            const long long mirrored = n >= 0 ? n : -(1 + n);
            return int((size - 1) - mirrored);
        }
        case Wrap::ClampToEdge: return int(std::clamp<long long>(i, 0, size - 1));
        case Wrap::ClampToBorder: return i < 0 || i >= size ? kBorder : int(i);
        case Wrap::MirrorOnce: return int(std::clamp<long long>(i >= 0 ? i : -(1 + i), 0, size - 1));
    }
    return 0;
}

struct AxisTap {
    int texel;
    double weight;
};

/// The unnormalised coordinate, less whole periods, which fmod takes away exactly.
double texel_space(Wrap wrap, float coordinate, int size) {
    if (!std::isfinite(coordinate)) return 0;
    const double u = coordinate;
    switch (wrap) {
        case Wrap::Repeat: return std::fmod(u, 1.0) * size;
        case Wrap::MirroredRepeat: return std::fmod(u, 2.0) * size;
        case Wrap::ClampToEdge:
        case Wrap::ClampToBorder:
        case Wrap::MirrorOnce: return std::clamp(u, -10.0, 10.0) * size;
    }
    return 0;
}

/// One or two taps along an axis (Vulkan "(u,v,w) to (i,j,k) Transformation and Array Layer Selection").
std::array<AxisTap, 2> axis_taps(Kernel kernel, Wrap wrap, float coordinate, int size) {
    const double x = texel_space(wrap, coordinate, size);
    if (kernel == Kernel::Nearest) return {{{wrap_texel(wrap, (long long)(std::floor(x)), size), 1.0}, {0, 0.0}}};
    const double base = std::floor(x - 0.5);
    const double fraction = (x - 0.5) - base;
    const auto i = (long long)(base);
    return {{{wrap_texel(wrap, i, size), 1 - fraction}, {wrap_texel(wrap, i + 1, size), fraction}}};
}

void add_level(const Image& image, const SamplerState& sampler, Kernel kernel, const Lookup& at, int level, double weight, Sample& sum) {
    const auto columns = axis_taps(kernel, sampler.wrap_s, at.u, extent_of(image.width, level));
    const auto rows = axis_taps(kernel, sampler.wrap_t, at.v, extent_of(image.height, level));
    for (const AxisTap& row : rows) {
        for (const AxisTap& column : columns) {
            if (row.weight * column.weight * weight == 0) continue;
            const Colour texel = image.texel(level, column.texel, row.texel);
            for (size_t c = 0; c < 4; ++c) {
                sum.colour[c] += row.weight * column.weight * weight * texel[c];
                sum.least[c] = sum.taps == 0 ? texel[c] : std::min(sum.least[c], texel[c]);
                sum.most[c] = sum.taps == 0 ? texel[c] : std::max(sum.most[c], texel[c]);
                sum.largest = std::max(sum.largest, std::abs(texel[c]));
            }
            ++sum.taps;
        }
    }
}

}  // namespace

Sample sample(const Image& image, const SamplerState& sampler, const Lookup& at, double lambda_shift) {
    Sample result;
    result.lambda = lambda_of(image, at) + lambda_shift;
    const Kernel kernel = result.lambda <= 0 ? sampler.magnify : sampler.minify;
    const double d = std::clamp(result.lambda, 0.0, double(image.levels - 1));
    switch (sampler.mip) {
        case MipMode::None: add_level(image, sampler, kernel, at, 0, 1, result); break;
        case MipMode::Nearest: add_level(image, sampler, kernel, at, int(std::ceil(d + 0.5)) - 1, 1, result); break;
        case MipMode::Linear: {
            const int high = int(std::floor(d));
            const int low = std::min(high + 1, image.levels - 1);
            const double delta = d - high;
            add_level(image, sampler, kernel, at, high, 1 - delta, result);
            result.mixes_levels = delta != 0;
            if (result.mixes_levels) add_level(image, sampler, kernel, at, low, delta, result);
            break;
        }
    }
    return result;
}

}  // namespace rawtexel::texunit::reference
