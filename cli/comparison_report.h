// The figures of comparisons, printed.
#pragma once

#include "cli/flip_comparison.h"
#include "cli/metrics/metrics.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <span>
#include <string>

namespace rawtexel::cli {

/// One image held against the reference.
struct Comparison {
    std::string path;
    ImageError error;
    std::optional<FlipComparison> flip;  ///< unset: not asked for
};

/// One line an image, under a heading; then the same of FLIP.
std::string print_table(std::span<const Comparison> comparisons);
/// JSON knows no infinity: the PSNR of equal images is null, and so is every figure of images that hold what is not a number.
nlohmann::ordered_json comparison_json(const std::string& reference, std::span<const Comparison> comparisons);
std::string print_json(const std::string& reference, std::span<const Comparison> comparisons);
/// RFC 4180, 17 digits a figure; what was not asked for is left empty.
std::string print_csv(const std::string& reference, std::span<const Comparison> comparisons);

/// Six digits.
std::string print_figure(double value);

}  // namespace rawtexel::cli
