#include "cli/bench/bench_page.h"
#include "cli/bench/bench_run.h"
#include "cli/command.h"
#include "cli/shell_words.h"
#include "scenes/image_io.h"
#include "tests/cli/program_runner.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>
#include <thread>

namespace rawtexel::cli {
namespace {

using test::run;
using test::TemporaryFolder;
using test::why_not_failed;
using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

Words with(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

/// Small frames, silent, without the sky whose prefiltering would take most of the time.
const Words kFrame{"--size", "24x16", "--progress", "never", "--light", "0.2,-0.3,-1,3", "--environment", "none"};
/// Few configurations.
const Words kSweep{"--mip", "none,linear", "--estimator", "all,reservoir", "--spp", "1,4", "--reference", "0.02", "--repeat", "2"};

Words bench_words(const std::string& folder, const Words& more = kSweep) {
    return with(with({"bench", "metal-edge", "-o", folder}, kFrame), more);
}

Json read_json(const std::string& path) { return Json::parse(test::read_file(path)); }

Json bench(const std::string& folder, const Words& more = kSweep) {
    const test::Outcome outcome = run(bench_words(folder, more));
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    return read_json(folder + "/bench.json");
}

std::vector<std::string> lines_of(const std::string& path) {
    std::istringstream file(test::read_file(path));
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
}

/// Cells of a line without quotes inside of fields.
std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (const char c : line) {
        if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            cells.emplace_back();
        else
            cells.back() += c;
    }
    return cells;
}

Json at_path(const Json& json, const std::string& column) {
    const size_t under = column.find('_');
    for (const char* group : {"image", "frame_s", "time_s", "texture"}) {
        const std::string start = std::string(group) + "_";
        if (column.starts_with(start) && json.contains(group) && json.at(group).contains(column.substr(start.size())))
            return json.at(group).at(column.substr(start.size()));
    }
    EXPECT_TRUE(json.contains(column)) << column << ' ' << under;
    return json.at(column);
}

TEST(Bench, TheTableHoldsTheNumbersOfTheJson) {
    const TemporaryFolder folder;
    const Json json = bench(folder / "out");
    const std::vector<std::string> lines = lines_of(folder / "out/bench.csv");
    const Json& configurations = json.at("configurations");
    ASSERT_EQ(lines.size(), configurations.size() + 1);
    ASSERT_EQ(configurations.size(), 24u);  // two kernels, two mips, all before, all and one draw after, two numbers of samples
    const std::vector<std::string> columns = cells_of(lines[0]);
    for (size_t i = 0; i < configurations.size(); ++i) {
        const std::vector<std::string> cells = cells_of(lines[i + 1]);
        ASSERT_EQ(cells.size(), columns.size());
        for (size_t c = 0; c < columns.size(); ++c) {
            const Json value = at_path(configurations[i], columns[c]);
            EXPECT_EQ(cells[c], value.is_null() ? "" : value.is_string() ? value.get<std::string>() : value.dump()) << columns[c];
        }
    }
    for (const char* key : {"rmse", "relmse", "psnr", "flip", "texels_per_pixel", "lines_per_pixel", "texture_lines_64", "time_s_geometry",
                            "time_s_raster", "time_s_shade", "frame_s_median", "frame_s_spread"})
        EXPECT_NE(std::ranges::find(columns, key), columns.end()) << key;
}

TEST(Bench, ErrorsAreThoseOfCompare) {
    const TemporaryFolder folder;
    const Json json = bench(folder / "out", with(kSweep, {"--filter", "bilinear"}));
    const std::string truth = json.at("scenes")[0].at("truths")[0].at("picture");
    for (const Json& one : json.at("configurations")) {
        const test::Outcome compared =
            run({"compare", folder / "out/" + one.at("picture").get<std::string>(), folder / "out/" + truth, "--json"});
        ASSERT_EQ(compared.code, kDone) << compared.err;
        const Json figures = Json::parse(compared.out).at("images")[0];
        for (const char* key : {"mse", "rmse", "psnr", "relmse", "max", "mean", "flip", "flip_kind"})
            EXPECT_EQ(one.at(key), figures.at(key)) << key << ' ' << one.at("options");
    }
}

void expect_rendered(const TemporaryFolder& folder, const Json& one, const Words& more = {}) {
    Words words = shell_words(one.at("command").get<std::string>());
    ASSERT_EQ(words[0], "rawtexel");
    words.erase(words.begin());
    const auto output = std::ranges::find(words, "-o") + 1;
    EXPECT_EQ(*output, one.at("picture"));
    *output = folder / "again.exr";
    const test::Outcome rendered = run(with(with(words, more), {"--progress", "never"}));
    ASSERT_EQ(rendered.code, kDone) << rendered.err << one.at("command");
    const test::Outcome compared =
        run({"compare", folder / "again.exr", folder / "out/" + one.at("picture").get<std::string>(), "--flip", "none", "--max-rmse", "0"});
    EXPECT_EQ(compared.code, kDone) << compared.out << compared.err << one.at("command");
}

TEST(Bench, PicturesAndFetchesAreThoseOfRender) {
    const TemporaryFolder folder;
    const Json json =
        bench(folder / "out", with(kSweep, {"--filter", "bilinear,mitchell:0,0.5", "--noise", "stbn", "--taps", "2", "--seed", "7"}));
    for (const Json& truth : json.at("scenes")[0].at("truths")) expect_rendered(folder, truth);
    std::set<std::string> filters, estimators, orders;
    for (const Json& one : json.at("configurations")) {
        filters.insert(one.at("filter"));
        estimators.insert(one.at("estimator"));
        orders.insert(one.at("order"));
        expect_rendered(folder, one, {"--stats", folder / "stats.json", "--count", "--aov", "lines"});
        const Json stats = read_json(folder / "stats.json");
        for (const auto& [key, value] : one.at("texture").items()) EXPECT_EQ(value, stats.at("texture").at(key)) << key;
        EXPECT_EQ(one.at("image"), stats.at("image"));
        const shading::Image rendered = scenes::read_image(folder / "again.exr", false);
        ASSERT_EQ(rendered.channels, 4);
        double lines = 0;
        for (size_t i = 3; i < rendered.values.size(); i += 4) lines += double(rendered.values[i]);
        EXPECT_GT(lines, 24 * 16);
        EXPECT_DOUBLE_EQ(one.at("lines_per_pixel").get<double>(), lines / (24 * 16));
        EXPECT_DOUBLE_EQ(one.at("texels_per_pixel").get<double>(), stats.at("texture").at("texels_requested").get<double>() / (24 * 16));
    }
    EXPECT_EQ(filters, (std::set<std::string>{"bilinear", "mitchell:0,0.5"}));
    EXPECT_EQ(estimators.size(), 2u);
    EXPECT_EQ(orders.size(), 2u);
}

TEST(Bench, TheTruthSharesNoSampleAndTellsItsError) {
    const TemporaryFolder folder;
    const Json json =
        bench(folder / "out", {"--filter", "bilinear", "--spp", "1,64", "--reference", "0.05", "--repeat", "1", "--seed", "3"});
    const Json truth = json.at("scenes")[0].at("truths")[0];
    EXPECT_EQ(truth.at("seed"), 0xffffffffu - 3);
    EXPECT_LT(truth.at("standard_error").get<double>(), 0.05);
    EXPECT_TRUE(truth.at("reached").get<bool>());
    size_t clear = 0;
    for (const Json& one : json.at("configurations")) {
        EXPECT_EQ(one.at("standard_error"), truth.at("standard_error"));
        EXPECT_EQ(one.at("clear").get<bool>(), one.at("rmse").get<double>() >= 3 * truth.at("standard_error").get<double>());
        clear += one.at("clear").get<bool>();
    }
    EXPECT_GT(clear, 0u);
    EXPECT_LT(clear, json.at("configurations").size());
}

/// What does not follow from a clock.
Json lasting(Json json) {
    json.erase("command");
    for (Json& scene : json.at("scenes"))
        for (Json& truth : scene.at("truths")) truth.erase("seconds");
    for (Json& one : json.at("configurations"))
        for (const char* key : {"frame_s", "time_s", "front_time"}) one.erase(key);
    return json;
}

TEST(Bench, TheSameSeedGivesTheSameErrorsAndFetches) {
    const TemporaryFolder folder;
    const Json json = lasting(bench(folder / "a"));
    EXPECT_EQ(json, lasting(bench(folder / "b", with(kSweep, {"--threads", "1", "--simd", "scalar"}))));
    EXPECT_NE(json, lasting(bench(folder / "c", with(kSweep, {"--seed", "1"}))));
}

TEST(Bench, FrontsAndSlopesFollowFromItsNumbers) {
    const TemporaryFolder folder;
    const Json json = bench(folder / "out");
    const Json& all = json.at("configurations");
    for (const auto& [front, cost] : {std::pair{"front_time", "/frame_s/median"}, std::pair{"front_fetches", "/texels_per_pixel"}}) {
        const Json::json_pointer path(cost);
        for (const Json& one : all) {
            bool on = true;
            for (const Json& other : all) {
                if (other.at("filter") != one.at("filter")) continue;
                const double x = other.at(path).get<double>() - one.at(path).get<double>();
                const double y = other.at("rmse").get<double>() - one.at("rmse").get<double>();
                if (x <= 0 && y <= 0 && (x < 0 || y < 0)) on = false;
            }
            EXPECT_EQ(one.at(front).get<bool>(), on) << front << one.at("options");
        }
    }
    size_t fitted = 0;
    for (const Json& series : json.at("scenes")[0].at("series")) {
        std::vector<std::pair<double, double>> points;
        for (const Json& i : series.at("configurations")) {
            const Json& one = all[i.get<size_t>()];
            EXPECT_EQ(one.at("minification"), series.at("minification"));
            if (one.at("clear").get<bool>()) points.emplace_back(one.at("image").at("spp"), one.at("rmse"));
        }
        ASSERT_EQ(series.at("slope").is_null(), points.size() < 2);
        if (points.size() < 2) continue;
        ++fitted;
        // Two points: the line through them.
        ASSERT_EQ(points.size(), 2u);
        EXPECT_NEAR(series.at("slope").get<double>(),
                    std::log(points[1].second / points[0].second) / std::log(points[1].first / points[0].first), 1e-12);
    }
    EXPECT_GT(fitted, 0u);
}

TEST(Bench, SaysWhatItLeavesOut) {
    const TemporaryFolder folder;
    const Json json = bench(folder / "out", {"--filter", "bilinear,lanczos2", "--mip", "none", "--hybrid-bias", "none,1", "--estimator",
                                             "jitter,reservoir", "--spp", "1", "--repeat", "1", "--reference", "0.05"});
    std::set<std::string> options;
    std::string reasons;
    for (const Json& one : json.at("scenes")[0].at("left_out")) {
        options.insert(one.at("options"));
        EXPECT_EQ(one.at("spp"), Json::array({1}));
        reasons += one.at("reason").get<std::string>() + "\n";
    }
    EXPECT_TRUE(options.contains("--filter lanczos2 --mip none --estimator jitter --order after")) << json.at("scenes")[0].at("left_out");
    EXPECT_TRUE(options.contains("--filter bilinear --mip none --estimator reservoir --order before"));
    EXPECT_TRUE(options.contains("--filter bilinear --mip none --hybrid-bias 1 --estimator reservoir --order after"));
    EXPECT_NE(reasons.find("cannot draw lanczos2"), std::string::npos) << reasons;
    EXPECT_NE(reasons.find("no level is finer"), std::string::npos) << reasons;
    EXPECT_EQ(json.at("configurations").size() + options.size(), 2u * 2 * 2 * 2);
}

TEST(Bench, EllipsesAreAMinificationOfTheirOwn) {
    const TemporaryFolder folder;
    const Json json = bench(folder / "out", {"--ewa", "--mip", "linear", "--filter", "bspline", "--aniso", "scene,4", "--spp", "1",
                                             "--estimator", "jitter", "--order", "after", "--repeat", "1", "--reference", "0.05"});
    std::vector<std::string> names;
    for (const Json& one : json.at("configurations"))
        names.push_back(one.at("filter").get<std::string>() + " " + one.at("minification").get<std::string>());
    EXPECT_EQ(names, (std::vector<std::string>{"bspline mip linear", "bspline mip linear, aniso 4", "scene ewa 0.16666667"}));
}

TEST(Bench, LeavesTheTruthItsSamplesWhereBlocksStop) {
    const TemporaryFolder folder;
    const Json json = bench(folder / "out", {"--filter", "bilinear", "--mip", "none", "--estimator", "reservoir", "--spp", "4,64",
                                             "--repeat", "1", "--reference", "0.05", "--adaptive", "0.1"});
    ASSERT_EQ(json.at("configurations").size(), 1u);
    const Json& one = json.at("configurations")[0];
    EXPECT_EQ(one.at("image").at("spp"), 64);
    EXPECT_LT(one.at("image").at("mean_spp").get<double>(), 64);
    expect_rendered(folder, one);
    expect_rendered(folder, json.at("scenes")[0].at("truths")[0]);
    bool said = false;
    for (const Json& left : json.at("scenes")[0].at("left_out"))
        said = said || left.at("reason").get<std::string>().starts_with("--adaptive: ");
    EXPECT_TRUE(said);
}

TEST(Bench, AnImageThatEqualsTheTruthHasNoLogarithm) {
    const TemporaryFolder folder;
    // Nothing but the background is in view.
    const Json json = bench(folder / "out", with(kSweep, {"--eye", "0,0,5", "--target", "0,0,10", "--background", "0.25,0.25,0.25"}));
    for (const Json& one : json.at("configurations")) {
        EXPECT_EQ(one.at("rmse"), 0.0);
        EXPECT_TRUE(one.at("psnr").is_null());
        EXPECT_EQ(one.at("texels_per_pixel"), 0.0);
    }
    for (const Json& one : json.at("scenes")[0].at("series")) EXPECT_TRUE(one.at("slope").is_null());
    for (const auto& plot : std::filesystem::directory_iterator(folder / "out/plots")) {
        const std::string svg = test::read_file(plot.path());
        EXPECT_EQ(svg.find("nan"), std::string::npos) << plot.path();
        EXPECT_EQ(svg.find("inf\""), std::string::npos) << plot.path();
    }
    EXPECT_TRUE(std::filesystem::exists(folder / "out/index.html"));
}

TEST(Bench, RefusesWhatMakesNoSense) {
    const TemporaryFolder folder;
    const std::string out = folder / "out";
    const std::pair<Words, std::string> wrong[] = {
        {{"bench", "plane"}, "-o DIR is missing"},
        {{"bench", "plane", "plane", "-o", out}, "'plane' is named twice"},
        {{"bench", "-o", out, "--filter", "bilinear,bilinear"}, "named twice"},
        {{"bench", "-o", out, "--filter", "bilinear,"}, "unknown value ''"},
        {{"bench", "-o", out, "--filter", "bilnear"}, "the nearest is 'bilinear'"},
        {{"bench", "-o", out, "--spp", "1,0"}, "'0' is not a whole number from 1"},
        {{"bench", "-o", out, "--spp", "4,4"}, "named twice"},
        {{"bench", "-o", out, "--order", "sideways"}, "unknown value 'sideways'"},
        {{"bench", "-o", out, "--reference", "0"}, "--reference"},
        {{"bench", "-o", out, "--repeat", "0"}, "--repeat"},
        {{"bench", "-o", out, "--aniso", "65"}, "--aniso"},
        {{"bench", "-o", out, "--hybrid-bias", "-1"}, "--hybrid-bias"},
        {{"bench", "-o", out, "--crop", "100,0,100,10"}, "reaches outside"},
        {{"bench", "-o", out, "--taps", "4", "--estimator", "all"}, "draws nothing"},
        {{"bench", "-o", out, "--noise", "stbn", "--estimator", "all"}, "draws nothing"},
        {{"bench", "-o", out, "--frames", "4"}, "unknown option '--frames'"},
        {{"bench", "-o", out, "--quick", "--size", "1920x1080"}, "--quick: frames of 2073600 pixels"},
        {{"bench", "magnify", "-o", out, "--resume"}, "there is no sweep to go on with"},
        {{"bench", "magnify", "-o", out, "--filter", "lanczos2", "--estimator", "jitter"}, "no configuration is left"},
    };
    for (const auto& [words, part] : wrong) EXPECT_EQ(why_not_failed(run(words), kWrongUsage, part), "") << words.back();
    EXPECT_EQ(why_not_failed(run({"bench", "magnify", "/nowhere/scene.gltf", "-o", out}), kBadInput, "/nowhere/scene.gltf"), "");
    EXPECT_EQ(why_not_failed(run({"bench", "magnify", "-o", folder / "no/such/folder"}), kCannotWrite, "no/such/folder"), "");
    test::write_file(folder / "file", "");
    EXPECT_EQ(why_not_failed(run({"bench", "magnify", "-o", folder / "file"}), kCannotWrite, "cannot be made a folder"), "");
    // Nothing of all that is left behind.
    EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(Bench, TakesFilesByNamesWithBlanks) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "my scenes");
    for (const char* name : {"a b.glb", "a-b.glb"}) ASSERT_EQ(run({"export", "magnify", "-o", folder / "my scenes/" + name}).code, kDone);
    const test::Outcome outcome = run(with({"bench", folder / "my scenes/a b.glb", folder / "my scenes/a-b.glb", "-o", folder / "my out",
                                            "--filter", "bilinear", "--mip", "none", "--spp", "1", "--repeat", "1", "--reference", "0.05"},
                                           kFrame));
    ASSERT_EQ(outcome.code, kDone) << outcome.err;
    const Json json = read_json(folder / "my out/bench.json");
    std::set<std::string> pictures;
    for (const Json& one : json.at("configurations")) {
        pictures.insert(one.at("picture"));
        EXPECT_TRUE(std::filesystem::exists(folder / "my out/" + one.at("picture").get<std::string>()));
    }
    EXPECT_EQ(pictures.size(), json.at("configurations").size());
}

TEST(Bench, QuickEndsWithinItsBudgetWhateverTheSize) {
    const TemporaryFolder folder;
    const test::Outcome outcome =
        run(with({"bench", "magnify", "-o", folder / "out", "--quick"}, {"--size", "120x80", "--progress", "never"}));
    ASSERT_EQ(outcome.code, kDone) << outcome.err;
    const Json json = read_json(folder / "out/bench.json");
    size_t over = 0;
    for (const Json& one : json.at("scenes")[0].at("left_out"))
        over += one.at("reason").get<std::string>().starts_with("--quick: ") ? one.at("spp").size() : 0;
    EXPECT_GT(over, 0u);
    for (const Json& one : json.at("configurations")) {
        const bool draws = one.at("estimator") != "all" || one.at("order") == "before";
        EXPECT_TRUE(!draws || one.at("image").at("spp").get<int>() * 120 * 80 <= 600000) << one.at("options");
    }
}

size_t measured_lines(const std::vector<std::string>& lines) {
    return size_t(std::ranges::count_if(lines, [](const std::string& line) { return line.starts_with("{\"configuration\""); }));
}

/// The first `count` configurations of a sweep, and what comes before them.
void interrupt_after(const std::string& path, size_t count) {
    std::string kept;
    for (const std::string& line : lines_of(path)) {
        if (line.starts_with("{\"configuration\"") && count-- == 0) break;
        kept += line + "\n";
    }
    test::write_file(path, kept);
}

TEST(Bench, BeginsNothingMoreWhenItsTimeIsOver) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "pictures");
    std::ostringstream out;
    const Invocation invocation{"bench", out, out};
    const auto executor = shading::make_executor(shading::default_executor_kind(), 1);
    BenchPlan plan;
    plan.scenes = {"magnify"};
    plan.folder = folder.path();
    plan.base.size = ImageSize{8, 8};
    plan.axes.spps = {1, 4};
    plan.budget = quick_budget(1);
    plan.start = ProgressReport::steady_seconds();
    size_t all = 0;
    for (const auto& [seconds, kept] : {std::pair{-1.0, 0}, std::pair{1e9, 0}, std::pair{-1.0, 1}}) {
        plan.seconds = seconds;
        const std::string path = folder / "sweep.jsonl";
        if (kept > 0) interrupt_after(path, size_t(kept));
        SweepFile file = kept > 0 ? SweepFile::resumed(path, {}) : SweepFile(path, {});
        ProgressReport progress(out, ProgressMode::Never, false);
        const std::vector<SceneResults> results = run_bench(plan, file, invocation, *executor, progress, [](const std::string&) {});
        ASSERT_EQ(results.size(), 1u);
        size_t late = 0, other = 0;
        for (const LeftOut& one : results[0].left_out) (one.late ? late : other) += one.spps.size();
        EXPECT_GT(other, 0u);
        EXPECT_EQ(late == 0, seconds > 0);
        // What is finished is kept, though its truth is known and the next would not take long.
        EXPECT_EQ(results[0].measurements.size(), seconds < 0 ? size_t(kept) : results[0].measurements.size());
        if (seconds > 0) all = results[0].measurements.size();
        EXPECT_TRUE(kept == 0 || late + size_t(kept) == all) << late << ' ' << all;
        // Nothing at all is a report, too.
        const std::vector<SceneAnalysis> analyses{analyse(results[0])};
        const std::vector<std::vector<BenchPlot>> plots{bench_plots(results[0], analyses[0].series, analyses[0].fronts, 0, "magnify")};
        const Json json = bench_json(results, analyses, "bench");
        EXPECT_EQ(bench_csv(json).find("scene,filter,"), 0u);
        EXPECT_NE(bench_page(folder.path(), results, analyses, plots, json, {}, *executor).find("</html>"), std::string::npos);
    }
}

