// Sampler state: which kernel, which levels, how coordinates wrap. Plain data with one spelling for command line, JSON and tests.
#pragma once

#include "texunit/estimator.h"
#include "texunit/kernel.h"

#include <array>
#include <limits>
#include <optional>
#include <string_view>

namespace rawtexel::texunit {

/// What a texel index outside the texture means (Vulkan "Wrapping Operation").
enum class Wrap { Repeat, MirroredRepeat, ClampToEdge, ClampToBorder, MirrorOnce };

/// Which mip levels a minified lookup reads.
enum class MipMode { None, Nearest, Linear };

/// How lambda, the anisotropy ratio and the major axis follow from derivatives: from the longer and the shorter one (Vulkan "Scale Factor
/// Operation", D3D11.3 7.18.11), or from the singular values of their matrix, which are the axes of the ellipse.
enum class LodRule { D3d, Exact };

/// Texel and level fractions unquantised, or in steps of 1/256 as D3D11.3 7.18.8 and Vulkan at 8 bits.
enum class Precision { Exact, Gpu };

struct SamplerState {
    Wrap wrap_s = Wrap::Repeat, wrap_t = Wrap::Repeat;
    Kernel magnify = Kernel::Bilinear;  ///< used where lambda <= 0
    Kernel minify = Kernel::Bilinear;
    MipMode mip = MipMode::Linear;
    Wrap wrap_r = Wrap::Repeat;   ///< third axis of 3-D textures
    int probes = 1;               ///< most anisotropic probes, 1..64
    float probe_variance = 0.0f;  ///< S2 > 0: probes and level of total covariance S2*J*J^T + I/6; 0: probes by the D3D and Vulkan rule
    float ellipse = 0.0f;         ///< S2 > 0: filter by the exact ellipse of covariance S2*J*J^T + I/6 instead, over level 0
    Estimator estimator = Estimator::All;  ///< how draws are made (texunit/draw.h); sample_wave weighs every tap whatever it says
    /// Of drawn ellipses: how much finer than the coarsest level that leaves room for the minor axis they draw, levels >= 0; what that
    /// level has not filtered goes into the draw. Infinite: level 0.
    float hybrid_bias = std::numeric_limits<float>::infinity();
    LodRule lod_rule = LodRule::D3d;
    Precision precision = Precision::Exact;
    float lod_bias = 0.0f;                    ///< added to lambda before it is clamped
    float min_lod = 0.0f, max_lod = 1000.0f;  ///< levels; min_lod wins
    std::array<float, 4> border{};            ///< linear RGBA beyond the edges of ClampToBorder
    bool reads_alpha = true;                  ///< false: nobody looks at the alpha that comes back, which is unspecified then

    /// One probe at the level that the longer axis asks for.
    bool is_isotropic() const { return probes == 1 && probe_variance <= 0.0f && ellipse <= 0.0f; }
    bool operator==(const SamplerState&) const = default;
};

std::string_view to_string(Wrap wrap);            // repeat mirror clamp border mirror-once
std::string_view to_string(MipMode mode);         // none nearest linear
std::string_view to_string(LodRule rule);         // d3d exact
std::string_view to_string(Precision precision);  // exact gpu
std::optional<Wrap> parse_wrap(std::string_view text);
std::optional<MipMode> parse_mip_mode(std::string_view text);
std::optional<LodRule> parse_lod_rule(std::string_view text);
std::optional<Precision> parse_precision(std::string_view text);

}  // namespace rawtexel::texunit
