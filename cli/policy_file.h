// Policies of materials and textures, from a file.
#pragma once

#include "shading/scene.h"

#include <string>

namespace rawtexel::cli {

/// Reads a JSON object such as {"materials": {"NAME": POLICY}, "textures": {"NAME": POLICY}}, a POLICY being an object with any of "order",
/// "estimator", "filter" and "mip", spelled as the options of those names, and puts the policies onto the scene's materials and textures of
/// those names: over what the scene's file says, member by member. Throws scenes::InputError for a file that cannot be read or is anything
/// else, and for a name that the scene does not have.
void apply_policy_file(const std::string& path, shading::Scene& scene);

}  // namespace rawtexel::cli
