// Files that appear whole or not at all, where they were meant to be.
#include "scenes/output_file.h"

#include "scenes/image_io.h"
#include "tests/temporary_folder.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

namespace rawtexel::scenes {
namespace {

using test::TemporaryFolder;
namespace fs = std::filesystem;

void write_text(const std::string& path, std::string_view text) { write_file(path, std::as_bytes(std::span(text))); }

/// The message of the OutputError that `action` throws; "" when it throws none.
template <class Action>
std::string failure(const Action& action) {
    try {
        action();
        return "";
    } catch (const OutputError& error) {
        return error.what();
    }
}

TEST(OutputFile, WritesAndReplaces) {
    const TemporaryFolder folder;
    write_text(folder / "a.txt", "first");
    EXPECT_EQ(folder.read("a.txt"), "first");
    write_text(folder / "a.txt", "second");
    EXPECT_EQ(folder.read("a.txt"), "second");
    EXPECT_EQ(folder.entries(), std::vector<std::string>{"a.txt"});
    write_text("/dev/null", "text");  // a device stays one
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(OutputFile, AFileThatDoesNotFitLeavesTheOldOneAndNothingElse) {
    TemporaryFolder folder;
    folder.write("a.bin", "old");
    // The limit on file sizes stands for a full disk.
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const rlimit small{1000, before.rlim_max};
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    std::string message;
    try {
        write_file(folder / "a.bin", std::vector<std::byte>(5000));
    } catch (const OutputError& error) {
        message = error.what();
    }
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_NE(message.find(folder / "a.bin" + ": cannot be written whole"), std::string::npos) << message;
    EXPECT_EQ(folder.entries(), std::vector<std::string>{"a.bin"});
    EXPECT_EQ(folder.read("a.bin"), "old");
}

TEST(OutputFile, NamesMayBeAsLongAsTheSystemAllows) {
    const TemporaryFolder folder;
    for (const size_t length : {240u, 251u, 255u}) {
        const std::string name(length, 'x');
        check_writable(folder / name);
        EXPECT_TRUE(folder.entries().empty());
        write_text(folder / name, "text");
        EXPECT_EQ(folder.entries(), std::vector<std::string>{name});
        fs::remove(folder / name);
    }
    const std::string too_long = folder / std::string(256, 'x');
    EXPECT_EQ(failure([&] { check_writable(too_long); }), too_long + ": cannot be written (File name too long)");
}

TEST(OutputFile, TheCheckFailsAsWritingDoes) {
    const TemporaryFolder folder;
    folder.write("file", "text");
    fs::create_directory(folder / "folder");
    fs::create_symlink("circle", folder / "circle");
    fs::create_symlink("missing/target", folder / "dangling");
    for (const char* name : {"missing/a", "file/a", "folder", "circle", "dangling", "", "missing/"}) {
        const std::string path = folder / name;
        const std::string checked = failure([&] { check_writable(path); }), written = failure([&] { write_text(path, "text"); });
        EXPECT_NE(checked.find(path + ": cannot be written ("), std::string::npos) << checked;
        EXPECT_EQ(checked, written);
    }
    EXPECT_EQ(folder.entries(), (std::vector<std::string>{"circle", "dangling", "file", "folder"}));
    EXPECT_EQ(folder.read("file"), "text");
    check_writable("/dev/null");
}

TEST(OutputFile, TheCheckChangesNothing) {
    const TemporaryFolder folder;
    folder.write("there", "text");
    const auto before = fs::last_write_time(folder / "there");
    check_writable(folder / "there");
    check_writable(folder / "new");
    EXPECT_EQ(folder.entries(), std::vector<std::string>{"there"});
    EXPECT_EQ(folder.read("there"), "text");
    EXPECT_EQ(fs::last_write_time(folder / "there"), before);
}

TEST(OutputFile, LinksStayAndTheirTargetsAreWritten) {
    const TemporaryFolder folder;
    folder.write("elsewhere/target", "old");
    fs::create_symlink("elsewhere/target", folder / "relative");
    fs::create_symlink(folder / "relative", folder / "absolute");
    fs::create_symlink("elsewhere/new", folder / "dangling");
    write_text(folder / "absolute", "new");
    write_text(folder / "dangling", "more");
    EXPECT_EQ(folder.read("elsewhere/target"), "new");
    EXPECT_EQ(folder.read("elsewhere/new"), "more");
    for (const char* link : {"relative", "absolute", "dangling"}) EXPECT_TRUE(fs::is_symlink(folder / link)) << link;
    EXPECT_EQ(folder.entries(), (std::vector<std::string>{"absolute", "dangling", "elsewhere", "relative"}));
    EXPECT_EQ(written_path(folder / "absolute"), folder / "elsewhere/target");
    EXPECT_EQ(written_path(folder / "plain"), folder / "plain");
}

}  // namespace
}  // namespace rawtexel::scenes
