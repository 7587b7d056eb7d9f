#include "cli/scenario.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace rawtexel::cli {
namespace {

using Json = nlohmann::json;

Json valid() {
    return Json::parse(R"({"scenario": {"lighting": "studio.hdr", "dimensions": {"width": 768, "height": 450},
        "target": {"x": 1, "y": 2.5, "z": -3}, "orbit": {"theta": 0, "phi": 90, "radius": 4}, "verticalFoV": 30,
        "renderSkybox": true, "name": "khronos-Thing", "model": "thing.glb"}, "outputFile": "out.png"})");
}

std::string error_of(const std::string& json) {
    try {
        parse_scenario(json);
    } catch (const UsageError& error) {
        return error.what();
    }
    return "";
}

TEST(Scenario, ReadsEveryField) {
    const Scenario scenario = parse_scenario(valid().dump());
    EXPECT_EQ(scenario.name, "khronos-Thing");
    EXPECT_EQ(scenario.model, "thing.glb");
    EXPECT_EQ(scenario.output_file, "out.png");
    EXPECT_EQ(scenario.lighting, "studio.hdr");
    EXPECT_EQ(scenario.size, (ImageSize{768, 450}));
    EXPECT_EQ(scenario.target, glm::vec3(1.0f, 2.5f, -3.0f));
    EXPECT_EQ(scenario.vertical_fov, 30.0f);
    EXPECT_TRUE(scenario.render_skybox);
}

TEST(Scenario, TheEyeTurnsAroundYFromZAndFallsFromY) {
    struct Case {
        float theta, phi;
        glm::vec3 direction;
    };
    for (const Case& c : {Case{0, 90, {0, 0, 1}}, Case{90, 90, {1, 0, 0}}, Case{180, 90, {0, 0, -1}}, Case{0, 0, {0, 1, 0}},
                          Case{0, 180, {0, -1, 0}}, Case{45, 90, {std::sqrt(0.5f), 0, std::sqrt(0.5f)}}}) {
        Json json = valid();
        json["scenario"]["orbit"]["theta"] = c.theta;
        json["scenario"]["orbit"]["phi"] = c.phi;
        RenderRequest request;
        apply(parse_scenario(json.dump()), request);
        const glm::vec3 expected = glm::vec3(1.0f, 2.5f, -3.0f) + 4.0f * c.direction;
        EXPECT_LT(glm::length(*request.view.eye - expected), 1e-5f) << c.theta << " " << c.phi;
        EXPECT_EQ(*request.view.target, glm::vec3(1.0f, 2.5f, -3.0f));
        EXPECT_EQ(*request.view.fov, 30.0f);
    }
}

TEST(Scenario, SetsWhatTheCommandLineLeftOpen) {
    RenderRequest request;
    apply(parse_scenario(valid().dump()), request);
    EXPECT_EQ(request.image_size(), (ImageSize{768, 450}));
    EXPECT_EQ(*request.light.environment, (EnvironmentOption{EnvironmentKind::File, "studio.hdr"}));
    EXPECT_FALSE(request.light.background);

    RenderRequest chosen;
    chosen.size = ImageSize{10, 20};
    chosen.view.orbit = Orbit{1, 2, 3};
    chosen.light.environment = EnvironmentOption{EnvironmentKind::Sky, {}};
    apply(parse_scenario(valid().dump()), chosen);
    EXPECT_EQ(chosen.image_size(), (ImageSize{10, 20}));
    EXPECT_FALSE(chosen.view.eye);
    EXPECT_FALSE(chosen.view.fov);
    EXPECT_EQ(chosen.light.environment->kind, EnvironmentKind::Sky);
}

TEST(Scenario, WithoutASkyboxTheBackdropIsWhiteUnlessABackgroundIsAskedFor) {
    Json json = valid();
    RenderRequest with, without, chosen;
    apply(parse_scenario(json.dump()), with);
    EXPECT_FALSE(with.tone.white_backdrop);
    json["scenario"]["renderSkybox"] = false;
    apply(parse_scenario(json.dump()), without);
    EXPECT_TRUE(without.tone.white_backdrop);
    chosen.light.background = glm::vec3(0.25f);
    apply(parse_scenario(json.dump()), chosen);
    EXPECT_FALSE(chosen.tone.white_backdrop);
    EXPECT_EQ(chosen.light.background, glm::vec3(0.25f));
}

TEST(Scenario, EveryMissingOrWrongFieldIsNamed) {
    const Json whole = valid();
    for (const std::string path :
         {"/outputFile", "/scenario", "/scenario/model", "/scenario/dimensions", "/scenario/dimensions/width", "/scenario/target",
          "/scenario/target/z", "/scenario/orbit", "/scenario/orbit/phi", "/scenario/verticalFoV"}) {
        const Json::json_pointer pointer(path);
        Json json = whole;
        json.at(pointer.parent_pointer()).erase(pointer.back());
        EXPECT_EQ(error_of(json.dump()), "--scenario: \"" + pointer.back() + "\" is missing");
        for (const Json& wrong : {Json(nullptr), Json::array(), Json(true), Json("")}) {
            json = whole;
            json[pointer] = wrong;
            EXPECT_TRUE(error_of(json.dump()).starts_with("--scenario: \"" + pointer.back() + "\" is not ")) << path << " " << wrong;
        }
    }
}

TEST(Scenario, HostileTextIsOneLine) {
    std::vector<std::string> texts{"",
                                   "{",
                                   "nonsense",
                                   "[]",
                                   "1",
                                   "null",
                                   "{\"scenario\":1e999}",
                                   "\"\\ud800\"",
                                   std::string(1000, '['),
                                   std::string(100000, '{'),
                                   "{\"scenario\":{}}",
                                   std::string("{\"a\0b\":1}", 9),
                                   "\xff\xfe"};
    const std::string whole = valid().dump();
    for (size_t length = 0; length < whole.size(); ++length) texts.push_back(whole.substr(0, length));
    for (const std::string& text : texts) {
        const std::string error = error_of(text);
        EXPECT_TRUE(error.starts_with("--scenario: ")) << text;
        EXPECT_EQ(error.find('\n'), std::string::npos);
    }
}

TEST(Scenario, ExtentsAndAnglesHaveLimits) {
    for (const auto& [path, value] : std::initializer_list<std::pair<const char*, Json>>{{"/scenario/dimensions/width", 0},
                                                                                         {"/scenario/dimensions/width", 20000},
                                                                                         {"/scenario/dimensions/height", 1.5},
                                                                                         {"/scenario/orbit/radius", 0},
                                                                                         {"/scenario/orbit/radius", 1e300},
                                                                                         {"/scenario/verticalFoV", 180},
                                                                                         {"/scenario/target/x", -1e30}}) {
        Json json = valid();
        json[Json::json_pointer(path)] = value;
        EXPECT_NE(error_of(json.dump()), "") << path << " " << value;
    }
}

}  // namespace
}  // namespace rawtexel::cli
