#include "cli/flip_comparison.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace rawtexel::cli {
namespace {

using shading::Image;

bool all_finite(const Image& image) {
    return std::ranges::all_of(image.values, [](float value) { return std::isfinite(value); });
}

Image as_shown(const ComparableImage& image, FlipKind kind) {
    const bool linear = kind == FlipKind::Hdr;
    Image colour = with_channels(image.image, 3);
    if (image.linear == linear) return colour;
    return linear ? to_linear(std::move(colour)) : to_display(std::move(colour));
}

}  // namespace

std::string_view to_string(FlipKind kind) {
    switch (kind) {
        case FlipKind::Auto: return "auto";
        case FlipKind::Ldr: return "ldr";
        case FlipKind::Hdr: return "hdr";
        case FlipKind::None: break;
    }
    return "none";
}

FlipComparison flip_comparison(const ComparableImage& test, const ComparableImage& reference, const FlipRequest& request,
                               shading::Executor& executor) {
    assert(request.kind != FlipKind::None);
    FlipComparison comparison;
    comparison.kind = request.kind;
    if (request.kind == FlipKind::Auto) comparison.kind = test.linear && reference.linear ? FlipKind::Hdr : FlipKind::Ldr;
    comparison.pixels_per_degree = request.pixels_per_degree;
    if (!all_finite(test.image) || !all_finite(reference.image)) {
        const double nan = std::numeric_limits<double>::quiet_NaN();
        comparison.figures = {nan, nan, nan, nan, nan, nan};
        return comparison;
    }
    const Image shown_test = as_shown(test, comparison.kind), shown_reference = as_shown(reference, comparison.kind);
    const FlipImages images{shown_test.values, shown_reference.values, shown_test.width, shown_test.height};
    const auto parallel_for = shading::parallel_for_of(executor);
    std::vector<float> errors;
    if (comparison.kind == FlipKind::Hdr) {
        comparison.exposures = flip_exposures(shown_reference.values);
        errors = hdr_flip(images, *comparison.exposures, request.pixels_per_degree, parallel_for);
    } else {
        errors = ldr_flip(images, request.pixels_per_degree, parallel_for);
    }
    comparison.figures = pooled_flip(errors);
    comparison.map = Image::unwritten(images.width, images.height, 1);
    comparison.map.values = shading::PixelValues(errors);
    return comparison;
}

}  // namespace rawtexel::cli
