// The page of `compare --html`: pictures under a slider, maps of their errors, a table of the figures.
#pragma once

#include "cli/comparison_report.h"

#include <string>
#include <vector>

namespace rawtexel::cli {

/// The reference among them, in the order in which the user named them.
struct ComparedPicture {
    std::string path;
    ComparableImage image;
    shading::Image flip;  ///< its map; empty where there is none
    bool reference = false;
};

/// All pictures of the same extents. Linear light is shown as `render` shows it by default.
std::string comparison_page(const std::vector<ComparedPicture>& pictures, std::span<const Comparison> comparisons,
                            const std::string& command);

}  // namespace rawtexel::cli