TEST(Bench, LeavesATruthWhenItsTimeIsOver) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "pictures");
    std::ostringstream out;
    const Invocation invocation{"bench", out, out};
    const auto executor = shading::make_executor(shading::default_executor_kind(), 1);
    BenchPlan plan;
    plan.scenes = {"magnify"};
    plan.folder = folder.path();
    plan.base.size = ImageSize{8, 8};
    plan.budget = full_budget();
    plan.start = ProgressReport::steady_seconds();
    plan.seconds = 0.5;  // loading takes less, the prefiltered sky more
    SweepFile file(folder / "sweep.jsonl", {});
    ProgressReport progress(out, ProgressMode::Never, false);
    const std::vector<SceneResults> results = run_bench(plan, file, invocation, *executor, progress, [](const std::string&) {});
    EXPECT_TRUE(results[0].truths.empty());
    EXPECT_TRUE(results[0].measurements.empty());
}

// --- Going on

TEST(BenchResume, KeepsWhatWasFinished) {
    const TemporaryFolder folder;
    const Json whole = bench(folder / "out");
    interrupt_after(folder / "out/sweep.jsonl", 10);
    const test::Outcome outcome = run(with(bench_words(folder / "out"), {"--resume"}));
    ASSERT_EQ(outcome.code, kDone) << outcome.err;
    EXPECT_NE(outcome.out.find("24 configurations, 10 of them before the interruption"), std::string::npos) << outcome.out;
    const Json resumed = read_json(folder / "out/bench.json");
    EXPECT_EQ(lasting(resumed), lasting(whole));
    size_t same = 0;
    for (size_t i = 0; i < 24; ++i) same += resumed.at("configurations")[i].at("frame_s") == whole.at("configurations")[i].at("frame_s");
    EXPECT_EQ(same, 10u);
    // One that is whole is kept whole.
    ASSERT_EQ(run(with(bench_words(folder / "out"), {"--resume"})).code, kDone);
    Json again = read_json(folder / "out/bench.json"), before = resumed;
    again.erase("command"), before.erase("command");
    EXPECT_EQ(again, before);
}

