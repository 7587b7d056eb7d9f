#include "cli/scenario.h"

#include "cli/limits.h"
#include "cli/option_values.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace rawtexel::cli {
namespace {

using Json = nlohmann::json;

constexpr float kMinRadius = 1e-6f;  // metres: the eye is not the target

UsageError scenario_error(const std::string& key, const std::string& what) { return UsageError("--scenario: \"" + key + "\" " + what); }

const Json& member(const Json& parent, const std::string& key) {
    const auto found = parent.find(key);
    if (found == parent.end()) throw scenario_error(key, "is missing");
    return *found;
}

const Json& object_member(const Json& parent, const std::string& key) {
    const Json& value = member(parent, key);
    if (!value.is_object()) throw scenario_error(key, "is not an object");
    return value;
}

std::string string_member(const Json& parent, const std::string& key) {
    const Json& value = member(parent, key);
    if (!value.is_string() || value.get_ref<const std::string&>().empty()) throw scenario_error(key, "is not a text");
    return value.get<std::string>();
}

float number_member(const Json& parent, const std::string& key, const NumberRange& range) {
    const Json& value = member(parent, key);
    const double number = value.is_number() ? value.get<double>() : std::nan("");
    if (!(number >= double(range.lowest) && number <= double(range.highest)))
        throw scenario_error(key, "is not a number from " + print(range));
    return float(number);
}

int extent_member(const Json& parent, const std::string& key) {
    const float extent = number_member(parent, key, {1.0f, float(kMaxImageExtent)});
    if (extent != std::floor(extent)) throw scenario_error(key, "is not a whole number");
    return int(extent);
}

Json parse_json(std::string_view text) {
    Json json = Json::parse(text, nullptr, /*allow_exceptions=*/false);
    if (json.is_discarded()) throw UsageError("--scenario: the argument is not valid JSON");
    if (!json.is_object()) throw UsageError("--scenario: the argument is not a JSON object");
    return json;
}

glm::vec3 eye_of(const Scenario& scenario) {
    const float theta = glm::radians(scenario.theta), phi = glm::radians(scenario.phi);
    const glm::vec3 direction(std::sin(theta) * std::sin(phi), std::cos(phi), std::cos(theta) * std::sin(phi));
    return scenario.target + scenario.radius * direction;
}

}  // namespace

Scenario parse_scenario(std::string_view text) {
    const Json json = parse_json(text);
    const Json& source = object_member(json, "scenario");
    Scenario scenario;
    scenario.output_file = string_member(json, "outputFile");
    scenario.model = string_member(source, "model");
    if (source.contains("name")) scenario.name = string_member(source, "name");
    if (source.contains("lighting")) scenario.lighting = string_member(source, "lighting");

    const Json& dimensions = object_member(source, "dimensions");
    scenario.size = {extent_member(dimensions, "width"), extent_member(dimensions, "height")};
    const Json& target = object_member(source, "target");
    const auto coordinate = [&](const char* axis) { return number_member(target, axis, {-kMaxLength, kMaxLength}); };
    scenario.target = {coordinate("x"), coordinate("y"), coordinate("z")};
    const Json& orbit = object_member(source, "orbit");
    scenario.theta = number_member(orbit, "theta", {-kMaxAngle, kMaxAngle});
    scenario.phi = number_member(orbit, "phi", {-kMaxAngle, kMaxAngle});
    scenario.radius = number_member(orbit, "radius", {kMinRadius, kMaxLength});
    scenario.vertical_fov = number_member(source, "verticalFoV", {kMinFov, kMaxFov});
    if (source.contains("renderSkybox")) {
        if (!source["renderSkybox"].is_boolean()) throw scenario_error("renderSkybox", "is not true or false");
        scenario.render_skybox = source["renderSkybox"].get<bool>();
    }
    return scenario;
}

void apply(const Scenario& scenario, RenderRequest& request) {
    if (!request.size) request.size = scenario.size;
    ViewOptions& view = request.view;
    const bool own_view = view.camera || view.orbit || view.eye || view.target;
    if (!own_view) {
        view.eye = eye_of(scenario);
        view.target = scenario.target;
    }
    if (!own_view && !view.fov) view.fov = scenario.vertical_fov;
    LightOptions& light = request.light;
    if (!light.environment && !scenario.lighting.empty()) light.environment = EnvironmentOption{EnvironmentKind::File, scenario.lighting};
    if (!light.background && !scenario.render_skybox) request.tone.white_backdrop = true;
}

}  // namespace rawtexel::cli
