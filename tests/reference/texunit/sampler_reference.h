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
    std::function<Colour(int level, int x, int y)> texel;   ///< linear RGBA; 0 <= x < extent of the level
};

struct Lookup {
    float u, v, dudx, dvdx, dudy, dvdy;
};

struct Sample {
    Colour colour{};
    Colour least{}, most{};     ///< of the texels read with a weight that is not 0
    double largest = 0;         ///< largest absolute value read
    int taps = 0;
    bool mixes_levels = false;
    double lambda = 0;          ///< before any clamp
};

/// `lambda_shift` is added to the level of detail: with it a test asks what the other side of a level decision would give.
Sample sample(const Image& image, const SamplerState& sampler, const Lookup& at, double lambda_shift = 0);

}  // namespace rawtexel::texunit::reference