TEST(BenchResume, RendersAnewWhatHasLostItsPicture) {
    const TemporaryFolder folder;
    const Json whole = bench(folder / "out");
    const std::string picture = folder / "out/" + whole.at("configurations")[3].at("picture").get<std::string>();
    const std::string truth = folder / "out/" + whole.at("scenes")[0].at("truths")[1].at("picture").get<std::string>();
    std::filesystem::remove(picture);
    std::filesystem::remove(truth);
    ASSERT_EQ(run(with(bench_words(folder / "out"), {"--resume"})).code, kDone);
    EXPECT_TRUE(std::filesystem::exists(picture));
    EXPECT_TRUE(std::filesystem::exists(truth));
    EXPECT_EQ(lasting(read_json(folder / "out/bench.json")), lasting(whole));
}

TEST(BenchResume, RefusesAnotherSweep) {
    const TemporaryFolder folder;
    bench(folder / "out");
    const std::string sweep = folder / "out/sweep.jsonl", before = test::read_file(sweep);
    Words other = bench_words(folder / "out", with(kSweep, {"--resume"}));
    *std::ranges::find(other, "24x16") = "32x16";
    EXPECT_EQ(why_not_failed(run(other), kWrongUsage, "found --size 24x16, asked for --size 32x16"), "");
    EXPECT_EQ(
        why_not_failed(run(bench_words(folder / "out", with(kSweep, {"--resume", "--seed", "1"}))), kWrongUsage, "asked for --seed 1"), "");
    EXPECT_EQ(test::read_file(sweep), before);
    // Where words stand, and how progress is told, makes no other sweep.
    Words turned{"bench", "--resume", "-o", folder / "out"};
    turned = with(with(turned, kSweep), kFrame);
    *std::ranges::find(turned, "never") = "auto";
    EXPECT_EQ(run(with(turned, {"metal-edge"})).code, kDone);
}

