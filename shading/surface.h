// What shading a wave needs to know of its surfaces, and what comes out.
#pragma once

#include "texunit/wave.h"

namespace rawtexel::shading {

using texunit::WaveFloat;
using texunit::WaveMask;

struct WaveVector {
    WaveFloat x, y, z;
};

/// Filtered material values and geometry at 32 shading points, world space.
struct SurfaceWave {
    WaveVector base_color;  ///< linear, >= 0
    WaveFloat metallic;     ///< 0..1
    WaveFloat roughness;    ///< perceptual, 0..1; alpha = roughness^2
    WaveFloat occlusion;    ///< 1: open
    WaveVector emission;
    WaveVector position;          ///< metres
    WaveVector normal;            ///< unit shading normal, on the viewer's side of a double-sided surface
    WaveVector geometric_normal;  ///< unit, of the triangle, on the same side
    WaveVector view;              ///< unit, towards the eye
    /// Punctual lights are reflected by an anisotropic lobe, of which `roughness` is the mean. Its axes lie across the normal, and the lobe
    /// spreads by alpha^2 = (axis[0].d)^2 + (axis[1].d)^2 towards a unit d across the normal.
    bool stretched = false;
    WaveVector axis[2];
};

}  // namespace rawtexel::shading
