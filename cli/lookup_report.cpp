#include "cli/lookup_report.h"

#include "cli/comparison_report.h"
#include "cli/option_values.h"
#include "cli/texture_info.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace rawtexel::cli {
namespace {

using Json = nlohmann::ordered_json;
using texunit::LookupTrace;
using texunit::SamplerState;
using texunit::Shape;
using texunit::TracedTap;

/// What a tap's slice is called in a texture of this shape: nothing in a flat one.
std::vector<std::pair<std::string, int>> slice_names(const Shape& shape, int slice) {
    if (shape.depth > 1) return {{"z", slice}};
    if (shape.cube && shape.cubes() > 1) return {{"layer", slice / shape.faces()}, {"face", slice % shape.faces()}};
    if (shape.cube) return {{"face", slice}};
    if (shape.layers > 1) return {{"layer", slice}};
    return {};
}

Json tap_json(const Shape& shape, const TracedTap& tap) {
    Json json{{"level", tap.level}};
    const auto texel = [&](const std::string& name, int index) { json[name] = tap.border ? Json(nullptr) : Json(index); };
    texel("x", tap.x);
    texel("y", tap.y);
    for (const auto& [name, index] : slice_names(shape, tap.slice)) texel(name, index);
    if (tap.border) json["border"] = true;
    json["weight"] = tap.weight;
    json["value"] = tap.value;
    return json;
}

using NamedNumber = std::pair<std::string, float>;
std::vector<NamedNumber> named(const texunit::RoleNumbers& numbers) {
    std::vector<NamedNumber> all{{"x", numbers.x}, {"y", numbers.y}};
    const auto add = [&](const char* role, const std::optional<float>& number) {
        if (number) all.emplace_back(role, *number);
    };
    add("z", numbers.z);
    add("level", numbers.level);
    add("probe", numbers.probe);
    add("sign", numbers.sign);
    return all;
}

Json drawn_tap_json(const Shape& shape, const texunit::DrawnTap& drawn) {
    Json json = tap_json(shape, drawn.tap);
    json["draw"] = drawn.draw;
    for (const auto& [role, number] : named(drawn.numbers)) json["random"][role] = number;
    return json;
}

std::string describe_numbers(const texunit::DrawTrace& drawn) {
    std::string text;
    for (const texunit::DrawnTap& tap : drawn.taps) {
        text += "Draw " + std::to_string(tap.draw) + (tap.tap.weight < 0 ? ", negative weight" : "") + ": random numbers";
        std::string separator = " ";
        for (const auto& [role, number] : named(tap.numbers)) text += std::exchange(separator, ", ") + role + " " + print_number(number);
        text += '\n';
    }
    return text;
}

/// The lookup as it is told: where texels were drawn, with those for taps.
LookupTrace told(const ReportedLookup& lookup) {
    LookupTrace trace = lookup.trace;
    if (lookup.drawn == nullptr) return trace;
    trace.taps.clear();
    for (const texunit::DrawnTap& drawn : lookup.drawn->taps) trace.taps.push_back(drawn.tap);
    trace.result = lookup.drawn->result;
    return trace;
}

std::string right_aligned(const std::string& text, size_t width) { return std::string(width - std::min(width, text.size()), ' ') + text; }

constexpr size_t kIndexWidth = 7, kFigureWidth = 15;  // characters

std::string figure(double value) { return right_aligned(print_figure(value), kFigureWidth); }

std::string describe_texture(const texunit::Texture& texture) {
    const Shape& shape = texture.shape();
    std::string text = texture.name() + ": " + std::string(texunit::info(texture.format()).name) + ", " + print_extents(shape, 0);
    if (shape.cube) text += shape.cubes() > 1 ? ", " + std::to_string(shape.cubes()) + " cube maps" : ", cube map";
    if (!shape.cube && shape.layers > 1) text += ", " + std::to_string(shape.layers) + " layers";
    if (shape.levels == 1) return text + ", 1 level\n";
    return text + ", " + std::to_string(shape.levels) + " levels, " + std::to_string(texture.source_levels()) + " of them in the file\n";
}

std::string describe_wraps(const Shape& shape, const SamplerState& sampler) {
    if (shape.cube) return "seamless across faces";
    std::string text = "wrap " + std::string(to_string(sampler.wrap_s)) + "," + std::string(to_string(sampler.wrap_t));
    return shape.depth > 1 ? text + "," + std::string(to_string(sampler.wrap_r)) : text;
}

std::string describe_footprint(const SamplerState& sampler) {
    if (sampler.ellipse > 0) return ", elliptical Gaussian of variance " + print_number(sampler.ellipse) + " pixels^2";
    if (sampler.probes == 1) return "";
    std::string text = ", up to " + std::to_string(sampler.probes) + " probes";
    return sampler.probe_variance > 0 ? text + " of variance " + print_number(sampler.probe_variance) + " pixels^2" : text;
}

std::string describe_sampler(const Shape& shape, const SamplerState& sampler, bool drawn) {
    const bool exact = sampler.precision == texunit::Precision::Exact;
    const bool one_kernel = sampler.magnify == sampler.minify;
    return "Sampler: " + to_string(sampler.minify) + (one_kernel ? "" : " (magnified " + to_string(sampler.magnify) + ")") + ", mip " +
           std::string(to_string(sampler.mip)) + ", " + describe_wraps(shape, sampler) + describe_footprint(sampler) +
           (drawn ? ", drawn by " + std::string(to_string(sampler.estimator)) : "") +
           "\nPrecision: " + std::string(to_string(sampler.precision)) +
           (exact ? " (fractions of texels and levels are not quantised)\n" : " (fractions of texels and levels in steps of 1/256)\n");
}

std::string print_components(const std::array<float, 3>& values, CoordinateKind kind) {
    std::string text = print_number(values[0]) + "," + print_number(values[1]);
    return components(kind) > 2 ? text + "," + print_number(values[2]) : text;
}

std::string describe_place(const LookupPlace& place, CoordinateKind kind) {
    std::string text = std::string(kind == CoordinateKind::Direction ? "Direction: " : "Coordinates: ") + print_components(place.at, kind);
    if (place.derivatives)
        text += ", changing by " + print_components(place.derivatives->dx, kind) + " to the right and " +
                print_components(place.derivatives->dy, kind) + " down";
    return text + "\n";
}

/// The level of detail, and what each level read contributes.
std::string describe_levels(const Shape& shape, const LookupTrace& trace) {
    std::string text = "Level of detail: " + print_number(trace.lod) + ", anisotropy " + print_number(trace.anisotropy) + "\n";
    std::map<int, std::pair<size_t, double>> shares;
    for (const TracedTap& tap : trace.taps) {
        auto& [taps, weight] = shares[tap.level];
        ++taps;
        weight += tap.weight;
    }
    for (const auto& [level, share] : shares)
        text += "  level " + std::to_string(level) + ", " + print_extents(shape, level) + " texels: weight " + print_figure(share.second) +
                " in " + std::to_string(share.first) + (share.first == 1 ? " tap\n" : " taps\n");
    return text;
}

std::string tap_columns(const Shape& shape) {
    std::string text = right_aligned("level", kIndexWidth) + right_aligned("x", kIndexWidth) + right_aligned("y", kIndexWidth);
    for (const auto& [name, index] : slice_names(shape, 0)) text += right_aligned(name, kIndexWidth);
    return text;
}

std::string tap_row(const Shape& shape, const TracedTap& tap) {
    std::string text = right_aligned(std::to_string(tap.level), kIndexWidth);
    const auto texel = [&](int index) { text += right_aligned(tap.border ? "border" : std::to_string(index), kIndexWidth); };
    texel(tap.x);
    texel(tap.y);
    for (const auto& [name, index] : slice_names(shape, tap.slice)) texel(index);
    text += figure(tap.weight);
    for (const float value : tap.value) text += figure(value);
    return text + "\n";
}

/// Every tap, then the weights' sum and the weighted sum of the values, then what the lookup returned.
std::string tap_table(const Shape& shape, const LookupTrace& trace) {
    const std::string columns = tap_columns(shape);
    std::string text = columns;
    for (const char* heading : {"weight", "red", "green", "blue", "alpha"}) text += right_aligned(heading, kFigureWidth);
    text += "\n";
    double weights = 0;
    std::array<double, 4> sums{};
    for (const TracedTap& tap : trace.taps) {
        text += tap_row(shape, tap);
        weights += tap.weight;
        for (size_t c = 0; c < 4; ++c) sums[c] += tap.weight * double(tap.value[c]);
    }
    text += right_aligned("sum", columns.size()) + figure(weights);
    for (const double sum : sums) text += figure(sum);
    text += '\n';
    text += right_aligned("result", columns.size() + kFigureWidth);
    for (const float value : trace.result) text += figure(value);
    return text + "\n";
}

}  // namespace

