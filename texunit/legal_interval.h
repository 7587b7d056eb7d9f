// Whether a colour is one that an implementation of given precision may return for a lookup: not a comparison with one value but with the
// interval of all legal ones, as Vulkan's conformance tests judge (VK-GL-CTS, "texture lookup verifier"). For shader ports and other
// texture units, and for our own Precision::Gpu.
#pragma once

#include "texunit/sampler.h"
#include "texunit/texel_source.h"

#include <array>
#include <functional>
#include <string>

namespace rawtexel::texunit {

/// A texture to be judged against: flat, an array, a volume, a cube map or an array of those.
struct JudgedTexture {
    Shape shape;
    /// Linear RGBA of texel (x, y), inside the level, of a slice: array layer, 6*cube + face, or depth slice.
    std::function<std::array<double, 4>(int level, int slice, int x, int y)> texel;
};

/// Components are u and v; u, v and w of a volume; x, y and z of a direction into a cube map.
struct JudgedLookup {
    std::array<double, 3> at{};
    std::array<double, 3> dx{}, dy{};  ///< change of `at` over one pixel to the right, one pixel down
    double layer = 0;                  ///< of an array, or cube of an array of cubes: the nearest there is
};

/// What the implementation promises. Defaults: the high quality of the conformance tests for 2-D textures, but 8 bits of subtexel and level
/// precision, which D3D11.3 7.18 asks for.
struct LegalPrecision {
    int coordinate_bits = 20;  ///< accurate bits of a coordinate's mantissa, before it is scaled; of a direction before it is projected
    int derivative_bits = 18;  ///< of a derivative's
    int subtexel_bits = 8;     ///< fractional bits of texel-space coordinates; each may be off by 2^-bits
    int lod_bits = 8;          ///< of the level of detail
    /// Vulkan lets the scale factor lie anywhere between the largest component of a derivative and sqrt(2) times their sum. False: it is
    /// the length of the longer derivative (SamplerState::lod_rule), up to the derivatives' precision. Of anisotropic lookups both factors,
    /// and so their ratio and the number of probes.
    bool approximate_scale = true;
    double colour_threshold = 1.0 / 255;  ///< every channel may be off by this much
};

struct LegalVerdict {
    bool legal = false;
    std::array<double, 4> least{}, most{};  ///< of all legal colours, each channel by itself, without the threshold
    std::array<double, 4> closest{};        ///< the legal colour found closest to the one judged; of probes, the interval's nearest
    double excess = 0;                      ///< of that: largest difference of a channel, in thresholds; at most 1 where legal
    double least_lod = 0, most_lod = 0;     ///< legal levels of detail, after bias and bounds
    int fewest_probes = 1, most_probes = 1;
};

/// Judges `colour` as the result of `lookup` under `sampler`, whose `precision` is not looked at and whose ellipse must be off. Legal if
/// some level of detail and some coordinates within the precision explain all four channels at once; coordinates of two levels may be off
/// independently; where they may be off by 32 texels and more, every colour is. Any kernel; Gaussians narrower than 0.1 texels are judged
/// less exactly. A coordinate that is not finite reads as 0, a derivative that is not finite makes every level legal.
///
/// Cube maps: any face that the direction's precision reaches, seamless edges, beyond a corner the mean of the three texels that meet
/// there. Volumes and cube maps are isotropic whatever `probes` says.
///
/// Anisotropic lookups are judged by our rule, for D3D and Vulkan leave number and places of the probes to implementations: with ratio eta
/// of the axes, ceil(eta * min(longer axis over eta in texels, 1)) probes of equal weight, probe i of n at (i + 1/2)/n - 1/2 of the longer
/// axis, at the level of that axis over eta; with S2 (SamplerState::probe_variance) the normal probes of docs/anisotropy.md. Legal if some
/// ratio, axis, number and level within the precision and coordinates of each probe by itself give the colour, or what lies between such
/// colours: colours of many probes are judged by how far all reach in 80 directions.
LegalVerdict judge_lookup(const JudgedTexture& texture, const SamplerState& sampler, const JudgedLookup& lookup,
                          const std::array<double, 4>& colour, const LegalPrecision& precision = {});

/// What an implementation probably did that returned a colour which is not legal: the first common mistake under which it would be, such
/// as "layer off by one" or "half as many probes"; empty where none explains it. Takes as long as some fifty verdicts.
std::string likely_cause(const JudgedTexture& texture, const SamplerState& sampler, const JudgedLookup& lookup,
                         const std::array<double, 4>& colour, const LegalPrecision& precision = {});

/// One line for people: the interval, what was found and the closest legal colour.
std::string to_string(const LegalVerdict& verdict, const std::array<double, 4>& colour);

}  // namespace rawtexel::texunit
