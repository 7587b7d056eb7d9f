// One texture lookup in double precision, one pixel at a time, written from the Vulkan specification ("Image Operations") and
// D3D11.3 7.18. Float coordinates are taken as exact. Nothing is shared with the product's sampling code but the sampler's description.
#pragma once

#include "texunit/sampler.h"

#include <array>
#include <functional>

namespace rawtexel::texunit::reference {

using Colour = std::array<double, 4>;

struct Image {
    int width, height, levels;
    std::function<Colour(int level, int x, int y)> texel;  ///< linear RGBA; 0 <= x < extent of the level
};

/// A texture of any shape. `slice` is an array layer, 6*cube + face, or a depth slice.
struct ShapedImage {
    int width, height, depth, levels;
    std::function<Colour(int level, int slice, int x, int y)> texel;
};

struct Lookup {
    float u, v, dudx, dvdx, dudy, dvdy;
};

/// Into a volume, or by direction into a cube map.
struct Lookup3 {
    std::array<float, 3> position, dx, dy;
};

/// Moves thresholds: with it a test asks what the other side of a discrete decision would give.
struct Shift {
    double lambda = 0;              ///< added to the level of detail
    std::array<double, 2> cut{};    ///< added to the reach of gaussian-point along s and t, texels
    std::array<double, 2> texel{};  ///< added to texel-space coordinates along s and t, before they are snapped for Precision::Gpu
};

struct Sample {
    Colour colour{};
    Colour least{}, most{};  ///< of the texels read with a weight that is not 0
    double largest = 0;      ///< largest absolute value read, or of a border that is
    int taps = 0;            ///< with those that take the border
    int texels = 0;          ///< reads; a tap beyond a corner of a cube map is three
    double magnitude = 0;    ///< sum of the weights' magnitudes
    bool mixes_levels = false;
    double lambda = 0;  ///< after bias and bounds, before the clamp to the levels
};

/// `lambda_shift` as in Shift.
Sample sample(const Image& image, const SamplerState& sampler, const Lookup& at, double lambda_shift = 0);

/// Isotropic, in slice `layer`.
Sample sample_layer(const ShapedImage& image, const SamplerState& sampler, const Lookup& at, int layer, const Shift& shift = {});
Sample sample_volume(const ShapedImage& image, const SamplerState& sampler, const Lookup3& at, const Shift& shift = {});
Sample sample_cube(const ShapedImage& image, const SamplerState& sampler, const Lookup3& direction, int cube, const Shift& shift = {});

}  // namespace rawtexel::texunit::reference
