// Materials, their maps and samplers, and which textures they share.
#include "scenes/encoded_bytes.h"
#include "tests/scenes/gltf_fixture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rawtexel::scenes {
namespace {

using shading::Material;
using texunit::Kernel;
using texunit::MipMode;
using texunit::Wrap;

class GltfMaterialsTest : public testing::Test {
  protected:
    /// Texture `n` has its own image.
    int add_texture() { return fixture_.add("textures", {{"source", fixture_.add_image(test_png(), "image/png")}}); }
    shading::Scene scene() { return load_fixture(folder_, fixture_, &warnings_); }
    std::string error() { return load_error(folder_, fixture_); }
    nlohmann::json& material(size_t i = 0) { return fixture_.json["materials"][i]; }

    TemporaryFolder folder_;
    GltfFixture fixture_ = quad_fixture();
    std::vector<std::string> warnings_;
};

TEST_F(GltfMaterialsTest, SilenceMeansTheDefaultsOfTheSpecification) {
    fixture_.add("materials", nlohmann::json::object());
    const Material m = scene().materials.at(0);
    EXPECT_EQ(m.base_color, glm::vec4(1.0f));
    EXPECT_EQ(m.metallic, 1.0f);
    EXPECT_EQ(m.roughness, 1.0f);
    EXPECT_EQ(m.emission, glm::vec3(0.0f));
    EXPECT_EQ(m.alpha_mode, shading::AlphaMode::Opaque);
    EXPECT_EQ(m.alpha_cutoff, 0.5f);
    EXPECT_FALSE(m.double_sided);
    EXPECT_FALSE(m.unlit);
    EXPECT_EQ(m.normal_scale, 1.0f);
    EXPECT_EQ(m.occlusion_strength, 1.0f);
    for (const shading::TextureMap& map : m.maps) EXPECT_EQ(map.texture, -1);
}

TEST_F(GltfMaterialsTest, APrimitiveWithoutMaterialGetsTheDefaultOne) {
    fixture_.add("materials", {{"name", "unused"}});
    const shading::Scene loaded = scene();
    ASSERT_EQ(loaded.materials.size(), 2u);
    EXPECT_EQ(loaded.meshes.at(0).material, 1u);
    EXPECT_EQ(loaded.materials[1].name, "default");
}

TEST_F(GltfMaterialsTest, EveryFactorAndMapIsRead) {
    for (int i = 0; i < 5; ++i) add_texture();
    fixture_.add("materials",
                 {{"name", "all"},
                  {"pbrMetallicRoughness",
                   {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
                    {"metallicFactor", 0.5},
                    {"roughnessFactor", 0.25},
                    {"baseColorTexture", {{"index", 0}}},
                    {"metallicRoughnessTexture", {{"index", 1}, {"texCoord", 1}}}}},
                  {"normalTexture", {{"index", 2}, {"scale", -0.75}}},
                  {"occlusionTexture", {{"index", 3}, {"strength", 0.5}}},
                  {"emissiveTexture", {{"index", 4}}},
                  {"emissiveFactor", {1, 0.5, 0}},
                  {"alphaMode", "MASK"},
                  {"alphaCutoff", 0.125},
                  {"doubleSided", true},
                  {"extensions",
                   {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}}, {"KHR_materials_unlit", nlohmann::json::object()}}}});
    const shading::Scene loaded = scene();
    const Material& m = loaded.materials.at(0);
    EXPECT_EQ(m.name, "all");
    EXPECT_EQ(m.base_color, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(m.metallic, 0.5f);
    EXPECT_EQ(m.roughness, 0.25f);
    EXPECT_EQ(m.normal_scale, -0.75f);
    EXPECT_EQ(m.occlusion_strength, 0.5f);
    EXPECT_EQ(m.emission, glm::vec3(8, 4, 0));
    EXPECT_EQ(m.alpha_mode, shading::AlphaMode::Mask);
    EXPECT_EQ(m.alpha_cutoff, 0.125f);
    EXPECT_TRUE(m.double_sided);
    EXPECT_TRUE(m.unlit);
    for (const auto slot : {shading::kBaseColor, shading::kMetallicRoughness, shading::kNormal, shading::kOcclusion, shading::kEmissive}) {
        const int texture = m.maps[slot].texture;
        ASSERT_GE(texture, 0) << slot;
        const bool colour = slot == shading::kBaseColor || slot == shading::kEmissive;
        EXPECT_EQ(loaded.textures[size_t(texture)].srgb, colour) << slot;
        EXPECT_EQ(loaded.textures[size_t(texture)].texture->format(), colour ? texunit::Format::RGBA8Srgb : texunit::Format::RGBA8Unorm)
            << slot;
        EXPECT_EQ(m.maps[slot].uv_set, slot == shading::kMetallicRoughness ? 1 : 0) << slot;
    }
}

