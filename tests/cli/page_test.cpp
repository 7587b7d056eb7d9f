#include "cli/reports/page.h"
#include "cli/reports/page_files.h"
#include "scenes/image_io.h"
#include "tests/cli/program_runner.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <limits>

namespace rawtexel::cli {
namespace {

using test::run;
using test::TemporaryFolder;
using Json = nlohmann::ordered_json;

std::string base64_of(std::string_view text) { return base64(std::as_bytes(std::span(text))); }

TEST(Base64, IsThatOfRfc4648) {
    const std::pair<std::string, std::string> vectors[] = {
        {"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}, {"fooba", "Zm9vYmE="}, {"foobar", "Zm9vYmFy"}};
    for (const auto& [text, expected] : vectors) EXPECT_EQ(base64_of(text), expected) << text;
    EXPECT_EQ(base64_of("\xff\xfe\xfd"), "//79");
}

/// The data that a page carries.
Json data_of(const std::string& page) {
    const std::string begin = "<script type=\"application/json\" id=\"data\">";
    const size_t from = page.find(begin) + begin.size();
    return Json::parse(page.substr(from, page.find("</script>", from) - from));
}

TEST(ReportPage, IsOneFileThatCarriesItsDataWhole) {
    const Json data{{"command", "<!-- </script> {{style.css}} \" & ü"}, {"images", Json::array()}};
    const std::string page = report_page("compare.html", data);
    EXPECT_EQ(page.find("{{page.js}}"), std::string::npos);
    const Json read = data_of(page);
    EXPECT_EQ(read["command"], data["command"]);
    EXPECT_EQ(std::string(read["colour_map"]).substr(0, 6), "000004");
    EXPECT_EQ(std::string(read["colour_map"]).size(), 256u * 6);
    for (const std::string outside : {"src=\"http", "href=\"http", "@import", "url(http"})
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

// What cannot be embedded as a raw string would end it.
TEST(ReportPage, FilesAreThereWhole) {
    for (const PageFile& file : page_files()) {
        EXPECT_GT(file.text.size(), 100u) << file.name;
        EXPECT_EQ(file.text.back(), '\n') << file.name;
    }
}

TEST(ComparePage, HoldsFiguresPicturesAndMaps) {
    const TemporaryFolder folder;
    const std::vector<uint8_t> dark(6 * 4 * 3, 50), light(6 * 4 * 3, 200);
    scenes::write_8bit(folder / "dark.png", 6, 4, 3, dark, {});
    scenes::write_8bit(folder / "light.png", 6, 4, 3, light, {});
    const test::Outcome outcome = run({"compare", folder / "dark.png", folder / "light.png", "--html", folder / "page.html", "--json"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Json data = data_of(test::read_file(folder / "page.html")), json = Json::parse(outcome.out);
    EXPECT_EQ(data["images"], json["images"]);
    EXPECT_EQ(data["absolute_range"], json["images"][0]["max"]);
    ASSERT_EQ(data["pictures"].size(), 2u);
    EXPECT_EQ(data["pictures"][0]["name"], folder / "dark.png");
    EXPECT_EQ(data["pictures"][0]["picture"], picture_address(6, 4, 3, dark));
    EXPECT_TRUE(data["pictures"][0].contains("flip"));
    EXPECT_EQ(data["pictures"][1]["reference"], true);
    EXPECT_FALSE(data["pictures"][1].contains("absolute"));
    // Without FLIP there is no map of it; what is not a number does not spoil the range of the others.
    shading::Image broken(6, 4, 3);
    broken.values[3] = std::numeric_limits<float>::quiet_NaN();
    broken.values[9] = 0.25f;
    scenes::write_float(folder / "broken.exr", broken, {}, {});
    scenes::write_float(folder / "black.exr", shading::Image(6, 4, 3), {}, {});
    ASSERT_EQ(run({"compare", folder / "broken.exr", folder / "black.exr", "--html", folder / "page.html"}).code, 0);
    const Json other = data_of(test::read_file(folder / "page.html"));
    EXPECT_EQ(other["absolute_range"], 0.25);
    EXPECT_FALSE(other["pictures"][0].contains("flip"));
    EXPECT_TRUE(other["tone_mapped"]);
}

}  // namespace
}  // namespace rawtexel::cli
