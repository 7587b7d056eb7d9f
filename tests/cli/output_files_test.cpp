#include "cli/output_files.h"

#include "cli/usage_error.h"
#include "scenes/image_io.h"
#include "tests/temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace rawtexel::cli {
namespace {

using test::TemporaryFolder;
namespace fs = std::filesystem;

std::string refusal(const std::vector<OutputFile>& outputs, const std::vector<std::string>& inputs = {}) {
    try {
        check_outputs(outputs, inputs);
        return "";
    } catch (const UsageError& error) {
        return error.what();
    }
}

TEST(OutputFiles, TwoOutputsAreTwoFilesByWhateverName) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "sub");
    fs::create_symlink("new.png", folder / "link.png");
    const std::string a = folder / "new.png";
    for (const std::string& same : {a, folder / "./new.png", folder / "sub/../new.png", folder / "link.png"})
        EXPECT_EQ(refusal({{"-o", a}, {"--stats", same}}), "--stats: '" + same + "' is the file that -o writes");
    EXPECT_EQ(refusal({{"-o", a}, {"--stats", folder / "sub/new.png"}}), "");
    EXPECT_EQ(refusal({{"-o", "/dev/null"}, {"--stats", "/dev/null"}}), "");
    EXPECT_EQ(folder.entries(), (std::vector<std::string>{"link.png", "sub"}));
}

TEST(OutputFiles, NoOutputIsAnInput) {
    const TemporaryFolder folder;
    const std::string scene = folder.write("scene.glb", "scene");
    fs::create_hard_link(scene, folder / "hard.glb");
    fs::create_symlink("scene.glb", folder / "soft.glb");
    for (const std::string& same :
         {scene, folder / "hard.glb", folder / "soft.glb", folder / "../" + fs::path(folder.path()).filename().string() + "/scene.glb"})
        EXPECT_EQ(refusal({{"-o", same}}, {folder / "other", scene}), "-o: '" + same + "' would replace a file that is read") << same;
    EXPECT_EQ(refusal({{"-o", folder / "new.glb"}}, {scene, "courtyard", folder / "missing"}), "");
    EXPECT_EQ(refusal({{"-o", "/dev/null"}}, {"/dev/null"}), "");
}

TEST(OutputFiles, WhatCannotBeWrittenIsTold) {
    const TemporaryFolder folder;
    EXPECT_THROW(refusal({{"-o", folder / "a"}, {"--stats", folder / "missing/a"}}), scenes::OutputError);
}

}  // namespace
}  // namespace rawtexel::cli
