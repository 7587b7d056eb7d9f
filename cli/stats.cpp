#include "cli/stats.h"

#include "cli/version.h"

#include <nlohmann/json.hpp>

#include <sys/resource.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>
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
    CounterInfo{"texture.texels_unique", "distinct texels of the frame, over textures, levels and layers (--count, as all that follow)"},
    CounterInfo{"texture.blocks_touched", "distinct 4x4 blocks"},
    CounterInfo{"texture.lines_32", "distinct 32-byte lines of decoded texels, in 4x4 blocks"},
    CounterInfo{"texture.lines_64", "the same of 64 bytes"},
    CounterInfo{"texture.lines_128", "the same of 128 bytes"},
    CounterInfo{"texture.lines_stored_32", "distinct 32-byte lines of the file's own blocks or texels, row after row"},
    CounterInfo{"texture.lines_stored_64", "the same of 64 bytes"},
    CounterInfo{"texture.lines_stored_128", "the same of 128 bytes"},
    CounterInfo{"texture.bytes_decoded", "64 * lines_64"},
    CounterInfo{"texture.bytes_stored", "64 * lines_stored_64"},
    CounterInfo{"texture.overfetch", "bytes_decoded over the bytes of the distinct texels"},
    CounterInfo{"texture.layouts.LAYOUT.decoded", "lines of decoded texels lying linear, morton, tiled-4k or tiled-64k"},
    CounterInfo{"texture.layouts.LAYOUT.stored", "lines of the file's blocks or texels lying so"},
    CounterInfo{"texture.cache.l1_hits", "texel reads that the modelled first-level cache held (--cache, as all of texture.cache)"},
    CounterInfo{"texture.cache.l1_misses", "texel reads that it did not; both sum to texels_requested"},
    CounterInfo{"texture.cache.l2_hits", "first-level misses that the second level held"},
    CounterInfo{"texture.cache.l2_misses", "first-level misses that it did not"},
    CounterInfo{"texture.cache.compulsory", "first-level misses of what was never there"},
    CounterInfo{"texture.cache.capacity", "first-level misses that a fully associative cache of the size would have too"},
    CounterInfo{"texture.cache.conflict", "the other first-level misses"},
    CounterInfo{"texture.performed.blocks_decoded", "4x4 blocks read from files or generators"},
    CounterInfo{"texture.performed.blocks_decoded_mips", "4x4 blocks of levels made from finer ones"},
    CounterInfo{"textures[].blocks_total", "4x4 blocks of all levels of one texture; the keys of texture follow"},
    CounterInfo{"textures[].per_level[]", "of each level its number, width and height; texels_requested and the keys after it follow"},
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

// --- textures

Json performed_numbers(const texunit::TextureWork& work) {
    return {{"blocks_decoded", work.blocks_decoded}, {"blocks_decoded_mips", work.blocks_decoded_mips}};
}

Json line_numbers(const texunit::LineCounts& counts) {
    Json json = Json::object();
    for (size_t size = 0; size < texunit::kLineBytes.size(); ++size)
        json["lines_" + std::to_string(texunit::kLineBytes[size])] = counts.lines[size];
    return json;
}

/// What the distinct texels cost.
void add_touched(Json& json, const texunit::TouchedLines& touched) {
    json["texels_unique"] = touched.texels_unique;
    json["blocks_touched"] = touched.blocks_touched;
    for (const auto& [name, counts] : {std::pair{"lines_", &touched.decoded}, {"lines_stored_", &touched.stored}})
        for (size_t size = 0; size < texunit::kLineBytes.size(); ++size)
            json[name + std::to_string(texunit::kLineBytes[size])] = counts->lines[size];
    json["bytes_decoded"] = touched.bytes_decoded();
    json["bytes_stored"] = touched.bytes_stored();
    if (touched.texel_bytes > 0) json["overfetch"] = double(touched.bytes_decoded()) / double(touched.texel_bytes);
    Json& layouts = json["layouts"];
    for (size_t i = 0; i < texunit::kAddressLayouts.size(); ++i) {
        layouts[std::string(to_string(texunit::kAddressLayouts[i]))] = {{"decoded", line_numbers(touched.decoded_as[i])},
                                                                        {"stored", line_numbers(touched.stored_as[i])}};
    }
}

Json cache_numbers(const texunit::CacheCounts& cache) {
    return {{"l1_hits", cache.l1_hits},       {"l1_misses", cache.l1_misses}, {"l2_hits", cache.l2_hits},  {"l2_misses", cache.l2_misses},
            {"compulsory", cache.compulsory}, {"capacity", cache.capacity},   {"conflict", cache.conflict}};
}

void add_counts(Json& json, const texunit::FetchCounts& counts, uint64_t samples_shaded) {
    json["lookups"] = counts.lookups;
    json["taps"] = counts.taps;
    json["texels_requested"] = counts.texels_requested;
    if (samples_shaded > 0) json["texels_per_sample"] = double(counts.texels_requested) / double(samples_shaded);
}

