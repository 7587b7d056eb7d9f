#include "texunit/sampler.h"

#include <array>
#include <utility>

namespace rawtexel::texunit {
namespace {

template <class T, size_t n>
using Spellings = std::array<std::pair<T, std::string_view>, n>;

constexpr Spellings<Wrap, 5> kWraps = {{{Wrap::Repeat, "repeat"},
                                        {Wrap::MirroredRepeat, "mirror"},
                                        {Wrap::ClampToEdge, "clamp"},
                                        {Wrap::ClampToBorder, "border"},
                                        {Wrap::MirrorOnce, "mirror-once"}}};
constexpr Spellings<MipMode, 3> kMipModes = {{{MipMode::None, "none"}, {MipMode::Nearest, "nearest"}, {MipMode::Linear, "linear"}}};
constexpr Spellings<LodRule, 2> kLodRules = {{{LodRule::D3d, "d3d"}, {LodRule::Exact, "exact"}}};
constexpr Spellings<Precision, 2> kPrecisions = {{{Precision::Exact, "exact"}, {Precision::Gpu, "gpu"}}};

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
std::string_view to_string(MipMode mode) { return spelling(kMipModes, mode); }
std::string_view to_string(LodRule rule) { return spelling(kLodRules, rule); }
std::string_view to_string(Precision precision) { return spelling(kPrecisions, precision); }

std::optional<Wrap> parse_wrap(std::string_view text) { return parse(kWraps, text); }
std::optional<MipMode> parse_mip_mode(std::string_view text) { return parse(kMipModes, text); }
std::optional<LodRule> parse_lod_rule(std::string_view text) { return parse(kLodRules, text); }
std::optional<Precision> parse_precision(std::string_view text) { return parse(kPrecisions, text); }

}  // namespace rawtexel::texunit
