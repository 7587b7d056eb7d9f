#include "cli/texture_stats.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <utility>
#include <vector>

namespace rawtexel::cli {
namespace {

using Json = nlohmann::ordered_json;

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

/// Which fragments' fetches were counted, and by which cache.
Json counting_choices(const FetchRequest& request) {
    Json json{{"model", to_string(request.model.value_or(shading::FetchModel::Visible))}};
    if (request.cache) json["cache"] = to_string(*request.cache);
    return json;
}

}  // namespace

void add_texture_stats(const RunRecord& record, const shading::Scene& scene, Json& json) {
    const shading::TextureSet set(scene);
    const std::vector<texunit::TextureWork> work = work_of(record, set);
    std::optional<FetchNumbers> fetches;
    if (record.result.fetches) fetches.emplace(*record.result.fetches, record.result.samples_shaded);
    if (fetches) json["fetches"] = counting_choices(record.request.fetches);
    json["texture"] = texture_totals(fetches, work);
    json["textures"] = texture_list(fetches, set, work);
}

}  // namespace rawtexel::cli