TEST_F(GltfMaterialsTest, AnImageIsSharedPerUseAsColourOrData) {
    add_texture();
    fixture_.add("textures", {{"source", 0}});
    fixture_.add("materials",
                 {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 0}}}}},
                  {"occlusionTexture", {{"index", 1}}},
                  {"emissiveTexture", {{"index", 1}}}});
    const shading::Scene loaded = scene();
    const auto& maps = loaded.materials.at(0).maps;
    ASSERT_EQ(loaded.textures.size(), 2u);
    EXPECT_EQ(maps[shading::kBaseColor].texture, maps[shading::kEmissive].texture);
    EXPECT_EQ(maps[shading::kMetallicRoughness].texture, maps[shading::kOcclusion].texture);
    EXPECT_NE(maps[shading::kBaseColor].texture, maps[shading::kOcclusion].texture);
    EXPECT_EQ(loaded.textures[0].encoded, loaded.textures[1].encoded);
    EXPECT_EQ(all_bytes(*loaded.textures[0].encoded), test_png());
    EXPECT_EQ(loaded.textures[0].mime_type, "image/png");
}

TEST_F(GltfMaterialsTest, TextureTransformsScaleThenRotateThenMove) {
    add_texture();
    const double angle = 0.3;
    fixture_.add("materials",
                 {{"normalTexture",
                   {{"index", 0},
                    {"texCoord", 0},
                    {"extensions",
                     {{"KHR_texture_transform", {{"offset", {0.5, -2}}, {"rotation", angle}, {"scale", {2, 3}}, {"texCoord", 1}}}}}}}});
    const shading::TextureMap map = scene().materials.at(0).maps[shading::kNormal];
    EXPECT_EQ(map.uv_set, 1);
    for (const glm::vec2 uv : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1), glm::vec2(0.25f, 0.75f)}) {
        // Counter-clockwise on the screen, where v runs down.
        const glm::dvec2 scaled = glm::dvec2(uv) * glm::dvec2(2, 3);
        const glm::dvec2 expected(std::cos(angle) * scaled.x + std::sin(angle) * scaled.y + 0.5,
                                  -std::sin(angle) * scaled.x + std::cos(angle) * scaled.y - 2.0);
        const glm::vec2 found = map.uv_from_vertex * glm::vec3(uv, 1.0f);
        EXPECT_NEAR(found.x, expected.x, 1e-6) << uv.x << " " << uv.y;
        EXPECT_NEAR(found.y, expected.y, 1e-6) << uv.x << " " << uv.y;
    }
}

TEST_F(GltfMaterialsTest, TheSpecificationsExampleShowsTheLowerLeftQuarter) {
    add_texture();
    fixture_.add(
        "materials",
        {{"normalTexture",
          {{"index", 0},
           {"extensions", {{"KHR_texture_transform", {{"offset", {0, 1}}, {"rotation", 1.57079632679}, {"scale", {0.5, 0.5}}}}}}}}});
    const glm::mat3x2 uv_from_vertex = scene().materials.at(0).maps[shading::kNormal].uv_from_vertex;
    for (const glm::vec2 uv : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1), glm::vec2(1, 1)}) {
        const glm::vec2 found = uv_from_vertex * glm::vec3(uv, 1.0f);
        EXPECT_TRUE(found.x > -1e-5f && found.x < 0.50001f && found.y > 0.49999f && found.y < 1.00001f) << found.x << " " << found.y;
    }
}

TEST_F(GltfMaterialsTest, MapsOnFurtherCoordinateSetsFallBackAndAreSaidOnce) {
    add_texture();
    fixture_.add("materials", {{"normalTexture", {{"index", 0}, {"texCoord", 2}}}, {"occlusionTexture", {{"index", 0}, {"texCoord", 5}}}});
    EXPECT_EQ(scene().materials.at(0).maps[shading::kNormal].uv_set, 0);
    ASSERT_EQ(warnings_.size(), 1u);
    EXPECT_TRUE(says(warnings_[0], "beyond the second set use the first"));
}

