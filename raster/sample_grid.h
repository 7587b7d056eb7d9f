// The fixed-point grids: vertices on 1/256 of a pixel (24.8), sample points on 1/512, so that every edge function is an exact integer.
#pragma once

#include <cstdint>

namespace rawtexel::raster {

inline constexpr int kSubpixelBits = 8;  ///< vertices: 24.8
inline constexpr int kSubpixelOne = 1 << kSubpixelBits;
inline constexpr int kSampleBits = 9;  ///< sample points: 1/512 pixel
inline constexpr int kSampleOne = 1 << kSampleBits;
inline constexpr int kGuardBand = 1 << 15;               ///< pixels: vertices lie within [-kGuardBand, kGuardBand] after clipping
inline constexpr int kBlockWidth = 8, kBlockHeight = 4;  ///< coverage and shading block, 32 pixels
inline constexpr int kMaxFrameExtent = 16384;            ///< pixels along a side of the frame
inline constexpr int kMostFilterRadius = 16;             ///< pixels

/// Where a pixel is sampled: offset of the sample point from the pixel's upper left corner, in 1/512 pixel.
/// The centre is (256, 256). Offsets may leave [0, 512) by the support of the pixel filter.
struct SampleOffset {
    int32_t x = kSampleOne / 2, y = kSampleOne / 2;
    bool operator==(const SampleOffset&) const = default;
};

/// The offsets from `x_min` to `x_max` and from `y_min` to `y_max`, ends included.
struct OffsetRange {
    int32_t x_min = 0, x_max = 0, y_min = 0, y_max = 0;
};

}  // namespace rawtexel::raster
