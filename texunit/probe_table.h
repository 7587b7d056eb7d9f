// Where the n probes of an anisotropic lookup lie along the major axis, and how much of the mean each is. Both depend on n and i alone.
#pragma once

#include <array>

namespace rawtexel::texunit {

inline constexpr int kMostProbes = 64;

/// Probe i of n, 1 <= n <= kMostProbes, at [64*n + i]. The mean is taken as a running one, m = lerp(share, m, probe), which never leaves
/// the probes' bounds and keeps a constant bit for bit.
struct ProbeTable {
    alignas(64) std::array<float, kMostProbes*(kMostProbes + 1)> place;
    alignas(
        64) std::array<float, kMostProbes*(kMostProbes + 1)> share;  ///< weight of probe i over that of probes 0..i; share of probe 0 is 1
    alignas(64) std::array<float, kMostProbes*(kMostProbes + 1)> weight;  ///< of the whole: those of n probes sum to 1
    std::array<float, kMostProbes + 1> gap;                               ///< between neighbouring probes
};

/// The D3D and Vulkan line: equal weights, place = (i + 1/2)/n - 1/2 of the major axis.
const ProbeTable& uniform_probes();

/// Equal steps over +-2 standard deviations with the normal density as weight; places are in units of the standard deviation of the
/// weighted places themselves, so that probes at place*sigma have variance sigma^2 for every n > 1.
const ProbeTable& gaussian_probes();

}  // namespace rawtexel::texunit
