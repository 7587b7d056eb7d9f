// One tile of a frame: for each sample visibility, then shading of what is visible; then the mean.
#pragma once

#include "raster/frame.h"
#include "raster/visibility.h"
#include "shading/accumulation.h"
#include "shading/adaptive_blocks.h"
#include "shading/candidate_log.h"
#include "shading/draw_state.h"
#include "shading/fetch_options.h"
#include "shading/filtering_options.h"
#include "shading/fragment_listener.h"
#include "shading/lighting.h"
#include "shading/lookup_listener.h"
#include "shading/pixel_rect.h"
#include "shading/pixel_sampling.h"
#include "shading/tile_planes.h"
#include "shading/view_rays.h"

#include <optional>
#include <span>
#include <vector>

namespace rawtexel::shading {

/// Everything that the tiles of a frame read.
struct TileInputs {
    const raster::Frame* frame = nullptr;
    std::span<const DrawState> draws;
    const Lighting* lighting = nullptr;
    ViewRays rays;
    PixelRect visible;  ///< nothing outside is shaded, tested for coverage or counted
    uint32_t first_sample = 0;
    int spp = 1;
    double adaptive_error = 0;  ///< 0: every pixel takes all samples
    PixelFilter pixel_filter = PixelFilter::Box;
    PixelJitter pixel_jitter = PixelJitter::Frame;
    uint32_t seed = 0;
    DerivativeRule derivatives;
    std::optional<glm::vec3> background;  ///< nullopt: the environment, black where there is none
    TilePlanes planes;
    ShadowTaps shadow_taps = ShadowTaps::All;
    TextureJitter texture_jitter = TextureJitter::None;
    texunit::Noise noise = texunit::Noise::White;  ///< of the numbers of both
    FetchModel fetch_model = FetchModel::Visible;  ///< of what listeners hear
    bool skip_zero_weights = true;                 ///< of light that does not arrive
    bool skip_empty_tiles = true;                  ///< look for nothing where the bin holds nothing
};

/// Counts and times of one worker.
struct TileTotals {
    uint64_t samples_shaded = 0;
    uint64_t hiz_rejected = 0;
    double raster_s = 0, shade_s = 0;

    TileTotals& operator+=(const TileTotals& other);
};

/// A worker's memory, used for one tile after another so that the tiles themselves allocate nothing.
struct TileScratch {
    explicit TileScratch(const TileInputs& inputs);

    raster::TileVisibility visibility;
    std::vector<SequenceShift> shifts;          ///< per pixel of the tile; empty for PixelJitter::Frame
    std::vector<raster::SampleOffset> offsets;  ///< likewise, of the sample at hand
    /// Planes of the sample at hand: wave w of the tile (row by row) of plane p is entry p*waves + w.
    std::vector<texunit::WaveFloat> sample;
    std::vector<texunit::WaveFloat> first_sample;  ///< planes that show the first sample alone
    SampleTree sums;
    std::optional<AdaptiveBlocks> adaptive;         ///< what has stopped holds nothing of meaning in `sums`
    LookupListener* listener = nullptr;             ///< hears of the tile's lookups; null: nobody does
    FragmentListener* fragment_listener = nullptr;  ///< likewise of its fragments
    CandidateLog candidates;                        ///< of the sample at hand, for the listener
    TileTotals totals;
};

/// Renders tile (tile_x, tile_y): afterwards `scratch.sums` holds the tile's samples, `scratch.first_sample` its first-sample planes.
/// Dispatches to the instruction set in use. Throws texunit::TextureError.
void render_tile(const TileInputs& inputs, int tile_x, int tile_y, TileScratch& scratch);

/// Depth of one tile at the pixel centres, as raster::TileVisibility, MASK and BLEND surfaces covering as a shadow caster does:
/// by alpha against the cutoff, by a hash of the texel against alpha.
void draw_shadow_tile(const raster::Frame& frame, std::span<const DrawState> draws, int tile_x, int tile_y, raster::TileVisibility& out);

}  // namespace rawtexel::shading
