// Short labels drawn into images: lower-case letters, digits and what numbers need, 5x7 pixels each.
#pragma once

#include "cli/reports/colour_map.h"

#include <string_view>
#include <vector>

namespace rawtexel::cli {

/// RGB codes, rows from top to bottom.
struct Canvas {
    int width = 0, height = 0;
    std::vector<uint8_t> codes;

    Canvas(int w, int h, Rgb8 ground);
    /// Pixels outside are left out.
    void fill(int x, int y, int w, int h, Rgb8 colour);
};

/// Pixels from one letter to the next, and their height, at a scale of 1.
inline constexpr int kLetterAdvance = 6, kLetterHeight = 7;

/// Width of `text` in pixels.
int text_width(std::string_view text, int scale);
/// (x, y): the upper left corner. Capitals show as small letters, what there is no letter for as "?".
void draw_text(Canvas& canvas, int x, int y, std::string_view text, int scale, Rgb8 colour);

}  // namespace rawtexel::cli
