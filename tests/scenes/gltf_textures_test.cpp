// Images of every kind that a glTF may name.
#include "tests/scenes/gltf_fixture.h"

#include "texunit/srgb.h"
#include "texunit/texel_source.h"

#include <gtest/gtest.h>

#include <array>

namespace rawtexel::scenes {
namespace {

using texunit::Format;

void append_32(std::vector<std::byte>& bytes, uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(std::byte(value >> shift & 0xff));
}
void append_64(std::vector<std::byte>& bytes, uint64_t value) {
    append_32(bytes, uint32_t(value));
    append_32(bytes, uint32_t(value >> 32));
}

/// A BC1 block of one colour: both endpoints `rgb565`.
std::array<uint8_t, 8> bc1_block(uint16_t rgb565) {
    const auto low = uint8_t(rgb565 & 0xff), high = uint8_t(rgb565 / 256);
    return {low, high, low, high, 0, 0, 0, 0};
}

/// A KTX2 file of one 4 x 4 level (KTX 2.0, 3): header, index, level index, a data format descriptor, one BC1 block.
std::vector<std::byte> ktx2(uint32_t vk_format, uint32_t supercompression) {
    std::vector<std::byte> file = bytes_of("\xabKTX 20\xbb\r\n\x1a\n");
    for (const uint32_t field : {vk_format, 1u, 4u, 4u, 0u, 0u, 1u, 1u, supercompression}) append_32(file, field);
    constexpr uint32_t kDescriptorOffset = 80 + 24, kDescriptorBytes = 44;
    for (const uint32_t field : {kDescriptorOffset, kDescriptorBytes, 0u, 0u}) append_32(file, field);
    append_64(file, 0);  // no supercompression data
    append_64(file, 0);
    constexpr uint64_t kDataOffset = 152;
    for (const uint64_t field : {kDataOffset, uint64_t{8}, uint64_t{8}}) append_64(file, field);
    // Basic descriptor block: BC1A, BT.709, linear, one sample.
    for (const uint32_t word : {kDescriptorBytes, 0u, 40u << 16 | 2u, 0x00010180u, 0x00000303u, 8u, 0u, 0x003f0000u, 0u, 0u, 0xffffffffu})
        append_32(file, word);
    while (file.size() < kDataOffset) file.push_back(std::byte{0});
    for (const uint8_t b : bc1_block(0xf800)) file.push_back(std::byte(b));
    return file;
}
constexpr uint32_t kVkBc1RgbUnorm = 131, kVkUndefined = 0;

/// A DDS file of one 4 x 4 BC1 block.
std::vector<std::byte> dds(const std::array<uint8_t, 8>& block = bc1_block(0x07e0)) {
    std::vector<std::byte> file = bytes_of("DDS ");
    for (const uint32_t field : {124u, 0x81007u, 4u, 4u, 8u, 0u, 1u}) append_32(file, field);
    for (int i = 0; i < 11; ++i) append_32(file, 0);
    for (const uint32_t field : {32u, 4u, 0x31545844u, 0u, 0u, 0u, 0u, 0u}) append_32(file, field);  // "DXT1"
    for (const uint32_t field : {0x1000u, 0u, 0u, 0u, 0u}) append_32(file, field);
    for (const uint8_t b : block) file.push_back(std::byte(b));
    return file;
}

class GltfTexturesTest : public testing::Test {
  protected:
    GltfTexturesTest() {
        fixture_.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
        fixture_.add("textures", {{"source", 0}});
    }
    nlohmann::json& texture() { return fixture_.json["textures"][0]; }
    std::string error() { return load_error(folder_, fixture_); }
    shading::SceneTexture loaded() { return load_fixture(folder_, fixture_, &warnings_).textures.at(0); }

