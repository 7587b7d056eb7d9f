// A frame: scene, camera and options in, linear radiance and layers out.
#pragma once

#include "raster/frame.h"
#include "shading/aov.h"
#include "shading/executor.h"
#include "shading/fetch_options.h"
#include "shading/filtering_options.h"
#include "shading/footprint_options.h"
#include "shading/fragment_listener.h"
#include "shading/frame_fetches.h"
#include "shading/image.h"
#include "shading/lighting.h"
#include "shading/lookup_listener.h"
#include "shading/pixel_sampling.h"
#include "shading/scene.h"
#include "shading/skips.h"
#include "texunit/sampler.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rawtexel::shading {

class TemporalSums;

struct Crop {
    int x = 0, y = 0, width = 0, height = 0;  ///< pixels; zero extents: the whole frame
};

struct RenderOptions {
    int width = 1280, height = 720;
    Crop crop;
    Camera camera;
    int spp = 1;
    /// Above 0: blocks of 16x16 pixels stop at 16, 32, 64 ... samples where the standard error of linear radiance is below it, and `spp` is
    /// the most (shading/adaptive_blocks.h). A crop holds whole blocks, and `sums` is null (asserted).
    double adaptive_error = 0;
    /// The first of the `spp` samples: parts of one image may be rendered apart, and SampleTree adds them to the bits of the whole.
    uint32_t first_sample = 0;
    int image_spp = 0;  ///< of the whole image, where `spp` is of a part of it: FootprintArea::Sample goes by it. 0: spp
    PixelFilter pixel_filter = PixelFilter::Box;
    PixelJitter pixel_jitter = PixelJitter::Frame;
    uint32_t seed = 0;
    /// Replace every map's own sampler; nullopt: what the scene says.
    std::optional<texunit::Kernel> filter;
    std::optional<texunit::MipMode> mip;
    FootprintOptions footprint;
    FilteringOptions filtering;
    texunit::Precision precision = texunit::Precision::Exact;  ///< of every lookup
    std::optional<glm::vec3> background;                       ///< nullopt: the environment, black where there is none
    std::vector<Aov> aovs;
    bool coverage = false;  ///< fill RenderResult::coverage
    /// Keeps the samples of earlier parts: RenderResult::radiance is then the mean over them and this part's, which are added. Parts differ
    /// in first_sample, spp, camera and layers alone, and no sample is of two (asserted).
    TemporalSums* sums = nullptr;
    FetchOptions fetches;  ///< what RenderResult::fetches is to hold; layers of counts ask for theirs themselves
    /// Hears of every lookup in place of counters: one thread's executor is wanted.
    LookupListener* listener = nullptr;
    FragmentListener* fragment_listener = nullptr;  ///< watches every fragment; one thread's executor is wanted
    int tile_size = 64;                             ///< 32, 64 or 128
    Skips skips;
};

struct RenderTimes {
    double geometry_s = 0, raster_s = 0, shade_s = 0;  ///< raster and shade summed over threads
    double frame_s = 0;                                ///< wall
};

struct RenderResult {
    Image radiance;             ///< 3 channels, crop extents
    std::vector<Layer> layers;  ///< one per requested AOV, in order
    Image coverage;             ///< 1 channel: the share of a pixel's samples that saw a surface; empty unless asked for
    Image sample_counts;        ///< 1 channel: samples of each pixel; empty unless adaptive
    raster::FrameCounts geometry;
    uint64_t samples_shaded = 0;            ///< samples that saw a surface
    std::unique_ptr<FrameFetches> fetches;  ///< null when nothing was counted
    RenderTimes times;
};

/// Samples per pixel, the mean over the image; nullopt where all pixels took as many.
std::optional<double> mean_samples(const RenderResult& result);

/// Called now and then from any thread with the share done, 0..1.
using Progress = std::function<void(double)>;

/// Lighting as the options ask, shadow map drawn. `shadows`: the first directional light casts.
Lighting resolve_lighting(const Scene& scene, std::vector<Light> lights, float ambient, std::shared_ptr<const Environment> environment,
                          bool shadows, Executor& executor);

/// Whether blocks of adaptive sampling lie in the crop wholly or not at all.
bool holds_whole_blocks(const Crop& crop, int width, int height);

/// Why the scene's maps cannot be looked up as the options say, as a line for people that names the material; empty where they can.
std::string refusal(const Scene& scene, const RenderOptions& options);

/// The same inputs give the same bits for any thread count and tile size; a crop has the bits of that part of the whole.
/// Throws texunit::TextureError when a texture proves damaged.
RenderResult render(const Scene& scene, const Lighting& lighting, const RenderOptions& options, Executor& executor,
                    const Progress& progress = {});

}  // namespace rawtexel::shading
