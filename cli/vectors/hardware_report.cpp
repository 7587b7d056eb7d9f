#include "cli/vectors/hardware_report.h"

#include "cli/vectors/legal_case.h"
#include "texunit/bc_rounding.h"
#include "texunit/block_codec.h"
#include "texunit/texel_value.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <span>

namespace rawtexel::cli {
namespace {

using texunit::Format;
using Json = nlohmann::ordered_json;

constexpr std::array kBits = {8, 7, 6, 5, 4};

/// Variances of the pixel filters that an implementation may mean (docs/anisotropy.md).
constexpr std::array kVariances = {1.0 / 24, 1.0 / 16, 1.0 / 12, 1.0 / 8, 1.0 / 6, 1.0 / 4, 1.0 / 3, 1.0 / 2, 2.0 / 3, 1.0, 4.0 / 3};

double largest_difference(const std::array<float, 4>& a, const std::array<float, 4>& b) {
    double largest = 0;
    for (size_t c = 0; c < 4; ++c) {
        if (a[c] == b[c]) continue;
        const double difference = std::abs(double(a[c]) - double(b[c]));
        largest = std::isfinite(difference) ? std::max(largest, difference) : std::numeric_limits<double>::infinity();
    }
    return largest;
}

bool all_legal(const Suite& suite, const CaseGroup& group, std::span<const PortResult> results, const HardwarePrecision& precision) {
    for (size_t n = group.first; n < size_t(group.first) + group.count; ++n) {
        if (!judge_hardware(suite, suite.cases[n], results[n], precision).legal) return false;
    }
    return true;
}

void find_bits(const Suite& suite, const CaseGroup& group, std::span<const PortResult> results, HardwareAgreement& agreement) {
    constexpr int kLeast = kBits.back();
    const auto legal = [&](const HardwarePrecision& precision) { return all_legal(suite, group, results, precision); };
    const auto subtexel = std::ranges::find_if(kBits, [&](int bits) { return legal({bits, kLeast, false}); });
    if (subtexel == kBits.end()) return;
    agreement.subtexel_bits = *subtexel;
    if (suite.cases[group.first].mip == 0) return;
    agreement.exact_scale = legal({*subtexel, kLeast, true});
    agreement.lod_bits = *std::ranges::find_if(kBits, [&](int bits) { return legal({*subtexel, bits, agreement.exact_scale}); });
}

/// Answers of the texture unit to the cases of a group, changed so.
template <class Change>
std::vector<std::array<float, 4>> answers(const Suite& suite, const CaseGroup& group, const Change& change) {
    std::vector<std::array<float, 4>> values;
    for (size_t n = group.first; n < size_t(group.first) + group.count; ++n) {
        CaseRecord record = suite.cases[n];
        change(record);
        values.push_back(evaluate(suite, record).value);
    }
    return values;
}

double rms(const std::vector<std::array<float, 4>>& a, const std::vector<std::array<float, 4>>& b) {
    double squares = 0;
    for (size_t n = 0; n < a.size(); ++n) {
        for (size_t c = 0; c < 4; ++c) squares += std::pow(double(a[n][c]) - double(b[n][c]), 2);
    }
    return std::sqrt(squares / (4 * double(a.size())));
}

/// Standard deviation of the values, all channels together: that of always answering their mean.
double deviation(const std::vector<std::array<float, 4>>& values) {
    double sum = 0, squares = 0;
    for (const auto& value : values) {
        for (const float channel : value) sum += double(channel), squares += double(channel) * double(channel);
    }
    const double count = 4 * double(values.size()), mean = sum / count;
    return std::sqrt(squares / count - mean * mean);
}

HardwareAgreement::Footprint measure_footprint(const Suite& suite, const CaseGroup& group, std::span<const PortResult> results) {
    std::vector<std::array<float, 4>> came;
    for (size_t n = group.first; n < size_t(group.first) + group.count; ++n) came.push_back(results[n].value);
    const auto probes = answers(suite, group, [](CaseRecord&) {});
    const auto isotropic = answers(suite, group, [](CaseRecord& c) { c.probes = 1; });
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    HardwareAgreement::Footprint best{.s2 = 0, .error = kInfinity, .ours = kInfinity, .isotropic = kInfinity};
    for (const double s2 : kVariances) {
        const auto truth = answers(suite, group, [&](CaseRecord& c) { c.ellipse = float(s2); });
        const double scale = 1 / deviation(truth), error = scale * rms(came, truth);
        if (error < best.error) best.error = error, best.s2 = s2;
        best.ours = std::min(best.ours, scale * rms(probes, truth));
        best.isotropic = std::min(best.isotropic, scale * rms(isotropic, truth));
    }
    return best;
}

/// The texel of a nearest lookup, decoded by a rule.
std::array<float, 4> decoded(const SuiteTexture& texture, const Expectation& e, texunit::BcRounding rounding) {
    const auto unit = size_t(texunit::info(texture.format()).bytes_per_block);
    const int columns = (texture.shape().width + 3) / 4;
    alignas(16) std::array<std::byte, 16 * 16> texels{};
    decode_block(texture.format(), texture.bytes().data() + unit * size_t(e.expected.x / 4 + columns * (e.expected.y / 4)), texels.data(),
                 rounding);
    const texunit::TexelLayout& layout = texunit::layout(texture.format(), rounding);
    const auto at = size_t(e.expected.x % 4 + 4 * (e.expected.y % 4)) * size_t(bytes_per_texel(layout.storage));
    return texunit::load_texel(layout, texels.data() + at);
}

HardwareAgreement::Blocks measure_blocks(const Suite& suite, const CaseGroup& group, std::span<const PortResult> results) {
    HardwareAgreement::Blocks blocks;
    for (size_t n = group.first; n < size_t(group.first) + group.count; ++n)
        blocks.largest = std::max(blocks.largest, largest_difference(results[n].value, suite.expected[n].expected.value));
    blocks.from_rounding = blocks.largest;
    const SuiteTexture& texture = suite.textures[suite.cases[group.first].texture];
    if (!has_bc_rounding(texture.format())) return blocks;
    blocks.from_rounding = std::numeric_limits<double>::infinity();
    for (const texunit::BcRounding rounding : texunit::kBcRoundings) {
        double largest = 0;
        for (size_t n = group.first; n < size_t(group.first) + group.count; ++n)
            largest = std::max(largest, largest_difference(results[n].value, decoded(texture, suite.expected[n], rounding)));
        if (largest < blocks.from_rounding) blocks.from_rounding = largest, blocks.rounding = to_string(rounding);
    }
    return blocks;
}

std::string print(const char* form, double value) {
    std::array<char, 64> text;
    std::snprintf(text.data(), text.size(), form, value);
    return text.data();
}

bool is_compressed(const Suite& suite, const CaseGroup& group) {
    const auto cases = std::span(suite.cases).subspan(group.first, group.count);
    return std::ranges::all_of(cases, [&](const CaseRecord& record) { return record.texture == cases[0].texture; }) &&
           texunit::info(suite.textures[cases[0].texture].format()).block_compressed;
}

std::string agreement_text(const HardwareAgreement& a) {
    if (!a.asked) return "not asked: the device has no such images, or the shader no binding for them";
    if (a.footprint) {
        const auto& f = *a.footprint;
        return print("%.1f", 100 * f.error) + " % from the ellipse of S2 = " + print("%.3f", f.s2) + " (our 16 probes " +
               print("%.1f", 100 * f.ours) + " %, isotropic " + print("%.1f", 100 * f.isotropic) + " %)" +
               (f.error < f.isotropic ? "" : ": no better than isotropic");
    }
    if (a.blocks) {
        std::string text = "off by " + print("%.3f", 255 * a.blocks->largest) + "/255 at most";
        if (!a.blocks->rounding.empty())
            text += ", by " + print("%.3f", 255 * a.blocks->from_rounding) + "/255 from the rule '" + a.blocks->rounding + "'";
        return text;
    }
    if (!a.subtexel_bits) return "not even at 4 bits";
    std::string text = "agrees at " + std::to_string(*a.subtexel_bits) + " subtexel bits";
    if (!a.lod_bits) return text;
    return text + " and " + std::to_string(*a.lod_bits) + " level bits of " +
           (a.exact_scale ? "the exact scale factor" : "an approximate scale factor");
}

}  // namespace

texunit::LegalVerdict judge_hardware(const Suite& suite, const CaseRecord& record, const PortResult& came,
                                     const HardwarePrecision& precision) {
    return judge_lookup(judged_texture(suite, record), sampler_of(record), judged_lookup(record), judged_colour(came.value),
                        legal_precision(suite, record, precision));
}

texunit::LegalPrecision legal_precision(const Suite& suite, const CaseRecord& record, const HardwarePrecision& precision) {
    return {.subtexel_bits = precision.subtexel_bits,
            .lod_bits = precision.lod_bits,
            .approximate_scale = !precision.exact_scale,
            .colour_threshold = hardware_threshold(suite, record)};
}

double hardware_threshold(const Suite& suite, const CaseRecord& record) {
    switch (suite.textures[record.texture].format()) {
        // The widest rule of a vendor that is known, NVIDIA's green, is 5.4/255 off the exact interpolation.
        case Format::BC1RgbUnorm:
        case Format::BC1RgbaUnorm:
        case Format::BC2Unorm:
        case Format::BC3Unorm: return 6.0 / 255;
        case Format::BC4Unorm:
        case Format::BC5Unorm: return 2.0 / 255;
        case Format::BC4Snorm:
        case Format::BC5Snorm: return 2.0 / 127;
        // Bit exact everywhere.
        case Format::BC6HUfloat:
        case Format::BC6HSfloat:
        case Format::BC7Unorm: return 1e-6;
        default: return (record.minify == 0 ? 0.5 : 1.0) / 255;
    }
}

std::vector<HardwareAgreement> measure_hardware(const Suite& suite, std::span<const PortResult> results,
                                                std::span<const uint32_t> unsupported) {
    std::vector<HardwareAgreement> agreements;
    for (const CaseGroup& group : suite.groups) {
        HardwareAgreement& agreement = agreements.emplace_back();
        agreement.group = group.name;
        agreement.asked = std::ranges::find(unsupported, suite.cases[group.first].texture) == unsupported.end();
        if (!agreement.asked) continue;
        if (group.name.starts_with(kAnisotropicGroup)) {
            agreement.footprint = measure_footprint(suite, group, results);
        } else if (is_compressed(suite, group)) {
            agreement.blocks = measure_blocks(suite, group, results);
        } else {
            find_bits(suite, group, results, agreement);
        }
    }
    return agreements;
}

std::string hardware_text(std::span<const HardwareAgreement> agreements) {
    std::string text;
    for (const HardwareAgreement& agreement : agreements) text += "  " + agreement.group + ": " + agreement_text(agreement) + "\n";
    return text;
}

Json hardware_json(std::span<const HardwareAgreement> agreements) {
    Json list = Json::array();
    for (const HardwareAgreement& a : agreements) {
        Json one = {{"group", a.group}, {"asked", a.asked}, {"holds", a.holds()}};
        if (a.subtexel_bits) one["subtexel_bits"] = *a.subtexel_bits;
        if (a.lod_bits) one["lod_bits"] = *a.lod_bits, one["exact_scale"] = a.exact_scale;
        if (a.footprint)
            one["footprint"] = {
                {"s2", a.footprint->s2}, {"error", a.footprint->error}, {"ours", a.footprint->ours}, {"isotropic", a.footprint->isotropic}};
        if (a.blocks)
            one["blocks"] = {{"largest", a.blocks->largest}, {"rounding", a.blocks->rounding}, {"from_rounding", a.blocks->from_rounding}};
        list.push_back(std::move(one));
    }
    return list;
}

}  // namespace rawtexel::cli
