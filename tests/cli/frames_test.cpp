// Sequences of frames from words to files.
#include "cli/command.h"
#include "scenes/image_io.h"
#include "tests/cli/program_runner.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace rawtexel::cli {
namespace {

using test::run;
using test::TemporaryFolder;
using test::why_not_failed;
using Json = nlohmann::json;
using Words = std::vector<std::string>;

class FramesTest : public testing::Test {
  protected:
    Words words(const std::string& output, const Words& more) const {
        Words all{"render", scene_, "-o", output, "--progress", "never", "--size", "40x30", "--light", "0.2,-0.3,-1,3"};
        all.insert(all.end(), {"--environment", "none", "--filter", "nearest", "--mip", "none"});
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    shading::Image rendered(const Words& more) const {
        const std::string file = folder_ / "image.exr";
        const test::Outcome outcome = run(words(file, more));
        EXPECT_EQ(outcome.code, kDone) << outcome.err;
        return scenes::read_image(file, false);
    }
    std::string refused(int code, const Words& more, const std::string& part) const {
        return why_not_failed(run(words(folder_ / "image.exr", more)), code, part);
    }
    Json stats_of(Words more) const {
        more.insert(more.end(), {"--stats", folder_ / "stats.json"});
        rendered(more);
        return Json::parse(folder_.read("stats.json"));
    }

    TemporaryFolder folder_;
    std::string scene_ = test::write_quad(folder_);
};

shading::Image cut(const shading::Image& image, int x0, int y0, int width, int height) {
    shading::Image part(width, height, image.channels);
    for (int y = 0; y < height; ++y) std::copy_n(image.pixel(x0, y0 + y), size_t(width) * size_t(image.channels), part.pixel(0, y));
    return part;
}

TEST_F(FramesTest, TheMeanIsOneLongRenderBitForBit) {
    const shading::Image expected = rendered({"--spp", "12"});
    EXPECT_EQ(rendered({"--frames", "4", "--spp", "3"}).values, expected.values);
    EXPECT_EQ(rendered({"--frames", "12", "--accumulate", "mean", "--tile-size", "32", "--threads", "3"}).values, expected.values);
    EXPECT_EQ(rendered({"--frames", "3", "--spp", "4", "--cache", "l1=16K:8", "--tile-size", "32"}).values, expected.values);
    EXPECT_NE(rendered({"--frames", "11"}).values, expected.values);
}

TEST_F(FramesTest, ReprojectionAtRestWithoutClampIsTheMovingAverageBitForBit) {
    const shading::Image average = rendered({"--frames", "6", "--accumulate", "ema:0.2"});
    EXPECT_EQ(rendered({"--frames", "6", "--accumulate", "reproject:0.2", "--history-clamp", "off"}).values, average.values);
    EXPECT_NE(rendered({"--frames", "6", "--accumulate", "reproject:0.2"}).values, average.values);
}

TEST_F(FramesTest, ACropHasTheBitsOfThatPart) {
    for (const char* accumulate : {"mean", "ema", "reproject"}) {
        const Words sequence{"--frames", "4", "--camera-path", "orbit", "--accumulate", accumulate, "--aov", "depth"};
        Words cropped = sequence;
        cropped.insert(cropped.end(), {"--crop", "11,7,20,15"});
        EXPECT_EQ(rendered(cropped).values, cut(rendered(sequence), 11, 7, 20, 15).values) << accumulate;
    }
}

TEST_F(FramesTest, EveryFrameCanBeWritten) {
    const Words sequence{"--frames", "3", "--accumulate", "ema", "--camera-path", "dolly"};
    Words all = sequence;
    all.insert(all.end(), {"--frames-out", folder_ / "f-%02d.exr"});
    const shading::Image last = rendered(all);
    EXPECT_EQ(scenes::read_image(folder_ / "f-02.exr", false).values, last.values);
    EXPECT_EQ(scenes::read_image(folder_ / "f-00.exr", false).values, rendered({"--frames", "1"}).values);
    EXPECT_NE(scenes::read_image(folder_ / "f-01.exr", false).values, last.values);
    EXPECT_EQ(std::ranges::count_if(folder_.entries(), [](const std::string& name) { return name.starts_with("f-"); }), 3);
}

TEST_F(FramesTest, FlickerIsTheDeviationOverTheLastHalf) {
    const Json json = stats_of({"--frames", "5", "--accumulate", "ema:0.5", "--frames-out", folder_ / "f-%d.exr", "--flicker",
                                folder_ / "flicker.exr", "--aov", "depth", "--count"});
    const shading::Image flicker = scenes::read_image(folder_ / "flicker.exr", false);
    std::vector<shading::Image> frames;
    for (int frame = 2; frame < 5; ++frame) frames.push_back(scenes::read_image(folder_ / ("f-" + std::to_string(frame) + ".exr"), false));
    double worst = 0.0, squares = 0.0;
    for (size_t i = 0; i < flicker.values.size(); ++i) {
        double mean = 0.0, variance = 0.0;
        for (const shading::Image& frame : frames) mean += double(frame.values[i]) / 3.0;
        for (const shading::Image& frame : frames) variance += std::pow(double(frame.values[i]) - mean, 2.0) / 3.0;
        worst = std::max(worst, std::abs(std::sqrt(variance) - double(flicker.values[i])));
        squares += variance;
    }
    EXPECT_LT(worst, 1e-6);
    const Json& sequence = json.at("sequence");
    EXPECT_EQ(sequence.at("frames"), 5);
    EXPECT_EQ(sequence.at("accumulate"), "ema:0.5");
    EXPECT_EQ(sequence.at("flicker_frames"), 3);
    EXPECT_NEAR(sequence.at("flicker_rms").get<double>(), std::sqrt(squares / double(flicker.values.size())), 1e-7);
    EXPECT_GT(sequence.at("flicker_rms").get<double>(), 0.0);
    EXPECT_FALSE(sequence.contains("disoccluded"));
    EXPECT_EQ(json.at("frame_s").at("n"), 5);
    // Counters are those of the first frame.
    const Json one = stats_of({"--count"});
    EXPECT_EQ(json.at("texture").at("taps"), one.at("texture").at("taps"));
    EXPECT_EQ(json.at("image").at("samples_shaded"), one.at("image").at("samples_shaded"));
    EXPECT_FALSE(one.contains("sequence"));
}

TEST_F(FramesTest, TellWhatTheyWere) {
    const test::Outcome outcome = run(words(folder_ / "a.png", {"--frames", "4", "--accumulate", "reproject", "--camera-path", "orbit"}));
    EXPECT_EQ(outcome.code, kDone) << outcome.err;
    EXPECT_NE(outcome.out.find("\nFrames: 4, accumulate reproject:0.1, flicker "), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find(" of the pixels without history\n"), std::string::npos) << outcome.out;
    const Json json = stats_of({"--frames", "2", "--accumulate", "reproject", "--camera-path", "dolly"});
    EXPECT_EQ(json.at("sequence").at("camera_path"), "dolly");
    EXPECT_GE(json.at("sequence").at("disoccluded").get<double>(), 0.0);
    EXPECT_FALSE(json.at("sequence").contains("flicker_rms")) << "too few frames";
}

TEST_F(FramesTest, FollowKeyFramesOfAFile) {
    const std::string file = folder_.write("way.json", R"([{"eye": [0, 0, 4], "target": [0, 0, 0], "fov": 40},
                                                           {"eye": [1, 0.5, 3], "target": [0.5, 0, 0], "fov": 50}])");
    const shading::Image first = rendered({"--eye", "0,0,4", "--target", "0,0,0", "--fov", "40"});
    EXPECT_EQ(rendered({"--camera-path", file}).values, first.values);
    const shading::Image ends = rendered({"--frames", "3", "--camera-path", file, "--accumulate", "ema:1", "--pixel-jitter", "frame"});
    EXPECT_NE(ends.values, first.values);
    EXPECT_EQ(refused(kBadInput, {"--camera-path", folder_.write("bad.json", "[{}]")}, "bad.json: key 0 has no"), "");
    EXPECT_EQ(refused(kBadInput, {"--camera-path", folder_ / "none.json"}, "none.json"), "");
    EXPECT_EQ(refused(kWrongUsage, {"--camera-path", file, "--orbit", "1,2"}, "--orbit makes no sense beside it"), "");
    EXPECT_EQ(refused(kWrongUsage, {"--camera-path", file, "--stats", file}, "would replace a file that is read"), "");
}

/// Adds a camera to the quad, and an animation of it, of `values` translations at even times.
std::string animated_quad(const TemporaryFolder& folder, const std::string& name, const std::vector<float>& times,
                          const std::vector<float>& places) {
    Json json = Json::parse(folder.read("quad.gltf"));
    std::vector<float> numbers = times;
    numbers.insert(numbers.end(), places.begin(), places.end());
    std::string bytes(numbers.size() * sizeof(float), '\0');
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    folder.write(name + ".bin", bytes);
    const size_t buffer = json["buffers"].size(), view = json["bufferViews"].size(), accessor = json["accessors"].size();
    const size_t split = times.size() * sizeof(float);
    json["buffers"].push_back({{"uri", name + ".bin"}, {"byteLength", bytes.size()}});
    json["bufferViews"].push_back({{"buffer", buffer}, {"byteLength", split}});
    json["bufferViews"].push_back({{"buffer", buffer}, {"byteOffset", split}, {"byteLength", bytes.size() - split}});
    json["accessors"].push_back({{"bufferView", view}, {"componentType", 5126}, {"type", "SCALAR"}, {"count", times.size()}});
    json["accessors"].push_back({{"bufferView", view + 1}, {"componentType", 5126}, {"type", "VEC3"}, {"count", places.size() / 3}});
    json["cameras"].push_back({{"type", "perspective"}, {"name", "eye"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}});
    const size_t node = json["nodes"].size();
    json["nodes"].push_back({{"camera", 0}, {"translation", {places[0], places[1], places[2]}}});
    json["scenes"][0]["nodes"].push_back(node);
    json["animations"].push_back({{"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}}}},
                                  {"samplers", {{{"input", accessor}, {"output", accessor + 1}}}}});
    return folder.write(name + ".gltf", json.dump());
}

TEST_F(FramesTest, FollowTheAnimationOfTheGltf) {
    const shading::Image outside = rendered({"--eye", "0,0,4", "--target", "0,0,0"});
    EXPECT_EQ(refused(kWrongUsage, {"--camera-path", "gltf"}, "the scene has no camera"), "");
    scene_ = animated_quad(folder_, "moving", {0, 1}, {0, 0, 4, 1, 0, 4});
    const shading::Image rest = rendered({});
    EXPECT_EQ(rendered({"--camera-path", "gltf"}).values, rest.values);
    // Of the last frame alone: what the camera sees at the animation's end, with that frame's sample.
    const Words last{"--frames", "2", "--camera-path", "gltf", "--accumulate", "ema:1"};
    const shading::Image end = rendered(last);
    scene_ = animated_quad(folder_, "there", {0, 1}, {1, 0, 4, 1, 0, 4});
    EXPECT_EQ(end.values, rendered(last).values);
    EXPECT_NE(end.values, rest.values);
    scene_ = animated_quad(folder_, "backwards", {1, 0}, {0, 0, 4, 1, 0, 4});
    const test::Outcome backwards = run(words(folder_ / "image.exr", {"--camera-path", "gltf"}));
    EXPECT_EQ(backwards.code, kBadInput);
    EXPECT_NE(backwards.err.find("times must increase"), std::string::npos) << backwards.err;
    EXPECT_EQ(rendered({}).values, rest.values);
}

TEST_F(FramesTest, RefuseWhatMakesNoSense) {
    EXPECT_EQ(refused(kWrongUsage, {"--frames", "2", "--repeat", "2"}, "--repeat times one frame"), "");
    EXPECT_EQ(refused(kWrongUsage, {"--frames", "3", "--frames-out", folder_ / "f.png"}, "has no %d"), "");
    EXPECT_EQ(refused(kWrongUsage, {"--frames", "3", "--frames-out", folder_ / "f-%d.pgn"}, "nearest image format is '.png'"), "");
    EXPECT_EQ(refused(kWrongUsage, {"--frames", "3", "--flicker", folder_ / "f.png"}, "cannot hold floats"), "");
    EXPECT_EQ(refused(kWrongUsage, {"--frames", "3", "--accumulate", "reproject", "--crop", "0,0,8,8", "--count"}, "renders whole frames"),
              "");
    // The second frame would be the image itself, the fourth the scene's texture.
    EXPECT_EQ(refused(kWrongUsage, {"--frames", "3", "--frames-out", folder_ / "%d.exr", "--flicker", folder_ / "1.exr"},
                      "is the file that --flicker writes"),
              "");
    Json json = Json::parse(folder_.read("quad.gltf"));
    json["images"][0] = {{"uri", "texture-3.png"}};
    folder_.write("texture-3.png", folder_.read("texture.png"));
    scene_ = folder_.write("numbered.gltf", json.dump());
    EXPECT_EQ(refused(kWrongUsage, {"--frames", "5", "--frames-out", folder_ / "texture-%d.png"}, "would replace a file that is read"), "");
    EXPECT_FALSE(std::ranges::count(folder_.entries(), "texture-0.png"));
    EXPECT_EQ(refused(kCannotWrite, {"--frames", "2", "--frames-out", "/proc/nowhere/%d.png"}, "/proc/nowhere/0.png"), "");
}

}  // namespace
}  // namespace rawtexel::cli
