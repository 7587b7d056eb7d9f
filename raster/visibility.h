// Per-tile visibility: which triangle is nearest at every sample point of a tile.
#pragma once

#include "raster/frame.h"

#include <cstdint>
#include <vector>

namespace rawtexel::raster {

/// The sample points of one pass over a tile: one offset for all pixels, or one per pixel.
/// No offset may lie farther from the centre than FrameOptions::filter_radius (asserted).
struct TileSamples {
    SampleOffset frame;                       ///< used where per_pixel is null
    const SampleOffset* per_pixel = nullptr;  ///< row by row over the tile, tile_size per row
};

/// A tile's visibility: tile_size x tile_size entries, row by row. Pixels outside the frame hold no triangle.
struct TileVisibility {
    int tile_size = 0;
    /// Whoever reads the entries asks the block first: one that shows the same all over may be left unwritten. Set by the owner.
    bool may_leave_blocks = false;
    std::vector<uint32_t> triangle;  ///< setup index, or kNoTriangle
    std::vector<float> depth;        ///< 1 near .. 0 far; 0 where there is no triangle
    uint64_t hiz_rejected = 0;       ///< 8x8 blocks of triangles skipped because what is drawn before hides all of them

    /// Pixels that hold opaque geometry, eight to a byte, row by row.
    std::vector<uint8_t> covered;
    static constexpr int kBlockSide = 8;  ///< pixels
    /// Of every block, row by row; what opaque geometry alone has written.
    struct Block {
        float farthest = 0.0f;                   ///< depth of the farthest pixel as of the last look
        float nearest = 0.0f;                    ///< no pixel is nearer
        int16_t open = kBlockSide * kBlockSide;  ///< pixels inside of the frame that hold none
        bool stale = false;                      ///< written since that look
        bool written = true;                     ///< the entries of its pixels hold what they show
        uint32_t shown = kNoTriangle;            ///< until they do: what all of them show, opaque or none
    };
    std::vector<Block> block;
    const Block& block_of(int column, int row) const {
        return block[size_t(row / kBlockSide) * size_t(tile_size / kBlockSide) + size_t(column / kBlockSide)];
    }

    /// A triangle of the bin, and the tile's pixels with a sample point inside its box, ends included.
    struct Hit {
        uint32_t setup_index;
        int16_t first_x, first_y, last_x, last_y;
        uint16_t covered;  ///< of tiny ones: bit column + kTiny*row, from the first pixel on
        bool small;        ///< its integers fit 32 bits (raster/small_triangle-inl.h)
        bool tiny;         ///< small, kTiny x kTiny pixels at most, and what it covers is known
        static constexpr int kTiny = 4;
    };
    std::vector<Hit> hits;

    /// Corners of the triangles of the bin drawn last, kept for its other samples.
    struct Corners {
        uint64_t frame = 0;  ///< Frame::serial()
        int tile_x = -1, tile_y = -1;
        size_t opaque = 0;  ///< triangles of the bin, its first ones
        std::vector<int32_t> x[3], y[3];
    } corners;

    /// Nothing visible; keeps its memory.
    void reset(int size);
};

/// A wave of candidate fragments of one triangle that pass the depth test so far: the 8x4 block whose upper left pixel is (x, y) of the
/// frame.
struct CandidateWave {
    const SetupTriangle* triangle;
    uint32_t setup_index;
    int x, y;                    ///< pixels of the frame, multiples of 8 and 4
    uint32_t mask;               ///< lane = column + 8*row
    const SampleOffset* offset;  ///< 32 sample offsets, by lane
    const float* depth;          ///< 32 depths, by lane; of lanes outside the mask anything
};

/// Draws the bin of tile (tile_x, tile_y) into `out`, which it resets first. The winner at a sample is the greatest depth value
/// (nearest), ties going to the smallest triangle_id, whatever the order of the bin: a total order. Opaque geometry is drawn first; for
/// every other triangle `coverage(const CandidateWave&) -> uint32_t` returns the lanes of the mask that cover, called only for lanes in
/// front so far. A coverage object with a member `opaque(const CandidateWave&)` hears of opaque waves in front so far, too. Coverage is
/// exact: integer edge functions at 1/512-pixel sample points, top-left rule (D3D11.3, "Top-Left Rule").
///
/// Defined in raster/visibility-inl.h, compiled into each caller's instruction set:
///   template <class Coverage>
///   void tile_visibility(const Frame&, int tile_x, int tile_y, const TileSamples&, Coverage&& coverage, TileVisibility& out);
///
/// This one draws with every candidate covering.
void tile_visibility_opaque(const Frame& frame, int tile_x, int tile_y, const TileSamples& samples, TileVisibility& out);

}  // namespace rawtexel::raster
