#include "cli/bench/bench_report.h"

#include "cli/csv_text.h"
#include "cli/version.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace rawtexel::cli {
namespace {

using Json = nlohmann::ordered_json;

// Columns by the path of their key in a configuration.
constexpr std::array kColumns{"scene",
                              "filter",
                              "minification",
                              "estimator",
                              "order",
                              "image.spp",
                              "rmse",
                              "mse",
                              "psnr",
                              "relmse",
                              "max",
                              "mean",
                              "flip",
                              "flip_kind",
                              "standard_error",
                              "clear",
                              "frame_s.min",
                              "frame_s.median",
                              "frame_s.max",
                              "frame_s.spread",
                              "frame_s.n",
                              "time_s.geometry",
                              "time_s.raster",
                              "time_s.shade",
                              "texels_per_pixel",
                              "lines_per_pixel",
                              "texture.lookups",
                              "texture.taps",
                              "texture.texels_requested",
                              "texture.texels_unique",
                              "texture.texels_per_sample",
                              "texture.blocks_touched",
                              "texture.lines_64",
                              "texture.bytes_decoded",
                              "texture.lines_stored_64",
                              "texture.bytes_stored",
                              "texture.overfetch",
                              "front_time",
                              "front_fetches",
                              "options",
                              "picture"};

Json fit_json(const Series& series) {
    Json json{{"slope", nullptr}, {"factor", nullptr}, {"bias", nullptr}, {"trend", to_string(series.trend)}};
    if (series.slope) {
        json["slope"] = series.slope->slope;
        json["factor"] = series.slope->factor;
    }
    if (series.bias) json["bias"] = *series.bias;
    return json;
}

Json series_json(const Series& series, size_t first) {
    Json json{{"name", series.name()},
              {"filter", series.filter},
              {"minification", series.minification},
              {"estimator", series.estimator},
              {"order", series.order},
              {"hybrid_bias", series.hybrid_bias ? Json(*series.hybrid_bias) : Json()},
              {"one_tap", series.one_tap}};
    json.update(fit_json(series));
    Json& points = json["configurations"] = Json::array();
    for (const size_t point : series.points) points.push_back(first + point);
    return json;
}

Json configuration_json(const Measurement& one, const Truth& truth, bool front_time, bool front_fetches) {
    Json json = to_json(one);
    for (const char* key : {"times", "spp"}) json.erase(key);
    json["standard_error"] = truth.standard_error;
    json["clear"] = is_clear(one, truth);
    json["frame_s"] = {{"min", std::ranges::min(one.frame_s)},
                       {"median", one.frame_median()},
                       {"max", std::ranges::max(one.frame_s)},
                       {"spread", one.frame_spread()},
                       {"n", one.frame_s.size()}};
    json["time_s"] = {{"geometry", median(one.geometry_s)}, {"raster", median(one.raster_s)}, {"shade", median(one.shade_s)}};
    json["texels_per_pixel"] = one.texels_per_pixel();
    json["front_time"] = front_time;
    json["front_fetches"] = front_fetches;
    return json;
}

Json scene_json(const SceneResults& results, const SceneAnalysis& analysis, size_t first) {
    Json json{{"scene", results.scene}, {"camera", results.camera}, {"truths", Json::array()}};
    for (const Truth& truth : results.truths) {
        Json one = to_json(truth);
        one.erase("scene");
        one["reached"] = truth.standard_error < truth.goal;
        json["truths"].push_back(std::move(one));
    }
    Json& findings = json["findings"] = Json::array();
    for (const Finding& finding : analysis.findings)
        findings.push_back({{"kind", to_string(finding.kind)}, {"filter", finding.filter}, {"text", finding.text}});
    Json& series = json["series"] = Json::array();
    for (const Series& one : analysis.series) series.push_back(series_json(one, first));
    Json& left_out = json["left_out"] = Json::array();
    for (const LeftOut& one : results.left_out) left_out.push_back({{"options", one.options}, {"spp", one.spps}, {"reason", one.reason}});
    return json;
}

std::string cell(const Json& configuration, const std::string& path) {
    const Json* value = &configuration;
    for (size_t at = 0; at <= path.size();) {
        const size_t end = std::min(path.find('.', at), path.size());
        const auto found = value->find(path.substr(at, end - at));
        if (found == value->end()) return "";
        value = &*found;
        at = end + 1;
    }
    if (value->is_null()) return "";
    return value->is_string() ? csv_field(value->get<std::string>()) : value->dump();
}

}  // namespace

SceneAnalysis analyse(const SceneResults& results) {
    SceneAnalysis analysis{series_of(results), fronts_of(results), {}};
    analysis.findings = findings_of(results, analysis.series);
    return analysis;
}

Json bench_json(std::span<const SceneResults> scenes, std::span<const SceneAnalysis> analyses, const std::string& command) {
    Json json{{"rawtexel", version()}, {"command", command}, {"scenes", Json::array()}, {"configurations", Json::array()}};
    Json& configurations = json["configurations"];
    for (size_t s = 0; s < scenes.size(); ++s) {
        json["scenes"].push_back(scene_json(scenes[s], analyses[s], configurations.size()));
        for (size_t i = 0; i < scenes[s].measurements.size(); ++i) {
            const Measurement& one = scenes[s].measurements[i];
            configurations.push_back(
                configuration_json(one, scenes[s].truth_of(one), analyses[s].fronts.time[i], analyses[s].fronts.fetches[i]));
        }
    }
    return json;
}

std::string bench_csv(const Json& bench) {
    std::string text;
    for (const char* column : kColumns) {
        std::string name = column;
        std::ranges::replace(name, '.', '_');
        text += (text.empty() ? "" : ",") + name;
    }
    text += "\n";
    for (const Json& configuration : bench.at("configurations")) {
        for (size_t i = 0; i < kColumns.size(); ++i) text += (i > 0 ? "," : "") + cell(configuration, kColumns[i]);
        text += "\n";
    }
    return text;
}

}  // namespace rawtexel::cli
