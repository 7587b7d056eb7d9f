// A worker's account of the lookups it hears of.
#pragma once

#include "shading/fetch_options.h"
#include "shading/frame_fetches.h"
#include "shading/lookup_listener.h"
#include "shading/pixel_lines.h"
#include "shading/pixel_rect.h"
#include "texunit/fetch_stream.h"

#include <array>
#include <functional>
#include <vector>

namespace rawtexel::shading {

class FetchTally final : public LookupListener {
  public:
    /// Gets the fetches of every sample of tile (tile_x, tile_y) in canonical order.
    using HandIn = std::function<void(int tile_x, int tile_y, texunit::FetchStream& stream)>;

    /// `hand_in` is called where options.needs_order(). end_tile writes to `pixels`, which outlives the tally: see FrameFetches.
    /// `tile_size` in pixels.
    FetchTally(const TextureSet& set, const FetchOptions& options, const PixelRect& visible, int tile_size, std::vector<Image>& pixels,
               HandIn hand_in);

    void begin_tile(int tile_x, int tile_y) override;
    void begin_wave(const ListenedWave& wave) override;
    void fragments(const ListenedFragments&) override { end_all_drawn(); }
    void lookup(const ListenedLookup& lookup) override;
    void drawn(const ListenedDraw& draw) override;
    void end_wave() override;
    void end_sample() override;
    void end_tile() override;

    /// Adds what this worker heard; pixels are there already.
    void add_to(FrameFetches& frame) const;

  private:
    /// Of one pixel of the tile, over its samples.
    struct PixelSums {
        uint64_t texels = 0;
        uint32_t lines = 0, samples = 0, lookups = 0;
        double level = 0, anisotropy = 0;
    };
    bool records() const { return options_.pixel_lines || options_.needs_order(); }
    bool sums_pixels() const { return !pixels_.empty(); }
    texunit::FetchCounter counter_of(size_t place);
    /// A lookup whose texels are drawn one after the other.
    struct DrawnLookup {
        texunit::WaveMask lanes = 0;
        texunit::Wave<uint32_t> texels{};
    };
    void add_drawn_texels(const ListenedDraw& draw, const texunit::Wave<uint32_t>& before);
    void end_drawn(DrawnLookup& drawn);
    void end_all_drawn();
    void measure(const ListenedLookup& lookup, const texunit::WaveFloat& lod);
    void sum_pixels_of_wave();
    size_t pixel(int lane) const;

    const TextureSet& set_;
    FetchOptions options_;
    PixelRect visible_;
    int tile_size_;
    std::vector<Image>& pixels_;
    HandIn hand_in_;
    std::vector<texunit::FetchCounts> counts_;
    texunit::TouchedTexels touched_;
    texunit::FetchStreamRecorder recorder_;
    texunit::FetchStream stream_;
    std::vector<PixelSums> sums_;
    PixelLines lines_;
    int tile_x_ = 0, tile_y_ = 0;  ///< the tile's number along either axis
    ListenedWave wave_;
    texunit::Wave<uint32_t> wave_texels_{};
    FetchHistograms histograms_;
    std::array<DrawnLookup, kMapSlots> drawn_{};  ///< of the fragments at hand
};

}  // namespace rawtexel::shading
