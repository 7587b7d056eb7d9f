// Parts of an arcade: round arches of alternating voussoirs on columns. A bay is centred on x = 0, its front in the plane z = 0.
#pragma once

#include "shading/scene.h"

namespace rawtexel::scenes {

struct ArcadeBay {
    float width = 2.4f;       ///< metres from column to column
    float radius = 0.90f;     ///< of the arch's opening
    float ring = 0.20f;       ///< depth of the voussoirs, outwards
    float spring = 2.15f;     ///< height where the arch begins
    float height = 3.75f;     ///< of the wall above it
    float thickness = 0.42f;  ///< of the wall, towards -z
};

/// The wall above the spring line with the arch cut out: front, back and the undersides beside the opening.
void append_spandrels(shading::Mesh& mesh, const ArcadeBay& bay, float metres_per_uv);

/// Every other voussoir of the arch, beginning with `first` (0 or 1); `count` in all, standing out of the wall by a little.
void append_voussoirs(shading::Mesh& mesh, const ArcadeBay& bay, int count, int first, float metres_per_uv);

/// A column with base and capital, as high as the spring line, its axis on x = z = 0.
void append_column(shading::Mesh& mesh, float height, float shaft_radius);

}  // namespace rawtexel::scenes
