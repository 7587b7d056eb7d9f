// Tone maps: scene-linear colour to display-linear colour in [0, 1].
#pragma once

#include "shading/display.h"

#include <glm/glm.hpp>

#include <cstddef>

namespace rawtexel::shading {

/// Stephen Hill's fit of the ACES reference rendering transform and sRGB output transform, for linear Rec. 709 input of any size >= 0.
glm::vec3 tone_map_aces(const glm::vec3& color);
/// c / (1 + c) per channel (Reinhard et al. 2002, eq. 3).
glm::vec3 tone_map_reinhard(const glm::vec3& color);

/// One colour through exposure factor and tone map; NaN and negative channels are black, the result is clamped to [0, 1].
glm::vec3 tone_mapped(const glm::vec3& radiance, float exposure_factor, ToneMap tone_map);

/// The same for `count` pixels in place, `channels` >= 3 apart; channels after the third are left alone.
void tone_map_pixels(float* pixels, size_t count, int channels, float exposure_factor, ToneMap tone_map);

}  // namespace rawtexel::shading
