// What a frame asked its textures for.
#pragma once

#include "shading/image.h"
#include "shading/scene.h"
#include "texunit/fetch_log.h"
#include "texunit/fetch_replay.h"
#include "texunit/touched_lines.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace rawtexel::shading {

/// The distinct textures of a scene: entries of Scene::textures may share one.
struct TextureSet {
    explicit TextureSet(const Scene& scene);
    std::vector<const texunit::Texture*> textures;
    std::vector<uint32_t> place;           ///< in `textures`, of every entry of Scene::textures
    std::vector<uint64_t> texels() const;  ///< of each texture's storage
};

/// Layers of FrameFetches::pixels, in this order, exact below 2^24. Sums over the pixels of the frame equal the counters of the same names,
/// but for lines_pixel (distinct 64-byte lines of the pixel alone) and the last three: mean level of detail and mean anisotropy of the
/// pixel's lookups, and samples that saw a surface.
enum class PixelCount { TexelsRequested, LinesPixel, LinesFirst, BlocksFirst, L1Miss, L2Miss, Level, Anisotropy, Samples };
std::string_view to_string(PixelCount count);  // texels_requested lines_pixel lines_first blocks_first l1_miss l2_miss level …
inline constexpr int kPixelCounts = int(PixelCount::Samples) + 1;

/// How many lookups there were of each kind.
struct FetchHistograms {
    static constexpr int kBinsPerLevel = 4;
    std::vector<uint64_t> level;       ///< bin i: level of detail from i to i + 1 quarters
    std::vector<uint64_t> anisotropy;  ///< bin i: ratio of the footprint's axes from i to i + 1
    std::vector<uint64_t> texels;      ///< bin i: i texels read

    void add_lookup(float level_of_detail, float ratio);
    void add_texels(uint32_t count);
    FetchHistograms& operator+=(const FetchHistograms& other);
    bool operator==(const FetchHistograms&) const = default;
};

struct FrameFetches {
    explicit FrameFetches(const TextureSet& set);

    std::vector<const texunit::Texture*> textures;              ///< the distinct ones
    std::vector<texunit::FetchCounts> counts;                   ///< of each
    texunit::TouchedTexels touched;                             ///< numbered likewise
    std::vector<texunit::FetchReplay::LevelCacheCounts> cache;  ///< likewise; empty unless a cache was modelled
    /// One image of one channel for each PixelCount; empty where nobody asked, or where no cache was modelled.
    std::vector<Image> pixels;
    FetchHistograms histograms;  ///< empty unless FetchOptions::pixel_layers; each sums to the lookups

    texunit::FetchCounts total() const;
    const Image& pixel(PixelCount count) const { return pixels[size_t(count)]; }
    /// Per texture and level, found from `touched`.
    std::vector<std::vector<texunit::TouchedLines>> measure() const;
};

}  // namespace rawtexel::shading
