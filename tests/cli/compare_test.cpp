#include "cli/command.h"
#include "scenes/image_io.h"
#include "tests/cli/program_runner.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace rawtexel::cli {
namespace {

using test::run;
using test::TemporaryFolder;
using test::why_not_failed;
using Json = nlohmann::json;

void write_flat_png(const std::string& path, uint8_t code, int channels = 3, int width = 8, int height = 4) {
    scenes::write_8bit(path, width, height, channels, std::vector<uint8_t>(size_t(width * height * channels), code), {});
}

void write_flat_exr(const std::string& path, float value) {
    shading::Image image(8, 4, 3);
    for (float& v : image.values) v = value;
    scenes::write_float(path, image, {}, {});
}

TEST(Compare, EightBitImagesAreComparedAsDisplayValues) {
    const TemporaryFolder folder;
    write_flat_png(folder / "a.png", 51);
    write_flat_png(folder / "b.png", 102);
    const test::Outcome outcome = run({"compare", folder / "a.png", folder / "b.png", "--json"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Json entry = Json::parse(outcome.out)["images"][0];
    EXPECT_NEAR(entry["rmse"], 0.2, 1e-7);
    EXPECT_NEAR(entry["mse"], 0.04, 1e-7);
    EXPECT_NEAR(entry["max"], 0.2, 1e-7);
    EXPECT_NEAR(entry["psnr"], -10 * std::log10(0.04), 1e-5);
    EXPECT_NEAR(entry["relmse"], 0.04 / (0.16 + 0.01), 1e-6);
}

TEST(Compare, FloatImagesAreComparedAsLinearValues) {
    const TemporaryFolder folder;
    write_flat_exr(folder / "a.exr", 3.5f);
    write_flat_exr(folder / "b.exr", 1.5f);
    const Json json = Json::parse(run({"compare", folder / "a.exr", folder / "b.exr", "--json"}).out);
    EXPECT_EQ(json["images"][0]["rmse"], 2.0);
}

TEST(Compare, EveryImageIsHeldAgainstTheSecond) {
    const TemporaryFolder folder;
    for (const int code : {0, 51, 102, 255}) write_flat_png(folder / (std::to_string(code) + ".png"), uint8_t(code));
    const test::Outcome outcome = run({"compare", folder / "51.png", folder / "0.png", folder / "102.png", folder / "255.png", "--json"});
    const Json images = Json::parse(outcome.out)["images"];
    ASSERT_EQ(images.size(), 3u);
    EXPECT_NEAR(images[0]["max"], 0.2, 1e-6);
    EXPECT_NEAR(images[1]["max"], 0.4, 1e-6);
    EXPECT_NEAR(images[2]["max"], 1.0, 1e-6);
    EXPECT_EQ(images[1]["image"], folder / "102.png");
}

TEST(Compare, EqualImagesHaveNoFiniteDecibels) {
    const TemporaryFolder folder;
    write_flat_png(folder / "a.png", 77);
    EXPECT_TRUE(Json::parse(run({"compare", folder / "a.png", folder / "a.png", "--json"}).out)["images"][0]["psnr"].is_null());
    EXPECT_NE(run({"compare", folder / "a.png", folder / "a.png"}).out.find(" inf"), std::string::npos);
    EXPECT_EQ(run({"compare", folder / "a.png", folder / "a.png", "--min-psnr", "1000", "--max-rmse", "0"}).code, kDone);
}

TEST(Compare, OpaqueAlphaChangesNothingAndGreyIsColour) {
    const TemporaryFolder folder;
    write_flat_png(folder / "grey.png", 90, 1);
    write_flat_png(folder / "rgb.png", 90, 3);
    std::vector<uint8_t> codes;
    for (int i = 0; i < 32; ++i) codes.insert(codes.end(), {90, 90, 90, 255});
    scenes::write_8bit(folder / "rgba.png", 8, 4, 4, codes, {});
    for (const char* test : {"grey.png", "rgba.png"})
        EXPECT_EQ(Json::parse(run({"compare", folder / test, folder / "rgb.png", "--json"}).out)["images"][0]["max"], 0.0) << test;
}

TEST(Compare, TransparentPixelsShowBlack) {
    const TemporaryFolder folder;
    std::vector<uint8_t> clear, black(8 * 4 * 3, 0);
    for (int i = 0; i < 32; ++i) clear.insert(clear.end(), {200, 100, 50, 0});
    scenes::write_8bit(folder / "clear.png", 8, 4, 4, clear, {});
    scenes::write_8bit(folder / "black.png", 8, 4, 3, black, {});
    EXPECT_EQ(Json::parse(run({"compare", folder / "clear.png", folder / "black.png", "--json"}).out)["images"][0]["max"], 0.0);
}

TEST(Compare, ChecksAreExitCode1) {
    const TemporaryFolder folder;
    write_flat_png(folder / "a.png", 0);
    write_flat_png(folder / "b.png", 51);
    const auto code = [&](const std::vector<std::string>& checks) {
        std::vector<std::string> words{"compare", folder / "a.png", folder / "b.png"};
        words.insert(words.end(), checks.begin(), checks.end());
        return run(words).code;
    };
    EXPECT_EQ(code({"--max-rmse", "0.201"}), kDone);
    EXPECT_EQ(code({"--max-rmse", "0.199"}), kCheckFailed);
    EXPECT_EQ(code({"--min-psnr", "13.9"}), kDone);
    EXPECT_EQ(code({"--min-psnr", "14.1"}), kCheckFailed);
    EXPECT_EQ(code({"--min-psnr", "13.9", "--max-rmse", "0.1"}), kCheckFailed);
    // The first image holds, a further one does not.
    write_flat_png(folder / "c.png", 255);
    const test::Outcome outcome = run({"compare", folder / "a.png", folder / "b.png", folder / "c.png", "--max-rmse", "0.5"});
    EXPECT_EQ(outcome.code, kCheckFailed);
    EXPECT_NE(outcome.err.find("c.png: RMSE 0.8 (at most 0.5)"), std::string::npos) << outcome.err;
}

TEST(Compare, AValueThatIsNoNumberFailsEveryCheck) {
    const TemporaryFolder folder;
    write_flat_exr(folder / "nan.exr", std::numeric_limits<float>::quiet_NaN());
    write_flat_exr(folder / "b.exr", 1.0f);
    EXPECT_EQ(run({"compare", folder / "nan.exr", folder / "b.exr", "--max-rmse", "1000"}).code, kCheckFailed);
    EXPECT_EQ(run({"compare", folder / "nan.exr", folder / "b.exr", "--min-psnr", "0"}).code, kCheckFailed);
}

TEST(Compare, WritesTheAbsoluteDifference) {
    const TemporaryFolder folder;
    write_flat_png(folder / "a.png", 51);
    write_flat_png(folder / "b.png", 153);
    ASSERT_EQ(run({"compare", folder / "a.png", folder / "b.png", "-o", folder / "d.png"}).code, kDone);
    for (const float value : scenes::read_image(folder / "d.png", false).values) ASSERT_NEAR(value, 0.4f, 1e-6f);
    write_flat_exr(folder / "a.exr", 1.0f);
    write_flat_exr(folder / "b.exr", 4.0f);
    ASSERT_EQ(run({"compare", folder / "a.exr", folder / "b.exr", "-o", folder / "d.exr"}).code, kDone);
    for (const float value : scenes::read_image(folder / "d.exr", false).values) ASSERT_EQ(value, 3.0f);
}

TEST(Compare, WritesCsvWithAHeader) {
    const TemporaryFolder folder;
    write_flat_png(folder / "a,b.png", 0);
    write_flat_png(folder / "b.png", 255);
    ASSERT_EQ(run({"compare", folder / "a,b.png", folder / "b.png", "--csv", folder / "x.csv"}).code, kDone);
    const std::string csv = test::read_file(folder / "x.csv");
    EXPECT_TRUE(
        csv.starts_with("image,reference,mse,rmse,psnr,relmse,max,mean,flip,flip_q1,flip_median,flip_q3,flip_min,flip_max,flip_kind\n\"" +
                        folder / "a,b.png" + "\"," + folder / "b.png" + ",1,1,0,0.990099009900"))
        << csv;
    EXPECT_NE(csv.find(",1,1,0.96"), std::string::npos) << csv;
    EXPECT_TRUE(csv.ends_with(",ldr\n")) << csv;
    ASSERT_EQ(run({"compare", folder / "a,b.png", folder / "b.png", "--csv", folder / "y.csv", "--flip", "none"}).code, kDone);
    EXPECT_TRUE(test::read_file(folder / "y.csv").ends_with(",1,1,,,,,,,\n")) << test::read_file(folder / "y.csv");
}

Json first_image(const std::vector<std::string>& words) {
    std::vector<std::string> all{"compare", "--json"};
    all.insert(all.end(), words.begin(), words.end());
    const test::Outcome outcome = run(all);
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    const Json json = Json::parse(outcome.out);
    return json["images"][0];
}

TEST(CompareFlip, IsLdrOfDisplayValuesAndHdrOfLinearLight) {
    const TemporaryFolder folder;
    write_flat_png(folder / "a.png", 0);
    write_flat_png(folder / "b.png", 255);
    write_flat_exr(folder / "a.exr", 0.5f);
    write_flat_exr(folder / "b.exr", 2.0f);
    const Json ldr = first_image({folder / "a.png", folder / "b.png"}), hdr = first_image({folder / "a.exr", folder / "b.exr"});
    EXPECT_EQ(ldr["flip_kind"], "ldr");
    EXPECT_FALSE(ldr.contains("flip_exposures"));
    EXPECT_GT(ldr["flip"], 0.95);
    EXPECT_EQ(ldr["flip"], ldr["flip_max"]);
    EXPECT_NEAR(ldr["flip_pixels_per_degree"], 67.02, 0.01);
    EXPECT_EQ(hdr["flip_kind"], "hdr");
    EXPECT_EQ(hdr["flip_exposures"]["count"], 2);
    // Beside a PNG, an EXR is shown as a screen would.
    EXPECT_EQ(first_image({folder / "a.exr", folder / "b.png"})["flip_kind"], "ldr");
    EXPECT_EQ(first_image({folder / "b.exr", folder / "b.png"})["flip"], 0.0);
    EXPECT_EQ(first_image({folder / "a.exr", folder / "b.exr", "--flip", "ldr"})["flip_kind"], "ldr");
    EXPECT_EQ(first_image({folder / "a.png", folder / "b.png", "--flip", "hdr"})["flip_kind"], "hdr");
    EXPECT_FALSE(first_image({folder / "a.png", folder / "b.png", "--flip", "none"}).contains("flip"));
}

// An integer TIFF holds display values, a float TIFF linear light.
TEST(CompareFlip, KnowsWhatATiffHolds) {
    const TemporaryFolder folder;
    write_flat_exr(folder / "a.exr", 0.25f);
    write_flat_exr(folder / "a.tif", 0.25f);
    const Json json = first_image({folder / "a.tif", folder / "a.exr"});
    EXPECT_EQ(json["flip_kind"], "hdr");
    EXPECT_EQ(json["flip"], 0.0);
    write_flat_png(folder / "b.tif", 188);
    EXPECT_EQ(first_image({folder / "b.tif", folder / "a.exr"})["flip_kind"], "ldr");
}

TEST(CompareFlip, TakesLightAndDisplayValuesToOneSpace) {
    const TemporaryFolder folder;
    write_flat_png(folder / "a.png", 188);
    write_flat_exr(folder / "a.exr", float(std::pow((188.0 / 255.0 + 0.055) / 1.055, 2.4)));
    for (const std::string kind : {"ldr", "hdr"})
        EXPECT_LT(first_image({folder / "a.png", folder / "a.exr", "--flip", kind})["flip"], 1e-4) << kind;
}

TEST(CompareFlip, DependsOnTheDistance) {
    const TemporaryFolder folder;
    scenes::write_8bit(folder / "a.png", 2, 1, 1, std::vector<uint8_t>{0, 255}, {});
    scenes::write_8bit(folder / "b.png", 2, 1, 1, std::vector<uint8_t>{255, 0}, {});
    const double near = first_image({folder / "a.png", folder / "b.png", "--pixels-per-degree", "1"})["flip"];
    const double far = first_image({folder / "a.png", folder / "b.png", "--pixels-per-degree", "200"})["flip"];
    EXPECT_GT(near, far + 0.1) << near << " against " << far;
}

TEST(CompareFlip, ChecksTheMean) {
    const TemporaryFolder folder;
    write_flat_png(folder / "a.png", 0);
    write_flat_png(folder / "b.png", 255);
    EXPECT_EQ(run({"compare", folder / "a.png", folder / "b.png", "--max-flip", "0.98"}).code, kDone);
    const test::Outcome outcome = run({"compare", folder / "a.png", folder / "b.png", "--max-flip", "0.9"});
    EXPECT_EQ(outcome.code, kCheckFailed);
    EXPECT_NE(outcome.err.find("a.png: FLIP 0.96"), std::string::npos) << outcome.err;
    write_flat_exr(folder / "nan.exr", std::numeric_limits<float>::quiet_NaN());
    write_flat_exr(folder / "b.exr", 1.0f);
    EXPECT_EQ(run({"compare", folder / "nan.exr", folder / "b.exr", "--max-flip", "2"}).code, kCheckFailed);
    EXPECT_TRUE(first_image({folder / "nan.exr", folder / "b.exr"})["flip"].is_null());
}

TEST(CompareFlip, WritesItsMap) {
    const TemporaryFolder folder;
    write_flat_png(folder / "a.png", 0);
    write_flat_png(folder / "b.png", 255);
    const double mean = first_image({folder / "a.png", folder / "b.png", "--flip-map", folder / "m.exr"})["flip"];
    const shading::Image map = scenes::read_image(folder / "m.exr", false);
    EXPECT_EQ(map.channels, 1);
    EXPECT_EQ(map.values[5], float(mean));
    first_image({folder / "a.png", folder / "b.png", "--flip-map", folder / "m.png"});
    const shading::Image picture = scenes::read_image(folder / "m.png", false);
    ASSERT_EQ(picture.channels, 3);
    EXPECT_GT(picture.values[0], 0.95f);
    write_flat_exr(folder / "nan.exr", std::numeric_limits<float>::quiet_NaN());
    write_flat_exr(folder / "b.exr", 1.0f);
    EXPECT_EQ(
        why_not_failed(run({"compare", folder / "nan.exr", folder / "b.exr", "--flip-map", folder / "n.png"}), kBadInput, "not finite"),
        "");
}

TEST(CompareFlip, WhatHasNoEffectIsRefused) {
    const TemporaryFolder folder;
    write_flat_png(folder / "a.png", 0);
    for (const std::vector<std::string>& option :
         {std::vector<std::string>{"--max-flip", "1"}, {"--pixels-per-degree", "60"}, {"--flip-map", folder / "m.png"}})
        EXPECT_EQ(why_not_failed(run({"compare", folder / "a.png", folder / "a.png", "--flip", "none", option[0], option[1]}), kWrongUsage,
                                 "--flip none leaves FLIP out"),
                  "");
    EXPECT_EQ(why_not_failed(run({"compare", folder / "a.png", folder / "a.png", "--flip", "ldd"}), kWrongUsage, "nearest is 'ldr'"), "");
    EXPECT_EQ(why_not_failed(run({"compare", folder / "a.png", folder / "a.png", "--pixels-per-degree", "0.5"}), kWrongUsage, "1 to 1000"),
              "");
}

TEST(Compare, InputThatDoesNotServeIsExitCode3) {
    const TemporaryFolder folder;
    write_flat_png(folder / "a.png", 0);
    write_flat_png(folder / "large.png", 0, 3, 9, 4);
    test::write_file(folder / "empty.png", "");
    test::write_file(folder / "text.png", "this is no image");
    test::write_file(folder / "half.png", test::read_file(folder / "a.png").substr(0, 50));
    EXPECT_EQ(why_not_failed(run({"compare", folder / "large.png", folder / "a.png"}), kBadInput, "found 9x4, allowed 8x4"), "");
    for (const std::string bad : {"missing.png", "empty.png", "text.png", "half.png"}) {
        EXPECT_EQ(why_not_failed(run({"compare", folder / bad, folder / "a.png"}), kBadInput, bad), "");
        EXPECT_EQ(why_not_failed(run({"compare", folder / "a.png", folder / bad}), kBadInput, bad), "");
    }
    EXPECT_EQ(why_not_failed(run({"compare", folder.path(), folder / "a.png"}), kBadInput, folder.path()), "");
}

TEST(Compare, OutputThatCannotBeWrittenIsExitCode4) {
    const TemporaryFolder folder;
    write_flat_png(folder / "a.png", 0);
    for (const std::string place : {"missing/d.png", "a.png/d.png"})
        EXPECT_EQ(why_not_failed(run({"compare", folder / "a.png", folder / "a.png", "-o", folder / place}), kCannotWrite, place), "");
    EXPECT_EQ(why_not_failed(run({"compare", folder / "a.png", folder / "a.png", "--csv", folder.path()}), kCannotWrite, folder.path()),
              "");
    EXPECT_EQ(folder.entries(), std::vector<std::string>{"a.png"});
}

TEST(Compare, LinearLightAgainstDisplayValuesIsWarnedOf) {
    const TemporaryFolder folder;
    write_flat_png(folder / "a.png", 0);
    write_flat_exr(folder / "a.exr", 0.0f);
    const test::Outcome outcome = run({"compare", folder / "a.exr", folder / "a.png"});
    EXPECT_EQ(outcome.code, kDone);
    EXPECT_TRUE(outcome.err.starts_with("rawtexel: warning: ")) << outcome.err;
}

TEST(Compare, NoImageIsOverwritten) {
    const TemporaryFolder folder;
    write_flat_png(folder / "a.png", 51);
    write_flat_png(folder / "b.png", 102);
    const std::string a = test::read_file(folder / "a.png");
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{"--csv", folder / "a.png"}, {"-o", folder / "a.png"}, {"-o", folder / "b.png"}})
        EXPECT_EQ(why_not_failed(run({"compare", folder / "a.png", folder / "b.png", more[0], more[1]}), kWrongUsage,
                                 "would replace a file that is read"),
                  "");
    EXPECT_EQ(why_not_failed(run({"compare", folder / "a.png", folder / "b.png", "-o", folder / "d.png", "--csv", folder / "d.png"}),
                             kWrongUsage, "is the file that -o writes"),
              "");
    EXPECT_EQ(test::read_file(folder / "a.png"), a);
    EXPECT_EQ(folder.entries(), (std::vector<std::string>{"a.png", "b.png"}));
}

}  // namespace
}  // namespace rawtexel::cli
