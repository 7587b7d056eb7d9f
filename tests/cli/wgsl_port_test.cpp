// Our WGSL ports pass every suite through npm's webgpu, on SwiftShader where Chromium has brought it. Skipped where Node, the package or a
// device is missing.
#include "cli/vectors/suite.h"
#include "tests/cli/port_device.h"
#include "tests/cli/program_runner.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace rawtexel::test {
namespace {

const std::string& wgsl_folder() {
    static const std::string folder = std::string(RAWTEXEL_SHADERS) + "/wgsl";
    return folder;
}

constexpr const char* kSwiftShader = "/usr/lib/chromium/vk_swiftshader_icd.json";

/// Answers the suite in `vectors` by `port`. "" or why not; `skipped` where that is for want of something installed.
std::string answer(const TemporaryFolder& folder, const std::string& vectors, const std::string& script, const std::string& port,
                   bool& skipped) {
    skipped = true;
    if (std::system("command -v node > /dev/null") != 0) return "no node (Node.js 20, then `npm install` in tests/shaders/wgsl)";
    if (!std::filesystem::exists(wgsl_folder() + "/node_modules/webgpu"))
        return "npm package webgpu is not installed: run `npm install` in tests/shaders/wgsl";
    std::string command =
        "node " + script + " " + vectors + " " + port + " " + (folder / "answers.bin") + " > " + (folder / "log") + " 2>&1";
    if (std::getenv("VK_ICD_FILENAMES") == nullptr && std::filesystem::exists(kSwiftShader))
        command = std::string("VK_ICD_FILENAMES=") + kSwiftShader + " " + command;
    const int status = std::system(command.c_str());
    if (status == 0) return skipped = false, "";
    skipped = WIFEXITED(status) && WEXITSTATUS(status) == 77;
    return folder.read("log");
}

class WgslPort : public testing::TestWithParam<std::string> {};

TEST_P(WgslPort, IsLegalInEveryCase) {
    const TemporaryFolder folder;
    ASSERT_EQ(run({"vectors", "--suite", GetParam(), "-o", folder / "vectors"}).code, 0);
    bool skipped = false;
    const std::string why =
        answer(folder, folder / "vectors", wgsl_folder() + "/run.mjs", wgsl_folder() + "/suites/" + GetParam() + ".wgsl", skipped);
    if (skipped) GTEST_SKIP() << why;
    ASSERT_EQ(why, "");
    const Outcome outcome = run({"verify-shader", "--suite", GetParam(), "--outputs", folder / "answers.bin"});
    EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
}

/// Samplers of the device cannot be asked through buffers.
std::vector<std::string> suites() {
    std::vector<std::string> names;
    for (const cli::SuiteInfo& info : cli::all_suites()) {
        if (info.name != "hardware") names.emplace_back(info.name);
    }
    return names;
}
INSTANTIATE_TEST_SUITE_P(Ports, WgslPort, testing::ValuesIn(suites()), [](const auto& tested) {
    std::string name = tested.param;
    std::ranges::replace(name, '-', '_');
    return name;
});

TEST(WgslFaults, AreCaught) {
    const TemporaryFolder folder;
    ASSERT_EQ(run({"vectors", "--suite", "mip-choice", "-o", folder / "vectors"}).code, 0);
    const std::string copy = folder / "wgsl";
    for (const auto& entry : std::filesystem::directory_iterator(wgsl_folder())) {
        const std::string name = entry.path().filename().string();
        if (name == "node_modules")
            std::filesystem::create_directory_symlink(entry.path(), folder / "node_modules");
        else if (name == "suites" || name.ends_with(".wgsl") || name == "run.mjs")
            std::filesystem::create_directories(copy),
                std::filesystem::copy(entry.path(), copy + "/" + name, std::filesystem::copy_options::recursive);
    }
    std::string text = read_file(copy + "/stochastic_mip.wgsl");
    const std::string right = "number < l.fraction";
    ASSERT_NE(text.find(right), std::string::npos);
    text.replace(text.find(right), right.size(), "number >= l.fraction");
    write_file(copy + "/stochastic_mip.wgsl", text);
    bool skipped = false;
    const std::string why = answer(folder, folder / "vectors", copy + "/run.mjs", copy + "/suites/mip-choice.wgsl", skipped);
    if (skipped) GTEST_SKIP() << why;
    ASSERT_EQ(why, "");
    EXPECT_EQ(run({"verify-shader", "--suite", "mip-choice", "--outputs", folder / "answers.bin"}).code, 1);
}

}  // namespace
}  // namespace rawtexel::test