    TemporaryFolder folder_;
    GltfFixture fixture_ = quad_fixture();
    std::vector<std::string> warnings_;
};

TEST_F(GltfTexturesTest, PngTexelsArriveAsTheyWereWritten) {
    fixture_.add_image(test_png(5, 3), "image/png");
    const auto texture = loaded().texture;
    EXPECT_EQ(texture->shape().width, 5);
    EXPECT_EQ(texture->shape().height, 3);
    const auto alpha = texture->texel(0, 0, 4, 2)[3];
    EXPECT_FLOAT_EQ(alpha, 251.0f / 255.0f);
}

TEST_F(GltfTexturesTest, Ktx2WithBlocksIsReadThroughItsExtensionAsTheMapAsks) {
    fixture_.add_image(test_png(), "image/png");
    fixture_.add_image(ktx2(kVkBc1RgbUnorm, 0), "image/ktx2");
    texture()["extensions"]["KHR_texture_basisu"]["source"] = 1;
    const shading::SceneTexture result = loaded();
    EXPECT_EQ(result.texture->format(), Format::BC1RgbSrgb);
    EXPECT_EQ(result.mime_type, "image/ktx2");
    EXPECT_EQ(result.texture->texel(0, 0, 2, 2), (std::array<float, 4>{1, 0, 0, 1}));
}

TEST_F(GltfTexturesTest, BasisUniversalFallsBackToThePlainSourceOrIsRefused) {
    for (const auto& [format, supercompression] : {std::pair{kVkUndefined, 0u}, std::pair{kVkUndefined, 1u}}) {
        GltfFixture fixture = fixture_;
        fixture.add_image(test_png(), "image/png");
        fixture.add_image(ktx2(format, supercompression), "image/ktx2");
        fixture.json["textures"][0]["extensions"]["KHR_texture_basisu"]["source"] = 1;
        warnings_.clear();
        EXPECT_EQ(load_fixture(folder_, fixture, &warnings_).textures.at(0).texture->format(), Format::RGBA8Srgb);
        ASSERT_EQ(warnings_.size(), 1u);
        EXPECT_TRUE(says(warnings_[0], "Basis Universal textures are left out"));
        fixture.json["textures"][0].erase("source");
        EXPECT_TRUE(says(load_error(folder_, fixture), "textures[0] is Basis Universal compressed"));
    }
}

TEST_F(GltfTexturesTest, DdsIsReadThroughItsExtension) {
    fixture_.add_image(test_png(), "image/png");
    fixture_.add_image(dds(), "image/vnd-ms.dds");
    texture()["extensions"]["MSFT_texture_dds"]["source"] = 1;
    const shading::SceneTexture result = loaded();
    EXPECT_EQ(result.mime_type, "image/vnd-ms.dds");
    EXPECT_EQ(result.texture->texel(0, 0, 1, 1), (std::array<float, 4>{0, 1, 0, 1}));
}

TEST_F(GltfTexturesTest, BlocksAreRoundedAsTheOptionsAsk) {
    // Every texel is two thirds of 6, 12, 6 and one of 5, 11, 5: the grey 47, which NVIDIA shows as 46, 47, 46.
    fixture_.add_image(dds({0x86, 0x31, 0x65, 0x29, 0xaa, 0xaa, 0xaa, 0xaa}), "image/vnd-ms.dds");
    const std::string file = folder_.write("scene.glb", fixture_.glb());
    LoadOptions options;
    const auto red = [&](texunit::BcRounding rounding) {
        options.files.bc_rounding = rounding;
        return load_gltf(file, options).textures.at(0).texture->texel(0, 0, 0, 0)[0];
    };
    EXPECT_FLOAT_EQ(red(texunit::BcRounding::Exact), float(texunit::srgb_to_linear(17.0 / 93)));
    EXPECT_FLOAT_EQ(red(texunit::BcRounding::Nvidia), float(texunit::srgb_to_linear(46.0 / 255)));
}

TEST_F(GltfTexturesTest, MoreTexelsThanTheOptionsAllowAreRefused) {
    const auto refusal = [&](const std::vector<std::byte>& image, const char* mime_type, uint64_t most) -> std::string {
        GltfFixture fixture = fixture_;
        fixture.add_image(image, mime_type);
        LoadOptions options;
        options.files.max_texture_bytes = most;
        try {
            load_gltf(folder_.write("scene.glb", fixture.glb()), options);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(refusal(dds(), "image/vnd-ms.dds", 8), "");
    EXPECT_TRUE(says(refusal(dds(), "image/vnd-ms.dds", 7), "8 bytes of texels; at most 7 are allowed"));
    EXPECT_EQ(refusal(test_png(5, 3), "image/png", 60), "");
    EXPECT_TRUE(says(refusal(test_png(5, 3), "image/png", 59), "60 bytes of texels (at most 59 are allowed)"));
}

TEST_F(GltfTexturesTest, ATextureWithoutAnImageIsWhiteAndTold) {
    fixture_.add_image(test_png(), "image/png");
    texture().erase("source");
    const shading::Scene scene = load_fixture(folder_, fixture_, &warnings_);
    EXPECT_EQ(scene.materials.at(0).maps[shading::kBaseColor].texture, -1);
    EXPECT_TRUE(scene.textures.empty());
    ASSERT_EQ(warnings_.size(), 1u);
    EXPECT_TRUE(says(warnings_[0], "textures[0] has no image, it is white"));
}

TEST_F(GltfTexturesTest, ImagesAreWhatTheyAreDeclaredToBe) {
    const std::vector<std::byte> png = test_png(), jpeg = bytes_of("\xff\xd8\xff\xe0 and so on");
    fixture_.add_image(png, "image/jpeg");
    EXPECT_TRUE(says(error(), "image 0: is PNG (declared: image/jpeg)"));
    fixture_.json["images"][0] = {{"uri", "data:image/png;base64," + base64(jpeg)}};
    EXPECT_TRUE(says(error(), "image 0: is JPEG (declared: image/png)"));
    fixture_.json["images"][0] = {{"uri", "data:image/ktx2;base64," + base64(dds())}};
    EXPECT_TRUE(says(error(), "image 0: is DDS (declared: image/ktx2)"));
    folder_.write("lie.PNG", jpeg);
    fixture_.json["images"][0] = {{"uri", "lie.PNG"}};
    EXPECT_TRUE(says(error(), "lie.PNG: is JPEG (declared: .png, which is PNG)"));
    folder_.write("lie.jpg", png);
    fixture_.json["images"][0] = {{"uri", "lie.jpg"}, {"name", "bricks"}};
    EXPECT_TRUE(says(error(), "bricks: is PNG (declared: .jpg, which is JPEG)"));
    // A declared type comes before the name, and what names no format claims nothing.
    fixture_.json["images"][0] = {{"uri", "lie.jpg"}, {"mimeType", "image/png"}};
    EXPECT_EQ(error(), "");
    folder_.write("picture.dat", png);
    for (const nlohmann::json& honest :
         {nlohmann::json{{"uri", "picture.dat"}}, nlohmann::json{{"uri", "lie.jpg"}, {"mimeType", "application/x"}}}) {
        fixture_.json["images"][0] = honest;
        EXPECT_EQ(error(), "") << honest;
    }
}

TEST_F(GltfTexturesTest, EveryImageIsOpenedUsedOrNot) {
    fixture_.add_image(test_png(), "image/png");
    fixture_.add_image(bytes_of("this is no image"), "image/png");
    EXPECT_TRUE(says(error(), "image 1: not an image of a known format"));
    fixture_.json["images"][1] = {{"uri", "missing.png"}};
    EXPECT_TRUE(says(file_error(folder_.write("scene.glb", fixture_.glb())), "missing.png"));
}

TEST_F(GltfTexturesTest, ContainersThatAreCutOffAreRefused) {
    std::vector<std::byte> file = ktx2(kVkBc1RgbUnorm, 0);
    file.resize(60);
    fixture_.add_image(file, "image/ktx2");
    EXPECT_NE(error(), "");
}

TEST_F(GltfTexturesTest, CutOffPixelsAreFoundWhenTheyAreSampled) {
    std::vector<std::byte> png = test_png(64, 64);
    png.resize(png.size() - 40);
    fixture_.add_image(png, "image/png");
    const auto texture = loaded().texture;
    EXPECT_THROW(texture->texel(0, 0, 0, 0), texunit::TextureError);
    EXPECT_THROW(texture->texel(0, 0, 40, 40), texunit::TextureError);
}

TEST_F(GltfTexturesTest, NamesComeFromTheImageElseItsFileElseItsNumber) {
    fixture_.add_image(test_png(), "image/png");
    EXPECT_EQ(loaded().image_name, "image 0");
    fixture_.json["images"][0]["name"] = "bricks";
    EXPECT_EQ(loaded().image_name, "bricks");
    folder_.write("some folder/wall 1.png", test_png());
    fixture_.json["images"][0] = {{"uri", "some%20folder/wall%201.png"}};
    EXPECT_EQ(loaded().image_name, "wall 1.png");
}

}  // namespace
}  // namespace rawtexel::scenes
