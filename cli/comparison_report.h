// The figures of comparisons, printed.
#pragma once

#include "cli/metrics/metrics.h"

#include <span>
#include <string>

namespace rawtexel::cli {

/// One image held against the reference.
struct Comparison {
    std::string path;
    ImageError error;
};

/// One line an image, under a heading.
std::string print_table(std::span<const Comparison> comparisons);
/// JSON knows no infinity: the PSNR of equal images is null, and so is every figure of images that hold what is not a number.
std::string print_json(const std::string& reference, std::span<const Comparison> comparisons);
/// RFC 4180, 17 digits a figure.
std::string print_csv(const std::string& reference, std::span<const Comparison> comparisons);

/// Six digits.
std::string print_figure(double value);

}  // namespace rawtexel::cli
