#include "cli/sequence_options.h"

#include "tests/cli/option_group.h"

#include <gtest/gtest.h>

namespace rawtexel::cli {
namespace {

using shading::Accumulation;
using Words = std::vector<std::string>;

SequenceOptions parsed(const Words& words) {
    const auto options = test::parsed_options<SequenceOptions>(declare_sequence_options, words);
    check(options, 1);
    return options;
}

std::string complaint(const Words& words) { return test::complaint_of(parsed, words); }

TEST(SequenceOptions, AreNoneUnlessOneIsGiven) {
    EXPECT_FALSE(parsed({}).is_sequence());
    EXPECT_FALSE(parsed({"--frames", "1"}).is_sequence());
    for (const Words& words : {Words{"--frames", "2"}, {"--camera-path", "orbit"}, {"--accumulate", "mean"}, {"--frames-out", "f%d.png"}})
        EXPECT_TRUE(parsed(words).is_sequence()) << words[0];
}

TEST(SequenceOptions, ReadHowFramesAccumulate) {
    EXPECT_EQ(parsed({}).temporal().accumulation, Accumulation::Mean);
    EXPECT_EQ(parsed({"--accumulate", "ema"}).temporal().weight, 0.1f);
    const shading::TemporalOptions reproject = parsed({"--accumulate", "reproject:0.05", "--history-clamp", "off"}).temporal();
    EXPECT_EQ(reproject.accumulation, Accumulation::Reproject);
    EXPECT_EQ(reproject.weight, 0.05f);
    EXPECT_FALSE(reproject.clamp);
    EXPECT_TRUE(parsed({"--accumulate", "reproject"}).temporal().clamp);
    for (const char* text : {"mean", "ema:0.1", "ema:1", "reproject:0.25"})
        EXPECT_EQ(print_accumulate(parsed({"--accumulate", text})), text);
    EXPECT_EQ(complaint({"--accumulate", "emma"}), "--accumulate: unknown value 'emma', the nearest is 'ema' (mean ema reproject)");
    EXPECT_EQ(complaint({"--accumulate", "mean:0.1"}), "--accumulate: 'mean' takes no weight, all samples count alike");
    for (const char* text : {"ema:", "ema:0", "ema:1.5", "ema:nan", "reproject:x", "ema:0.1:2"})
        EXPECT_NE(complaint({"--accumulate", text}).find("is not a number from"), std::string::npos) << text;
}

TEST(SequenceOptions, ReadCameraPaths) {
    for (const char* text : {"orbit", "dolly", "gltf", "some/way.json"}) EXPECT_EQ(print(*parsed({"--camera-path", text}).path), text);
    EXPECT_EQ(parsed({"--camera-path", "some/way.json"}).path->kind, CameraPathKind::File);
    EXPECT_EQ(complaint({"--camera-path", "orbits"}),
              "--camera-path: unknown value 'orbits', the nearest is 'orbit' (orbit dolly gltf), or the path of a .json file");
}

TEST(SequenceOptions, NameFramesByTheirPattern) {
    EXPECT_EQ(frame_name("frame-%04d.png", 7), "frame-0007.png");
    EXPECT_EQ(frame_name("%d", 12), "12");
    EXPECT_EQ(frame_name("100%%/%02d.exr", 123), "100%/123.exr");
    for (const char* pattern :
         {"frame.png", "%s.png", "%", "frame-%04d-%d.png", "%5d.png", "%0d.png", "%04", "%012345678901234d.png", "%n%d"}) {
        const std::string message = complaint({"--frames-out", pattern});
        EXPECT_TRUE(message.starts_with("--frames-out: '" + std::string(pattern) + "' ")) << message;
    }
}

TEST(SequenceOptions, RefuseWhatMeansNothing) {
    EXPECT_NE(complaint({"--frames", "0"}).find("from 1 to 100000"), std::string::npos);
    EXPECT_NE(complaint({"--history-clamp", "off"}).find("for --accumulate reproject alone"), std::string::npos);
    EXPECT_NE(complaint({"--flicker", "f.exr", "--frames", "2"}).find("--frames 3 or more"), std::string::npos);
    EXPECT_EQ(complaint({"--flicker", "f.exr", "--frames", "3"}), "");
    SequenceOptions many;
    many.frames = 100000;
    EXPECT_THROW(check(many, 1 << 20), UsageError);
    EXPECT_NO_THROW(check(many, 1 << 14));
}

TEST(SequenceOptions, TakeTheLastHalfForTheFlicker) {
    EXPECT_EQ(first_flicker_frame(3), 1);
    EXPECT_EQ(first_flicker_frame(4), 2);
    EXPECT_EQ(first_flicker_frame(9), 4);
}

}  // namespace
}  // namespace rawtexel::cli
