// Golden images of the gallery: at most 1/255 on 99.9 % of the values, none above 4/255.
// RAWTEXEL_UPDATE_GOLDEN=1 writes them anew instead; look at what changed before committing it.
#include "scenes/builtin.h"
#include "scenes/image_io.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace rawtexel;

class Gallery : public testing::TestWithParam<std::string> {};

TEST_P(Gallery, looks_as_it_did) {
    const std::string scene = GetParam();
    const std::string golden = std::string(RAWTEXEL_TEST_DATA) + "/gallery/" + scene + ".png";
    const bool update = std::getenv("RAWTEXEL_UPDATE_GOLDEN") != nullptr;
    const std::string drawn = update ? golden : (std::filesystem::temp_directory_path() / ("rawtexel-golden-" + scene + ".png")).string();
    if (update) std::filesystem::create_directories(std::filesystem::path(golden).parent_path());
    const std::string command = std::string(RAWTEXEL_PROGRAM) + " render " + scene + " --size 192x108 --spp 4 --progress never -o " + drawn + " > /dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
    if (update) GTEST_SKIP() << "RAWTEXEL_UPDATE_GOLDEN is set: wrote " << golden;

    const shading::Image test = scenes::read_image(drawn, false), reference = scenes::read_image(golden, false);
    std::filesystem::remove(drawn);
    ASSERT_EQ(test.width, reference.width);
    ASSERT_EQ(test.height, reference.height);
    ASSERT_EQ(test.channels, reference.channels);
    size_t off = 0;
    float worst = 0.0f;
    for (size_t i = 0; i < test.values.size(); ++i) {
        const float difference = std::abs(test.values[i] - reference.values[i]) * 255.0f;
        off += difference > 1.5f;
        worst = std::max(worst, difference);
    }
    EXPECT_LE(worst, 4.5f) << "of 255, " << scene;
    EXPECT_LE(off, test.values.size() / 1000) << "values off by more than 1/255 of " << test.values.size() << ", " << scene;
}

std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    for (const scenes::BuiltinScene& scene : scenes::builtin_scenes()) names.emplace_back(scene.name);
    return names;
}

std::string test_name(const testing::TestParamInfo<std::string>& scene) {
    std::string name = scene.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Builtin, Gallery, testing::ValuesIn(scene_names()), test_name);

}  // namespace
