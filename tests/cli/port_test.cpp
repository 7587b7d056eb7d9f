// Our own ports pass every suite on the Vulkan device that is here, lavapipe in continuous integration.
#include "cli/vectors/suite.h"
#include "cli/vulkan/child_process.h"
#include "cli/vulkan/glsl_compiler.h"
#include "tests/cli/port_device.h"
#include "tests/cli/program_runner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <span>
#include <string>
#include <unistd.h>
#include <utility>

namespace rawtexel::test {
namespace {

std::string suite_label(std::string name) {
    std::ranges::replace(name, '-', '_');
    return name;
}

class PortTest : public testing::TestWithParam<std::string> {};

TEST_P(PortTest, IsValidSpirvAndLegalInEveryCase) {
    RAWTEXEL_NEED_PORTS();
    const TemporaryFolder folder;
    const std::vector<std::byte> compiled = cli::compile_glsl(port_of(GetParam()));
    const std::string module = folder.write("port.spv", std::span<const std::byte>(compiled));
    const Outcome outcome = run({"verify-shader", "--suite", GetParam(), "--spirv", module});
    EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
    EXPECT_NE(outcome.out.find("all legal"), std::string::npos) << outcome.out;
    if (std::system("command -v spirv-val > /dev/null") != 0) {
        if (std::getenv("RAWTEXEL_REQUIRE_VULKAN") != nullptr) FAIL() << "no spirv-val (Debian: spirv-tools)";
        GTEST_SKIP() << "no spirv-val (Debian: spirv-tools)";
    }
    EXPECT_EQ(std::system(("spirv-val --target-env vulkan1.0 " + module + " > " + (folder / "log") + " 2>&1").c_str()), 0)
        << folder.read("log");
}

std::vector<std::string> suite_names() {
    std::vector<std::string> names;
    for (const cli::SuiteInfo& info : cli::all_suites()) names.emplace_back(info.name);
    return names;
}
INSTANTIATE_TEST_SUITE_P(Ports, PortTest, testing::ValuesIn(suite_names()), [](const auto& tested) { return suite_label(tested.param); });

TEST(PortRun, WritesTheAnswersThatOutputsTakes) {
    RAWTEXEL_NEED_PORTS();
    const TemporaryFolder folder;
    const std::string answers = folder / "answers.bin";
    ASSERT_EQ(run({"verify-shader", "--suite", "triplanar", "--glsl", port_of("triplanar"), "-o", answers}).code, 0);
    const Outcome judged = run({"verify-shader", "--suite", "triplanar", "--outputs", answers});
    EXPECT_EQ(judged.code, 0) << judged.out << judged.err;
}

TEST(PortRun, JudgesAFolderOfVectors) {
    RAWTEXEL_NEED_PORTS();
    const TemporaryFolder folder;
    ASSERT_EQ(run({"vectors", "--suite", "lod", "-o", folder / "lod"}).code, 0);
    const Outcome judged = run({"verify-shader", "--suite", folder / "lod", "--glsl", port_of("lod")});
    EXPECT_EQ(judged.code, 0) << judged.out << judged.err;
}

// A user's own lookups, of a scene whose textures are together too large for the device's buffers where it is lavapipe (128 MiB), and of
// one with draws.
TEST(PortRun, JudgesLookupsOfAScene) {
    RAWTEXEL_NEED_PORTS();
    const TemporaryFolder folder;
    const std::vector<std::vector<std::string>> asked = {{"layers", "--aniso", "8"},
                                                         {"metal-edge", "--filter", "catmull-rom", "--estimator", "reservoir"}};
    for (const std::vector<std::string>& options : asked) {
        std::vector<std::string> words{"vectors", "--size", "160x90", "--cases", "96", "-o", folder / "scene", "--from"};
        words.insert(words.end(), options.begin(), options.end());
        ASSERT_EQ(run(words).code, 0);
        if (options[0] == "layers") {
            EXPECT_GT(std::filesystem::file_size(folder / "scene/texels.bin"), size_t{128} << 20);
        }
        const Outcome judged = run({"verify-shader", "--suite", folder / "scene", "--glsl", port_of("adversarial")});
        EXPECT_EQ(judged.code, 0) << judged.out << judged.err;
    }
}

// The walk through docs/porting.md: a first try with two faults, whose causes are named.
TEST(PortRun, FindsTheFaultsOfTheExample) {
    RAWTEXEL_NEED_PORTS();
    const Outcome tried =
        run({"verify-shader", "--suite", "addressing", "--glsl", std::string(RAWTEXEL_SHADERS) + "/example/first_try.comp"});
    EXPECT_EQ(tried.code, 1) << tried.err;
    for (const char* part : {"index mirror: ", "likeliest cause: mirror off by one: the edge texel is not repeated",
                             "likeliest cause: coordinates scaled before their whole repeats are taken away"})
        EXPECT_NE(tried.out.find(part), std::string::npos) << part << "\n" << tried.out;
    // Of every group that fails the cause is known, and the right one.
    for (const auto& [group, cause] : {std::pair{"nearest mirror", "mirror off by one"},
                                       {"texel edges mirror", "mirror off by one"},
                                       {"bilinear mirror", "mirror off by one"},
                                       {"two wraps", "mirror off by one"},
                                       {"far from the origin", "coordinates scaled before"},
                                       {"not finite", "a coordinate that is not finite"}}) {
        const size_t at = tried.out.find("\n  " + std::string(group) + ": ");
        ASSERT_NE(at, std::string::npos) << group << "\n" << tried.out;
        const std::string line = "    likeliest cause: ";
        const size_t named = tried.out.find("\n" + line, at) + 1 + line.size();
        EXPECT_EQ(tried.out.substr(named, std::string(cause).size()), cause) << group;
    }
}

TEST(PortRun, RefusesWhatIsNoShaderOfTheContract) {
    RAWTEXEL_NEED_PORTS();
    const TemporaryFolder folder;
    const auto refused = [&](const std::string& name, const std::string& text, const std::string& part) {
        const std::string path = folder.write(name, text);
        const std::string option = name.ends_with(".spv") ? "--spirv" : "--glsl";
        return why_not_failed(run({"verify-shader", "--suite", "triplanar", option, path}), 3, part);
    };
    EXPECT_EQ(refused("text.spv", "not a module, but more than twenty bytes", "not SPIR-V"), "");
    EXPECT_EQ(refused("short.spv", "abc", "not SPIR-V"), "");
    EXPECT_EQ(refused("broken.comp", "#version 450\nvoid main() { int a = ; }\n", "syntax error"), "");
    EXPECT_EQ(
        refused("square.comp", "#version 450\nlayout(local_size_x = 8, local_size_y = 8) in;\nvoid main() {}\n", "workgroup is 8x8x1"), "");
    EXPECT_EQ(refused("binding.comp",
                      "#version 450\nlayout(local_size_x = 8) in;\nlayout(set = 0, binding = 9) buffer B { uint b[]; };\nvoid main() { "
                      "b[0] = 1u; }\n",
                      "binding 9"),
              "");
    EXPECT_EQ(refused("set.comp",
                      "#version 450\nlayout(local_size_x = 8) in;\nlayout(set = 1, binding = 0) buffer B { uint b[]; };\nvoid main() { "
                      "b[0] = 1u; }\n",
                      "descriptor set 1"),
              "");
    EXPECT_EQ(why_not_failed(run({"verify-shader", "--suite", "triplanar", "--glsl", folder / "missing.comp"}), 3, "missing.comp"), "");
    EXPECT_EQ(why_not_failed(run({"verify-shader", "--suite", "triplanar", "--glsl", port_of("triplanar"), "--device", "no such device"}),
                             3, "no Vulkan device has 'no such device' in its name"),
              "");
}

/// Mesa's compiler of SPIR-V crashes on some of these, and must not take the program with it.
TEST(PortRun, EndsInOneLineWhateverIsDamagedInAModule) {
    RAWTEXEL_NEED_PORTS();
    compile_for_narrow_vectors();
    const TemporaryFolder folder;
    const std::vector<std::byte> whole = cli::compile_glsl(port_of("triplanar"));
    std::mt19937 random(3);
    int crashed = 0, refused = 0;
    for (int n = 0; n < 24; ++n) {
        std::vector<std::byte> damaged = whole;
        if (n % 4 == 0) {
            damaged.resize(whole.size() * (size_t(n) / 4 + 1) / 8 / 4 * 4);
        } else {
            for (int bit = 0; bit < 1 << n % 4; ++bit) damaged[20 + random() % (whole.size() - 20)] ^= std::byte(1 << random() % 8);
        }
        const std::string text(reinterpret_cast<const char*>(damaged.data()), damaged.size());
        const Outcome outcome = run({"verify-shader", "--suite", "triplanar", "--spirv", folder.write("damaged.spv", text)});
        EXPECT_TRUE(outcome.code == 0 || outcome.code == 1 || outcome.code == 3) << n << ": " << outcome.code;
        if (outcome.code != 3) continue;
        ++refused;
        crashed += outcome.err.find("the driver crashed on it") != std::string::npos;
        EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << n << ": " << outcome.err;
    }
    EXPECT_GT(refused, 0);
    std::printf("of 24 damaged modules %d are refused, of which %d crash the driver\n", refused, crashed);
}

TEST(ChildProcess, TellsHowItsWorkEnded) {
    using End = cli::ChildOutcome::End;
    std::vector<std::byte> much(300'000);
    for (size_t i = 0; i < much.size(); ++i) much[i] = std::byte(i * 7 >> 3);
    const cli::ChildOutcome returned = cli::run_in_child([&] { return much; }, std::chrono::seconds(60));
    EXPECT_EQ(returned.end, End::Returned);
    EXPECT_EQ(returned.bytes, much);
    const cli::ChildOutcome died = cli::run_in_child(
        [&]() -> std::vector<std::byte> {
            std::raise(SIGKILL);
            return much;
        },
        std::chrono::seconds(60));
    EXPECT_EQ(died.end, End::Died);
    EXPECT_EQ(died.signal, SIGKILL);
    EXPECT_TRUE(died.bytes.empty());
    const cli::ChildOutcome hung = cli::run_in_child(
        [&]() -> std::vector<std::byte> {
            for (;;) pause();
        },
        std::chrono::milliseconds(50));
    EXPECT_EQ(hung.end, End::Hung);
    EXPECT_TRUE(hung.bytes.empty());
}

TEST(PortRun, SaysThatAShaderThatWritesNothingWritesNothing) {
    RAWTEXEL_NEED_PORTS();
    const TemporaryFolder folder;
    const std::string idle = folder.write("idle.comp", "#version 450\nlayout(local_size_x = 64) in;\nvoid main() {}\n");
    const Outcome outcome = run({"verify-shader", "--suite", "random-numbers", "--glsl", idle});
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    EXPECT_NE(outcome.out.find("nothing was written"), std::string::npos) << outcome.out;
}

// Whatever Vulkan is installed, a machine without drivers is told what to install.
TEST(PortRun, SaysWhatToInstallWhereThereIsNoDriver) {
    const std::string shader = port_of("triplanar");
    const std::string command = "VK_ICD_FILENAMES=/nonexistent VK_DRIVER_FILES=/nonexistent " + std::string(RAWTEXEL_PROGRAM) +
                                " verify-shader --suite triplanar --spirv ";
    const TemporaryFolder folder;
    // A module of the contract: header, one entry point, its mode.
    const uint32_t words[] = {0x07230203, 0x00010000, 0, 8, 0, 5u << 16 | 15, 5, 1, 0x6E69616D, 0, 6u << 16 | 16, 1, 17, 64, 1, 1};
    const std::string module = folder.write("module.spv", std::as_bytes(std::span(words)));
    const int status = std::system((command + module + " 2> " + (folder / "log")).c_str());
    EXPECT_EQ(WEXITSTATUS(status), 3) << folder.read("log");
    EXPECT_NE(folder.read("log").find("install"), std::string::npos) << folder.read("log");
    EXPECT_NE(folder.read("log").find("--outputs FILE"), std::string::npos) << folder.read("log");
}

}  // namespace
}  // namespace rawtexel::test
