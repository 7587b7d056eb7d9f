// Who watches fragments being made: explanations of a pixel. Counters listen to lookups instead (shading/lookup_listener.h).
#pragma once

#include "raster/frame.h"
#include "raster/interpolate.h"
#include "shading/draw_state.h"
#include "shading/fragment.h"
#include "shading/surface.h"
#include "texunit/shared_draw.h"

#include <cstdint>
#include <optional>

namespace rawtexel::shading {

/// The block of 8x4 pixels and the sample that something happens at.
struct WatchedBlock {
    int x = 0, y = 0;  ///< upper left pixel, in the frame
    uint32_t sample = 0;
    WaveMask lanes = 0;  ///< of those below, other lanes hold anything
};

/// A MASK or BLEND triangle that was asked whether it covers, where it lies before all that was drawn so far.
struct JudgedFragments {
    WatchedBlock block;
    const DrawState* draw = nullptr;
    const raster::SetupTriangle* triangle = nullptr;
    uint32_t setup_index = 0;
    WaveMask covered = 0;          ///< lanes that cover
    const float* depth = nullptr;  ///< 32, of raster::TileVisibility
    const WaveFloat* alpha = nullptr;
    const texunit::WaveCoordinates* base_color = nullptr;  ///< where its map was looked up, where it has one
};

/// Texels that were drawn, or listed, for maps of a material: before the surface that they make is shaded.
struct TappedTexels {
    WatchedBlock block;  ///< lanes: those that weigh the tap
    const DrawState* draw = nullptr;
    const TapPlan* plan = nullptr;            ///< whose maps; of one map alone where `slot` names it
    std::optional<MapSlot> slot = {};         ///< drawn with numbers of its own
    const texunit::SharedTap* tap = nullptr;  ///< weights before they are shared among draws
    /// What it was drawn with, null where all taps are listed. Texels of negative weight have level and probe from the first.
    const texunit::DrawNumbers* numbers = nullptr;
    int number = 0;         ///< of the draw
    bool averaged = false;  ///< with others before shading
};

/// The mask of layers was looked up.
struct MaskedFragments {
    WatchedBlock block;
    const MapState* map = nullptr;
    const texunit::WaveCoordinates* at = nullptr;
};

/// One of several planes or layers begins that are blended: what is tapped and shaded next, with `branch` set, is of it. Or the one that is
/// drawn from them, without a weight: what is tapped and shaded next is what is seen.
struct BranchedFragments {
    WatchedBlock block;
    const MaterialState* whole = nullptr;  ///< that branches
    const WaveFloat* weight = nullptr;
};

/// Surfaces of one draw that are seen, each lane on its own triangle, shaded.
struct ShadedFragments {
    WatchedBlock block;
    const DrawState* draw = nullptr;
    const raster::Frame* frame = nullptr;
    const uint32_t* setup_index = nullptr;  ///< 32, of raster::Frame::triangle
    const raster::BarycentricWave* weights = nullptr;
    const FragmentWave* fragment = nullptr;
    const texunit::WaveColor* maps = nullptr;  ///< kMapSlots, of those with a texture
    const SurfaceWave* surface = nullptr;      ///< of an unlit material the base colour and the normals alone
    const WaveVector* radiance = nullptr;
    /// Of one tap among several that are added up: shading/tap_sum-inl.h. Null: what is seen.
    const WaveFloat* weight = nullptr;
    const WaveFloat* alpha = nullptr;  ///< of the tap, where its texel decides what it covers
    bool branch = false;               ///< of the plane or layer begun last; what is seen comes after all of them
    bool lit = true;                   ///< false: `radiance` is not this surface's, or that of its branches
};

/// What a block's pixels got for one sample.
struct SampledPixels {
    WatchedBlock block;
    const WaveFloat* radiance[3] = {};
    const float* depth = nullptr;  ///< 32, of raster::TileVisibility
};

/// Of a sample of a tile it hears first of all that was judged, in the order in which it was drawn; then block by block of texels drawn, of
/// the surfaces that they make and, after them, of the pixels.
class FragmentListener {
  public:
    virtual ~FragmentListener() = default;
    virtual void judged(const JudgedFragments& fragments) = 0;
    virtual void masked(const MaskedFragments&) {}
    virtual void branched(const BranchedFragments&) {}
    virtual void tapped(const TappedTexels&) {}
    virtual void shaded(const ShadedFragments& fragments) = 0;
    virtual void sampled(const SampledPixels& pixels) = 0;
};

}  // namespace rawtexel::shading
