// The account of a frame's fetches: a tally for every worker, and what needs their order.
#pragma once

#include "shading/fetch_sequencer.h"
#include "shading/fetch_tally.h"
#include "shading/tile_range.h"
#include "texunit/fetch_replay.h"

#include <memory>
#include <optional>
#include <vector>

namespace rawtexel::shading {

inline constexpr int kCanonicalTile = 64;  ///< pixels: tiles of the canonical order

class FetchAccount {
  public:
    /// Where options.needs_order(), `tile_size` is kCanonicalTile. `frame_width`: pixels of the whole frame.
    FetchAccount(const Scene& scene, const FetchOptions& options, const PixelRect& visible, int tile_size, int frame_width);
    FetchAccount(const FetchAccount&) = delete;
    FetchAccount& operator=(const FetchAccount&) = delete;

    /// A worker's listener, owned by the account.
    LookupListener& add_worker();
    /// The tile that a worker does next in place of `index`: where order matters, tiles are begun in theirs.
    int64_t begin_tile(int64_t index);
    void end_tile(int64_t tile);
    /// A tile has failed: nobody waits for it.
    void abandon();
    /// When all tiles are done.
    std::unique_ptr<FrameFetches> take();

  private:
    std::vector<Image> make_pixels() const;
    void consume(int64_t tile, const texunit::FetchStream& stream);

    FetchOptions options_;
    PixelRect visible_;
    int tile_size_, frame_columns_;
    TileRange tiles_;
    TextureSet set_;
    std::unique_ptr<FrameFetches> frame_;
    std::optional<texunit::FetchReplay> replay_;
    std::vector<texunit::FetchReplay::PixelCosts> costs_;
    FetchSequencer sequencer_;
    std::mutex workers_mutex_;
    std::vector<std::unique_ptr<FetchTally>> workers_;
};

}  // namespace rawtexel::shading
