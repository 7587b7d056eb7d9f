// Barycentrics in single precision, as steps from a point nearby where they are known in double.
#pragma once

#include "raster/frame.h"

#include <array>
#include <cstdint>

namespace rawtexel::raster {

/// Anchors serve cells of this many pixels a side, aligned to the frame: what a pixel gets depends on neither tiles nor waves.
inline constexpr int kAnchorCell = 32;

/// A triangle's barycentrics about a cell. A step j from the anchor, in pixels, leads to b + (b_dx*j.x + b_dy*j.y)/(1 + w_dx*j.x +
/// w_dy*j.y). The anchor is the corner of the cell, widened by all that samples and their quads reach, that 1/w is largest at: so that the
/// denominator is in (0, 1] wherever the cell shows the triangle, and rounding does no more than move the point by some 2^-24 of its
/// distance from the anchor.
struct Anchor {
    int32_t x, y;  ///< pixels
    float b1, b2;
    float b1_dx, b2_dx, b1_dy, b2_dy;  ///< per pixel, at the anchor
    float w_dx, w_dy;                  ///< relative change of 1/w per pixel
};

/// Of the cell that has pixel (x, y).
Anchor anchor_in_cell(const Frame& frame, uint32_t setup_index, int x, int y);

/// The anchors that were asked for last, of a few triangles in the cells that a row of a tile crosses.
class LatestAnchors {
  public:
    explicit LatestAnchors(const Frame& frame) : frame_(frame) {}
    /// As anchor_in_cell.
    const Anchor& of(uint32_t setup_index, int x, int y) {
        const int32_t cell_x = x / kAnchorCell, cell_y = y / kAnchorCell;
        Entry& entry = entries_[setup_index % kTriangles * kColumns + size_t(cell_x) % kColumns];
        if (entry.setup_index != setup_index || entry.cell_x != cell_x || entry.cell_y != cell_y)
            entry = {setup_index, cell_x, cell_y, anchor_in_cell(frame_, setup_index, x, y)};
        return entry.anchor;
    }

  private:
    static constexpr size_t kTriangles = 4, kColumns = 4;
    struct Entry {
        uint32_t setup_index = kNoTriangle;
        int32_t cell_x = 0, cell_y = 0;
        Anchor anchor{};
    };
    const Frame& frame_;
    std::array<Entry, kTriangles * kColumns> entries_;
};

}  // namespace rawtexel::raster
