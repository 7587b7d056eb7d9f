// Noise that tiles: the raw material of the generated textures. Every function is pure; equal arguments give equal bits.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>

namespace rawtexel::scenes {

/// 32 well-mixed bits of a lattice point.
uint32_t lattice_bits(int x, int y, uint32_t seed);
/// The same in [0, 1): 24 bits.
float lattice_float(int x, int y, uint32_t seed);

/// Lattice values smoothly interpolated, 0..1. `p` in lattice units; repeats every `period` units along each axis.
float value_noise(glm::vec2 p, glm::ivec2 period, uint32_t seed);

/// Perlin 2002, "Improving Noise": gradients at the lattice, quintic fade. About -1..1, 0 on the lattice.
float gradient_noise(glm::vec2 p, glm::ivec2 period, uint32_t seed);

/// Octaves of gradient noise, each twice as fine and half as strong; about -1..1.
float fractal_noise(glm::vec2 p, glm::ivec2 period, int octaves, uint32_t seed);

/// Fractal noise of a swatch, `p` in 0..1: `frequency` lattice squares along each side in the first octave.
float swatch_noise(glm::vec2 p, int frequency, int octaves, uint32_t seed);

/// Eight of the random bits of an id, from bit `shift` on, as a number in [0, 1).
float random_part(uint32_t id, int shift);

/// A point among cells grown around one jittered centre per lattice square (Worley 1996).
struct CellPoint {
    glm::vec2 from_center{0.0f};  ///< lattice units, from the centre of the cell that holds the point
    float edge = 0.0f;            ///< distance to the nearest border of that cell, lattice units
    uint32_t id = 0;              ///< random bits of the cell
};
/// `jitter` 0: squares, 1: centres anywhere in their square.
CellPoint cells(glm::vec2 p, glm::ivec2 period, float jitter, uint32_t seed);

/// Hermite step from 0 at `low` to 1 at `high` (which may be the smaller).
float smooth_step(float low, float high, float x);

}  // namespace rawtexel::scenes
