// A wave of visible triangles, taken apart into its draws.
#if defined(RAWTEXEL_SHADING_WAVE_DRAWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_WAVE_DRAWS_INL_H_
#undef RAWTEXEL_SHADING_WAVE_DRAWS_INL_H_
#else
#define RAWTEXEL_SHADING_WAVE_DRAWS_INL_H_
#endif

#include "raster/frame.h"
#include "shading/corners-inl.h"
#include "shading/scene.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// The entries of a wave out of a tile's, `tile_size` to a row, the wave's upper left one at `first`.
template <class T>
HWY_INLINE void load_wave(const T* first, int tile_size, T* lanes) {
    for (int row = 0; row < texunit::kWaveHeight; ++row)
        std::copy_n(first + size_t(row) * size_t(tile_size), texunit::kWaveWidth, lanes + row * texunit::kWaveWidth);
}

/// Lanes of the 32 that hold `wanted`. `setup_index` is aligned as waves are.
HWY_INLINE WaveMask lanes_that_see(const uint32_t* setup_index, uint32_t wanted) {
    const FloatLanes d;
    const UintLanes du;
    WaveMask mask = 0;
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d))
        mask |= wave_mask_bits(hn::RebindMask(d, hn::Eq(hn::Load(du, setup_index + i), hn::Set(du, wanted))), i);
    return mask;
}

/// Lanes that see triangles of one draw.
struct DrawLanes {
    uint32_t draw = 0;
    WaveMask lanes = 0;
    bool one_triangle = false;
};

/// The draw that the first lane of `rest`, which is not empty, sees, with all lanes of `rest` that see it.
HWY_INLINE DrawLanes first_draw(const raster::Frame& frame, const uint32_t* setup_index, WaveMask rest) {
    const uint32_t first = setup_index[std::countr_zero(rest)];
    DrawLanes found{frame.triangle(first).draw, rest & lanes_that_see(setup_index, first), true};
    for (WaveMask others = rest & ~found.lanes; others != 0; others &= others - 1) {
        const int lane = std::countr_zero(others);
        if (frame.triangle(setup_index[lane]).draw != found.draw) continue;
        found.lanes |= WaveMask(1) << lane;
        found.one_triangle = false;
    }
    return found;
}

/// Calls act(corners) with the corners of the triangles that `seen` sees; the corners of other lanes are valid.
template <class Act>
HWY_INLINE void with_corners(const raster::Frame& frame, const Mesh& mesh, const uint32_t* setup_index, const DrawLanes& seen,
                             const Act& act) {
    const auto vertices = [&](int lane) { return &mesh.indices[size_t(frame.triangle(setup_index[lane]).primitive) * 3]; };
    if (seen.one_triangle) return act(OneTriangle{vertices(std::countr_zero(seen.lanes))});
    TrianglePerLane corners{};
    for (WaveMask lanes = seen.lanes; lanes != 0; lanes &= lanes - 1) {
        const int lane = std::countr_zero(lanes);
        for (int k = 0; k < 3; ++k) corners.vertex[k][lane] = int32_t(vertices(lane)[k]);
    }
    act(corners);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();
#endif
