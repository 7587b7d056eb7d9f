#include "texunit/bc_colour.h"

#include "texunit/bc_ramp.h"
#include "texunit/little_endian.h"

#include <array>
#include <cstdint>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "texunit/bc_colour.cpp"
#include <hwy/foreach_target.h>

#include "texunit/bc_lanes-inl.h"
#include "texunit/bc_ramp-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace {

/// Where fields lie in a 64-bit word (BC3): green, and blue in its upper half.
constexpr int kBc3GreenShift = 16;

/// An endpoint's 5:6:5 bits spread to the places of its numerators. No sum of six endpoints carries into the next field
/// (6*31 < 2^8, 6*63 < 2^9), so a word is interpolated as a whole.
constexpr uint32_t spread_endpoint(uint32_t rgb565) {
    return ((rgb565 >> 11) & 31) | (((rgb565 >> 5) & 63) << kBc1GreenShift) | ((rgb565 & 31) << kBc1BlueShift);
}
constexpr uint32_t spread_red_green(uint32_t rgb565) { return ((rgb565 >> 11) & 31) | (((rgb565 >> 5) & 63) << kBc3GreenShift); }
constexpr uint32_t spread_blue(uint32_t rgb565) { return rgb565 & 31; }

/// Two endpoints and sixteen 2-bit indices.
struct ColourBlock {
    uint32_t first, second, indices;

    explicit ColourBlock(const std::byte* block)
        : first(load<uint16_t>(block)), second(load<uint16_t>(block + 2)), indices(load<uint32_t>(block + 4)) {}
    bool four_colours() const { return first > second; }
};

// Sixths of the two endpoints that make up the four colours: both, then their half and black, or their thirds.
constexpr uint32_t kThreeColours = 0, kFourColours = 1;
alignas(32) constexpr int32_t kOfFirst[2][8] = {{6, 0, 3, 0, 6, 0, 3, 0}, {6, 0, 4, 2, 6, 0, 4, 2}};
alignas(32) constexpr int32_t kOfSecond[2][8] = {{0, 6, 3, 0, 0, 6, 3, 0}, {0, 6, 2, 4, 0, 6, 2, 4}};
// BC1's alpha of the four colours.
constexpr int32_t kOpaque = 1 << kBc1AlphaShift;
alignas(32) constexpr int32_t kBc1Alpha[2][8] = {{kOpaque, kOpaque, kOpaque, 0, kOpaque, kOpaque, kOpaque, 0},
                                                 {kOpaque, kOpaque, kOpaque, kOpaque, kOpaque, kOpaque, kOpaque, kOpaque}};

#if RAWTEXEL_BC_LANES

/// The four colours between two spread endpoints, twice.
HWY_INLINE TexelLanes palette_of(uint32_t first, uint32_t second, uint32_t rule) {
    const TexelTag d;
    return hn::Add(hn::Mul(hn::Set(d, int32_t(first)), hn::Load(d, kOfFirst[rule])),
                   hn::Mul(hn::Set(d, int32_t(second)), hn::Load(d, kOfSecond[rule])));
}

HWY_INLINE TexelLanes colour_indices(const ColourBlock& block, int half) { return unpack_fields<2>(block.indices >> (16 * half)); }

template <bool has_alpha>
HWY_INLINE void decode_bc1(const std::byte* block, std::byte* texels) {
    const ColourBlock colour(block);
    TexelLanes palette = palette_of(spread_endpoint(colour.first), spread_endpoint(colour.second), colour.four_colours());
    if constexpr (has_alpha) palette = hn::Or(palette, hn::Load(TexelTag(), kBc1Alpha[colour.four_colours()]));
    for (int half = 0; half < 2; ++half) store_texels(look_up(palette, colour_indices(colour, half)), texels + 32 * half);
}

HWY_INLINE void decode_bc2_block(const std::byte* block, std::byte* texels) {
    const uint64_t alphas = load<uint64_t>(block);
    const ColourBlock colour(block + 8);
    const TexelLanes palette = palette_of(spread_endpoint(colour.first), spread_endpoint(colour.second), kFourColours);
    for (int half = 0; half < 2; ++half) {
        const TexelLanes alpha = hn::ShiftLeft<kBc1AlphaShift>(unpack_fields<4>(alphas >> (32 * half)));
        store_texels(hn::Or(look_up(palette, colour_indices(colour, half)), alpha), texels + 32 * half);
    }
}

