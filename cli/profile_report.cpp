#include "cli/profile_report.h"

#include "cli/csv_text.h"
#include "cli/stats.h"
#include "cli/texture_stats.h"

#include <nlohmann/json.hpp>

#include <array>

namespace rawtexel::cli {
namespace {

using Json = nlohmann::ordered_json;

// Columns that are keys of every texture and level; those of the cache follow.
constexpr std::array kColumns{"texels_requested", "texels_unique",   "blocks_touched", "lines_64",
                              "bytes_decoded",    "lines_stored_64", "bytes_stored",   "overfetch"};
constexpr std::array kCacheColumns{"l1_hits", "l1_misses", "l2_hits", "l2_misses", "compulsory", "capacity", "conflict"};

Json histogram_numbers(const shading::FetchHistograms& histograms) {
    return {{"levels_per_bin", 1.0 / shading::FetchHistograms::kBinsPerLevel},
            {"level", histograms.level},
            {"anisotropy", histograms.anisotropy},
            {"texels", histograms.texels}};
}

Json frame_numbers(const ProfiledFrame& frame) {
    Json json = stats_object(frame.record, *frame.scene);
    json["memory_bytes"].erase("peak_rss");
    json["histograms"] = histogram_numbers(frame.record.result.fetches->histograms);
    return json;
}

Json model_sums(const RunRecord& record, const shading::Scene& scene) {
    Json json;
    add_texture_stats(record, scene, json);
    Json sums = json["texture"];
    sums.erase("performed");
    return sums;
}

void add_line(std::string& text, const Json& texture, const std::string& level, const Json& numbers) {
    const auto text_of = [](const Json& json, const char* key) {
        const auto found = json.find(key);
        if (found == json.end()) return std::string();
        return found->is_string() ? csv_field(found->get<std::string>()) : found->dump(-1, ' ', false, Json::error_handler_t::replace);
    };
    text += text_of(texture, "name") + "," + text_of(texture, "format") + "," + level + "," + text_of(numbers, "width") + "," +
            text_of(numbers, "height");
    for (const char* column : kColumns) text += "," + text_of(numbers, column);
    const Json cache = numbers.value("cache", Json::object());
    for (const char* column : kCacheColumns) text += "," + text_of(cache, column);
    text += "\n";
}

}  // namespace

Json profile_json(const ProfileRuns& runs) {
    Json json = frame_numbers(runs.frame);
    Json& models = json["models"] = Json::object();
    for (const auto& [model, record] : runs.models) {
        const bool own = record.result.fetches == nullptr;
        models[std::string(to_string(model))] = model_sums(own ? runs.frame.record : record, *runs.frame.scene);
    }
    Json& compared = json["compare_with"] = Json::array();
    for (const ProfiledFrame& frame : runs.compared) {
        Json numbers{{"options", frame.options}};
        numbers.update(frame_numbers(frame));
        for (const char* key : {"rawtexel", "scene", "command"}) numbers.erase(key);
        compared.push_back(std::move(numbers));
    }
    return json;
}

std::string textures_csv(const Json& profile) {
    std::string text = "texture,format,level,width,height";
    for (const char* column : kColumns) text += std::string(",") + column;
    for (const char* column : kCacheColumns) text += std::string(",") + column;
    text += "\n";
    for (const Json& texture : profile.at("textures")) {
        for (const Json& level : texture.at("per_level")) add_line(text, texture, level.at("level").dump(), level);
        add_line(text, texture, "all", texture);
    }
    add_line(text, Json{{"name", "all"}}, "all", profile.at("texture"));
    return text;
}

}  // namespace rawtexel::cli
