// Options that a scene gives no meaning to, or that exclude each other in it.
#pragma once

#include "shading/material_state.h"

#include <string>

namespace rawtexel::shading {

/// Why maps of the scene cannot be looked up so, as a line for people that names the material; empty where they can.
std::string refusal(const Scene& scene, const LookupOverrides& overrides);

}  // namespace rawtexel::shading
