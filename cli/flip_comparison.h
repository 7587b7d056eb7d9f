// FLIP of two image files: which of its two forms suits them, and what comes out.
#pragma once

#include "cli/comparable_image.h"
#include "cli/metrics/flip.h"
#include "shading/executor.h"

#include <optional>
#include <string_view>

namespace rawtexel::cli {

/// Auto: HDR where both images hold linear light, LDR otherwise.
enum class FlipKind { Auto, Ldr, Hdr, None };
std::string_view to_string(FlipKind kind);  // auto ldr hdr none

struct FlipRequest {
    FlipKind kind = FlipKind::Auto;
    double pixels_per_degree = kDefaultPixelsPerDegree;
};

struct FlipComparison {
    FlipKind kind = FlipKind::Ldr;  ///< Ldr or Hdr
    double pixels_per_degree = 0;
    std::optional<FlipExposures> exposures;  ///< of HDR
    FlipFigures figures;                     ///< all NaN where an image holds what is not finite
    shading::Image map;                      ///< 1 channel, 0 to 1; empty where an image holds what is not finite
};

/// Both of the same extents. Display values become linear light for HDR, linear light is clamped and encoded for LDR. The exposures are the
/// reference's. `request.kind` is not None.
FlipComparison flip_comparison(const ComparableImage& test, const ComparableImage& reference, const FlipRequest& request,
                               shading::Executor& executor);

}  // namespace rawtexel::cli