TEST(BenchResume, RefusesADamagedFile) {
    const TemporaryFolder folder;
    bench(folder / "out", {"--filter", "bilinear", "--mip", "none", "--spp", "1", "--repeat", "1", "--reference", "0.05"});
    const Words words = bench_words(
        folder / "out", {"--filter", "bilinear", "--mip", "none", "--spp", "1", "--repeat", "1", "--reference", "0.05", "--resume"});
    const std::string sweep = folder / "out/sweep.jsonl", whole = test::read_file(sweep);
    const size_t line = whole.find("{\"configuration\"");
    ASSERT_NE(line, std::string::npos);
    const std::string damages[] = {whole.substr(0, line + 40),
                                   whole.substr(0, line) + "{\"configuration\": 3}\n",
                                   whole.substr(0, line) + "[]\n",
                                   whole.substr(0, line) + "{\"more\": 1}\n",
                                   "",
                                   "\xff\xfe"};
    for (const std::string& damage : damages) {
        test::write_file(sweep, damage);
        EXPECT_EQ(why_not_failed(run(words), kBadInput, "sweep.jsonl"), "") << damage.substr(0, 60);
    }
}

TEST(BenchResume, RefusesASceneThatHasChanged) {
    const TemporaryFolder folder;
    const std::string scene = test::write_quad(folder);
    const Words words = with({"bench", scene, "-o", folder / "out", "--filter", "bilinear", "--mip", "none", "--spp", "1", "--repeat", "1",
                              "--reference", "0.05"},
                             kFrame);
    ASSERT_EQ(run(words).code, kDone);
    ASSERT_EQ(run(with(words, {"--resume"})).code, kDone);
    test::write_file(scene, test::read_file(scene) + "\n");
    EXPECT_EQ(why_not_failed(run(with(words, {"--resume"})), kWrongUsage, "has changed since the sweep began"), "");
}

