#include "texunit/bc_ramp.h"

#include "texunit/little_endian.h"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "texunit/bc_ramp.cpp"
#include <hwy/foreach_target.h>

#include "texunit/bc_ramp-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace {

#if RAWTEXEL_BC_LANES

template <bool is_signed>
HWY_INLINE void decode_one(const std::byte* block, std::byte* texels) {
    const ValueLanes red = read_value_lanes<is_signed>(block);
    for (int half = 0; half < 2; ++half) store_texels(red.values(half), hn::Zero(TexelTag()), texels + 64 * half);
}

template <bool is_signed>
HWY_INLINE void decode_two(const std::byte* block, std::byte* texels) {
    const ValueLanes red = read_value_lanes<is_signed>(block), green = read_value_lanes<is_signed>(block + 8);
    for (int half = 0; half < 2; ++half) {
        store_texels(hn::Or(red.values(half), hn::ShiftLeft<16>(green.values(half))), hn::Zero(TexelTag()), texels + 64 * half);
    }
}

#else

template <bool is_signed>
HWY_INLINE ValueBlock read_values(const std::byte* block) {
    return is_signed ? read_signed_values(block) : read_unsigned_values(block);
}

HWY_INLINE void store(std::byte* texels, int i, uint64_t word) { std::memcpy(texels + 8 * i, &word, 8); }

template <bool is_signed>
HWY_INLINE void decode_one(const std::byte* block, std::byte* texels) {
    const ValueBlock red = read_values<is_signed>(block);
    for (int i = 0; i < 16; ++i) store(texels, i, red.value(i));
}

template <bool is_signed>
HWY_INLINE void decode_two(const std::byte* block, std::byte* texels) {
    const ValueBlock red = read_values<is_signed>(block), green = read_values<is_signed>(block + 8);
    for (int i = 0; i < 16; ++i) store(texels, i, red.value(i) | (uint64_t{green.value(i)} << 16));
}

#endif  // RAWTEXEL_BC_LANES

void decode_bc4u(const std::byte* block, std::byte* texels) { decode_one<false>(block, texels); }
void decode_bc4s(const std::byte* block, std::byte* texels) { decode_one<true>(block, texels); }
void decode_bc5u(const std::byte* block, std::byte* texels) { decode_two<false>(block, texels); }
void decode_bc5s(const std::byte* block, std::byte* texels) { decode_two<true>(block, texels); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rawtexel::texunit {
namespace {

HWY_EXPORT(decode_bc4u);
HWY_EXPORT(decode_bc4s);
HWY_EXPORT(decode_bc5u);
HWY_EXPORT(decode_bc5s);

/// Sevenths of the way where `eight_values`, else fifths and the two extremes; all over 35 times the codes' denominator.
std::array<uint16_t, 8> interpolate(int first, int second, bool eight_values, int minimum, int maximum) {
    std::array<uint16_t, 8> palette;
    palette[0] = uint16_t(35 * first);
    palette[1] = uint16_t(35 * second);
    if (eight_values) {
        for (int i = 2; i < 8; ++i) palette[size_t(i)] = uint16_t(5 * ((8 - i) * first + (i - 1) * second));
        return palette;
    }
    for (int i = 2; i < 6; ++i) palette[size_t(i)] = uint16_t(7 * ((6 - i) * first + (i - 1) * second));
    palette[6] = uint16_t(35 * minimum);
    palette[7] = uint16_t(35 * maximum);
    return palette;
}

}  // namespace

ValueBlock read_unsigned_values(const std::byte* block) {
    const uint64_t bits = load<uint64_t>(block);
    const int first = int(bits & 0xFF), second = int((bits >> 8) & 0xFF);
    return {interpolate(first, second, first > second, 0, 255), bits >> 16};
}

ValueBlock read_signed_values(const std::byte* block) {
    const uint64_t bits = load<uint64_t>(block);
    const int first = int8_t(bits & 0xFF), second = int8_t((bits >> 8) & 0xFF);
    return {interpolate(std::max(first, -127), std::max(second, -127), first > second, -127, 127), bits >> 16};
}

void decode_bc4_unorm(const std::byte* block, std::byte* texels) { HWY_DYNAMIC_DISPATCH(decode_bc4u)(block, texels); }
void decode_bc4_snorm(const std::byte* block, std::byte* texels) { HWY_DYNAMIC_DISPATCH(decode_bc4s)(block, texels); }
void decode_bc5_unorm(const std::byte* block, std::byte* texels) { HWY_DYNAMIC_DISPATCH(decode_bc5u)(block, texels); }
void decode_bc5_snorm(const std::byte* block, std::byte* texels) { HWY_DYNAMIC_DISPATCH(decode_bc5s)(block, texels); }

}  // namespace rawtexel::texunit
#endif
