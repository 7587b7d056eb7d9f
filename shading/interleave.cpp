#include "shading/interleave.h"

#include "texunit/wave.h"

#include <cassert>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/interleave.cpp"
#include <hwy/foreach_target.h>

#include <hwy/cache_control.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using texunit::kWaveHeight;
using texunit::kWaveLanes;
using texunit::kWaveWidth;

using RowLanes = hn::CappedTag<float, kWaveWidth>;

/// Neighbouring pixels: of(c) gives their values of channel c.
template <int channels, class Of>
HWY_INLINE void store_pixels(const Of& of, float* out) {
    const RowLanes d;
    if constexpr (channels == 1) hn::StoreU(of(0), d, out);
    if constexpr (channels == 2) hn::StoreInterleaved2(of(0), of(1), d, out);
    if constexpr (channels == 3) hn::StoreInterleaved3(of(0), of(1), of(2), d, out);
    if constexpr (channels == 4) hn::StoreInterleaved4(of(0), of(1), of(2), of(3), d, out);
}

/// The same past the caches, which then need not read what is about to be overwritten; `out` is aligned to vectors.
template <int channels, class Of>
HWY_INLINE void stream_pixels(const Of& of, float* out) {
    const RowLanes d;
    alignas(64) float pixels[channels * kWaveWidth];
    store_pixels<channels>(of, pixels);
    for (size_t i = 0; i < channels * hn::Lanes(d); i += hn::Lanes(d)) hn::Stream(hn::Load(d, pixels + i), d, out + i);
}

template <int channels>
void interleave_channels(const WavePlaneSet& planes, const PixelRect& rect, float factor, float* out, size_t out_stride) {
    const RowLanes d;
    const auto times = hn::Set(d, factor);
    const auto misplaced = (reinterpret_cast<uintptr_t>(out) | out_stride * sizeof(float)) % (hn::Lanes(d) * sizeof(float));
    for (int y = rect.y0; y < rect.y1; ++y, out += out_stride) {
        const size_t first_wave = size_t(y / kWaveHeight) * planes.waves_x + size_t(rect.x0 / kWaveWidth);
        const float* values = planes.values + first_wave * kWaveLanes + size_t(y % kWaveHeight * kWaveWidth);
        float* pixel = out;
        for (int x = rect.x0; x < rect.x1; x += kWaveWidth, values += kWaveLanes) {
            for (size_t i = 0; i < size_t(kWaveWidth); i += hn::Lanes(d), pixel += hn::Lanes(d) * channels) {
                const auto of = [&](size_t c) HWY_ATTR { return hn::Mul(hn::LoadU(d, values + c * planes.stride + i), times); };
                if (misplaced == 0) {
                    stream_pixels<channels>(of, pixel);
                } else {
                    store_pixels<channels>(of, pixel);
                }
            }
        }
    }
    hwy::FlushStream();
}

void interleave_waves_lanes(const WavePlaneSet& planes, const PixelRect& rect, float factor, float* out, size_t out_stride) {
    switch (planes.channels) {
        case 1: return interleave_channels<1>(planes, rect, factor, out, out_stride);
        case 2: return interleave_channels<2>(planes, rect, factor, out, out_stride);
        case 3: return interleave_channels<3>(planes, rect, factor, out, out_stride);
        case 4: return interleave_channels<4>(planes, rect, factor, out, out_stride);
        default: assert(false);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rawtexel::shading {

HWY_EXPORT(interleave_waves_lanes);

void interleave_waves(const WavePlaneSet& planes, const PixelRect& rect, float factor, float* out, size_t out_stride) {
    assert(rect.x0 >= rect.x1 || (rect.x0 % texunit::kWaveWidth == 0 && rect.x1 % texunit::kWaveWidth == 0));
    HWY_DYNAMIC_DISPATCH(interleave_waves_lanes)(planes, rect, factor, out, out_stride);
}

}  // namespace rawtexel::shading
#endif