/// All that was counted, ready to be summed over textures and levels.
class FetchNumbers {
  public:
    FetchNumbers(const shading::FrameFetches& fetches, uint64_t samples_shaded)
        : fetches_(fetches), samples_shaded_(samples_shaded), touched_(fetches.measure()) {}

    void add_total(Json& json) const {
        add_counts(json, fetches_.total(), samples_shaded_);
        texunit::TouchedLines touched;
        texunit::CacheCounts cache;
        for (size_t i = 0; i < touched_.size(); ++i) touched += touched_of(i), cache += cache_of(i);
        add_touched(json, touched);
        if (has_cache()) json["cache"] = cache_numbers(cache);
    }

    void add_texture(Json& json, size_t texture) const {
        add_counts(json, fetches_.counts[texture], samples_shaded_);
        add_touched(json, touched_of(texture));
        if (has_cache()) json["cache"] = cache_numbers(cache_of(texture));
    }

    void add_levels(Json& json, size_t texture) const {
        const texunit::LevelTable& table = fetches_.textures[texture]->levels();
        Json& levels = json["per_level"] = Json::array();
        for (size_t level = 0; level < touched_[texture].size(); ++level) {
            Json numbers{{"level", level}, {"width", table.width[level]}, {"height", table.height[level]}};
            numbers["texels_requested"] = fetches_.counts[texture].level_texels[level];
            add_touched(numbers, touched_[texture][level]);
            if (has_cache()) numbers["cache"] = cache_numbers(fetches_.cache[texture][level]);
            levels.push_back(std::move(numbers));
        }
    }

  private:
    bool has_cache() const { return !fetches_.cache.empty(); }
    texunit::TouchedLines touched_of(size_t texture) const {
        texunit::TouchedLines sum;
        for (const texunit::TouchedLines& level : touched_[texture]) sum += level;
        return sum;
    }
    texunit::CacheCounts cache_of(size_t texture) const {
        texunit::CacheCounts sum;
        if (!has_cache()) return sum;
        for (const texunit::CacheCounts& level : fetches_.cache[texture]) sum += level;
        return sum;
    }

    const shading::FrameFetches& fetches_;
    uint64_t samples_shaded_;
    std::vector<std::vector<texunit::TouchedLines>> touched_;
};

/// Work of the distinct textures, in the order of TextureSet.
std::vector<texunit::TextureWork> work_of(const RunRecord& record, const shading::TextureSet& set) {
    std::vector<texunit::TextureWork> work(set.textures.size());
    for (size_t i = 0; i < set.place.size(); ++i) work[set.place[i]] = record.work[i];
    return work;
}

Json texture_totals(const std::optional<FetchNumbers>& fetches, const std::vector<texunit::TextureWork>& work) {
    Json json = Json::object();
    if (fetches) fetches->add_total(json);
    texunit::TextureWork total;
    for (const texunit::TextureWork& one : work) {
        total.blocks_decoded += one.blocks_decoded;
        total.blocks_decoded_mips += one.blocks_decoded_mips;
    }
    json["performed"] = performed_numbers(total);
    return json;
}

Json texture_list(const std::optional<FetchNumbers>& fetches, const shading::TextureSet& set,
                  const std::vector<texunit::TextureWork>& work) {
    Json list = Json::array();
    for (size_t i = 0; i < set.textures.size(); ++i) {
        const texunit::Texture& texture = *set.textures[i];
        Json json{{"name", texture.name()},           {"format", texunit::info(texture.format()).name},
                  {"width", texture.shape().width},   {"height", texture.shape().height},
                  {"levels", texture.shape().levels}, {"blocks_total", texture.blocks_total()}};
        if (fetches) fetches->add_texture(json, i);
        json["performed"] = performed_numbers(work[i]);
        if (fetches) fetches->add_levels(json, i);
        list.push_back(std::move(json));
    }
    return list;
}

}  // namespace

std::string stats_json(const RunRecord& record, const shading::Scene& scene) {
    const shading::TextureSet set(scene);
    const std::vector<texunit::TextureWork> work = work_of(record, set);
    std::optional<FetchNumbers> fetches;
    if (record.result.fetches) fetches.emplace(*record.result.fetches, record.result.samples_shaded);
    const Json json{{"rawtexel", version()},
                    {"scene", record.scene},
                    {"command", record.command},
                    {"image", image_numbers(record)},
                    {"frame_s", frame_numbers(record.times.frame_s)},
                    {"time_s", time_numbers(record)},
                    {"memory_bytes", memory_numbers(record, scene)},
                    {"geometry", geometry_numbers(record.result.geometry)},
                    {"texture", texture_totals(fetches, work)},
                    {"textures", texture_list(fetches, set, work)}};
    // Names come from files: bytes that are no UTF-8 are replaced, not refused.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::span<const CounterInfo> all_counters() { return kCounters; }

}  // namespace rawtexel::cli
