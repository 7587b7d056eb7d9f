// What stands and hangs in a courtyard: fountain, pots, lanterns, door, windows, roof.
#pragma once

#include "shading/scene.h"

namespace rawtexel::scenes {

/// A tiered fountain about the y axis, by material.
struct Fountain {
    shading::Mesh stone;   ///< rim, foot, upper bowl
    shading::Mesh tiles;   ///< the basin's outer and inner wall and its floor
    shading::Mesh bronze;  ///< finial and spouts
    shading::Mesh water;   ///< both surfaces and the falling streams
};
Fountain make_fountain();

/// A turned pot with a rim, `height` metres, standing on the origin; the mouth's soil is separate.
void append_pot(shading::Mesh& pot, float height, float radius);
/// A disc facing up.
void append_disc(shading::Mesh& mesh, float y, float radius, int around, float metres_per_uv);

/// A hanging lantern, its ring at the origin, by material.
struct Lantern {
    shading::Mesh metal, glass, flame;
};
Lantern make_lantern();

/// A wall of barrel tiles: `columns` rows of tiles side by side along +x from the origin, falling from (y = rise) towards +z.
void append_roof(shading::Mesh& mesh, int columns, float pitch, float run, float rise);

}  // namespace rawtexel::scenes