TEST(BenchResume, RefusesAPolicyThatHasChanged) {
    const TemporaryFolder folder;
    test::write_file(folder / "policy.json", "{}");
    const Words words = bench_words(folder / "out", {"--filter", "bilinear", "--mip", "none", "--spp", "1", "--repeat", "1", "--reference",
                                                     "0.05", "--policy", folder / "policy.json"});
    ASSERT_EQ(run(words).code, kDone);
    ASSERT_EQ(run(with(words, {"--resume"})).code, kDone);
    test::write_file(folder / "policy.json", "{\"materials\": {}}");
    EXPECT_EQ(why_not_failed(run(with(words, {"--resume"})), kWrongUsage, "policy.json' has changed since the sweep began"), "");
}

TEST(BenchResume, GoesOnAfterItWasKilled) {
    const TemporaryFolder folder;
    const Words words = with(bench_words(folder / "out", {"--filter", "bilinear", "--spp", "1,2,3,4,5,6,7,8,9,10,11,12", "--repeat", "3",
                                                          "--reference", "0.05"}),
                             {"--size", "24x16"});
    Words once = words;
    once.resize(once.size() - 2);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        std::vector<char*> arguments;
        std::string program = RAWTEXEL_PROGRAM;
        arguments.push_back(program.data());
        for (std::string& word : once) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        execv(program.c_str(), arguments.data());
        _exit(127);
    }
    const auto lines = [&] { return lines_of(folder / "out/sweep.jsonl"); };
    for (int i = 0; i < 6000 && measured_lines(lines()) < 5; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the sweep ended before it was killed: " << status;
    const std::vector<std::string> before = lines();
    const size_t finished = measured_lines(before);
    ASSERT_GE(finished, 5u);
    EXPECT_FALSE(std::filesystem::exists(folder / "out/bench.json"));

    const test::Outcome anew = run(with(once, {"--resume"}));
    ASSERT_EQ(anew.code, kDone) << anew.err;
    const std::vector<std::string> after = lines();
    ASSERT_GT(after.size(), before.size());
    EXPECT_TRUE(std::equal(before.begin(), before.end(), after.begin()));
    const size_t all = read_json(folder / "out/bench.json").at("configurations").size();
    EXPECT_EQ(measured_lines(after), all);
    EXPECT_LT(finished, all);
    EXPECT_NE(anew.out.find(std::to_string(finished) + " of them before the interruption"), std::string::npos) << anew.out;
}

TEST(BenchResume, WarnsBeforeItBeginsAnew) {
    const TemporaryFolder folder;
    bench(folder / "out");
    EXPECT_EQ(run(bench_words(folder / "out")).err, "");
    interrupt_after(folder / "out/sweep.jsonl", 4);
    const test::Outcome outcome = run(bench_words(folder / "out"));
    EXPECT_EQ(outcome.code, kDone);
    EXPECT_NE(outcome.err.find("begins anew (--resume goes on with it)"), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out.find("before the interruption"), std::string::npos);
}

}  // namespace
}  // namespace rawtexel::cli
