// Eight texels of a block side by side: indices in lanes look up palettes in lanes. For instruction sets with vectors of 256 bits; on the
// others the decoders go texel by texel.
#include "texunit/bc_bits.h"

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_BC_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_BC_LANES_INL_H_
#undef RAWTEXEL_TEXUNIT_BC_LANES_INL_H_
#else
#define RAWTEXEL_TEXUNIT_BC_LANES_INL_H_
#endif

#undef RAWTEXEL_BC_LANES
#if HWY_TARGET != HWY_SCALAR && HWY_MAX_BYTES >= 32
#define RAWTEXEL_BC_LANES 1
#else
#define RAWTEXEL_BC_LANES 0
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if RAWTEXEL_BC_LANES

using TexelTag = hn::FixedTag<int32_t, 8>;
using TexelLanes = hn::Vec<TexelTag>;

/// Fields of `bits` bits in the eight lanes, the first from the lowest bits of `stream`.
template <int bits>
HWY_INLINE TexelLanes unpack_fields(uint64_t stream) {
    static_assert(8 * bits <= 32);
    alignas(32) static constexpr uint32_t kShift[8] = {0, bits, 2 * bits, 3 * bits, 4 * bits, 5 * bits, 6 * bits, 7 * bits};
    const TexelTag d;
    const hn::RebindToUnsigned<TexelTag> du;
    const auto shifted = hn::Shr(hn::Set(du, uint32_t(stream)), hn::Load(du, kShift));
    return hn::And(hn::BitCast(d, shifted), hn::Set(d, (1 << bits) - 1));
}

/// Entry `index` of eight. Only the lowest three bits of an index count.
HWY_INLINE TexelLanes look_up(TexelLanes palette, TexelLanes index) {
    const TexelTag d;
    return hn::TableLookupLanes(palette, hn::IndicesFromVec(d, hn::And(index, hn::Set(d, 7))));
}

/// Entry `index` of eight times `tables`.
template <int tables>
HWY_INLINE TexelLanes look_up(const TexelLanes (&palette)[tables], TexelLanes index) {
    const TexelTag d;
    TexelLanes found = look_up(palette[0], index);
    for (int table = 1; table < tables; ++table) {
        found = hn::IfThenElse(hn::Gt(index, hn::Set(d, 8 * table - 1)), look_up(palette[table], index), found);
    }
    return found;
}

/// Eight texels of 32 bits.
HWY_INLINE void store_texels(TexelLanes texels, std::byte* out) {
    const hn::Repartition<uint8_t, TexelTag> bytes;
    hn::StoreU(hn::BitCast(bytes, texels), bytes, reinterpret_cast<uint8_t*>(out));
}

/// Eight texels of 64 bits by their halves.
HWY_INLINE void store_texels(TexelLanes low, TexelLanes high, std::byte* out) {
    const TexelTag d;
    const hn::Repartition<int64_t, TexelTag> pairs;
    const auto even = hn::BitCast(pairs, hn::InterleaveLower(d, low, high)), odd = hn::BitCast(pairs, hn::InterleaveUpper(d, low, high));
    store_texels(hn::BitCast(d, hn::ConcatLowerLower(pairs, odd, even)), out);
    store_texels(hn::BitCast(d, hn::ConcatUpperUpper(pairs, odd, even)), out + 32);
}

#endif  // RAWTEXEL_BC_LANES

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_BC_LANES_INL_H_