Json lookup_object(const ReportedLookup& lookup) {
    const LookupTrace& trace = lookup.trace;
    const Shape& shape = lookup.texture.shape();
    Json json{{"lod", trace.lod}, {"anisotropy", trace.anisotropy}, {"precision", to_string(lookup.sampler.precision)}};
    Json taps = Json::array();
    if (lookup.drawn != nullptr) {
        json["estimator"] = to_string(lookup.sampler.estimator);
        for (const texunit::DrawnTap& drawn : lookup.drawn->taps) taps.push_back(drawn_tap_json(shape, drawn));
    } else {
        for (const TracedTap& tap : trace.taps) taps.push_back(tap_json(shape, tap));
    }
    json["taps"] = std::move(taps);
    json["result"] = lookup.drawn != nullptr ? lookup.drawn->result : trace.result;
    return json;
}

std::string lookup_json(const ReportedLookup& lookup) { return lookup_object(lookup).dump() + "\n"; }

std::string lookup_table(const ReportedLookup& lookup) {
    const Shape& shape = lookup.texture.shape();
    const LookupTrace trace = told(lookup);
    return describe_texture(lookup.texture) + describe_sampler(shape, lookup.sampler, lookup.drawn != nullptr) +
           describe_place(lookup.place, coordinate_kind(shape)) + describe_levels(shape, trace) + tap_table(shape, trace) +
           (lookup.drawn != nullptr ? describe_numbers(*lookup.drawn) : "");
}

}  // namespace rawtexel::cli
