// The vector doors of raster, callable from tests on every instruction set of this machine.
#pragma once

#include "raster/anchor.h"
#include "raster/interpolate.h"
#include "raster/visibility.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace rawtexel::raster::testing {

using CoveragePolicy = std::function<uint32_t(const CandidateWave&)>;

void draw_tile(const Frame& frame, int tile_x, int tile_y, const TileSamples& samples, const CoveragePolicy& coverage, TileVisibility& out);
/// The same; `opaque` hears of opaque waves.
void draw_tile_telling(const Frame& frame, int tile_x, int tile_y, const TileSamples& samples, const CoveragePolicy& coverage,
                       const std::function<void(const CandidateWave&)>& opaque, TileVisibility& out);
void interpolate_wave(const Frame& frame, const uint32_t* setup_index, const SampleOffset* offset, int x, int y, uint32_t mask,
                      LatestAnchors& latest, BarycentricWave& out);

/// Instruction sets built and supported here, scalar included.
std::vector<int64_t> instruction_sets();
std::string name_of(int64_t instruction_set);

/// All vector code runs on one instruction set while this lives.
class UseInstructionSet {
  public:
    explicit UseInstructionSet(int64_t instruction_set);
    ~UseInstructionSet();
    UseInstructionSet(const UseInstructionSet&) = delete;
    UseInstructionSet& operator=(const UseInstructionSet&) = delete;
};

}  // namespace rawtexel::raster::testing
