// Whether a colour is one that an implementation of given precision may return for a lookup: not a comparison with one value but with the
// interval of all legal ones, as Vulkan's conformance tests judge (VK-GL-CTS, "texture lookup verifier"). For shader ports and other
// texture units, and for our own Precision::Gpu.
#pragma once

#include "texunit/sampler.h"

#include <array>
#include <functional>
#include <string>

namespace rawtexel::texunit {

/// A 2-D texture, or a layer of one, to be judged against.
struct JudgedTexture {
    int width = 1, height = 1;  ///< texels of level 0
    int levels = 1;
    std::function<std::array<double, 4>(int level, int x, int y)> texel;  ///< linear RGBA; 0 <= x < extent of the level
};

struct JudgedLookup {
    double u = 0, v = 0;
    double dudx = 0, dvdx = 0, dudy = 0, dvdy = 0;
};

/// What the implementation promises. Defaults: the high quality of the conformance tests for 2-D textures, but 8 bits of subtexel and level
/// precision, which D3D11.3 7.18 asks for.
struct LegalPrecision {
    int coordinate_bits = 20;  ///< accurate bits of a coordinate's mantissa, before it is scaled
    int derivative_bits = 18;  ///< of a derivative's
    int subtexel_bits = 8;     ///< fractional bits of texel-space coordinates; each may be off by 2^-bits
    int lod_bits = 8;          ///< of the level of detail
    /// Vulkan lets the scale factor lie anywhere between the largest component of the derivatives and sqrt(2) times their sum. False: it is
    /// the length of the longer derivative (SamplerState::lod_rule), up to the derivatives' precision.
    bool approximate_scale = true;
    double colour_threshold = 1.0 / 255;  ///< every channel may be off by this much
};

struct LegalVerdict {
    bool legal = false;
    std::array<double, 4> least{}, most{};  ///< of all legal colours, each channel by itself, without the threshold
    std::array<double, 4> closest{};        ///< the legal colour found closest to the one judged
    double excess = 0;                      ///< of that: largest difference of a channel, in thresholds; at most 1 where legal
    double least_lod = 0, most_lod = 0;     ///< legal levels of detail, after bias and bounds
};

/// Judges `colour` as the result of `lookup` under `sampler`, whose `precision` is not looked at and whose probes and ellipse must be off.
/// Legal if some level of detail and some coordinates within the precision explain all four channels at once; coordinates of two levels
/// may be off independently. Any kernel; Gaussians narrower than 0.1 texels are judged less exactly. A coordinate that is not finite reads
/// as 0, a derivative that is not finite makes every level legal.
LegalVerdict judge_lookup(const JudgedTexture& texture, const SamplerState& sampler, const JudgedLookup& lookup,
                          const std::array<double, 4>& colour, const LegalPrecision& precision = {});

/// One line for people: the interval, what was found and the closest legal colour.
std::string to_string(const LegalVerdict& verdict, const std::array<double, 4>& colour);

}  // namespace rawtexel::texunit
