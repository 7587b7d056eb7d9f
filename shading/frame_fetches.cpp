#include "shading/frame_fetches.h"

#include <array>
#include <unordered_map>

namespace rawtexel::shading {
namespace {

constexpr std::array<std::string_view, kPixelCounts> kNames = {"texels_requested", "lines_pixel", "lines_first", "blocks_first", "l1_miss",
                                                               "l2_miss",          "level",       "anisotropy",  "samples"};

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
