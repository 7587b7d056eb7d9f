// Coordinates of volumes and cube maps as flat ones: a plane's derivatives that ask for the same level, and which cube of an array.
#include "texunit/cube-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_SOLID_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_SOLID_INL_H_
#undef RAWTEXEL_TEXUNIT_SOLID_INL_H_
#else
#define RAWTEXEL_TEXUNIT_SOLID_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Derivatives along one texture axis that ask for the same level as those of a volume along three: the length of each derivative, or for
/// LodRule::Exact the longer axis of the ellipse that both span.
HWY_NOINLINE inline void flatten_derivatives(const LevelTable& table, LodRule rule, const WaveCoordinates3& at, WaveCoordinates& flat) {
    const FloatTag d;
    const auto zero = hn::Zero(d), half = hn::Set(d, 0.5f);
    const float extents[3] = {float(table.width[0]), float(table.height[0]), float(table.depth[0])};
    const auto width = hn::Set(d, extents[0]), height = hn::Set(d, extents[1]);
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        auto xx = zero, xy = zero, yy = zero;
        for (int axis = 0; axis < 3; ++axis) {
            const auto extent = hn::Set(d, extents[axis]);
            const auto x = hn::Mul(hn::Load(d, at.dx[axis].lane + i), extent), y = hn::Mul(hn::Load(d, at.dy[axis].lane + i), extent);
            xx = hn::Add(xx, hn::Mul(x, x));
            xy = hn::Add(xy, hn::Mul(x, y));
            yy = hn::Add(yy, hn::Mul(y, y));
        }
        auto rho_x = hn::Sqrt(xx), rho_y = hn::Sqrt(yy);
        if (rule == LodRule::Exact) {
            // The larger eigenvalue of the derivatives' Gram matrix.
            const auto middle = hn::Mul(half, hn::Add(xx, yy)), difference = hn::Mul(half, hn::Sub(xx, yy));
            rho_x = hn::Sqrt(hn::Add(middle, hn::Sqrt(hn::Add(hn::Mul(difference, difference), hn::Mul(xy, xy)))));
            rho_y = zero;
        }
        hn::Store(hn::Div(rho_x, width), d, flat.dudx.lane + i);
        hn::Store(zero, d, flat.dvdx.lane + i);
        hn::Store(zero, d, flat.dudy.lane + i);
        hn::Store(hn::Div(rho_y, height), d, flat.dvdy.lane + i);
    }
}

/// Faces of the cubes that the lanes choose in an array of `cubes`: adds 6 times the cube's number.
HWY_NOINLINE inline void add_cube(const WaveFloat& layer, WaveMask mask, int cubes, WaveInt& slice) {
    const IntTag d;
    WaveInt cube;
    select_layers(layer, mask, cubes, cube);
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto faces = hn::Mul(hn::Load(d, cube.lane + i), hn::Set(d, 6));
        hn::Store(hn::Add(hn::Load(d, slice.lane + i), faces), d, slice.lane + i);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_SOLID_INL_H_
