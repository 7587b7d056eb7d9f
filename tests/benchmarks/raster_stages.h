// Vector stages of raster that have no door of their own, by themselves, on the instruction set in use.
#pragma once

#include "raster/interpolate.h"
#include "raster/visibility.h"

#include <cstdint>

namespace rawtexel::raster::stages {

/// Sample points of tile (0, 0) that triangles [0, count) of the frame cover, whatever their depth: edge functions by 8x8 blocks, then by
/// 8x4 masks.
uint64_t covered_samples(const Frame& frame, uint32_t count, const TileSamples& samples);

/// Which derivatives a wave of barycentrics has.
enum class Derivatives { Analytic, OfQuads };

/// Barycentrics of the 128 waves of tile (0, 0) of 64x64 pixels. `setup_index` has 32 lanes, used for each of them.
void interpolate_tile(const Frame& frame, const uint32_t* setup_index, Derivatives derivatives, BarycentricWave& out);

}  // namespace rawtexel::raster::stages
