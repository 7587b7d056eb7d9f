// Sampler state: which kernel, which levels, how coordinates wrap. Plain data with one spelling for command line, JSON and tests.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace rawtexel::texunit {

/// What a coordinate outside [0, 1) means (Vulkan "Wrapping Operation").
enum class Wrap { Repeat, MirroredRepeat, ClampToEdge };

/// Reconstruction kernel.
enum class Kernel { Nearest, Bilinear };

/// Which mip levels a minified lookup reads.
enum class MipMode { None, Nearest, Linear };

struct SamplerState {
    Wrap wrap_s = Wrap::Repeat, wrap_t = Wrap::Repeat;
    Kernel magnify = Kernel::Bilinear;   ///< used where lod <= 0
    Kernel minify = Kernel::Bilinear;
    MipMode mip = MipMode::Linear;

    bool operator==(const SamplerState&) const = default;
};

std::string_view to_string(Wrap wrap);        // repeat mirror clamp
std::string_view to_string(Kernel kernel);    // nearest bilinear
std::string_view to_string(MipMode mode);     // none nearest linear
std::optional<Wrap> parse_wrap(std::string_view text);
std::optional<Kernel> parse_kernel(std::string_view text);
std::optional<MipMode> parse_mip_mode(std::string_view text);

}  // namespace rawtexel::texunit
