// Policies of single materials and textures, from a file to the image.
#include "cli/policy_file.h"

#include "cli/command.h"
#include "scenes/builtin.h"
#include "scenes/load.h"
#include "tests/cli/program_runner.h"
#include "tests/temporary_folder.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace rawtexel::cli {
namespace {

using shading::FilterOrder;
using test::TemporaryFolder;
using texunit::Estimator;

class PolicyFile : public testing::Test {
  protected:
    void apply(const std::string& text, shading::Scene& scene) {
        const std::string path = folder_ / "policy.json";
        test::write_file(path, text);
        apply_policy_file(path, scene);
    }
    std::string error_of(const std::string& text) {
        try {
            shading::Scene scene = scene_;
            apply(text, scene);
        } catch (const scenes::InputError& error) {
            return error.what();
        }
        return "";
    }
    TemporaryFolder folder_;
    shading::Scene scene_ = scenes::load("metal-edge", {});
};

TEST_F(PolicyFile, PutsPoliciesOnWhatHasTheirNames) {
    const std::string material = scene_.materials[0].name, texture = scene_.textures[0].texture->name();
    shading::Scene scene = scene_;
    apply(R"({"materials": {")" + material + R"(": {"order": "after", "estimator": "reservoir", "filter": "mitchell:0.2,0.4"}},
              "textures": {")" +
              texture + R"(": {"order": "before", "mip": "none"}}})",
          scene);
    const shading::LookupPolicy& of_material = scene.materials[0].policy;
    EXPECT_EQ(of_material.order, FilterOrder::After);
    EXPECT_EQ(of_material.estimator, Estimator::Reservoir);
    EXPECT_EQ(of_material.filter, texunit::Kernel::mitchell(0.2f, 0.4f));
    EXPECT_FALSE(of_material.mip);
    EXPECT_EQ(scene.textures[0].policy.order, FilterOrder::Before);
    EXPECT_EQ(scene.textures[0].policy.mip, texunit::MipMode::None);
}

TEST_F(PolicyFile, RefusesWhatItDoesNotKnow) {
    for (const auto& [text, part] : {std::pair{"[]", "no JSON object"},
                                     {"{", "not valid JSON"},
                                     {R"({"material": {}})", "unknown member 'material'"},
                                     {R"({"materials": []})", "no object of names"},
                                     {R"({"materials": {"inlai": {}}})", "the nearest is 'inlay'"},
                                     {R"({"materials": {"inlay": 3}})", "is no object"},
                                     {R"({"materials": {"inlay": {"ordre": "after"}}})", "materials.inlay.ordre is unknown"},
                                     {R"({"materials": {"inlay": {"order": "afterwards"}}})", "materials.inlay.order is \"afterwards\""},
                                     {R"({"textures": {"no such": {"mip": 1}}})", "textures.no such.mip is 1"}})
        EXPECT_NE(error_of(text).find(part), std::string::npos) << text << ": " << error_of(text);
}

TEST(LookupPolicies, SpecificOnesWin) {
    using shading::LookupPolicy;
    const LookupPolicy material{.order = FilterOrder::After, .estimator = Estimator::Jitter, .filter = texunit::Kernel::BSpline, .mip = {}};
    const LookupPolicy texture{.order = FilterOrder::Before, .estimator = {}, .filter = {}, .mip = texunit::MipMode::None};
    const LookupPolicy both = combine(material, texture);
    EXPECT_EQ(both.order, FilterOrder::Before);
    // Its order says every tap: the material's estimator belongs to another order.
    EXPECT_FALSE(both.estimator);
    EXPECT_EQ(both.filter, texunit::Kernel::BSpline);
    EXPECT_EQ(both.mip, texunit::MipMode::None);
    const shading::FilteringOptions applied = apply(both, {.estimator = Estimator::Reservoir});
    EXPECT_EQ(applied.effective_order(), FilterOrder::Before);
    EXPECT_FALSE(applied.draws());
    EXPECT_EQ(apply(LookupPolicy{.order = {}, .estimator = Estimator::Jitter, .filter = {}, .mip = {}}, {}).effective_order(),
              FilterOrder::After);
}

TEST_F(PolicyFile, RefusesWhatTheOptionsLeaveWithoutEffect) {
    const std::string policy = folder_ / "policy.json";
    const auto with = [&](const char* member, const std::vector<std::string>& options) {
        test::write_file(policy, R"({"textures": {")" + scene_.textures[0].texture->name() + "\": " + member + "}}");
        std::vector<std::string> words{"render", "metal-edge", "--size", "16x9", "-o", folder_ / "a.exr", "--policy", policy};
        words.insert(words.end(), options.begin(), options.end());
        return test::run(words);
    };
    const std::string filtered = R"({"filter": "bspline"})", levels = R"({"mip": "linear"})";
    EXPECT_EQ(test::why_not_failed(with(filtered.c_str(), {"--ewa"}), kWrongUsage, "which --ewa has no use for"), "");
    EXPECT_EQ(test::why_not_failed(with(levels.c_str(), {"--ewa"}), kWrongUsage, "which --ewa has no use for"), "");
    EXPECT_EQ(test::why_not_failed(with(levels.c_str(), {"--mip", "none", "--texture-jitter", "affine"}), kWrongUsage, "asks for levels"),
              "");
    EXPECT_EQ(with(filtered.c_str(), {"--mip", "none", "--texture-jitter", "affine"}).code, kDone);
}

/// A texture that keeps `before` beside draws: the draws of the others stay, and its own texels are all weighed.
TEST_F(PolicyFile, KeepsATextureFilteredBeforeShading) {
    const std::string policy = folder_ / "policy.json", stats = folder_ / "stats.json";
    test::write_file(policy, R"({"textures": {")" + scene_.textures[0].texture->name() +
                                 R"(": {"order": "before", "filter": "bspline", "mip": "none"}}})");
    const test::Outcome outcome = test::run({"render", "metal-edge", "--size", "64x36", "-o", folder_ / "a.exr", "--estimator", "reservoir",
                                             "--policy", policy, "--count", "--stats", stats});
    ASSERT_EQ(outcome.code, kDone) << outcome.err;
    const nlohmann::json json = nlohmann::json::parse(test::read_file(stats));
    for (const nlohmann::json& texture : json["textures"]) {
        const bool kept = texture["name"] == scene_.textures[0].texture->name();
        // Where a coordinate falls on a texel's centre some of the 16 weigh nothing.
        const double per_lookup = texture["texels_requested"].get<double>() / texture["lookups"].get<double>();
        EXPECT_NEAR(per_lookup, kept ? 16 : 1, kept ? 0.05 : 0) << texture["name"];
    }
}

}  // namespace
}  // namespace rawtexel::cli
