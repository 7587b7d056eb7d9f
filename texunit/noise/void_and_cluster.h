// Blue-noise masks by Ulichney's void-and-cluster method (1993, "The void-and-cluster method for dither array generation"), extended to
// time as by Wolfe et al. 2022 ("Spatiotemporal Blue Noise Masks") and to pairs of numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rawtexel::texunit::noise {

/// A torus of extent x extent pixels and `depth` slices of time; entry (x, y, z) lies at x + extent*(y + extent*z).
struct MaskShape {
    int extent = 64;  ///< pixels, a power of two
    int depth = 1;    ///< slices, a power of two

    constexpr size_t size() const { return size_t(extent) * size_t(extent) * size_t(depth); }
};

/// Two entries repel each other by a Gaussian of their distance: `sigma` pixels within a slice, `sigma` slices within a column, and not at
/// all elsewhere. Sigma is at most 1.9. The method starts from a pattern that has `initial_density` of the entries.
struct VoidAndCluster {
    MaskShape shape;
    uint32_t seed = 0;
    double sigma = 1.9;
    double initial_density = 0.1;
};

/// The ranks 0..size-1 of all entries: those below any rank are spread evenly over each slice and along each column.
std::vector<uint32_t> make_mask(const VoidAndCluster& method);

inline constexpr int kCompanionStrata = 64;

/// The second numbers of pairs whose first are the ranks `first`; a mask itself. Two additions to the method make the pairs even:
/// - A share of the repulsion acts only between entries with similar first numbers (the similarity of Georgiev and Fajardo 2016,
/// "Blue-noise
///   Dithered Sampling", as a weight of the energy): entries below one rank of the first mask and another of the second are spread evenly
///   as well, and with them whatever a smooth function makes of both numbers.
/// - Ranks are given in rounds, each of which takes one entry from each of kCompanionStrata equal ranges of the first numbers (a Latin
///   square, Chiu, Shirley and Wang 1994, "Multi-Jittered Sampling"): cells of kCompanionStrata x size/kCompanionStrata hold one pair each.
std::vector<uint32_t> make_companion(const VoidAndCluster& method, std::span<const uint32_t> first);

}  // namespace rawtexel::texunit::noise
