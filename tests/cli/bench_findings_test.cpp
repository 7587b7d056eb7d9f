// What is said of a sweep follows from its numbers.
#include "cli/bench/bench_plots.h"
#include "cli/bench/bench_report.h"
#include "cli/bench/file_names.h"
#include "cli/bench/findings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rawtexel::cli {
namespace {

struct Curve {
    const char* filter = "bilinear";
    const char* minification = "mip none";
    const char* estimator = "all";
    const char* order = "before";
    double texels = 4;            ///< a sample
    double floor = 0, noise = 1;  ///< of the error
    std::optional<float> bias = {};
};

/// 1, 4, 16 and 64 samples of each curve, against truths without an error but `standard_error`.
SceneResults results_of(const std::vector<Curve>& curves, double standard_error = 0) {
    SceneResults results;
    results.scene = "scene";
    for (const char* filter : {"bilinear", "bspline"}) {
        Truth truth;
        truth.filter = filter;
        truth.standard_error = standard_error;
        results.truths.push_back(truth);
    }
    for (const Curve& curve : curves)
        for (const int spp : {1, 4, 16, 64}) {
            Measurement one;
            one.filter = curve.filter;
            one.minification = curve.minification;
            one.estimator = curve.estimator;
            one.order = curve.order;
            one.hybrid_bias = curve.bias;
            one.one_tap = one.estimator == "reservoir";
            one.spp = spp;
            one.width = one.height = 10;
            one.texture = {{"texels_requested", curve.texels * spp * 100}};
            one.error.mse = curve.floor * curve.floor + curve.noise * curve.noise / spp;
            one.error.rmse = std::sqrt(one.error.mse);
            one.frame_s = {0.002, 0.001, 0.003};
            one.geometry_s = one.raster_s = one.shade_s = {0.001};
            results.measurements.push_back(one);
        }
    return results;
}

std::string text_of(const SceneResults& results, FindingKind kind, const std::string& filter = "bilinear") {
    for (const Finding& finding : findings_of(results, series_of(results)))
        if (finding.kind == kind && finding.filter == filter) return finding.text;
    return "";
}

TEST(Series, TellFloorsFromFalls) {
    const SceneResults results = results_of({{.minification = "a", .floor = 0.5, .noise = 0.3},
                                             {.minification = "b", .noise = 2},
                                             {.minification = "c", .floor = 0.1, .noise = 0.8},
                                             {.minification = "d", .noise = 0.05}},
                                            0.004);
    const std::vector<Series> series = series_of(results);
    ASSERT_EQ(series.size(), 4u);
    EXPECT_EQ(series[0].trend, Trend::Floor);
    // Without the truth's own.
    ASSERT_TRUE(series[0].bias);
    EXPECT_NEAR(*series[0].bias, std::sqrt(0.25 - 0.004 * 0.004), 1e-9);
    EXPECT_EQ(series[1].trend, Trend::Falls);
    ASSERT_TRUE(series[1].slope);
    EXPECT_NEAR(series[1].slope->slope, -0.5, 1e-9);
    EXPECT_EQ(series[2].trend, Trend::Flattens);
    // Its last error, 0.00625, is below three times 0.004.
    EXPECT_EQ(series[3].trend, Trend::Truth);
    EXPECT_FALSE(series[3].bias);
    // Fitted to what is clear of the truth: 0.05, 0.025 and 0.0125.
    EXPECT_NEAR(series[3].slope->slope, -0.5, 1e-9);
}

TEST(Series, HaveNoFitWhereErrorsAreNothingOrNoNumber) {
    for (const double value : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
        SceneResults results = results_of({{}});
        for (Measurement& one : results.measurements) one.error.mse = one.error.rmse = value;
        const std::vector<Series> series = series_of(results);
        EXPECT_FALSE(series[0].slope);
        EXPECT_FALSE(series[0].bias);
        EXPECT_EQ(series[0].trend, Trend::Unknown);
        const SceneAnalysis analysis = analyse(results);
        EXPECT_NE(bench_json(std::vector{results}, std::vector{analysis}, "").dump().find("\"slope\":null"), std::string::npos);
        for (const BenchPlot& plot : bench_plots(results, series, analysis.fronts, 0, "scene"))
            EXPECT_EQ(plot_svg(plot.plot).find("nan"), std::string::npos) << plot.kind;
    }
}

TEST(Series, ReachAnErrorBetweenTheirPoints) {
    const SceneResults results = results_of({{.texels = 4}});
    const Series series = series_of(results)[0];
    // 1 / sqrt(n) with 4 n texels.
    EXPECT_NEAR(fetches_at(series, results, 0.5).value(), 16, 1e-9);
    EXPECT_NEAR(fetches_at(series, results, std::sqrt(1.0 / 8)).value(), 32, 1e-9);
    EXPECT_NEAR(fetches_at(series, results, 3).value(), 4, 1e-9);
    EXPECT_FALSE(fetches_at(series, results, 0.12));
}

TEST(Findings, SayWhatHitsAFloor) {
    const std::vector<Curve> curves{{.minification = "mip linear", .floor = 0.5, .noise = 0.3},
                                    {.minification = "mip none", .floor = 0.3, .noise = 0.3},
                                    {.estimator = "reservoir", .order = "after", .texels = 1, .noise = 0.8}};
    const SceneResults results = results_of(curves);
    EXPECT_EQ(text_of(results, FindingKind::Before),
              "bilinear, filtered before shading: hits a floor: mip linear · all (0.5), mip none · all (0.3).");
    EXPECT_EQ(text_of(results, FindingKind::After),
              "bilinear, filtered after shading: falls: mip none · reservoir (0.1 with 64 samples, N^−0.50).");
    EXPECT_EQ(
        text_of(results, FindingKind::Orders),
        "bilinear, with 64 samples: filtering after shading is 3.02 times nearer to the truth: 0.1 (mip none · reservoir) against 0.302 "
        "(mip none · all).");
}

TEST(Findings, SayWhereTheTruthMissedItsGoal) {
    SceneResults results = results_of({{}}, 0.02);
    results.truths[0].goal = 0.001;
    EXPECT_EQ(text_of(results, FindingKind::Truth),
              "bilinear: its truth is known to 0.02 and not to the 0.001 aimed at; errors below 0.06 are its own.");
    results.truths[0].goal = 0.02;
    EXPECT_EQ(text_of(results, FindingKind::Truth), "");
}

TEST(Findings, NameEstimatorsThatComeToTheSameTogether) {
    const Curve one{.estimator = "reservoir", .order = "after", .texels = 1, .noise = 0.8};
    Curve same = one, other = one;
    same.estimator = "jitter";
    other.estimator = "all";
    other.noise = 0.4;
    EXPECT_EQ(
        text_of(results_of({one, same, other}), FindingKind::After),
        "bilinear, filtered after shading: falls: mip none · reservoir/jitter (0.1 with 64 samples, N^−0.50), mip none · all (0.05 with "
        "64 samples, N^−0.50).");
}

TEST(Findings, TellNoTrendFromTwoErrors) {
    SceneResults results = results_of({{}});
    results.measurements.resize(2);
    EXPECT_EQ(text_of(results, FindingKind::Before),
              "bilinear, filtered before shading: too few numbers to tell: mip none · all (0.5 with 4 samples).");
}

TEST(Findings, DoNotFavourAfter) {
    const SceneResults results = results_of({{.noise = 0.3}, {.estimator = "reservoir", .order = "after", .floor = 0.4, .noise = 0.3}});
    EXPECT_EQ(text_of(results, FindingKind::After), "bilinear, filtered after shading: hits a floor: mip none · reservoir (0.4).");
    EXPECT_NE(text_of(results, FindingKind::Orders).find("filtering before shading is 10.7 times nearer"), std::string::npos);
    const SceneResults equal = results_of({{.noise = 0.3}, {.order = "after", .noise = 0.301}});
    EXPECT_NE(text_of(equal, FindingKind::Orders).find("equally near"), std::string::npos);
    const SceneResults unclear = results_of({{.noise = 0.3}, {.order = "after", .noise = 0.2}}, 0.02);
    EXPECT_NE(text_of(unclear, FindingKind::Orders).find("both as near as this truth can tell"), std::string::npos);
}

TEST(Findings, CompareOrdersWithSamplesThatBothHaveOfTheNearestSetting) {
    const Curve before{.noise = 0.3}, after{.order = "after", .noise = 0.3};
    const Curve drawn{.estimator = "reservoir", .order = "after", .texels = 1, .noise = 3};
    SceneResults results = results_of({before, after, drawn});
    // All taps after shading were left out with 64 samples; the draws were not.
    std::erase_if(results.measurements,
                  [](const Measurement& one) { return one.order == "after" && one.estimator == "all" && one.spp == 64; });
    EXPECT_EQ(text_of(results, FindingKind::Orders),
              "bilinear, with 16 samples: before and after shading are equally near to the truth (0.075).");
    // Draws that win all the same win.
    for (Measurement& one : results.measurements)
        if (one.estimator == "reservoir") one.error.rmse /= 100;
    EXPECT_EQ(text_of(results, FindingKind::Orders),
              "bilinear, with 64 samples: filtering after shading is 10 times nearer to the truth: 0.00375 (mip none · reservoir) against "
              "0.0375 (mip none · all).");
}

TEST(Findings, SayWhereOneTapOfACubicReadsTheFewest) {
    const Curve one{.filter = "bspline", .estimator = "reservoir", .order = "after", .texels = 1, .noise = 1};
    // All 16 taps have half the noise: they read four times as many texels for the same error, but for one sample's.
    const SceneResults wins = results_of({one, {.filter = "bspline", .order = "after", .texels = 16, .noise = 0.5}});
    EXPECT_EQ(text_of(wins, FindingKind::OneTap, "bspline"),
              "One-tap bspline (mip none · reservoir) has the fewest fetches at 4 of 4 errors that it reaches, against more taps of its "
              "kernel: at RMSE 0.125 (64 samples) it reads 64 texels a pixel, bspline · mip none · all · after 256.");
    // A tenth of the noise: from 16 samples on one sample of all taps reads no more.
    const SceneResults loses = results_of({one, {.filter = "bspline", .order = "after", .texels = 16, .noise = 0.1}});
    EXPECT_EQ(text_of(loses, FindingKind::OneTap, "bspline"),
              "One-tap bspline (mip none · reservoir) has the fewest fetches at 3 of 4 errors that it reaches, against more taps of its "
              "kernel: at RMSE 0.25 (16 samples) it reads 16 texels a pixel, as many as bspline · mip none · all · after. It has not at "
              "RMSE 0.125 "
              "(64 samples): there bspline · mip none · all · after reads 16, it 64.");
    const SceneResults floor = results_of({one, {.filter = "bspline", .texels = 16, .floor = 2, .noise = 0.1}});
    EXPECT_NE(text_of(floor, FindingKind::OneTap, "bspline").find("none of them gets there"), std::string::npos);
    // Other kernels are another matter.
    const SceneResults others = results_of({one, {.estimator = "reservoir", .order = "after", .texels = 1, .noise = 0.5}});
    EXPECT_EQ(text_of(others, FindingKind::OneTapOthers, "bspline"),
              "One-tap bspline (mip none · reservoir) has the fewest fetches at 1 of 4 errors that it reaches, against other kernels, each "
              "beside its own truth: at "
              "RMSE 1 (1 sample) it reads 1 texel a pixel, as many as bilinear · mip none · reservoir · after. It has not at RMSE 0.5 (4 "
              "samples): "
              "there bilinear · mip none · reservoir · after reads 1, it 4.");
}

TEST(Findings, LeaveFinerLevelsOut) {
    const SceneResults results =
        results_of({{.floor = 0.5, .noise = 0.1}, {.minification = "mip linear, hybrid 2", .floor = 0.1, .bias = 2.0f}});
    EXPECT_EQ(text_of(results, FindingKind::Before).find("hybrid"), std::string::npos);
    const std::vector<Series> series = series_of(results);
    bool plotted = false;
    for (const BenchPlot& plot : bench_plots(results, series, fronts_of(results), 0, "scene"))
        plotted = plotted || plot.kind == "bias-hybrid";
    EXPECT_TRUE(plotted);
}

TEST(FileNames, AreTakenFromScenesAndToldApart) {
    EXPECT_EQ(file_word("mip linear, aniso 16:0.5"), "mip-linear-aniso-16-0.5");
    EXPECT_EQ(file_word("ü--/x "), "x");
    const std::vector<std::string> scenes{"bumps", "a b/ship.gltf", "c/ship.glb", "…"};
    EXPECT_EQ(scene_word("bumps", scenes), "bumps");
    EXPECT_EQ(scene_word(scenes[1], scenes), "ship-2");
    EXPECT_EQ(scene_word(scenes[2], scenes), "ship-3");
    EXPECT_EQ(scene_word(scenes[3], scenes), "4");
}

}  // namespace
}  // namespace rawtexel::cli
