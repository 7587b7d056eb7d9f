#include "cli/stats.h"

#include "cli/texture_stats.h"
#include "cli/version.h"

#include <nlohmann/json.hpp>

#include <sys/resource.h>

#include <algorithm>
#include <unordered_set>

namespace rawtexel::cli {
namespace {

using Json = nlohmann::ordered_json;

uint64_t peak_resident_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return uint64_t(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    const size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

Json image_numbers(const RunRecord& record) {
    const shading::RenderResult& result = record.result;
    Json json{{"width", result.radiance.width},
              {"height", result.radiance.height},
              {"spp", record.request.samples.spp},
              {"samples_shaded", result.samples_shaded}};
    if (const std::optional<double> mean = mean_samples(result)) json["mean_spp"] = *mean;
    return json;
}

Json frame_numbers(const std::vector<double>& frame_s) {
    return {{"min", std::ranges::min(frame_s)}, {"median", median(frame_s)}, {"n", frame_s.size()}};
}

/// What the frames of a sequence became.
Json sequence_numbers(const RunRecord& record) {
    const SequenceRecord& sequence = *record.sequence;
    const SequenceOptions& options = record.request.sequence;
    Json json{{"frames", sequence.frames}, {"accumulate", print_accumulate(options)}, {"accumulate_s", sequence.accumulate_s}};
    if (options.path) json["camera_path"] = print(*options.path);
    if (sequence.flicker_rms) {
        json["flicker_rms"] = *sequence.flicker_rms;
        json["flicker_frames"] = sequence.flicker_frames;
    }
    if (sequence.disoccluded) json["disoccluded"] = *sequence.disoccluded;
    return json;
}

Json time_numbers(const RunRecord& record) {
    const shading::RenderTimes& frame = record.result.times;
    return {{"load", record.times.load_s}, {"geometry", frame.geometry_s},  {"raster", frame.raster_s},
            {"shade", frame.shade_s},      {"write", record.times.write_s}, {"total", record.times.total_s}};
}

Json memory_numbers(const RunRecord& record, const shading::Scene& scene) {
    uint64_t stored = 0, decoded = 0;
    // Entries of a scene may share a texture.
    std::unordered_set<const texunit::Texture*> seen;
    for (size_t i = 0; i < scene.textures.size(); ++i) {
        const texunit::Texture* texture = scene.textures[i].texture.get();
        if (!seen.insert(texture).second) continue;
        stored += texture->stored_bytes();
        decoded += record.work[i].bytes_decoded;
    }
    return {{"peak_rss", peak_resident_bytes()}, {"textures_stored", stored}, {"textures_decoded", decoded}};
}

Json geometry_numbers(const raster::FrameCounts& counts) {
    return {{"triangles", counts.triangles},
            {"culled_frustum", counts.culled_frustum},
            {"culled_backface", counts.culled_backface},
            {"culled_degenerate", counts.culled_degenerate},
            {"culled_small", counts.culled_small},
            {"culled_unsampled", counts.culled_unsampled},
            {"culled_occluded", counts.culled_occluded},
            {"culled_nonfinite", counts.culled_nonfinite},
            {"clipped", counts.clipped},
            {"binned", counts.binned},
            {"tiles", counts.tiles},
            {"tiles_empty", counts.tiles_empty},
            {"hiz_rejected", counts.hiz_rejected}};
}

/// The choices that made the lookups, by the names of their options.
Json lookup_choices(const LookupOptions& lookup) {
    Json json = Json::object();
    for (auto [name, choice] : print_choices(lookup)) {
        std::ranges::replace(name, '-', '_');
        json[name] = choice;
    }
    return json;
}

}  // namespace

Json stats_object(const RunRecord& record, const shading::Scene& scene) {
    Json json{{"rawtexel", version()},
              {"scene", record.scene},
              {"command", record.command},
              {"lookup", lookup_choices(record.request.lookup)},
              {"image", image_numbers(record)},
              {"frame_s", frame_numbers(record.times.frame_s)},
              {"time_s", time_numbers(record)},
              {"memory_bytes", memory_numbers(record, scene)},
              {"geometry", geometry_numbers(record.result.geometry)}};
    if (record.sequence) json["sequence"] = sequence_numbers(record);
    add_texture_stats(record, scene, json);
    return json;
}

std::string stats_json(const RunRecord& record, const shading::Scene& scene) {
    // Names come from files: bytes that are no UTF-8 are replaced, not refused.
    return stats_object(record, scene).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rawtexel::cli
