#include "scenes/gltf_policy.h"

#include "scenes/message_text.h"

#include <nlohmann/json.hpp>

namespace rawtexel::scenes {

shading::LookupPolicy read_policy(const GltfDocument& document, const std::string& place, const tinygltf::Value& extras) {
    shading::LookupPolicy policy;
    if (!extras.Has("rawtexel") || !extras.Get("rawtexel").Has("policy")) return policy;
    const tinygltf::Value& members = extras.Get("rawtexel").Get("policy");
    for (const std::string& name : members.Keys()) {
        const std::string spelling = members.Get(name).Get<std::string>();
        if (set_policy_member(policy, name, spelling) != shading::PolicyMemberResult::Set)
            document.fail(place + ".extras.rawtexel.policy." + name + " is \"" + shortened(spelling) +
                          "\" (allowed: what the option of this name takes)");
    }
    return policy;
}

nlohmann::json policy_json(const shading::LookupPolicy& policy) {
    nlohmann::json members;
    for (const auto& [name, spelling] : policy_members(policy)) members[std::string(name)] = spelling;
    return members;
}

}  // namespace rawtexel::scenes
