// Plots: where their ticks are, and what their curves say.
#include "cli/reports/plot.h"

#include "cli/command.h"
#include "cli/reports/kernel_plot.h"
#include "tests/cli/program_runner.h"
#include "tests/temporary_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rawtexel::cli {
namespace {

using texunit::Kernel;

size_t count(const std::string& text, const std::string& part) {
    size_t found = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

TEST(AxisTicks, AreRoundAndSpanTheValues) {
    EXPECT_EQ(axis_ticks(0, 1, false), (std::vector<double>{0, 0.2, 0.4, 0.2 * 3, 0.8, 1}));
    EXPECT_EQ(axis_ticks(-4, 4, false), (std::vector<double>{-4, -3, -2, -1, 0, 1, 2, 3, 4}));
    EXPECT_EQ(axis_ticks(1, 4096, true), (std::vector<double>{1, 10, 100, 1000, 10000}));
    EXPECT_EQ(axis_ticks(3, 40, true), (std::vector<double>{2, 5, 10, 20, 50}));
    const std::pair<double, double> spans[] = {{3, 3}, {0, 0}, {-7.3e-9, 2.1e-8}, {1e9, 1.001e9}, {12.5, 99}, {-1, -1}};
    for (const auto& [least, most] : spans) {
        for (const bool logarithmic : {false, true}) {
            if (logarithmic && !(least > 0)) continue;
            const std::vector<double> ticks = axis_ticks(least, most, logarithmic);
            ASSERT_GE(ticks.size(), 2u) << least << ' ' << most;
            EXPECT_LE(ticks.size(), 12u) << least << ' ' << most;
            EXPECT_LE(ticks.front(), least * (1 + 1e-9) + 1e-300) << most;
            EXPECT_GE(ticks.back(), most * (1 - 1e-9) - 1e-300) << least;
            for (size_t i = 1; i < ticks.size(); ++i) EXPECT_LT(ticks[i - 1], ticks[i]);
        }
    }
    EXPECT_LE(axis_ticks(1e-12, 1e12, true).size(), 12u);
}

TEST(PlotSvg, DrawsWhatItIsGiven) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Plot plot{.title = "a < b & c",
                    .x = {"samples", true},
                    .y = {"RMSE", true},
                    .series = {{"one", {{1, 1}, {10, 0.1}, {100, 0.01}}, true}, {"two", {{1, 0.5}, {10, nan}, {50, -1}, {100, 0.5}}}}};
    const std::string svg = plot_svg(plot);
    EXPECT_EQ(count(svg, "<svg"), 1u);
    EXPECT_EQ(count(svg, "a &lt; b &amp; c"), 2u);
    EXPECT_EQ(count(svg, "<circle"), 3u);
    // Both axes from 72,364 to 540,40: a power of ten is half of x and of y.
    EXPECT_NE(svg.find("M72 40L306 202L540 364"), std::string::npos) << svg;
    // What is no number, or below a logarithmic axis, breaks the line.
    EXPECT_NE(svg.find("M72 88.77M540 88.77"), std::string::npos) << svg;
    EXPECT_NE(svg.find(">one</text>"), std::string::npos);
    EXPECT_NE(svg.find(">samples</text>"), std::string::npos);
    EXPECT_EQ(plot_svg({}).find("nan"), std::string::npos);
}

TEST(PlotSvg, MarksPointsAsTheyAre) {
    const PlotPoint ringed{.x = 1, .y = 1, .ringed = true, .note = "a < b", .key = 7}, hollow{.x = 2, .y = 2, .hollow = true};
    const std::string svg = plot_svg({.title = "", .x = {}, .y = {}, .series = {{"s", {ringed, hollow}, true}}});
    EXPECT_EQ(count(svg, "<circle"), 3u);
    EXPECT_EQ(count(svg, "data-key=\"7\""), 1u);
    EXPECT_EQ(count(svg, "<title>a &lt; b</title></circle>"), 1u);
    EXPECT_EQ(count(svg, "fill=\"#fff\" stroke="), 1u);
}

TEST(PlotSvg, MakesRoomForItsLegend) {
    Plot plot{.title = "", .x = {}, .y = {}, .series = {}};
    for (int i = 0; i < 40; ++i) plot.series.push_back({.name = i == 3 ? std::string(60, 'x') : "s", .points = {{0, 0}, {1, 1}}});
    plot.series.push_back({.name = "", .points = {{0, 0}, {1, 1}}, .thin = true});
    const std::string svg = plot_svg(plot);
    EXPECT_NE(svg.find("viewBox=\"0 0 968 778\""), std::string::npos) << svg.substr(0, 200);
    EXPECT_NE(plot_svg({}).find("viewBox=\"0 0 720 420\""), std::string::npos);
    EXPECT_EQ(count(svg, "h24"), 40u);  // nothing in the legend without a name
    EXPECT_EQ(count(svg, "stroke-dasharray=\"1 3\""), 1u);
}

TEST(KernelPlot, HasTheKernelsShapes) {
    const std::vector<Kernel> kernels{Kernel::Bilinear, Kernel::BSpline, Kernel::CatmullRom, Kernel::Lanczos3};
    const Plot plot = kernel_plot(kernels);
    ASSERT_EQ(plot.series.size(), kernels.size());
    const auto at = [&](size_t series, double x) {
        for (const PlotPoint& point : plot.series[series].points)
            if (point.x == x) return point.y;
        return -9.0;
    };
    for (const double x : {-1.5, -0.25, 0.0, 0.5, 0.75, 2.5}) EXPECT_NEAR(at(0, x), std::max(0.0, 1 - std::abs(x)), 1e-6) << x;
    EXPECT_NEAR(at(1, 0), 2.0 / 3, 1e-6);
    EXPECT_NEAR(at(1, 1), 1.0 / 6, 1e-6);
    EXPECT_NEAR(at(2, 0.5), 9.0 / 16, 1e-6);
    EXPECT_NEAR(at(2, -1.5), -1.0 / 16, 1e-6);
    EXPECT_LT(at(3, 1.5), -0.05);
    EXPECT_GT(at(3, 2.5), 0.005);
    EXPECT_EQ(at(3, 3.5), 0);
}

TEST(KernelPlot, IsWrittenByListFilters) {
    const test::TemporaryFolder folder;
    EXPECT_EQ(test::run({"list", "filters", "--plot", folder / "kernels.svg"}).code, kDone);
    const std::string svg = test::read_file(folder / "kernels.svg");
    for (const char* name : {"nearest", "mitchell", "gaussian-point"})
        EXPECT_NE(svg.find(">" + std::string(name)), std::string::npos) << name;
    EXPECT_EQ(test::why_not_failed(test::run({"list", "noises", "--plot", folder / "x.svg"}), kWrongUsage, "allowed: list filters"), "");
    EXPECT_EQ(test::why_not_failed(test::run({"list", "filters", "--plot", folder / "x.png"}), kWrongUsage, ".svg"), "");
    EXPECT_EQ(test::why_not_failed(test::run({"list", "filters", "--plot", folder / "none/x.svg"}), kCannotWrite, "x.svg"), "");
}

}  // namespace
}  // namespace rawtexel::cli
