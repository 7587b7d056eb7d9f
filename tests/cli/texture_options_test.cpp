// How texture files are opened, from words to pixels.
#include "cli/texture_options.h"

#include "cli/command.h"
#include "scenes/image_io.h"
#include "tests/cli/program_runner.h"

#include "tests/cli/option_group.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace rawtexel::cli {
namespace {

using test::TemporaryFolder;

texunit::ContainerOptions options_of(const std::vector<std::string>& words) {
    return test::parsed_options<texunit::ContainerOptions>(declare_texture_options, words);
}

TEST(TextureOptions, ReachTheirMembers) {
    EXPECT_EQ(options_of({}).bc_rounding, texunit::BcRounding::Exact);
    EXPECT_EQ(options_of({}).max_texture_bytes, uint64_t{4} << 30);
    EXPECT_EQ(options_of({"--bc-rounding", "amd"}).bc_rounding, texunit::BcRounding::Amd);
    EXPECT_EQ(options_of({"--max-texture-bytes", "1"}).max_texture_bytes, 1u);
    EXPECT_THROW(options_of({"--bc-rounding", "intel"}), UsageError);
}

void append_32(std::string& bytes, uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) bytes += char(value >> shift & 0xff);
}

/// A DDS file of one 4x4 BC1 block whose texels are all two thirds of one near-black and one third of another.
std::string grey_dds() {
    std::string bytes = "DDS ";
    for (const uint32_t field : {124u, 0x81007u, 4u, 4u, 8u, 0u, 1u}) append_32(bytes, field);
    for (int i = 0; i < 11; ++i) append_32(bytes, 0);
    for (const uint32_t field : {32u, 4u, 0x31545844u, 0u, 0u, 0u, 0u, 0u}) append_32(bytes, field);  // "DXT1"
    for (const uint32_t field : {0x1000u, 0u, 0u, 0u, 0u}) append_32(bytes, field);
    append_32(bytes, 0x29653186);
    append_32(bytes, 0xaaaaaaaa);
    return bytes;
}

/// The quad with that texture in place of its own.
std::string write_grey_quad(const TemporaryFolder& folder) {
    const std::string scene = test::write_quad(folder);
    test::write_file(folder / "texture.dds", grey_dds());
    std::string json = test::read_file(scene);
    test::write_file(scene, json.replace(json.find("texture.png"), 11, "texture.dds"));
    return scene;
}

std::vector<std::string> render_words(const std::string& scene, const std::string& output, const std::vector<std::string>& more) {
    std::vector<std::string> words{"render", scene,     "-o",       output,          "--size", "16x16",      "--ambient",
                                   "1",      "--light", "0,0,-1,0", "--environment", "none",   "--progress", "never"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

TEST(TextureOptions, RoundWhatARenderShows) {
    const TemporaryFolder folder;
    const std::string scene = write_grey_quad(folder);
    const auto centre = [&](const char* rounding) {
        const test::Outcome outcome = test::run(render_words(scene, folder / "image.exr", {"--bc-rounding", rounding}));
        EXPECT_EQ(outcome.code, kDone) << outcome.err;
        const shading::Image image = scenes::read_image(folder / "image.exr", false);
        return std::vector<float>(image.pixel(8, 8), image.pixel(8, 8) + 3);
    };
    const std::vector<float> exact = centre("exact"), nvidia = centre("nvidia");
    EXPECT_GT(exact[0], 0.0f);
    EXPECT_LT(nvidia[0], exact[0]) << "red 46 instead of 46.6";
    EXPECT_EQ(nvidia[0], nvidia[2]);
    EXPECT_GT(nvidia[1] / nvidia[0], exact[1] / exact[0]) << "greener than it is";
}

TEST(TextureOptions, RefuseFilesBeyondTheLimit) {
    const TemporaryFolder folder;
    const std::string scene = write_grey_quad(folder);
    const auto words = [&](const char* most) { return render_words(scene, folder / "image.png", {"--max-texture-bytes", most}); };
    EXPECT_EQ(test::run(words("8")).code, kDone);
    EXPECT_EQ(test::why_not_failed(test::run(words("7")), 3, "8 bytes of texels; at most 7 are allowed"), "");
    EXPECT_EQ(test::why_not_failed(test::run(words("0")), 2, "--max-texture-bytes"), "");
}

}  // namespace
}  // namespace rawtexel::cli
