// What interpolation gives to the material: geometry at the shading points of a wave.
#pragma once

#include "shading/scene.h"
#include "shading/surface.h"
#include "texunit/sample.h"

namespace rawtexel::shading {

struct FragmentWave {
    WaveVector position;                              ///< world, metres
    WaveVector normal;                                ///< unit, of the vertices where the mesh has them; on the front face's side
    WaveVector geometric_normal;                      ///< unit, of the triangle; on the front face's side
    WaveVector tangent;                               ///< unit, or 0 where the mapping has none
    WaveFloat bitangent_sign;                         ///< bitangent = sign * cross(normal, tangent)
    WaveFloat facing;                                 ///< 1 where the front face is seen, -1 where the back face is
    texunit::WaveColor color;                         ///< of the vertices
    texunit::WaveCoordinates coordinates[kMapSlots];  ///< as MaterialState::coordinates
};

}  // namespace rawtexel::shading
