// Which image formats the program writes and speaks of.
#include "cli/image_output.h"

#include "cli/usage_error.h"
#include "tests/cli/program_runner.h"

#include <gtest/gtest.h>

#include <string>

namespace rawtexel::cli {
namespace {

std::string complaint(const std::string& path) {
    try {
        check_image_format("-o", path);
    } catch (const UsageError& error) {
        return error.what();
    }
    return "";
}

TEST(ImageOutput, EveryFormatThatIsSuggestedCanBeWritten) {
    for (const std::string_view format : kCommonImageFormats) {
        EXPECT_TRUE(scenes::is_writable_format("image." + std::string(format))) << format;
        EXPECT_EQ(complaint("image." + std::string(format)), "");
    }
}

TEST(ImageOutput, EveryFormatThatTheHelpNamesCanBeWritten) {
    const std::string help = test::run({"render", "--help"}).out;
    for (const char* format : {".exr", ".hdr", ".tif", ".png", ".jpg"}) {
        EXPECT_NE(help.find(format), std::string::npos) << format;
        EXPECT_EQ(complaint(std::string("image") + format), "");
    }
    EXPECT_EQ(help.find(".pfm"), std::string::npos);
}

TEST(ImageOutput, OtherFormatsAreRefusedWithTheNearest) {
    EXPECT_EQ(complaint("a.pgn"), "-o: 'a.pgn' has the unknown extension '.pgn', the nearest image format is '.png'");
    EXPECT_EQ(complaint("a"), "-o: 'a' has no extension, the nearest image format is '.png'");
    // It can be read alone.
    EXPECT_NE(complaint("a.pfm"), "");
    EXPECT_EQ(complaint("a.pfm").find("format is '.pfm'"), std::string::npos);
}

}  // namespace
}  // namespace rawtexel::cli
