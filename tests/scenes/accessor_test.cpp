// Accessors seen through the meshes they make: values, ranges, sparse elements.
#include "tests/scenes/gltf_fixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rawtexel::scenes {
namespace {

/// A triangle with the colour accessor under test; its vertices are used in order.
class AccessorTest : public testing::Test {
  protected:
    AccessorTest() { positions_ = fixture_.add_vec3({0, 0, 0, 1, 0, 0, 0, 1, 0}); }

    void show_with(const char* attribute, int accessor) {
        nlohmann::json attributes = {{"POSITION", positions_}};
        attributes[attribute] = accessor;
        fixture_.show({{"attributes", attributes}});
    }
    shading::Mesh mesh() { return load_fixture(folder_, fixture_).meshes.at(0); }
    std::string error() { return load_error(folder_, fixture_); }

    TemporaryFolder folder_;
    GltfFixture fixture_;
    int positions_ = 0;
};

TEST_F(AccessorTest, NormalizedIntegersBecomeFractions) {
    const std::vector<uint8_t> bytes = {0, 51, 255, 128, 1, 2, 3, 4, 5, 6, 7, 8};
    const std::vector<uint16_t> words = {0, 13107, 65535, 32768, 1, 2, 3, 4, 5, 6, 7, 8};
    show_with("COLOR_0", fixture_.add_values("VEC4", 4, bytes, true));
    const auto from_bytes = mesh();
    for (size_t i = 0; i < bytes.size(); ++i) EXPECT_EQ(from_bytes.colors[i / 4][int(i % 4)], float(bytes[i]) / 255.0f) << i;

    fixture_.json["accessors"].erase(1);
    fixture_.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = fixture_.add_values("VEC4", 4, words, true);
    const auto from_words = mesh();
    for (size_t i = 0; i < words.size(); ++i) EXPECT_EQ(from_words.colors[i / 4][int(i % 4)], float(words[i]) / 65535.0f) << i;
}

TEST_F(AccessorTest, SignedFractionsReachMinusOneTwice) {
    const std::vector<int8_t> bytes = {-128, -127, 0, 127, 64, -64};
    show_with("TEXCOORD_0", fixture_.add_values("VEC2", 2, bytes, true));
    const auto uv = mesh().uv[0];
    EXPECT_EQ(uv[0], glm::vec2(-1.0f, -1.0f));
    EXPECT_EQ(uv[1], glm::vec2(0.0f, 1.0f));
    EXPECT_EQ(uv[2], glm::vec2(64.0f / 127.0f, -64.0f / 127.0f));

    const std::vector<int16_t> words = {-32768, -32767, 0, 32767, 100, -100};
    fixture_.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = fixture_.add_values("VEC2", 2, words, true);
    EXPECT_EQ(mesh().uv[0][0], glm::vec2(-1.0f, -1.0f));
    EXPECT_EQ(mesh().uv[0][2], glm::vec2(100.0f / 32767.0f, -100.0f / 32767.0f));
}

TEST_F(AccessorTest, PlainIntegersAreTakenAsTheyAre) {
    const std::vector<int16_t> words = {-300, 2, 3, 4, 5, 600};
    show_with("TEXCOORD_0", fixture_.add_values("VEC2", 2, words));
    EXPECT_EQ(mesh().uv[0][0], glm::vec2(-300.0f, 2.0f));
    EXPECT_EQ(mesh().uv[0][2], glm::vec2(5.0f, 600.0f));
}

TEST_F(AccessorTest, InterleavedAndUnalignedElementsAreRead) {
    // Elements of 8 bytes at a stride of 12 from an odd offset.
    std::vector<std::byte> bytes(3 + 12 * 3);
    for (int i = 0; i < 3; ++i) {
        const float uv[2] = {float(i) + 0.25f, float(i) + 0.5f};
        std::memcpy(bytes.data() + 3 + 12 * i, uv, sizeof uv);
    }
    const int view = fixture_.add_view(bytes);
    fixture_.json["bufferViews"][view]["byteStride"] = 12;
    const int accessor = fixture_.add_accessor(view, 5126, "VEC2", 3);
    fixture_.json["accessors"][accessor]["byteOffset"] = 3;
    show_with("TEXCOORD_0", accessor);
    const auto uv = mesh().uv[0];
    for (int i = 0; i < 3; ++i) EXPECT_EQ(uv[size_t(i)], glm::vec2(float(i) + 0.25f, float(i) + 0.5f)) << i;
}

TEST_F(AccessorTest, TheLastElementMayEndWithTheViewButNotBeyond) {
    const int view = fixture_.add_view(bytes_of(std::vector<float>{1, 2, 3, 4, 5, 6}));
    show_with("TEXCOORD_0", fixture_.add_accessor(view, 5126, "VEC2", 3));
    EXPECT_EQ(error(), "");
    for (const size_t missing : {1, 4, 23}) {
        fixture_.json["bufferViews"][view]["byteLength"] = 24 - missing;
        EXPECT_TRUE(says(error(), "accessors[1] reaches beyond bufferViews[1]")) << missing;
    }
}

TEST_F(AccessorTest, HugeCountsOffsetsAndViewsAreRefusedWithoutOverflow) {
    const int view = fixture_.add_view(bytes_of(std::vector<float>(6)));
    const int accessor = fixture_.add_accessor(view, 5126, "VEC2", 3);
    show_with("TEXCOORD_0", accessor);
    for (const uint64_t count : {uint64_t{4}, uint64_t{1} << 32, (uint64_t{1} << 53) - 1, uint64_t{1} << 53}) {
        fixture_.json["accessors"][accessor]["count"] = count;
        EXPECT_NE(error(), "") << count;
    }
    fixture_.json["accessors"][accessor]["count"] = 3;
    fixture_.json["accessors"][accessor]["byteOffset"] = uint64_t{1} << 52;
    EXPECT_TRUE(says(error(), "reaches beyond"));
    fixture_.json["accessors"][accessor]["byteOffset"] = 0;
    fixture_.json["bufferViews"][view]["byteOffset"] = uint64_t{1} << 52;
    EXPECT_TRUE(says(error(), "bufferViews[1] ends at byte"));
}

TEST_F(AccessorTest, ManyElementsWithoutAViewAreRefusedWithoutAllocating) {
    const int accessor = fixture_.add("accessors", {{"componentType", 5126}, {"type", "VEC3"}, {"count", uint64_t{1} << 40}});
    fixture_.show({{"attributes", {{"POSITION", accessor}}}});
    EXPECT_TRUE(says(error(), "elements without a buffer view"));
}

TEST_F(AccessorTest, AFewElementsWithoutAViewAreZero) {
    show_with("TEXCOORD_0", fixture_.add("accessors", {{"componentType", 5126}, {"type", "VEC2"}, {"count", 3}}));
    EXPECT_EQ(mesh().uv[0], std::vector<glm::vec2>(3, glm::vec2(0.0f)));
}

TEST_F(AccessorTest, SparseElementsReplaceThoseOfTheBase) {
    for (const bool with_base : {true, false}) {
        GltfFixture fixture = fixture_;
        const int accessor = with_base ? fixture.add_vec2({1, 2, 3, 4, 5, 6})
                                       : fixture.add("accessors", {{"componentType", 5126}, {"type", "VEC2"}, {"count", 3}});
        const int indices = fixture.add_view(bytes_of(std::vector<uint8_t>{1, 2})),
                  values = fixture.add_view(bytes_of(std::vector<float>{7, 8, 9, 10}));
        fixture.json["accessors"][accessor]["sparse"] = {
            {"count", 2}, {"indices", {{"bufferView", indices}, {"componentType", 5121}}}, {"values", {{"bufferView", values}}}};
        fixture.show({{"attributes", {{"POSITION", positions_}, {"TEXCOORD_0", accessor}}}});
        const auto uv = load_fixture(folder_, fixture).meshes.at(0).uv[0];
        EXPECT_EQ(uv[0], with_base ? glm::vec2(1, 2) : glm::vec2(0, 0));
        EXPECT_EQ(uv[1], glm::vec2(7, 8));
        EXPECT_EQ(uv[2], glm::vec2(9, 10));
    }
}

TEST_F(AccessorTest, SparsePartsAreCheckedLikeTheRest) {
    const int accessor = fixture_.add_vec2({1, 2, 3, 4, 5, 6});
    const int indices = fixture_.add_view(bytes_of(std::vector<uint16_t>{1, 2})),
              values = fixture_.add_view(bytes_of(std::vector<float>{7, 8, 9, 10}));
    auto& sparse = fixture_.json["accessors"][accessor]["sparse"];
    sparse = {{"count", 2}, {"indices", {{"bufferView", indices}, {"componentType", 5123}}}, {"values", {{"bufferView", values}}}};
    show_with("TEXCOORD_0", accessor);
    EXPECT_EQ(error(), "");
    const auto good = sparse;
    sparse["count"] = 3;
    EXPECT_TRUE(says(error(), "sparse.indices reaches beyond"));
    sparse["count"] = 2147483647;
    EXPECT_TRUE(says(error(), "sparse.indices reaches beyond"));
    sparse = good;
    sparse["values"]["byteOffset"] = 4;
    EXPECT_TRUE(says(error(), "sparse.values reaches beyond"));
    sparse = good;
    sparse["indices"]["componentType"] = 5126;
    EXPECT_TRUE(says(error(), "sparse.indices.componentType is 5126"));
    sparse = good;
    sparse["indices"]["bufferView"] = fixture_.add_view(bytes_of(std::vector<uint16_t>{2, 2}));
    EXPECT_TRUE(says(error(), "they must increase"));
    sparse["indices"]["bufferView"] = fixture_.add_view(bytes_of(std::vector<uint16_t>{1, 3}));
    EXPECT_TRUE(says(error(), "allowed: 0 to 2"));
}

TEST_F(AccessorTest, WrongTypesAreNamed) {
    const std::vector<uint32_t> wide(6);
    show_with("TEXCOORD_0", fixture_.add_values("VEC2", 2, wide));
    EXPECT_TRUE(says(error(), "TEXCOORD_0 is VEC2 of unsigned 32-bit (allowed: float, 8-bit, 16-bit)"));
    auto& attributes = fixture_.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["TEXCOORD_0"] = fixture_.add_vec3(std::vector<float>(9));
    EXPECT_TRUE(says(error(), "TEXCOORD_0 is VEC3 of float (allowed: 2 components)"));
    attributes.erase("TEXCOORD_0");
    attributes["COLOR_0"] = fixture_.add_values("VEC4", 4, std::vector<uint8_t>(12));
    EXPECT_TRUE(says(error(), "COLOR_0 is VEC4 of unsigned 8-bit (allowed: float, normalized 8-bit, 16-bit)"));
    fixture_.json["accessors"].back()["componentType"] = 5124;
    EXPECT_TRUE(says(error(), "componentType is 5124"));
    fixture_.json["accessors"].back()["componentType"] = 5130;
    EXPECT_TRUE(says(error(), "componentType is 5130"));
}

TEST_F(AccessorTest, StrideBelowTheElementIsRefused) {
    const int accessor = fixture_.add_vec2({1, 2, 3, 4, 5, 6});
    fixture_.json["bufferViews"].back()["byteStride"] = 4;
    show_with("TEXCOORD_0", accessor);
    EXPECT_TRUE(says(error(), "elements of 8 bytes at a stride of 4"));
}

TEST_F(AccessorTest, NumbersThatAreNotFiniteAreRefusedWithTheirPlace) {
    for (const float bad : {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(), std::nanf("")}) {
        GltfFixture fixture = fixture_;
        const int accessor = fixture.add_vec2({1, 2, 3, bad, 5, 6});
        fixture.show({{"attributes", {{"POSITION", positions_}, {"TEXCOORD_0", accessor}}}});
        EXPECT_TRUE(says(load_error(folder_, fixture), "at element 1 (allowed: finite numbers)"));
    }
}

TEST_F(AccessorTest, AttributesOfDifferentLengthsAreRefused) {
    show_with("NORMAL", fixture_.add_vec3({0, 0, 1, 0, 0, 1}));
    EXPECT_TRUE(says(error(), "NORMAL has 2 elements (allowed: as many as POSITION, 3)"));
}

}  // namespace
}  // namespace rawtexel::scenes
