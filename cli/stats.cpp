#include "cli/stats.h"

#include "cli/version.h"

#include <nlohmann/json.hpp>

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <unordered_set>

namespace rawtexel::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kCounters{
    CounterInfo{"image.width", "pixels of the image written"},
    CounterInfo{"image.height", "pixels of the image written"},
    CounterInfo{"image.spp", "samples per pixel"},
    CounterInfo{"image.samples_shaded", "samples that saw a surface; the background is left out"},
    CounterInfo{"frame_s.min", "wall seconds of the fastest frame, geometry to resolved image"},
    CounterInfo{"frame_s.median", "wall seconds of the median frame"},
    CounterInfo{"frame_s.n", "frames timed (--repeat)"},
    CounterInfo{"time_s.load", "wall seconds until the first frame: scene, environment, shadow map"},
    CounterInfo{"time_s.geometry", "wall seconds: transform, clip, set up, bin"},
    CounterInfo{"time_s.raster", "seconds of visibility, summed over threads"},
    CounterInfo{"time_s.shade", "seconds of lookups and shading, summed over threads"},
    CounterInfo{"time_s.write", "wall seconds: display transform, encoding, file"},
    CounterInfo{"time_s.total", "wall seconds of the whole run"},
    CounterInfo{"memory_bytes.peak_rss", "most memory resident at any time"},
    CounterInfo{"memory_bytes.textures_stored", "bytes of the textures as their files hold them"},
    CounterInfo{"memory_bytes.textures_decoded", "bytes of the blocks decoded or generated"},
    CounterInfo{"geometry.triangles", "triangles of the scene, over all instances"},
    CounterInfo{"geometry.culled_frustum", "triangles outside the view"},
    CounterInfo{"geometry.culled_backface", "triangles seen from behind"},
    CounterInfo{"geometry.culled_degenerate", "triangles without area after snapping"},
    CounterInfo{"geometry.culled_small", "triangles that no sample point can hit"},
    CounterInfo{"geometry.culled_nonfinite", "triangles with a vertex that is not a number"},
    CounterInfo{"geometry.clipped", "triangles cut by the near plane or the guard band"},
    CounterInfo{"geometry.binned", "triangles that reached a tile"},
    CounterInfo{"geometry.tiles", "tiles of the image"},
    CounterInfo{"geometry.tiles_empty", "tiles without a triangle"},
    CounterInfo{"geometry.hiz_rejected", "triangles or blocks hidden by what a tile holds already"},
    CounterInfo{"texture.lookups", "maps asked at shading points (--count)"},
    CounterInfo{"texture.taps", "taps weighed (--count)"},
    CounterInfo{"texture.texels_requested", "texel reads, with repeats (--count)"},
    CounterInfo{"texture.texels_per_sample", "texels_requested over samples_shaded (--count)"},
    CounterInfo{"texture.performed.blocks_decoded", "4x4 blocks read from files or generators"},
    CounterInfo{"texture.performed.blocks_decoded_mips", "4x4 blocks of levels made from finer ones"},
    CounterInfo{"textures[].blocks_total", "4x4 blocks of all levels of one texture; the keys of texture follow"},
};

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
    return {{"width", result.radiance.width},
            {"height", result.radiance.height},
            {"spp", record.request.samples.spp},
            {"samples_shaded", result.samples_shaded}};
}

Json frame_numbers(const std::vector<double>& frame_s) {
    return {{"min", std::ranges::min(frame_s)}, {"median", median(frame_s)}, {"n", frame_s.size()}};
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
            {"culled_nonfinite", counts.culled_nonfinite},
            {"clipped", counts.clipped},
            {"binned", counts.binned},
            {"tiles", counts.tiles},
            {"tiles_empty", counts.tiles_empty},
            {"hiz_rejected", counts.hiz_rejected}};
}

void add_fetches(Json& json, const texunit::FetchCounts& counts, uint64_t samples_shaded) {
    json["lookups"] = counts.lookups;
    json["taps"] = counts.taps;
    json["texels_requested"] = counts.texels_requested;
    if (samples_shaded > 0) json["texels_per_sample"] = double(counts.texels_requested) / double(samples_shaded);
}

Json performed_numbers(const texunit::TextureWork& work) {
    return {{"blocks_decoded", work.blocks_decoded}, {"blocks_decoded_mips", work.blocks_decoded_mips}};
}

Json texture_totals(const RunRecord& record, const shading::Scene& scene) {
    Json json = Json::object();
    if (!record.result.fetches.empty()) add_fetches(json, total_fetches(record.result), record.result.samples_shaded);
    texunit::TextureWork total;
    std::unordered_set<const texunit::Texture*> seen;
    for (size_t i = 0; i < scene.textures.size(); ++i) {
        if (!seen.insert(scene.textures[i].texture.get()).second) continue;
        total.blocks_decoded += record.work[i].blocks_decoded;
        total.blocks_decoded_mips += record.work[i].blocks_decoded_mips;
    }
    json["performed"] = performed_numbers(total);
    return json;
}

Json texture_list(const RunRecord& record, const shading::Scene& scene) {
    Json list = Json::array();
    for (size_t i = 0; i < scene.textures.size(); ++i) {
        const texunit::Texture& texture = *scene.textures[i].texture;
        Json json{{"name", texture.name()},           {"format", texunit::info(texture.format()).name},
                  {"width", texture.shape().width},   {"height", texture.shape().height},
                  {"levels", texture.shape().levels}, {"blocks_total", texture.blocks_total()}};
        if (i < record.result.fetches.size()) add_fetches(json, record.result.fetches[i], record.result.samples_shaded);
        json["performed"] = performed_numbers(record.work[i]);
        list.push_back(std::move(json));
    }
    return list;
}

}  // namespace

std::string stats_json(const RunRecord& record, const shading::Scene& scene) {
    const Json json{{"rawtexel", version()},
                    {"scene", record.scene},
                    {"command", record.command},
                    {"image", image_numbers(record)},
                    {"frame_s", frame_numbers(record.times.frame_s)},
                    {"time_s", time_numbers(record)},
                    {"memory_bytes", memory_numbers(record, scene)},
                    {"geometry", geometry_numbers(record.result.geometry)},
                    {"texture", texture_totals(record, scene)},
                    {"textures", texture_list(record, scene)}};
    // Names come from files: bytes that are no UTF-8 are replaced, not refused.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::span<const CounterInfo> all_counters() { return kCounters; }

}  // namespace rawtexel::cli
