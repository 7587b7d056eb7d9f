// What vectors of this room share, of whatever lanes.
#if defined(RAWTEXEL_RASTER_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_RASTER_LANES_INL_H
#undef RAWTEXEL_RASTER_LANES_INL_H
#else
#define RAWTEXEL_RASTER_LANES_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::raster {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// first, first + 1 … as Iota, which highway makes number by number where `first` is not a constant.
template <class D, class T = hn::TFromD<D>>
HWY_INLINE hn::Vec<D> numbers_from(D d, T first) {
    return hn::Add(hn::Iota(d, T{0}), hn::Set(d, first));
}

/// One bit per lane, of at most 32.
template <class D, class M>
HWY_INLINE uint32_t lane_bits(D d, M mask) {
    alignas(8) uint8_t bits[8] = {};
    hn::StoreMaskBits(d, mask, bits);
    uint32_t some;
    hwy::CopyBytes<4>(bits, &some);
    return hn::Lanes(d) >= 32 ? some : some & ((1u << hn::Lanes(d)) - 1);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::raster
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_RASTER_LANES_INL_H
