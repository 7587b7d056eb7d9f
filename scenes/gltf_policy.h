// How the lookups of a material or texture differ from what is asked of all: extras.rawtexel.policy.
#pragma once

#include "scenes/gltf_document.h"

#include "shading/lookup_policy.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace rawtexel::scenes {

/// The policy in the extras of the element called `place`, such as "materials[0]"; unset where there is none. Throws InputError for values
/// that the options of the members' names do not take.
shading::LookupPolicy read_policy(const GltfDocument& document, const std::string& place, const tinygltf::Value& extras);

/// What `read_policy` reads as this policy: members by name. The policy is not empty.
nlohmann::json policy_json(const shading::LookupPolicy& policy);

}  // namespace rawtexel::scenes
