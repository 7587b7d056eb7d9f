// Golden images of the gallery: at most 1/255 on 99.9 % of the pixels, none above 4/255.
// RAWTEXEL_UPDATE_GOLDEN=1 writes them anew instead; look at what changed before committing it.
#include "scenes/builtin.h"
#include "scenes/image_io.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace rawtexel;
namespace fs = std::filesystem;

/// Draws the scene into `folder`/SCENE.png. The program runs there, so that the image's metadata name no other place.
fs::path draw(const std::string& scene, const fs::path& folder) {
    const std::string file = scene + ".png";
    const std::string command = "cd '" + folder.string() + "' && '" RAWTEXEL_PROGRAM "' render " + scene +
                                " --size 192x108 --spp 4 --progress never -o " + file + " > /dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return folder / file;
}

/// A folder of this process alone.
class ScratchFolder {
  public:
    ScratchFolder() : path_(fs::temp_directory_path() / ("rawtexel-gallery-" + std::to_string(::getpid()))) {
        fs::create_directories(path_);
    }
    ~ScratchFolder() { fs::remove_all(path_); }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

class Gallery : public testing::TestWithParam<std::string> {};

TEST_P(Gallery, LooksAsItDid) {
    const std::string& scene = GetParam();
    const fs::path golden_folder = fs::path(RAWTEXEL_TEST_DATA) / "gallery", golden = golden_folder / (scene + ".png");
    if (std::getenv("RAWTEXEL_UPDATE_GOLDEN") != nullptr) {
        draw(scene, golden_folder);
        GTEST_SKIP() << "RAWTEXEL_UPDATE_GOLDEN is set: wrote " << golden;
    }

    const ScratchFolder scratch;
    const shading::Image test = scenes::read_image(draw(scene, scratch.path()).string(), false);
    const shading::Image reference = scenes::read_image(golden.string(), false);
    ASSERT_EQ(test.width, reference.width);
    ASSERT_EQ(test.height, reference.height);
    ASSERT_EQ(test.channels, reference.channels);
    int off = 0;
    float worst = 0.0f;
    for (int y = 0; y < test.height; ++y) {
        for (int x = 0; x < test.width; ++x) {
            float difference = 0.0f;
            for (int c = 0; c < test.channels; ++c)
                difference = std::max(difference, std::abs(test.pixel(x, y)[c] - reference.pixel(x, y)[c]) * 255.0f);
            off += difference > 1.5f;
            worst = std::max(worst, difference);
        }
    }
    std::printf("  %s: worst %.2f/255, %d of %d pixels beyond 1/255\n", scene.c_str(), worst, off, test.width * test.height);
    EXPECT_LE(worst, 4.5f) << "of 255";
    EXPECT_LE(off, test.width * test.height / 1000);
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
