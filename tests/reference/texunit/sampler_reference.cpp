#include "tests/reference/texunit/sampler_reference.h"

#include "tests/reference/texunit/cube_reference.h"
#include "tests/reference/texunit/kernel_reference.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace rawtexel::texunit::reference {
namespace {

int extent_of(int base, int level) { return std::max(1, base >> level); }

/// Level of detail (Vulkan "Scale Factor Operation, Level-of-Detail Operation"; D3D11.3 7.18.11) from derivatives in texels of level 0.
struct Levels {
    double lambda;  ///< after bias and bounds
    int finer, coarser;
    double fraction;
};
Levels choose_levels(const SamplerState& sampler, int levels, const std::array<double, 3>& dx, const std::array<double, 3>& dy,
                     double shift) {
    // libstdc++'s std::hypot of three numbers may lose a NaN.
    const auto length = [](const std::array<double, 3>& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); };
    const double x = length(dx), y = length(dy);
    const bool finite = std::isfinite(x) && std::isfinite(y);
    double rho = std::max(x, y);
    if (sampler.lod_rule == LodRule::Exact) {
        const double cross = dx[0] * dy[0] + dx[1] * dy[1] + dx[2] * dy[2];
        rho = std::sqrt((x * x + y * y) / 2 + std::hypot((x * x - y * y) / 2, cross));
    }
    const double raw = finite ? std::log2(rho) : std::numeric_limits<double>::infinity();
    double lambda = std::max(std::min(raw + shift + double(sampler.lod_bias), double(sampler.max_lod)), double(sampler.min_lod));
    const bool gpu = sampler.precision == Precision::Gpu;
    if (gpu && std::isfinite(lambda)) lambda = std::nearbyint(lambda * 256) / 256;
    const double d = std::clamp(lambda, 0.0, double(levels - 1));
    switch (sampler.mip) {
        case MipMode::None: return {lambda, 0, 0, 0};
        case MipMode::Nearest: {
            const int level = gpu ? int(std::floor(d + 0.5)) : int(std::ceil(d + 0.5)) - 1;
            return {lambda, level, level, 0};
        }
        case MipMode::Linear: break;
    }
    const int high = int(std::floor(d));
    return {lambda, high, std::min(high + 1, levels - 1), d - high};
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

/// The unnormalised coordinate, less whole periods, which fmod takes away exactly; far outside a texture that does not repeat every
/// coordinate means the same.
double texel_space(Wrap wrap, float coordinate, int size) {
    if (!std::isfinite(coordinate)) return 0;
    const double u = coordinate;
    switch (wrap) {
        case Wrap::Repeat: return std::fmod(u, 1.0) * size;
        case Wrap::MirroredRepeat: return std::fmod(u, 2.0) * size;
        case Wrap::ClampToEdge:
        case Wrap::ClampToBorder:
        case Wrap::MirrorOnce: return std::clamp(u, -1e6, 1e6) * size;
    }
    return 0;
}

/// 8 fractional bits for Precision::Gpu.
double snapped(const SamplerState& sampler, double x) { return sampler.precision == Precision::Gpu ? std::nearbyint(x * 256) / 256 : x; }

struct AxisTap {
    int texel;
    double weight;
};

std::vector<AxisTap> axis_taps(const Kernel& kernel, const SamplerState& sampler, Wrap wrap, float coordinate, int size, double shift,
                               double cut_shift) {
    std::vector<AxisTap> taps;
    for (const KernelTap& tap : kernel_taps(kernel, snapped(sampler, texel_space(wrap, coordinate, size) + shift), cut_shift)) {
        taps.push_back({wrap_texel(wrap, tap.texel, size), tap.weight});
    }
    return taps;
}

void add_texel(const Colour& texel, double weight, Sample& sum) {
    for (size_t c = 0; c < 4; ++c) {
        sum.colour[c] += weight * texel[c];
        sum.least[c] = sum.taps == 0 ? texel[c] : std::min(sum.least[c], texel[c]);
        sum.most[c] = sum.taps == 0 ? texel[c] : std::max(sum.most[c], texel[c]);
        sum.largest = std::max(sum.largest, std::abs(texel[c]));
    }
    sum.magnitude += std::abs(weight);
    ++sum.taps;
}

Colour border_of(const SamplerState& sampler) {
    return {double(sampler.border[0]), double(sampler.border[1]), double(sampler.border[2]), double(sampler.border[3])};
}

/// Both levels of a choice, each added by `add_level(kernel, level, weight)`.
template <class AddLevel>
void add_levels(const SamplerState& sampler, const Levels& levels, Sample& result, const AddLevel& add_level) {
    const Kernel kernel = levels.lambda <= 0 ? sampler.magnify : sampler.minify;
    result.lambda = levels.lambda;
    add_level(kernel, levels.finer, 1 - levels.fraction);
    result.mixes_levels = levels.fraction != 0;
    if (result.mixes_levels) add_level(kernel, levels.coarser, levels.fraction);
}

}  // namespace

