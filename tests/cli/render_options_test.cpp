#include "cli/render_options.h"

#include "tests/cli/option_group.h"

#include <gtest/gtest.h>

namespace rawtexel::cli {
namespace {

RenderRequest request_of(const std::vector<std::string>& words) {
    RenderRequest request = test::parsed_options<RenderRequest>(declare_render_options, words);
    settle(request);
    return request;
}

std::string error_of(const std::vector<std::string>& words) { return test::complaint_of(request_of, words); }

TEST(RenderOptions, DefaultsAreThoseOfTheContract) {
    const RenderRequest request = request_of({});
    EXPECT_EQ(request.image_size(), (ImageSize{1280, 720}));
    EXPECT_EQ(request.crop.width, 0);
    EXPECT_EQ(request.samples.spp, 1);
    EXPECT_EQ(request.samples.seed, 0u);
    EXPECT_EQ(request.samples.pixel_filter, shading::PixelFilter::Box);
    EXPECT_EQ(request.samples.pixel_jitter, shading::PixelJitter::Frame);
    EXPECT_FALSE(request.lookup.filter || request.lookup.mip);
    EXPECT_EQ(request.lookup.mip_storage, texunit::MipStorage::Source);
    EXPECT_FALSE(request.tone.exposure || request.tone.tone_map || request.tone.transfer);
    EXPECT_EQ(request.machine.threads, 0);
    EXPECT_EQ(request.machine.tile_size, 64);
    EXPECT_EQ(request.machine.simd, texunit::Simd::Auto);
    EXPECT_EQ(request.machine.progress, ProgressMode::Auto);
    EXPECT_EQ(request.light.reflections, shading::EnvironmentReflections::Prefiltered);
    EXPECT_FALSE(request.light.light || request.light.ambient || request.light.shadows || request.light.environment ||
                 request.light.background);
}

TEST(RenderOptions, EveryOptionReachesItsMember) {
    const RenderRequest request =
        request_of({"--size",        "640x480",    "--crop",       "10,20,30,40", "--camera",       "front",    "--target",       "1,2,3",
                    "--fov",         "60",         "--light",      "0,-1,0,2",    "--ambient",      "0.25",     "--shadows",      "off",
                    "--environment", "sky.exr",    "--background", "1,0,.5",      "--filter",       "nearest",  "--mip",          "none",
                    "--mip-storage", "float",      "--spp",        "16",          "--pixel-filter", "tent",     "--pixel-jitter", "pixel",
                    "--seed",        "4294967295", "--exposure",   "-1.5",        "--tonemap",      "reinhard", "--transfer",     "sqrt",
                    "--threads",     "3",          "--tile-size",  "128",         "--simd",         "scalar",   "--progress",     "never"});
    EXPECT_EQ(request.image_size(), (ImageSize{640, 480}));
    EXPECT_EQ(print(request.crop), "10,20,30,40");
    EXPECT_EQ(request.view.camera, "front");
    EXPECT_EQ(request.view.target, glm::vec3(1, 2, 3));
    EXPECT_EQ(request.view.fov, 60.0f);
    EXPECT_EQ(*request.light.light, (SunOption{{0, -1, 0}, 2}));
    EXPECT_EQ(request.light.ambient, 0.25f);
    EXPECT_EQ(request.light.shadows, false);
    EXPECT_EQ(*request.light.environment, (EnvironmentOption{EnvironmentKind::File, "sky.exr"}));
    EXPECT_EQ(request.light.background, glm::vec3(1, 0, 0.5f));
    EXPECT_EQ(request_of({"--environment-reflections", "split-sum"}).light.reflections, shading::EnvironmentReflections::SplitSum);
    EXPECT_EQ(request.lookup.filter, texunit::Kernel::Nearest);
    EXPECT_EQ(request.lookup.mip, texunit::MipMode::None);
    EXPECT_EQ(request.lookup.mip_storage, texunit::MipStorage::Float);
    EXPECT_EQ(request.samples.spp, 16);
    EXPECT_EQ(request.samples.pixel_filter, shading::PixelFilter::Tent);
    EXPECT_EQ(request.samples.pixel_jitter, shading::PixelJitter::Pixel);
    EXPECT_EQ(request.samples.seed, 4294967295u);
    EXPECT_EQ(request.tone.exposure, -1.5f);
    EXPECT_EQ(request.tone.tone_map, shading::ToneMap::Reinhard);
    EXPECT_EQ(request.tone.transfer, shading::Transfer::Sqrt);
    EXPECT_EQ(request.machine.threads, 3);
    EXPECT_EQ(request.machine.tile_size, 128);
    EXPECT_EQ(request.machine.simd, texunit::Simd::Scalar);
    EXPECT_EQ(request.machine.progress, ProgressMode::Never);
}

TEST(RenderOptions, PrintedValuesReadBack) {
    EXPECT_EQ(parse_size(print(ImageSize{16384, 1})), (ImageSize{16384, 1}));
    EXPECT_EQ(parse_orbit(print(Orbit{-30.5f, 12.25f, 0.1f})), (Orbit{-30.5f, 12.25f, 0.1f}));
    EXPECT_EQ(parse_light(print(SunOption{{0.1f, -1, 3}, 2.5f})), (SunOption{{0.1f, -1, 3}, 2.5f}));
    for (const std::string text : {"sky", "none", "a/b.hdr"}) EXPECT_EQ(print(parse_environment(text)), text);
    for (const std::string text : {"scene", "nearest", "bilinear"}) EXPECT_EQ(print_filter(parse_filter(text)), text);
    for (const std::string text : {"scene", "linear", "nearest", "none"}) EXPECT_EQ(print_mip(parse_mip(text)), text);
    for (const std::string text : {"source", "float"}) EXPECT_EQ(print(parse_mip_storage(text)), text);
}

TEST(RenderOptions, OptionalPartsHaveDefaults) {
    EXPECT_EQ(parse_orbit("10,20").zoom, 1.0f);
    EXPECT_EQ(parse_light("0,-1,0").intensity, 3.0f);
    EXPECT_FALSE(parse_background("environment"));
}

TEST(RenderOptions, WrongValuesAreRefusedWithTheNearest) {
    const std::initializer_list<std::pair<std::vector<std::string>, const char*>> cases{
        {{"--mip", "liner"}, "--mip: unknown value 'liner', the nearest is 'linear' (scene linear nearest none)"},
        {{"--tonemap", "ACES"}, "--tonemap: unknown value 'ACES', the nearest is 'aces' (aces reinhard none)"},
        {{"--shadows", "of"}, "--shadows: unknown value 'of', the nearest is 'off' (on off)"},
        {{"--tile-size", "63"}, "--tile-size: unknown value '63', the nearest is '64' (32 64 128)"},
        {{"--background", "enviroment"}, "--background: unknown value 'enviroment', the nearest is 'environment' (environment)"},
        {{"--size", "0x4"}, "--size: '0' is not a whole number from 1 to 16384"},
        {{"--size", "64"}, "--size: '64' is not WxH, such as 1280x720"},
        {{"--spp", "0"}, "--spp: '0' is not a whole number from 1 to 1048576"},
        {{"--seed", "-1"}, "--seed: '-1' is not a whole number from 0 to 4294967295"},
        {{"--fov", "180"}, "--fov: '180' is not a number from 0.01 to 179"},
        {{"--light", "0,0,0"}, "--light: '0,0,0' has no direction"},
        {{"--light", "0,-1,0,-1"}, "--light: '0,-1,0,-1' has I -1 (allowed: 0 to 1e15)"},
        {{"--orbit", "1,2,0"}, "--orbit: '1,2,0' has ZOOM 0 (allowed: 1e-6 to 1e6)"},
        {{"--orbit", "1,2,2e6"}, "--orbit: '1,2,2e6' has ZOOM 2e+06 (allowed: 1e-6 to 1e6)"},
        {{"--orbit", "36001,2"}, "--orbit: '36001,2' has YAW 36001 (allowed: -36000 to 36000)"},
        {{"--orbit", "1,-1e9,2"}, "--orbit: '1,-1e9,2' has PITCH -1e+09 (allowed: -36000 to 36000)"},
        {{"--ambient", "1e7"}, "--ambient: '1e7' is not a number from 0 to 1e6"},
        {{"--background", "0,-1,0"}, "--background: '0,-1,0' is not environment or R,G,B from 0 to 1e15"},
        {{"--eye", "0,0,2e15"}, "--eye: '0,0,2e15' is not X,Y,Z from -1e15 to 1e15"},
        {{"--environment", "skyy"}, "--environment: unknown value 'skyy', the nearest is 'sky' (sky none), or the path of an image"},
        {{"--environment", "nnone"}, "--environment: unknown value 'nnone', the nearest is 'none' (sky none), or the path of an image"},
        {{"--crop", "0,0,0,5"}, "--crop: '0,0,0,5' is empty"},
        {{"--crop", "0,0,10,10", "--size", "9x20"}, "--crop: 0,0,10,10 reaches outside the image of 9x20"},
        {{"--camera", "a", "--orbit", "1,2"}, "--camera and --orbit exclude each other"},
        {{"--orbit", "1,2", "--eye", "1,2,3"}, "--orbit and --eye exclude each other"},
    };
    for (const auto& [words, message] : cases) EXPECT_EQ(error_of(words), message);
}

TEST(RenderOptions, WhatHasNoEffectIsRefused) {
    const std::initializer_list<std::pair<std::vector<std::string>, const char*>> cases{
        {{"--ewa", "--filter", "bspline"}, "--filter: "},
        {{"--mip", "none", "--ewa"}, "--mip: "},
        {{"--ewa", "--lod-rule", "d3d"}, "--lod-rule: "},
        {{"--ewa", "--lod-bias", "1"}, "--lod-bias: "},
        {{"--ewa", "--precision", "gpu"}, "--precision gpu: "},
        {{"--ewa", "--hybrid-bias", "1"}, "--hybrid-bias: "},
        {{"--hybrid-bias", "1", "--mip", "none"}, "--hybrid-bias: --mip none reads level 0"},
        {{"--footprint", "sample"}, "--footprint sample: one sample"},
        {{"--aniso", "16:0.25", "--lod-rule", "exact"}, "--lod-rule: --aniso N:S2 always takes the axes of the ellipse"},
        {{"--reference", "0.1", "--lod-rule", "d3d"}, "--reference: the truth leaves no choice to --aniso"},
    };
    for (const auto& [words, start] : cases) EXPECT_TRUE(error_of(words).starts_with(start)) << words[0] << ": " << error_of(words);
    EXPECT_EQ(error_of({"--aniso", "16", "--lod-rule", "exact"}), "");
    EXPECT_EQ(error_of({"--footprint", "sample", "--spp", "2"}), "");
    EXPECT_EQ(error_of({"--ewa", "--estimator", "jitter", "--hybrid-bias", "1"}), "");
}

TEST(RenderOptions, WhatLooksLikeAFileIsOneWhetherItExistsOrNot) {
    for (const char* text : {"studio.hdr", "./skyy", "folder/sky", "/skyy"})
        EXPECT_EQ(parse_environment(text), (EnvironmentOption{EnvironmentKind::File, text}));
}

TEST(RenderOptions, HelpSaysTheRangeOfEveryNumber) {
    CommandLine line("", "");
    RenderRequest request;
    declare_render_options(line, request);
    std::string help = line.help();
    for (size_t end; (end = help.find("\n   ")) != help.npos;) help.erase(end, help.find_first_not_of(" \n", end) - end - 1).at(end) = ' ';
    const std::initializer_list<std::pair<const char*, const char*>> ranges{
        {"--size", "1 to 16384"},      {"--orbit", "-36000 to 36000"},  {"--orbit", "1e-6 to 1e6"},    {"--eye", "-1e15 to 1e15"},
        {"--target", "-1e15 to 1e15"}, {"--fov", "0.01 to 179"},        {"--light", "0 to 1e15"},      {"--ambient", "0 to 1e6"},
        {"--background", "0 to 1e15"}, {"--spp", "1 to 1048576"},       {"--seed", "0 to 4294967295"}, {"--exposure", "-64 to 64"},
        {"--threads", "1 to 1024"},    {"--tile-size", "32, 64 or 128"}};
    for (const auto& [option, range] : ranges) {
        const size_t start = help.find(std::string("  ") + option + " "), end = help.find('\n', start);
        ASSERT_NE(start, help.npos) << option;
        EXPECT_NE(help.substr(start, end - start).find(range), help.npos) << help.substr(start, end - start);
    }
}

TEST(RenderOptions, AdaptiveSamplingIsRefusedWhereItDecidesNothing) {
    EXPECT_EQ(request_of({"--adaptive", "0.01", "--spp", "17"}).samples.adaptive, 0.01f);
    for (const std::vector<std::string>& words :
         std::initializer_list<std::vector<std::string>>{{"--adaptive", "0.01"},
                                                         {"--adaptive", "0.01", "--spp", "16"},
                                                         {"--adaptive", "0", "--spp", "64"},
                                                         {"--adaptive", "nan", "--spp", "64"},
                                                         {"--adaptive", "0.01", "--spp", "64", "--crop", "0,8,16,16"},
                                                         {"--adaptive", "0.01", "--spp", "64", "--size", "40x40", "--crop", "0,0,39,40"},
                                                         {"--adaptive", "0.01", "--reference", "0.1"}})
        EXPECT_TRUE(error_of(words).starts_with(words.back() == "0.1" ? "--reference" : "--adaptive")) << error_of(words);
    EXPECT_EQ(error_of({"--adaptive", "0.01", "--spp", "64", "--size", "40x40", "--crop", "16,32,24,8"}), "");
}

TEST(RenderOptions, PeerShadingPresetsWhatNoOptionSays) {
    const RenderRequest preset = request_of({"--peer-shading"});
    EXPECT_EQ(preset.light.ambient, 0.1f);
    EXPECT_EQ(preset.light.shadows, false);
    EXPECT_EQ(preset.light.environment->kind, EnvironmentKind::None);
    EXPECT_EQ(preset.tone.tone_map, shading::ToneMap::None);
    const RenderRequest mixed =
        request_of({"--ambient", "0.3", "--peer-shading", "--shadows", "on", "--tonemap", "aces", "--environment", "sky"});
    EXPECT_EQ(mixed.light.ambient, 0.3f);
    EXPECT_EQ(mixed.light.shadows, true);
    EXPECT_EQ(mixed.light.environment->kind, EnvironmentKind::Sky);
    EXPECT_EQ(mixed.tone.tone_map, shading::ToneMap::Aces);
}

}  // namespace
}  // namespace rawtexel::cli
