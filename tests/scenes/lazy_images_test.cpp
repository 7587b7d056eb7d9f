// Images that a scene names cost next to nothing until they are sampled.
#include "scenes/encoded_bytes.h"
#include "scenes/image_codec.h"

#include "tests/scenes/gltf_fixture.h"
#include "tests/scenes/png_parts.h"
#include "texunit/texture.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <random>
#include <unistd.h>

namespace rawtexel::scenes {
namespace {

std::vector<std::byte> noise(size_t count) {
    std::mt19937 random(3);
    std::vector<std::byte> bytes(count);
    for (std::byte& byte : bytes) byte = std::byte(random());
    return bytes;
}

std::vector<std::byte> noise_png(int extent) { return encode_png(extent, extent, 4, 8, noise(size_t(extent) * size_t(extent) * 4)); }

std::vector<std::byte> noise_jpeg(int extent) {
    const std::vector<std::byte> pixels = noise(size_t(extent) * size_t(extent) * 3);
    return encode_image("noise.jpg", {extent, extent, {"R", "G", "B"}, SampleType::Unorm8, pixels.data()}, {});
}

/// Counts the bytes that are asked for.
class CountedBytes final : public texunit::ByteSource {
  public:
    explicit CountedBytes(std::vector<std::byte> bytes) : bytes_(texunit::open_memory("image", std::move(bytes))) {}
    uint64_t size() const override { return bytes_->size(); }
    const std::string& name() const override { return bytes_->name(); }
    void read(uint64_t offset, std::span<std::byte> out) const override {
        asked += out.size();
        bytes_->read(offset, out);
    }
    mutable std::atomic<uint64_t> asked{0};

  private:
    std::shared_ptr<texunit::ByteSource> bytes_;
};

/// A chunk of so much text, as it stands in a PNG.
std::vector<std::byte> text_chunk(size_t bytes) {
    PngParts png;
    const size_t signature = png.bytes().size();
    png.chunk("tEXt", std::vector<uint8_t>(bytes, 'a'));
    return {png.bytes().begin() + ptrdiff_t(signature), png.bytes().end()};
}

uint64_t resident_bytes() {
    uint64_t whole = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> whole >> resident;
    return resident * uint64_t(sysconf(_SC_PAGESIZE));
}

ptrdiff_t open_descriptors() {
    return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), std::filesystem::directory_iterator());
}

/// A quad whose only material shows the first of the images `names`, files beside it.
std::string write_scene(const TemporaryFolder& folder, const std::vector<std::string>& names) {
    GltfFixture fixture = quad_fixture();
    for (const std::string& name : names) fixture.add("images", {{"uri", name}});
    for (size_t i = 0; i < names.size(); ++i) {
        fixture.add("textures", {{"source", i}});
        fixture.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", i}}}}}});
    }
    nlohmann::json primitive = quad_primitive(fixture);
    primitive["material"] = 0;
    fixture.show(primitive);
    return folder.write("scene.gltf", fixture.gltf());
}

/// The message of the TextureError that the first texel throws, "" when there is none.
std::string pixel_error(const shading::Scene& scene) {
    try {
        scene.textures.at(0).texture->texel(0, 0, 0, 0);
        return "";
    } catch (const texunit::TextureError& error) {
        return error.what();
    }
}

TEST(LazyImages, AreReadNoFurtherThanTheirHeadersUntilSampled) {
    for (const auto& encoded : {noise_png(256), noise_jpeg(512)}) {
        ASSERT_GT(encoded.size(), size_t{200000});
        const auto bytes = std::make_shared<CountedBytes>(encoded);
        texunit::Texture texture("image", open_image(bytes, true));
        EXPECT_LE(bytes->asked, 65536u);
        const uint64_t before = bytes->asked;
        texture.texel(0, 0, 7, 9);
        texture.texel(0, 0, 100, 200);
        EXPECT_EQ(bytes->asked - before, encoded.size()) << "read once, whole";
    }
}

