#include "cli/policy_file.h"

#include "cli/json_text.h"
#include "scenes/load.h"
#include "scenes/message_text.h"
#include "scenes/spelling.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace rawtexel::cli {
namespace {

using Json = nlohmann::json;
using shading::LookupPolicy;

[[noreturn]] void fail(const std::string& path, const std::string& what) { throw scenes::InputError(path + ": " + what); }

LookupPolicy parse_policy(const std::string& path, const std::string& place, const Json& json) {
    if (!json.is_object()) fail(path, place + " is no object");
    LookupPolicy policy;
    for (const auto& [name, value] : json.items()) {
        using enum shading::PolicyMemberResult;
        const std::string member = place + "." + scenes::shortened(name);
        const std::string spelling = value.is_string() ? value.get<std::string>() : std::string();
        switch (set_policy_member(policy, name, spelling)) {
            case Set: break;
            case UnknownName: fail(path, member + " is unknown (allowed: order, estimator, filter, mip)");
            case UnknownValue:
                fail(path, member + " is " + scenes::shortened(value.dump(-1, ' ', false, Json::error_handler_t::replace)) +
                               " (allowed: what the option of this name takes)");
        }
    }
    return policy;
}

/// Puts each policy of `group` on what has its name: name_of(item) and policy_of(item) of the scene's `items`.
template <class Items, class NameOf>
void apply_group(const std::string& path, const std::string& group, const Json& policies, Items& items, const NameOf& name_of) {
    if (!policies.is_object()) fail(path, group + " is no object of names");
    for (const auto& [name, json] : policies.items()) {
        const LookupPolicy policy = parse_policy(path, group + "." + scenes::one_line(name), json);
        bool found = false;
        for (auto& item : items) {
            if (name_of(item) != name) continue;
            item.policy = combine(item.policy, policy);
            found = true;
        }
        if (found) continue;
        std::vector<std::string> names;
        for (const auto& item : items) names.push_back(name_of(item));
        fail(path, group + ": the scene has none named '" + scenes::one_line(name) + "'" +
                       (names.empty() ? "" : ", the nearest is '" + scenes::one_line(scenes::nearest_spelling(name, names)) + "'"));
    }
}

}  // namespace

void apply_policy_file(const std::string& path, shading::Scene& scene) {
    const Json json = read_json(path);
    if (!json.is_object()) fail(path, "is no JSON object (allowed: {\"materials\": {…}, \"textures\": {…}})");
    for (const auto& [group, policies] : json.items()) {
        if (group == "materials") {
            apply_group(path, group, policies, scene.materials, [](const shading::Material& material) { return material.name; });
        } else if (group == "textures") {
            apply_group(path, group, policies, scene.textures,
                        [](const shading::SceneTexture& texture) { return texture.texture->name(); });
        } else {
            fail(path, "unknown member '" + scenes::shortened(group) + "' (allowed: materials, textures)");
        }
    }
}

}  // namespace rawtexel::cli
