// The vector form of texunit/level_table.h: a texel's index from its column, row and level.
#include "texunit/level_table.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_ADDRESS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_ADDRESS_INL_H_
#undef RAWTEXEL_TEXUNIT_ADDRESS_INL_H_
#else
#define RAWTEXEL_TEXUNIT_ADDRESS_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// table[level] per lane.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V look_up_level(D d, const std::array<int32_t, 16>& table, V level) {
#if HWY_TARGET == HWY_AVX3
    // One register holds the table.
    return hn::TableLookupLanes(hn::Load(d, table.data()), hn::IndicesFromVec(d, level));
#else
    return hn::GatherIndex(d, table.data(), level);
#endif
}

/// column_offset of level_table.h.
template <StorageClass storage, class V>
HWY_INLINE V column_offset_v(V x) {
    const hn::DFromV<V> d;
    constexpr PageShape page = page_shape(storage);
    const auto bit = [&](int place) HWY_ATTR { return hn::And(x, hn::Set(d, 1 << place)); };
    V offset = hn::Or(hn::And(x, hn::Set(d, 3)), hn::ShiftLeft<2>(bit(2)));
    offset = hn::Or(offset, hn::ShiftLeft<3>(bit(3)));
    if constexpr (page.log2_width > 4) offset = hn::Or(offset, hn::ShiftLeft<4>(bit(4)));
    return hn::Or(offset, hn::ShiftLeft<page.log2_texels()>(hn::ShiftRight<page.log2_width>(x)));
}

/// row_offset of level_table.h.
template <StorageClass storage, class V>
HWY_INLINE V row_offset_v(V y, V row_stride) {
    const hn::DFromV<V> d;
    constexpr PageShape page = page_shape(storage);
    const auto bit = [&](int place) HWY_ATTR { return hn::And(y, hn::Set(d, 1 << place)); };
    V offset = hn::Or(hn::ShiftLeft<2>(hn::And(y, hn::Set(d, 3))), hn::ShiftLeft<3>(bit(2)));
    offset = hn::Or(offset, hn::ShiftLeft<4>(bit(3)));
    if constexpr (page.log2_height > 4) offset = hn::Or(offset, hn::ShiftLeft<5>(bit(4)));
    return hn::Add(offset, hn::Mul(hn::ShiftRight<page.log2_height>(y), row_stride));
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_ADDRESS_INL_H_
