// How well a device's own texture unit filters: with how many bits it agrees, how far its anisotropic footprints are from the ellipse, and
// how it rounds compressed texels.
#pragma once

#include "cli/vectors/expectation.h"
#include "cli/vectors/judge.h"
#include "texunit/legal_interval.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rawtexel::cli {

inline constexpr const char* kHardwareSuite = "hardware";
inline constexpr const char* kAnisotropicGroup = "anisotropic 1:";

/// Precision of an implementation. Vulkan lets the scale factor of a footprint lie within more than a factor of sqrt(2); `exact_scale`: it
/// is the length of the longer derivative.
struct HardwarePrecision {
    int subtexel_bits = 8, lod_bits = 8;
    bool exact_scale = false;
};
/// Subtexel and level bits that every implementation has (Vulkan "Required Limits": subTexelPrecisionBits, mipmapPrecisionBits).
inline constexpr HardwarePrecision kLeastPrecision{4, 4, false};

texunit::LegalPrecision legal_precision(const Suite& suite, const CaseRecord& record, const HardwarePrecision& precision);

/// The verdict of texunit's legal-interval verifier on an answer, for an implementation of this precision.
texunit::LegalVerdict judge_hardware(const Suite& suite, const CaseRecord& record, const PortResult& came,
                                     const HardwarePrecision& precision);

/// How far each channel may be off beside that: weights of 8-bit texels are rounded, compressed ones interpolated in several ways.
double hardware_threshold(const Suite& suite, const CaseRecord& record);

/// Of one group of the suite `hardware`.
struct HardwareAgreement {
    std::string group;
    // Of filters: the most bits at which all cases are legal; nullopt where not even the fewest are.
    std::optional<int> subtexel_bits, lod_bits;  ///< lod_bits of those that read levels
    bool exact_scale = false;                    ///< at these bits, with levels of the exact scale factor
    // Of anisotropic footprints, root mean square of (answer - ellipse) over the ellipses' standard deviation: 1 is
    // what always answering their mean has.
    struct Footprint {
        double s2 = 0;  ///< variance of the pixel filter, in pixels^2, that suits the answers best
        double error = 0, ours = 0,
               isotropic = 0;  ///< of the device, of our 16 probes and of a trilinear lookup, each at what suits it best
    };
    std::optional<Footprint> footprint;
    // Of compressed formats.
    struct Blocks {
        double largest = 0;    ///< difference from the exact interpolation, of any channel
        std::string rounding;  ///< the rule (texunit/bc_rounding.h) that the answers are nearest to; empty where there is only one
        double from_rounding = 0;
    };
    std::optional<Blocks> blocks;
    bool asked = true;  ///< the device has such images

    /// Footprints of several probes and the rounding of blocks are measured, not judged: Vulkan leaves them open.
    bool holds() const { return !asked || footprint || blocks || subtexel_bits; }
};

/// Of every group. `unsupported`: textures that the device has no images of.
std::vector<HardwareAgreement> measure_hardware(const Suite& suite, std::span<const PortResult> results,
                                                std::span<const uint32_t> unsupported);

/// One line a group.
std::string hardware_text(std::span<const HardwareAgreement> agreements);
nlohmann::ordered_json hardware_json(std::span<const HardwareAgreement> agreements);

}  // namespace rawtexel::cli
