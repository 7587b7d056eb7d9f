// The wave: an aligned 8x4 block of pixels, 32 lanes, the unit in which texels are selected, fetched and shaded.
#pragma once

#include <cstdint>

namespace rawtexel::texunit {

inline constexpr int kWaveWidth = 8;   ///< pixels
inline constexpr int kWaveHeight = 4;  ///< pixels
inline constexpr int kWaveLanes = 32;  ///< lane = x + 8*y inside the block

/// One bit per lane, bit i = lane i.
using WaveMask = uint32_t;
inline constexpr WaveMask kWaveFull = 0xFFFFFFFFu;

/// One value per lane, aligned for the widest vector. Lanes outside the mask in use hold unspecified but initialised values.
template <class T>
struct alignas(64) Wave {
    T lane[kWaveLanes];
    T& operator[](int i) { return lane[i]; }
    const T& operator[](int i) const { return lane[i]; }
};

using WaveFloat = Wave<float>;
using WaveInt = Wave<int32_t>;

/// Red, green, blue, alpha of 32 lanes, structure of arrays.
struct WaveColor {
    WaveFloat channel[4];
};

}  // namespace rawtexel::texunit