Sample sample_layer(const ShapedImage& image, const SamplerState& sampler, const Lookup& at, int layer, const Shift& shift) {
    const double w = image.width, h = image.height;
    Sample result;
    const Levels levels = choose_levels(sampler, image.levels, {at.dudx * w, at.dvdx * h, 0}, {at.dudy * w, at.dvdy * h, 0}, shift.lambda);
    add_levels(sampler, levels, result, [&](const Kernel& kernel, int level, double weight) {
        const auto columns = axis_taps(kernel, sampler, sampler.wrap_s, at.u, extent_of(image.width, level), shift.texel[0], shift.cut[0]);
        const auto rows = axis_taps(kernel, sampler, sampler.wrap_t, at.v, extent_of(image.height, level), shift.texel[1], shift.cut[1]);
        for (const AxisTap& row : rows) {
            for (const AxisTap& column : columns) {
                const bool border = row.texel == kBorder || column.texel == kBorder;
                result.texels += !border;
                add_texel(border ? border_of(sampler) : image.texel(level, layer, column.texel, row.texel),
                          row.weight * column.weight * weight, result);
            }
        }
    });
    return result;
}

Sample sample(const Image& image, const SamplerState& sampler, const Lookup& at, double lambda_shift) {
    const ShapedImage shaped{image.width, image.height, 1, image.levels,
                             [&](int level, int, int x, int y) { return image.texel(level, x, y); }};
    return sample_layer(shaped, sampler, at, 0, {.lambda = lambda_shift});
}

Sample sample_volume(const ShapedImage& image, const SamplerState& sampler, const Lookup3& at, const Shift& shift) {
    const std::array<double, 3> extent = {double(image.width), double(image.height), double(image.depth)};
    std::array<double, 3> dx, dy;
    for (size_t axis = 0; axis < 3; ++axis) dx[axis] = at.dx[axis] * extent[axis], dy[axis] = at.dy[axis] * extent[axis];
    Sample result;
    add_levels(
        sampler, choose_levels(sampler, image.levels, dx, dy, shift.lambda), result, [&](const Kernel& kernel, int level, double weight) {
            const auto columns =
                axis_taps(kernel, sampler, sampler.wrap_s, at.position[0], extent_of(image.width, level), shift.texel[0], shift.cut[0]);
            const auto rows =
                axis_taps(kernel, sampler, sampler.wrap_t, at.position[1], extent_of(image.height, level), shift.texel[1], shift.cut[1]);
            const auto slices = axis_taps(kernel, sampler, sampler.wrap_r, at.position[2], extent_of(image.depth, level), 0, shift.cut[0]);
            for (const AxisTap& slice : slices) {
                for (const AxisTap& row : rows) {
                    for (const AxisTap& column : columns) {
                        const bool border = slice.texel == kBorder || row.texel == kBorder || column.texel == kBorder;
                        result.texels += !border;
                        add_texel(border ? border_of(sampler) : image.texel(level, slice.texel, column.texel, row.texel),
                                  slice.weight * row.weight * column.weight * weight, result);
                    }
                }
            }
        });
    return result;
}

Sample sample_cube(const ShapedImage& image, const SamplerState& sampler, const Lookup3& direction, int cube, const Shift& shift) {
    const FacePoint at = face_point(direction);
    const double n = image.width;
    Sample result;
    const Levels levels = choose_levels(sampler, image.levels, {at.dsdx * n, at.dtdx * n, 0}, {at.dsdy * n, at.dtdy * n, 0}, shift.lambda);
    add_levels(sampler, levels, result, [&](const Kernel& kernel, int level, double weight) {
        const int size = extent_of(image.width, level);
        const auto taps = [&](double s, double moved, double cut_shift) {
            auto found = kernel_taps(kernel, snapped(sampler, s * size + moved), cut_shift);
            // A single texel stays on the face.
            if (kernel == Kernel::Nearest) found[0].texel = std::clamp<long long>(found[0].texel, 0, size - 1);
            return found;
        };
        const auto columns = taps(at.s, shift.texel[0], shift.cut[0]), rows = taps(at.t, shift.texel[1], shift.cut[1]);
        for (const KernelTap& row : rows) {
            for (const KernelTap& column : columns) {
                const auto texels = cube_texels(at.face, column.texel, row.texel, size);
                for (const CubeTexelPlace& place : texels) {
                    ++result.texels;
                    add_texel(image.texel(level, 6 * cube + place.face, place.x, place.y),
                              row.weight * column.weight * weight / double(texels.size()), result);
                }
            }
        }
    });
    return result;
}

}  // namespace rawtexel::texunit::reference
