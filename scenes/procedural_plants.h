// Leaves, grass and bark. Alpha is 0 or 1 with one texel of transition; what is cut away keeps the colour of its surroundings.
#pragma once

#include "scenes/procedural_surface.h"

namespace rawtexel::scenes {

Surface leaf_spray();     ///< a twig of ovate leaves, its stem from the middle of the lower edge
Surface olive_spray();    ///< narrow silvery leaves
Surface ivy_spray();      ///< lobed dark leaves, all over the card
Surface blossom_spray();  ///< leaves and magenta bracts, as bougainvillea has
Surface grass_tuft();     ///< blades from the lower edge
Surface flower_tuft();    ///< stems with poppies, daisies and cornflowers
Surface bark();           ///< 1 m, tiles
Surface meadow_ground();  ///< 4 m, tiles

}  // namespace rawtexel::scenes
