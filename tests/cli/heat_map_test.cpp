#include "cli/reports/heat_map.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

namespace rawtexel::cli {
namespace {

Rgb8 pixel(const Canvas& canvas, int x, int y) {
    const uint8_t* code = canvas.codes.data() + (size_t(y) * size_t(canvas.width) + size_t(x)) * 3;
    return {code[0], code[1], code[2]};
}

shading::Image ramp(int width, int height) {
    shading::Image image(width, height, 1);
    for (size_t i = 0; i < image.values.size(); ++i) image.values[i] = float(i);
    return image;
}

TEST(HeatMap, ShowsItsValuesInTheRangeOfItsLegend) {
    const shading::Image image = ramp(400, 2);
    const Canvas canvas = draw_heat_map(image, {"level", 0.0, 799.0});
    ASSERT_EQ(canvas.width, 400);
    ASSERT_EQ(canvas.height, 2 + kLegendHeight);
    EXPECT_EQ(pixel(canvas, 0, 0), magma(0.0));
    EXPECT_EQ(pixel(canvas, 399, 1), magma(1.0));
    EXPECT_EQ(pixel(canvas, 7, 1), magma(407.0 / 799.0));
    // The bar runs through all colours, from dark to bright.
    const int row = 2 + kLegendHeight - 20;
    int seen = 0;
    for (int x = 1; x < canvas.width; ++x) seen += pixel(canvas, x, row) != pixel(canvas, x - 1, row);
    EXPECT_GT(seen, 200);
}

TEST(HeatMap, IsAsWideAsItsLegendNeeds) {
    const Canvas canvas = draw_heat_map(ramp(3, 2), {"texel reads a pixel", 123.456, 654321.0});
    EXPECT_EQ(canvas.width, kLeastHeatMapWidth);
    EXPECT_EQ(pixel(canvas, 3, 0), (Rgb8{255, 255, 255}));
    // Nothing runs out of the picture: its last column and row are paper.
    for (int y = 2; y < canvas.height; ++y) ASSERT_EQ(pixel(canvas, canvas.width - 1, y), (Rgb8{255, 255, 255})) << y;
    for (int x = 0; x < canvas.width; ++x) ASSERT_EQ(pixel(canvas, x, canvas.height - 1), (Rgb8{255, 255, 255})) << x;
}

TEST(HeatMap, OfNothingButZerosIsDark) {
    const Canvas canvas = draw_heat_map(shading::Image(2, 2, 1), {"level", 0.0, 0.0});
    EXPECT_EQ(pixel(canvas, 1, 1), magma(0.0));
}

TEST(HeatMap, MaximumLeavesOutWhatIsNotFinite) {
    shading::Image image(3, 1, 1);
    image.values = {2.0f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()};
    EXPECT_EQ(finite_maximum(image), 2.0);
    image.values = {-1.0f, -2.0f, -3.0f};
    EXPECT_EQ(finite_maximum(image), 0.0);
}

/// The letters of `text` as rows of '#' and '.'.
std::string drawn(std::string_view text) {
    Canvas canvas(text_width(text, 1), kLetterHeight, {255, 255, 255});
    draw_text(canvas, 0, 0, text, 1, {0, 0, 0});
    std::string rows;
    for (int y = 0; y < canvas.height; ++y) {
        for (int x = 0; x < canvas.width; ++x) rows += pixel(canvas, x, y)[0] == 0 ? '#' : '.';
        rows += '\n';
    }
    return rows;
}

TEST(RasterText, DrawsLetters) {
    EXPECT_EQ(drawn("7t"),
              "#####..#...\n"
              "....#..#...\n"
              "...#..###..\n"
              "..#....#...\n"
              ".#.....#...\n"
              ".#.....#..#\n"
              ".#......##.\n");
    EXPECT_EQ(drawn("L"), drawn("l"));
    EXPECT_EQ(drawn("\xc3"), drawn("?"));
    EXPECT_EQ(text_width("", 2), 0);
    EXPECT_EQ(text_width("abc", 2), 34);
}

TEST(RasterText, EveryLetterIsItsOwn) {
    const std::string letters = "abcdefghijklmnopqrstuvwxyz0123456789_.,-+:/%()";
    std::set<std::string> shapes;
    for (const char letter : letters) shapes.insert(drawn(std::string(1, letter)));
    shapes.insert(drawn("?"));
    EXPECT_EQ(shapes.size(), letters.size() + 1);
}

TEST(RasterText, StaysInsideTheCanvas) {
    Canvas canvas(10, 5, {1, 2, 3});
    draw_text(canvas, -3, -2, "wide text", 3, {0, 0, 0});
    canvas.fill(8, 3, 100, 100, {9, 9, 9});
    EXPECT_EQ(pixel(canvas, 9, 4), (Rgb8{9, 9, 9}));
    EXPECT_EQ(canvas.codes.size(), 150u);
}

}  // namespace
}  // namespace rawtexel::cli
