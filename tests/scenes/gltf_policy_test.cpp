// Policies of materials and textures in extras.rawtexel, read and written.
#include "scenes/gltf_policy.h"

#include "scenes/export.h"
#include "tests/scenes/gltf_fixture.h"

#include <gtest/gtest.h>

namespace rawtexel::scenes {
namespace {

using nlohmann::json;
using shading::FilterOrder;
using shading::LookupPolicy;
using texunit::Estimator;

json policy_extras(const json& policy) { return {{"rawtexel", {{"policy", policy}}}}; }

class GltfPolicyTest : public testing::Test {
  protected:
    /// A material whose base colour is a texture of image `image`.
    void add_material(int image, const json& texture_extras, const json& material_extras) {
        json texture = {{"source", image}};
        if (!texture_extras.is_null()) texture["extras"] = texture_extras;
        const json map = {{"index", fixture_.add("textures", texture)}};
        json material = {{"pbrMetallicRoughness", {{"baseColorTexture", map}}}};
        if (!material_extras.is_null()) material["extras"] = material_extras;
        fixture_.add("materials", material);
    }
    shading::Scene scene() { return load_fixture(folder_, fixture_); }
    std::string error() { return load_error(folder_, fixture_); }

    TemporaryFolder folder_;
    GltfFixture fixture_ = quad_fixture();
};

TEST_F(GltfPolicyTest, OfMaterialsAndTexturesAreRead) {
    const int image = fixture_.add_image(test_png(), "image/png");
    add_material(image, policy_extras({{"order", "before"}, {"mip", "none"}}),
                 policy_extras({{"estimator", "reservoir"}, {"filter", "mitchell:0.2,0.4"}}));
    add_material(image, nullptr, {{"rawtexel", {{"other", 1}}}});
    const shading::Scene loaded = scene();
    const LookupPolicy &of_material = loaded.materials.at(0).policy, &of_texture = loaded.textures.at(0).policy;
    EXPECT_EQ(of_material.estimator, Estimator::Reservoir);
    EXPECT_EQ(of_material.filter, texunit::Kernel::mitchell(0.2f, 0.4f));
    EXPECT_FALSE(of_material.order || of_material.mip);
    EXPECT_EQ(of_texture.order, FilterOrder::Before);
    EXPECT_EQ(of_texture.mip, texunit::MipMode::None);
    EXPECT_FALSE(of_texture.estimator || of_texture.filter);
    EXPECT_EQ(loaded.materials.at(1).policy, LookupPolicy());
}

TEST_F(GltfPolicyTest, TexturesOfOneImageKeepTheirOwnAndShareTheTexels) {
    const int image = fixture_.add_image(test_png(), "image/png");
    add_material(image, policy_extras({{"order", "before"}}), nullptr);
    add_material(image, nullptr, nullptr);
    add_material(image, policy_extras({{"order", "before"}}), nullptr);
    const shading::Scene loaded = scene();
    ASSERT_EQ(loaded.textures.size(), 2u);
    const auto texture_of = [&](size_t material) { return loaded.materials[material].maps[shading::kBaseColor].texture; };
    EXPECT_EQ(texture_of(0), texture_of(2));
    ASSERT_NE(texture_of(0), texture_of(1));
    EXPECT_EQ(loaded.textures[size_t(texture_of(0))].policy.order, FilterOrder::Before);
    EXPECT_EQ(loaded.textures[size_t(texture_of(1))].policy, LookupPolicy());
    EXPECT_EQ(loaded.textures[0].texture, loaded.textures[1].texture);
}

TEST_F(GltfPolicyTest, ThatMakeNoSenseAreErrors) {
    add_material(fixture_.add_image(test_png(), "image/png"), nullptr, nullptr);
    const auto error_of = [&](const char* array, const json& policy) {
        fixture_.json[array][0]["extras"] = policy_extras(policy);
        const std::string found = error();
        fixture_.json[array][0].erase("extras");
        return found;
    };
    for (const char* array : {"materials", "textures"}) {
        const std::string place = std::string(array) + "[0].extras.rawtexel.policy";
        EXPECT_TRUE(says(error_of(array, {{"order", "during"}}), place + ".order is \"during\""));
        EXPECT_TRUE(says(error_of(array, {{"filter", "mitchell:x"}}), place + ".filter is \"mitchell:x\""));
        EXPECT_TRUE(says(error_of(array, {{"mip", 3}}), place + ".mip is 3 (allowed: a string)"));
        EXPECT_TRUE(says(error_of(array, {{"ordre", "after"}}), place + ".ordre is unknown (allowed: order, estimator, filter, mip)"));
        EXPECT_TRUE(says(error_of(array, "before"), place + " is \"before\" (allowed: an object)"));
    }
}

TEST_F(GltfPolicyTest, AreExported) {
    const int image = fixture_.add_image(test_png(), "image/png");
    add_material(image, policy_extras({{"order", "after"}, {"estimator", "jitter"}}), policy_extras({{"filter", "gaussian:0.7"}}));
    add_material(image, policy_extras({{"mip", "nearest"}}), nullptr);
    const shading::Scene written = scene();
    export_glb(written, folder_ / "again.glb");
    const shading::Scene read = load_gltf(folder_ / "again.glb", {});
    for (size_t i = 0; i < 2; ++i) {
        const auto texture_policy = [&](const shading::Scene& from) {
            return from.textures[size_t(from.materials[i].maps[shading::kBaseColor].texture)].policy;
        };
        EXPECT_EQ(written.materials.at(i).policy, read.materials.at(i).policy) << i;
        EXPECT_EQ(texture_policy(written), texture_policy(read)) << i;
    }
    EXPECT_NE(written.materials[0].policy, LookupPolicy());
}

}  // namespace
}  // namespace rawtexel::scenes
