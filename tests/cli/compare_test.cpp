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
    EXPECT_TRUE(csv.starts_with("image,reference,mse,rmse,psnr,relmse,max,mean\n\"" + folder / "a,b.png" + "\"," + folder / "b.png" +
                                ",1,1,0,0.990099009900"))
        << csv;
    EXPECT_TRUE(csv.ends_with(",1,1\n")) << csv;
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