TEST(LazyImages, HeadersBehindMuchMetadataAreFound) {
    std::vector<std::byte> png = noise_png(256);
    constexpr size_t kAfterHeaderChunk = 8 + 25;
    const std::vector<std::byte> text = text_chunk(3 << 20);
    png.insert(png.begin() + kAfterHeaderChunk, text.begin(), text.end());

    std::vector<std::byte> jpeg = noise_jpeg(512);
    std::vector<std::byte> segments;  // of application data, 65533 bytes each
    for (int i = 0; i < 20; ++i) {
        for (const int byte : {0xff, 0xed, 0xff, 0xff}) segments.push_back(std::byte(byte));
        segments.resize(segments.size() + 65533);
    }
    jpeg.insert(jpeg.begin() + 2, segments.begin(), segments.end());

    for (const auto& encoded : {png, jpeg}) {
        const auto bytes = std::make_shared<CountedBytes>(encoded);
        const auto source = open_image(bytes, false);
        EXPECT_EQ(source->shape().width, source->shape().height);
        EXPECT_GT(bytes->asked, 65536u);
        EXPECT_NO_THROW(texunit::Texture("image", open_image(bytes, false)).texel(0, 0, 0, 0));
    }
}

TEST(LazyImages, CostASceneNeitherMemoryNorTimeHoweverLarge) {
    const TemporaryFolder folder;
    std::vector<std::string> names;
    for (int i = 0; i < 8; ++i) {
        names.push_back("image" + std::to_string(i) + ".png");
        // Nothing that follows the last chunk is looked at, and zeros that nobody wrote take no space on disk.
        std::filesystem::resize_file(folder.write(names.back(), test_png()), uint64_t{2} << 30);
    }
    const std::string path = write_scene(folder, names);
    const uint64_t before = resident_bytes();
    const auto start = std::chrono::steady_clock::now();
    const shading::Scene scene = load_gltf(path);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(scene.textures.size(), names.size());
    const uint64_t after = resident_bytes();
    EXPECT_LT(after - std::min(after, before), uint64_t{64} << 20) << "for 16 GiB of images";
    EXPECT_LT(taken.count(), 2.0) << "seconds";
}

TEST(LazyImages, DoNotHoldTheirFilesOpen) {
    const TemporaryFolder folder;
    std::vector<std::string> names;
    for (int i = 0; i < 40; ++i) {
        names.push_back("image" + std::to_string(i) + ".png");
        folder.write(names.back(), test_png());
    }
    const std::string path = write_scene(folder, names);
    const ptrdiff_t before = open_descriptors();
    const shading::Scene scene = load_gltf(path);
    EXPECT_EQ(open_descriptors(), before);
    EXPECT_EQ(pixel_error(scene), "");
    EXPECT_EQ(open_descriptors(), before);
}

TEST(LazyImages, InsideABinaryFileKeepNoneOfIt) {
    const TemporaryFolder folder;
    GltfFixture fixture = quad_fixture();
    const std::vector<std::byte> png = noise_png(64);
    fixture.add_image(png, "image/png");
    fixture.add("textures", {{"source", 0}});
    fixture.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    const shading::Scene scene = load_gltf(folder.write("scene.glb", fixture.glb()));
    EXPECT_FALSE(scene.textures.at(0).encoded->in_memory());
    EXPECT_EQ(all_bytes(*scene.textures.at(0).encoded), png);
    EXPECT_EQ(pixel_error(scene), "");
}

TEST(LazyImages, ThatAreGoneOrHaveChangedWhenSampledAreErrors) {
    const TemporaryFolder folder;
    const auto replace = [&](const std::vector<std::byte>& bytes) { return folder.write("image.png", bytes); };
    const auto error_after = [&](const auto& change) {
        replace(test_png(4, 4));
        const shading::Scene scene = load_gltf(write_scene(folder, {"image.png"}));
        change();
        return pixel_error(scene);
    };
    const size_t size = test_png(4, 4).size();
    EXPECT_EQ(error_after([] {}), "");
    EXPECT_TRUE(says(error_after([&] { std::filesystem::remove(folder / "image.png"); }), "images[0] 'image.png': cannot be opened"));
    EXPECT_TRUE(says(error_after([&] { replace(test_png(64, 64)); }), "images[0] 'image.png': has changed since the scene was loaded"));
    // As long as before, but larger inside: its pixels would not fit where the header said.
    EXPECT_TRUE(says(error_after([&] {
                         const std::vector<std::byte> grey = encode_png(5, 4, 1, 8, noise(20));
                         ASSERT_LE(grey.size(), size);
                         std::filesystem::resize_file(replace(grey), size);
                     }),
                     "has changed since its header was read"));
}

}  // namespace
}  // namespace rawtexel::scenes
