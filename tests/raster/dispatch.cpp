#include "tests/raster/dispatch.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/raster/dispatch.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set

#include "raster/interpolate-inl.h"
#include "raster/visibility-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::raster {
namespace HWY_NAMESPACE {

void draw_tile_here(const Frame& frame, int tile_x, int tile_y, const TileSamples& samples, const testing::CoveragePolicy& coverage,
                    TileVisibility& out) {
    tile_visibility(frame, tile_x, tile_y, samples, coverage, out);
}

struct TellingCoverage {
    uint32_t operator()(const CandidateWave& wave) const { return coverage(wave); }
    void opaque(const CandidateWave& wave) const { told(wave); }
    const testing::CoveragePolicy& coverage;
    const std::function<void(const CandidateWave&)>& told;
};

void draw_tile_telling_here(const Frame& frame, int tile_x, int tile_y, const TileSamples& samples, const testing::CoveragePolicy& coverage,
                            const std::function<void(const CandidateWave&)>& opaque, TileVisibility& out) {
    tile_visibility(frame, tile_x, tile_y, samples, TellingCoverage{coverage, opaque}, out);
}

void interpolate_wave_here(const Frame& frame, const uint32_t* setup_index, const SampleOffset* offset, int x, int y, uint32_t mask,
                           LatestAnchors& latest, BarycentricWave& out) {
    const bool same = std::all_of(offset, offset + 32, [&](const SampleOffset& o) { return o.x == offset->x && o.y == offset->y; });
    barycentric_wave(frame, setup_index, {x, y, offset, same}, mask, latest, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::raster
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace rawtexel::raster {

HWY_EXPORT(draw_tile_here);
HWY_EXPORT(draw_tile_telling_here);
HWY_EXPORT(interpolate_wave_here);

namespace testing {

void draw_tile(const Frame& frame, int tile_x, int tile_y, const TileSamples& samples, const CoveragePolicy& coverage,
               TileVisibility& out) {
    HWY_DYNAMIC_DISPATCH(draw_tile_here)(frame, tile_x, tile_y, samples, coverage, out);
}

void draw_tile_telling(const Frame& frame, int tile_x, int tile_y, const TileSamples& samples, const CoveragePolicy& coverage,
                       const std::function<void(const CandidateWave&)>& opaque, TileVisibility& out) {
    HWY_DYNAMIC_DISPATCH(draw_tile_telling_here)(frame, tile_x, tile_y, samples, coverage, opaque, out);
}

void interpolate_wave(const Frame& frame, const uint32_t* setup_index, const SampleOffset* offset, int x, int y, uint32_t mask,
                      LatestAnchors& latest, BarycentricWave& out) {
    HWY_DYNAMIC_DISPATCH(interpolate_wave_here)(frame, setup_index, offset, x, y, mask, latest, out);
}

std::vector<int64_t> instruction_sets() {
    std::vector<int64_t> sets;
    const int64_t built = HWY_TARGETS, runnable = hwy::SupportedTargets() | HWY_STATIC_TARGET;
    for (int64_t rest = built & runnable; rest != 0; rest &= rest - 1) sets.push_back(rest & -rest);
    return sets;
}

std::string name_of(int64_t instruction_set) { return hwy::TargetName(instruction_set); }

UseInstructionSet::UseInstructionSet(int64_t instruction_set) {
    hwy::SetSupportedTargetsForTest(instruction_set);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

UseInstructionSet::~UseInstructionSet() {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace testing
}  // namespace rawtexel::raster

#endif  // HWY_ONCE
