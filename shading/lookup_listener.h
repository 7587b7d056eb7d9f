// Who hears of the lookups that a frame's fragments ask for: counters, traces, explanations.
#pragma once

#include "raster/frame.h"
#include "shading/draw_state.h"
#include "texunit/draw.h"
#include "texunit/sample.h"

#include <cstddef>
#include <cstdint>

namespace rawtexel::shading {

/// A block of 8x4 pixels at one sample.
struct ListenedWave {
    int x = 0, y = 0;  ///< upper left pixel, in the frame
    size_t index = 0;  ///< in the tile, row by row
    uint32_t sample = 0;
    texunit::WaveMask surface = 0;  ///< lanes that see a surface
};

/// Fragments of one draw in a wave, each lane on its own triangle.
struct ListenedFragments {
    const DrawState* draw = nullptr;
    texunit::WaveMask lanes = 0;
    const uint32_t* setup_index = nullptr;  ///< 32, of raster::Frame::triangle; means something for the lanes that look up
    bool let_through = false;               ///< alpha discarded them all
};

/// One map asked by the lanes of a group of fragments.
struct ListenedLookup {
    MapSlot slot{};
    const MapState* map = nullptr;
    texunit::WaveMask lanes = 0;
    const texunit::WaveCoordinates* at = nullptr;  ///< other lanes hold anything
};

/// A texel drawn for one map by the lanes of a group of fragments.
struct ListenedDraw {
    ListenedLookup lookup;  ///< its lanes are those that read the texel
    const texunit::TexelDraw* draw = nullptr;
    bool first = false;  ///< of the lookup's draws, read by all of its lanes
};

/// Of a tile it hears sample by sample, of a sample wave by wave in Morton order, of a wave its fragments in the order in which they are
/// drawn, of fragments their maps in the order of their slots: first those that weigh every tap, then draw by draw those that draw.
class LookupListener {
  public:
    virtual ~LookupListener() = default;
    virtual void begin_tile(int tile_x, int tile_y) = 0;
    virtual void begin_wave(const ListenedWave& wave) = 0;
    virtual void fragments(const ListenedFragments& fragments) = 0;
    virtual void lookup(const ListenedLookup& lookup) = 0;
    virtual void drawn(const ListenedDraw& draw) = 0;
    virtual void end_wave() = 0;
    virtual void end_sample() = 0;
    virtual void end_tile() = 0;
};

}  // namespace rawtexel::shading
