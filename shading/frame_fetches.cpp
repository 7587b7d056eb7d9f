#include "shading/frame_fetches.h"

#include <algorithm>
#include <array>
#include <unordered_map>

namespace rawtexel::shading {
namespace {

constexpr std::array<std::string_view, kPixelCounts> kNames = {"texels_requested", "lines_pixel", "lines_first", "blocks_first", "l1_miss",
                                                               "l2_miss",          "level",       "anisotropy",  "samples"};

void add_to_bin(std::vector<uint64_t>& bins, size_t bin, uint64_t count) {
    if (bins.size() <= bin) bins.resize(bin + 1);
    bins[bin] += count;
}

void add_bins(std::vector<uint64_t>& bins, const std::vector<uint64_t>& other) {
    for (size_t i = 0; i < other.size(); ++i) add_to_bin(bins, i, other[i]);
}

}  // namespace

std::string_view to_string(PixelCount count) { return kNames[size_t(count)]; }

TextureSet::TextureSet(const Scene& scene) {
    std::unordered_map<const texunit::Texture*, uint32_t> seen;
    for (const SceneTexture& entry : scene.textures) {
        const auto [at, is_new] = seen.emplace(entry.texture.get(), uint32_t(textures.size()));
        if (is_new) textures.push_back(entry.texture.get());
        place.push_back(at->second);
    }
}

std::vector<uint64_t> TextureSet::texels() const {
    std::vector<uint64_t> texels;
    for (const texunit::Texture* texture : textures) texels.push_back(texture->levels().texels);
    return texels;
}

void FetchHistograms::add_lookup(float level_of_detail, float ratio) {
    // Bins hold what is at least 0: levels of detail are clamped to the levels there are, and no ratio is below 1.
    add_to_bin(level, size_t(std::max(level_of_detail, 0.0f) * kBinsPerLevel), 1);
    add_to_bin(anisotropy, size_t(std::max(ratio, 0.0f)), 1);
}

void FetchHistograms::add_texels(uint32_t count) { add_to_bin(texels, count, 1); }

FetchHistograms& FetchHistograms::operator+=(const FetchHistograms& other) {
    add_bins(level, other.level);
    add_bins(anisotropy, other.anisotropy);
    add_bins(texels, other.texels);
    return *this;
}

FrameFetches::FrameFetches(const TextureSet& set) : textures(set.textures), counts(set.textures.size()), touched(set.texels()) {}

texunit::FetchCounts FrameFetches::total() const {
    texunit::FetchCounts sum;
    for (const texunit::FetchCounts& one : counts) sum += one;
    return sum;
}

std::vector<std::vector<texunit::TouchedLines>> FrameFetches::measure() const {
    std::vector<std::vector<texunit::TouchedLines>> levels;
    for (size_t i = 0; i < textures.size(); ++i) levels.push_back(measure_touched(*textures[i], touched, i));
    return levels;
}

}  // namespace rawtexel::shading
