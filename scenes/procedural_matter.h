// Wood, metal, glaze and water.
#pragma once

#include "scenes/procedural_surface.h"

namespace rawtexel::scenes {

Surface oak_planks();        ///< 1.2 m: upright boards with iron nails
Surface painted_planks();    ///< 1.2 m: the same under blue paint, worn at the edges
Surface wrought_iron();      ///< 1 m: forged, dark, rust in the hollows
Surface aged_bronze();       ///< 1 m: metal rubbed bright, verdigris (a dielectric) in the hollows
Surface glazed_tiles();      ///< 1.2 m: painted majolica, four by four tiles of blue, ochre and white
Surface rippled_water();     ///< 2 m: see-through, with gentle waves
Surface hammered_ceramic();  ///< 2 m: dark glazed hexagons, deeply hammered and very glossy
Surface sculpted_stucco();   ///< 1 m: pale, with shallow scrolls in relief

}  // namespace rawtexel::scenes
