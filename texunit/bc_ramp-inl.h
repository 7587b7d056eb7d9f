// The eight values of a block of BC4, of one channel of BC5, or of BC3's alpha, in lanes (texunit/bc_ramp.h says what they are).
#include "texunit/bc_lanes-inl.h"
#include "texunit/bc_ramp.h"
#include "texunit/little_endian.h"

#include <algorithm>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_BC_RAMP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_BC_RAMP_INL_H_
#undef RAWTEXEL_TEXUNIT_BC_RAMP_INL_H_
#else
#define RAWTEXEL_TEXUNIT_BC_RAMP_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {

#if RAWTEXEL_BC_LANES

struct ValueLanes {
    TexelLanes palette;
    uint64_t indices;

    /// Of texels 0 to 7 or 8 to 15, in the low 16 bits of each lane; the others are zero.
    HWY_INLINE TexelLanes values(int half) const { return look_up(palette, unpack_fields<3>(indices >> (24 * half))); }
};

template <bool is_signed>
HWY_INLINE ValueLanes read_value_lanes(const std::byte* block) {
    // Sevenths and, where there are six values, fifths, all in 35ths; then those that are the extremes.
    alignas(32) static constexpr int32_t kOfFirst[2][8] = {{35, 0, 28, 21, 14, 7, 0, 0}, {35, 0, 30, 25, 20, 15, 10, 5}};
    alignas(32) static constexpr int32_t kOfSecond[2][8] = {{0, 35, 7, 14, 21, 28, 0, 0}, {0, 35, 5, 10, 15, 20, 25, 30}};
    constexpr int32_t kLeast = is_signed ? -127 * 35 : 0, kMost = is_signed ? 127 * 35 : 255 * 35;
    alignas(32) static constexpr int32_t kExtremes[2][8] = {{0, 0, 0, 0, 0, 0, kLeast, kMost}, {}};

    const TexelTag d;
    const uint64_t bits = load<uint64_t>(block);
    int first = int(bits & 0xFF), second = int((bits >> 8) & 0xFF);
    if constexpr (is_signed) first = int8_t(first), second = int8_t(second);
    const size_t eight_values = first > second;
    if constexpr (is_signed) first = std::max(first, -127), second = std::max(second, -127);

    const auto of_first = hn::Mul(hn::Set(d, first), hn::Load(d, kOfFirst[eight_values]));
    const auto of_second = hn::Mul(hn::Set(d, second), hn::Load(d, kOfSecond[eight_values]));
    const auto palette = hn::Add(hn::Add(of_first, of_second), hn::Load(d, kExtremes[eight_values]));
    return {is_signed ? hn::And(palette, hn::Set(d, 0xFFFF)) : palette, bits >> 16};
}

#endif  // RAWTEXEL_BC_LANES

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_BC_RAMP_INL_H_