TEST_F(GltfMaterialsTest, SamplersSayWrapAndFilters) {
    struct Case {
        nlohmann::json sampler;
        texunit::SamplerState expected;
    };
    const std::vector<Case> cases = {
        {nlohmann::json::object(), {}},
        {{{"wrapS", 33071}, {"wrapT", 33648}}, {.wrap_s = Wrap::ClampToEdge, .wrap_t = Wrap::MirroredRepeat}},
        {{{"wrapS", 10497}, {"magFilter", 9728}}, {.magnify = Kernel::Nearest}},
        {{{"magFilter", 9729}, {"minFilter", 9728}}, {.minify = Kernel::Nearest, .mip = MipMode::None}},
        {{{"minFilter", 9729}}, {.mip = MipMode::None}},
        {{{"minFilter", 9984}}, {.minify = Kernel::Nearest, .mip = MipMode::Nearest}},
        {{{"minFilter", 9985}}, {.mip = MipMode::Nearest}},
        {{{"minFilter", 9986}}, {.minify = Kernel::Nearest, .mip = MipMode::Linear}},
        {{{"minFilter", 9987}}, {.mip = MipMode::Linear}},
    };
    add_texture();
    fixture_.add("materials", {{"normalTexture", {{"index", 0}}}});
    EXPECT_EQ(scene().materials.at(0).maps[shading::kNormal].sampler, texunit::SamplerState{});
    fixture_.json["textures"][0]["sampler"] = 0;
    for (const Case& c : cases) {
        fixture_.json["samplers"] = nlohmann::json::array({c.sampler});
        EXPECT_EQ(scene().materials.at(0).maps[shading::kNormal].sampler, c.expected) << c.sampler;
    }
    fixture_.json["samplers"] = {{{"wrapS", 12345}}};
    EXPECT_TRUE(says(error(), "samplers[0].wrapS is 12345 (allowed: 33071 CLAMP_TO_EDGE, 33648 MIRRORED_REPEAT, 10497 REPEAT)"));
    fixture_.json["samplers"] = {{{"magFilter", 9987}}};
    EXPECT_TRUE(says(error(), "samplers[0].magFilter is 9987"));
}

TEST_F(GltfMaterialsTest, IndicesOutsideTheirArraysAreRefused) {
    add_texture();
    fixture_.add("materials", {{"normalTexture", {{"index", 1}}}});
    EXPECT_TRUE(says(error(), "materials[0].normalTexture.index is 1 (allowed: an index of textures, 0 to 0)"));
    material()["normalTexture"]["index"] = -1;
    EXPECT_TRUE(says(error(), "normalTexture.index is -1"));
    material()["normalTexture"]["index"] = 0.5;
    EXPECT_TRUE(says(error(), "normalTexture.index is 0.5"));
    material()["normalTexture"]["index"] = 0.0;  // the same number as 0
    EXPECT_EQ(error(), "");
    fixture_.json["textures"][0]["source"] = 3;
    EXPECT_TRUE(says(error(), "textures[0].source is 3"));
    fixture_.json["textures"][0]["source"] = 0;
    fixture_.json["textures"][0]["sampler"] = 0;
    EXPECT_TRUE(says(error(), "there are no samplers"));
    fixture_.json["textures"][0].erase("sampler");
    fixture_.json["meshes"][0]["primitives"][0]["material"] = 7;
    EXPECT_TRUE(says(error(), "primitives[0].material is 7"));
}

TEST_F(GltfMaterialsTest, ValuesOutsideTheirRangesAreRefused) {
    fixture_.add("materials", {{"alphaMode", "GLASS"}});
    EXPECT_TRUE(says(error(), "materials[0].alphaMode is \"GLASS\" (allowed: OPAQUE, MASK, BLEND)"));
    material() = {{"pbrMetallicRoughness", {{"roughnessFactor", 1.5}}}};
    EXPECT_TRUE(says(error(), "roughnessFactor is 1.5 (allowed: a number from 0 to 1)"));
    material() = {{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1}}}}};
    EXPECT_TRUE(says(error(), "baseColorFactor is an array of 3 (allowed: an array of 4)"));
    material() = {{"emissiveFactor", {1, -1, 1}}};
    EXPECT_TRUE(says(error(), "emissiveFactor[1] is -1"));
    material() = {{"alphaCutoff", 1e39}};
    EXPECT_TRUE(says(error(), "alphaCutoff is 1e+39"));
    material() = {{"doubleSided", 1}};
    EXPECT_TRUE(says(error(), "doubleSided is 1 (allowed: true or false)"));
    material() = {{"name", 5}};
    EXPECT_TRUE(says(error(), "materials[0].name is 5 (allowed: a string)"));
}