HWY_INLINE void decode_bc3_block(const std::byte* block, std::byte* texels) {
    const ValueLanes alpha = read_value_lanes<false>(block);
    const ColourBlock colour(block + 8);
    const TexelLanes red_green = palette_of(spread_red_green(colour.first), spread_red_green(colour.second), kFourColours);
    const TexelLanes blue = palette_of(spread_blue(colour.first), spread_blue(colour.second), kFourColours);
    for (int half = 0; half < 2; ++half) {
        const TexelLanes index = colour_indices(colour, half);
        store_texels(look_up(red_green, index), hn::Or(look_up(blue, index), hn::ShiftLeft<16>(alpha.values(half))), texels + 64 * half);
    }
}

#else

HWY_INLINE std::array<uint32_t, 4> palette_of(uint32_t first, uint32_t second, uint32_t rule) {
    std::array<uint32_t, 4> palette;
    for (size_t i = 0; i < 4; ++i) palette[i] = uint32_t(kOfFirst[rule][i]) * first + uint32_t(kOfSecond[rule][i]) * second;
    return palette;
}

template <class Word>
HWY_INLINE void store(std::byte* texels, int i, Word word) {
    std::memcpy(texels + size_t(i) * sizeof(Word), &word, sizeof(Word));
}

HWY_INLINE size_t colour_index(const ColourBlock& block, int texel) { return (block.indices >> (2 * texel)) & 3; }

template <bool has_alpha>
HWY_INLINE void decode_bc1(const std::byte* block, std::byte* texels) {
    const ColourBlock colour(block);
    auto palette = palette_of(spread_endpoint(colour.first), spread_endpoint(colour.second), colour.four_colours());
    for (size_t i = 0; has_alpha && i < 4; ++i) palette[i] |= uint32_t(kBc1Alpha[colour.four_colours()][i]);
    for (int i = 0; i < 16; ++i) store(texels, i, palette[colour_index(colour, i)]);
}

HWY_INLINE void decode_bc2_block(const std::byte* block, std::byte* texels) {
    const uint64_t alphas = load<uint64_t>(block);
    const ColourBlock colour(block + 8);
    const auto palette = palette_of(spread_endpoint(colour.first), spread_endpoint(colour.second), kFourColours);
    for (int i = 0; i < 16; ++i) {
        const uint32_t alpha = uint32_t(alphas >> (4 * i)) & 15;
        store(texels, i, palette[colour_index(colour, i)] | (alpha << kBc1AlphaShift));
    }
}

HWY_INLINE void decode_bc3_block(const std::byte* block, std::byte* texels) {
    const ValueBlock alpha = read_unsigned_values(block);
    const ColourBlock colour(block + 8);
    const auto red_green = palette_of(spread_red_green(colour.first), spread_red_green(colour.second), kFourColours);
    const auto blue = palette_of(spread_blue(colour.first), spread_blue(colour.second), kFourColours);
    for (int i = 0; i < 16; ++i) {
        const size_t index = colour_index(colour, i);
        store(texels, i, red_green[index] | (uint64_t{blue[index]} << 32) | (uint64_t{alpha.value(i)} << 48));
    }
}

#endif  // RAWTEXEL_BC_LANES

void decode_opaque(const std::byte* block, std::byte* texels) { decode_bc1<false>(block, texels); }
void decode_transparent(const std::byte* block, std::byte* texels) { decode_bc1<true>(block, texels); }
void decode_explicit(const std::byte* block, std::byte* texels) { decode_bc2_block(block, texels); }
void decode_interpolated(const std::byte* block, std::byte* texels) { decode_bc3_block(block, texels); }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rawtexel::texunit {
namespace {
HWY_EXPORT(decode_opaque);
HWY_EXPORT(decode_transparent);
HWY_EXPORT(decode_explicit);
HWY_EXPORT(decode_interpolated);
}  // namespace

void decode_bc1_rgb(const std::byte* block, std::byte* texels) { HWY_DYNAMIC_DISPATCH(decode_opaque)(block, texels); }
void decode_bc1_rgba(const std::byte* block, std::byte* texels) { HWY_DYNAMIC_DISPATCH(decode_transparent)(block, texels); }
void decode_bc2(const std::byte* block, std::byte* texels) { HWY_DYNAMIC_DISPATCH(decode_explicit)(block, texels); }
void decode_bc3(const std::byte* block, std::byte* texels) { HWY_DYNAMIC_DISPATCH(decode_interpolated)(block, texels); }

}  // namespace rawtexel::texunit
#endif
