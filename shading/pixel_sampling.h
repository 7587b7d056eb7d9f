// Where in a pixel its samples lie.
#pragma once

#include "raster/sample_grid.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace rawtexel::shading {

/// Weight of a sample by its distance from the pixel's centre; sampled, never splatted.
/// box: the pixel. tent: radius 1. gaussian: sigma 0.5 pixel, cut at 1.5.
enum class PixelFilter { Box, Tent, Gaussian };
/// One offset per sample for all pixels (sample 0 at the centre), or one per pixel.
enum class PixelJitter { Frame, Pixel };

std::string_view to_string(PixelFilter filter);
std::string_view to_string(PixelJitter jitter);
std::optional<PixelFilter> parse_pixel_filter(std::string_view text);
std::optional<PixelJitter> parse_pixel_jitter(std::string_view text);

/// Support along one axis from the pixel's centre, pixels: 0.5, 1, 1.5.
float filter_radius(PixelFilter filter);

/// Offset of sample `sample` of pixel (x, y): odd multiples of 1/512 pixel, but the centre for sample 0 of PixelJitter::Frame.
/// The same for any total number of samples. Sequence: R2 (Roberts 2018), in Pixel mode shifted by a hash of the pixel.
raster::SampleOffset sample_offset(PixelFilter filter, PixelJitter jitter, uint32_t sample, uint32_t x, uint32_t y, uint32_t seed);

/// The offset that the filter gives to two numbers in [0, 1): odd multiples of 1/512 pixel.
raster::SampleOffset filtered_offset(PixelFilter filter, float x, float y);

/// The part of it that does not depend on the sample: a toroidal shift of the sequence, in 2^-32.
struct SequenceShift {
    uint32_t x = 0, y = 0;
};
SequenceShift sequence_shift(PixelJitter jitter, uint32_t x, uint32_t y, uint32_t seed);
raster::SampleOffset sample_offset(PixelFilter filter, PixelJitter jitter, uint32_t sample, const SequenceShift& shift);

}  // namespace rawtexel::shading