TEST_F(GltfMaterialsTest, ExtrasOfTheProgramMakeMaterialsTriplanarAndLayered) {
    add_texture();
    fixture_.add("materials", {{"extras", {{"rawtexel", {{"triplanar", {{"scale", 0.25}, {"sharpness", 7}}}}}}}});
    fixture_.add("materials", {{"extras", {{"rawtexel", {{"triplanar", {{"scale", 1}}}}}, {"other", 1}}}});
    const nlohmann::json mask = {{"index", 0}, {"texCoord", 1}, {"extensions", {{"KHR_texture_transform", {{"scale", {2, 3}}}}}}};
    fixture_.add("materials", {{"extras", {{"rawtexel", {{"layers", {{"materials", {1, 0, 1}}, {"mask", mask}}}}}}}});
    fixture_.add("materials", {{"extras", {{"rawtexel", {{"layers", {{"materials", {0, 1}}}}}}}}});
    fixture_.add("materials", {{"extras", "anything"}});
    const std::vector<Material> materials = scene().materials;
    ASSERT_TRUE(materials.at(0).triplanar && materials.at(1).triplanar);
    EXPECT_EQ(materials[0].triplanar->scale, 0.25f);
    EXPECT_EQ(materials[0].triplanar->sharpness, 7);
    EXPECT_EQ(materials[1].triplanar->scale, 1.0f);
    EXPECT_EQ(materials[1].triplanar->sharpness, 4);
    ASSERT_TRUE(materials[2].layers && materials[3].layers);
    EXPECT_EQ(materials[2].layers->materials, (std::vector<uint32_t>{1, 0, 1}));
    EXPECT_GE(materials[2].layers->mask.texture, 0);
    EXPECT_EQ(materials[2].layers->mask.uv_set, 1);
    EXPECT_EQ(materials[2].layers->mask.uv_from_vertex, (glm::mat3x2{2, 0, 0, 3, 0, 0}));
    EXPECT_EQ(materials[3].layers->mask.texture, -1);
    EXPECT_FALSE(materials[4].layers || materials[4].triplanar);
}

TEST_F(GltfMaterialsTest, ExtrasThatMakeNoSenseAreErrors) {
    using nlohmann::json;
    for (int i = 0; i < 4; ++i) fixture_.add("materials", json::object());
    material(2)["alphaMode"] = "BLEND";
    material(3)["extensions"]["KHR_materials_unlit"] = json::object();
    const auto error_of = [&](const json& own) {
        material()["extras"]["rawtexel"] = own;
        return error();
    };
    const auto layered = [&](const json& materials) { return error_of({{"layers", {{"materials", materials}}}}); };
    const std::string place = "materials[0].extras.rawtexel.";
    EXPECT_TRUE(says(error_of({{"triplanar", {{"scale", 0}}}}), place + "triplanar.scale is 0 (allowed: a number above 0, at most 1e6)"));
    EXPECT_TRUE(says(error_of({{"triplanar", {{"scale", 1e30}}}}), place + "triplanar.scale is 1e+30"));
    EXPECT_TRUE(says(error_of({{"triplanar", {{"scale", 1}, {"sharpness", 65}}}}), place + "triplanar.sharpness is 65"));
    EXPECT_TRUE(says(error_of({{"triplanar", {{"scale", 1}, {"sharpness", 2.5}}}}), place + "triplanar.sharpness is 2.5"));
    EXPECT_TRUE(says(error_of({{"triplanar", json::object()}}), "triplanar has no \"scale\" (it is required)"));
    EXPECT_TRUE(says(error_of({{"triplanar", 3}}), place + "triplanar is 3 (allowed: an object)"));
    EXPECT_TRUE(says(error_of("loud"), "materials[0].extras.rawtexel is \"loud\" (allowed: an object)"));
    EXPECT_TRUE(says(error_of({{"layers", json::object()}}), "layers has no \"materials\" (it is required)"));
    EXPECT_TRUE(says(layered({1}), place + "layers.materials is an array of 1 (allowed: 2 to 4)"));
    EXPECT_TRUE(says(layered({1, 1, 1, 1, 1}), "is an array of 5 (allowed: 2 to 4)"));
    EXPECT_TRUE(says(layered({1, 9}), place + "layers.materials[1] is 9 (allowed: an index of materials, 0 to 3)"));
    EXPECT_TRUE(says(layered({1, 0}), place + "layers.materials[1] is 0, a material with layers of its own"));
    EXPECT_TRUE(says(layered({1, 2}), place + "layers.materials[1] is 2, a material that is not OPAQUE"));
    EXPECT_TRUE(says(layered({1, 3}), place + "layers.materials[1] is 3, a material that is unlit (allowed: all are, or none)"));
    EXPECT_TRUE(says(error_of({{"layers", {{"materials", {1, 1}}, {"mask", {{"index", 5}}}}}}), "layers.mask.index is 5"));
    EXPECT_TRUE(says(error_of({{"layers", {{"materials", {1, 1}}}}, {"triplanar", {{"scale", 1}}}}), "has triplanar and layers"));
    material()["alphaMode"] = "MASK";
    EXPECT_TRUE(says(error_of({{"triplanar", {{"scale", 1}}}}), "materials[0].alphaMode is not OPAQUE"));
}

}  // namespace
}  // namespace rawtexel::scenes
