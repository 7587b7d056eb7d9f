#include "texunit/sampler.h"

#include <array>
#include <utility>

namespace rawtexel::texunit {
namespace {

template <class T, size_t n>
using Spellings = std::array<std::pair<T, std::string_view>, n>;

constexpr Spellings<Wrap, 3> kWraps = {{{Wrap::Repeat, "repeat"}, {Wrap::MirroredRepeat, "mirror"}, {Wrap::ClampToEdge, "clamp"}}};
constexpr Spellings<Kernel, 2> kKernels = {{{Kernel::Nearest, "nearest"}, {Kernel::Bilinear, "bilinear"}}};
constexpr Spellings<MipMode, 3> kMipModes = {{{MipMode::None, "none"}, {MipMode::Nearest, "nearest"}, {MipMode::Linear, "linear"}}};

template <class T, size_t n>
std::string_view spelling(const Spellings<T, n>& spellings, T value) {
    for (const auto& [known, text] : spellings) {
        if (known == value) return text;
    }
    return {};
}

template <class T, size_t n>
std::optional<T> parse(const Spellings<T, n>& spellings, std::string_view text) {
    for (const auto& [known, name] : spellings) {
        if (name == text) return known;
    }
    return std::nullopt;
}

}  // namespace

std::string_view to_string(Wrap wrap) { return spelling(kWraps, wrap); }
std::string_view to_string(Kernel kernel) { return spelling(kKernels, kernel); }
std::string_view to_string(MipMode mode) { return spelling(kMipModes, mode); }

std::optional<Wrap> parse_wrap(std::string_view text) { return parse(kWraps, text); }
std::optional<Kernel> parse_kernel(std::string_view text) { return parse(kKernels, text); }
std::optional<MipMode> parse_mip_mode(std::string_view text) { return parse(kMipModes, text); }

}  // namespace rawtexel::texunit
