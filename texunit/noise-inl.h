// The numbers of a wave by any noise. Meaning: texunit/noise.h, whose doors call these for the chosen instruction set.
#include "texunit/noise.h"
#include "texunit/noise_sequence.h"
#include "texunit/random-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_NOISE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_NOISE_INL_H_
#undef RAWTEXEL_TEXUNIT_NOISE_INL_H_
#else
#define RAWTEXEL_TEXUNIT_NOISE_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using NoiseTag = hn::ScalableTag<uint32_t>;
using NoiseVector = hn::Vec<NoiseTag>;  ///< 32 bits a lane, of which the top 24 are the number

HWY_INLINE NoiseVector noise_set(uint32_t value) { return hn::Set(NoiseTag(), value); }

template <int kBits>
HWY_INLINE NoiseVector swap_neighbours(NoiseVector bits, uint32_t lower) {
    const auto mask = noise_set(lower);
    return hn::Or(hn::ShiftLeft<kBits>(hn::And(bits, mask)), hn::And(hn::ShiftRight<kBits>(bits), mask));
}

HWY_INLINE NoiseVector reverse_bits_v(NoiseVector bits) {
    bits = swap_neighbours<1>(bits, 0x55555555u);
    bits = swap_neighbours<2>(bits, 0x33333333u);
    bits = swap_neighbours<4>(bits, 0x0F0F0F0Fu);
    bits = swap_neighbours<8>(bits, 0x00FF00FFu);
    return hn::Or(hn::ShiftLeft<16>(bits), hn::ShiftRight<16>(bits));
}

HWY_INLINE NoiseVector scramble_reversed_v(NoiseVector bits, NoiseVector seed) {
    bits = hn::Xor(bits, hn::Mul(bits, noise_set(0x3D20ADEAu)));
    bits = hn::Add(bits, seed);
    bits = hn::Mul(bits, hn::Or(hn::ShiftRight<16>(seed), noise_set(1)));
    bits = hn::Xor(bits, hn::Mul(bits, noise_set(0x05526C56u)));
    return hn::Xor(bits, hn::Mul(bits, noise_set(0x53A22864u)));
}

/// The state that all pixels share at one sample, or for all samples at number 0.
HWY_INLINE uint32_t shared_state(const RandomAddress& first, Dimension dimension, uint32_t sample) {
    return random_state(first.seed, sample, first.surface, dimension);
}

/// The first two dimensions of Sobol's sequence, their order and their values scrambled for each pixel by keys of its own.
struct SobolSource {
    explicit SobolSource(const RandomAddress& address) : first(address), reversed_sample(reverse_bits(address.sample)) {}

    HWY_INLINE NoiseVector key_of(NoiseVector x, NoiseVector y) const {
        return random_bits_v(shared_state(first, first.dimension, 0), x, y);
    }
    /// The number in the sequence. Its bits are those of the first dimension's number reversed.
    HWY_INLINE NoiseVector index(NoiseVector key) const { return reverse_bits_v(scramble_reversed_v(noise_set(reversed_sample), key)); }
    HWY_INLINE static NoiseVector value(NoiseVector reversed, NoiseVector key) {
        return reverse_bits_v(scramble_reversed_v(reversed, key));
    }

    template <int kShift>
    HWY_INLINE static NoiseVector add_upper(NoiseVector bits, uint32_t lower) {
        return hn::Xor(bits, hn::And(hn::ShiftRight<kShift>(bits), noise_set(lower)));
    }
    /// The reversed bits of the second dimension: the matrix of binomials mod 2, a Kronecker power of ((1, 1), (0, 1)).
    HWY_INLINE static NoiseVector second_dimension(NoiseVector index) {
        index = add_upper<1>(index, 0x55555555u);
        index = add_upper<2>(index, 0x33333333u);
        index = add_upper<4>(index, 0x0F0F0F0Fu);
        index = add_upper<8>(index, 0x00FF00FFu);
        return add_upper<16>(index, 0x0000FFFFu);
    }

    HWY_INLINE NoiseVector one(NoiseVector x, NoiseVector y) const {
        const auto key = key_of(x, y);
        return value(index(key), mix_bits_v(hn::Not(key)));
    }
    HWY_INLINE void pair(NoiseVector x, NoiseVector y, NoiseVector& a, NoiseVector& b) const {
        const auto key = key_of(x, y), at = index(key), key_a = mix_bits_v(hn::Not(key));
        a = value(at, key_a);
        b = value(second_dimension(at), mix_bits_v(hn::Not(key_a)));
    }

    const RandomAddress& first;
    uint32_t reversed_sample;
};

/// Kronecker sequences that start at random.
struct R2Source {
    const RandomAddress& first;
    Dimension second;

    HWY_INLINE NoiseVector of(NoiseVector x, NoiseVector y, Dimension dimension) const {
        const auto start = random_bits_v(shared_state(first, dimension, 0), x, y);
        return hn::Add(start, noise_set(kronecker_offset(first, dimension)));
    }
    HWY_INLINE NoiseVector one(NoiseVector x, NoiseVector y) const { return of(x, y, first.dimension); }
    HWY_INLINE void pair(NoiseVector x, NoiseVector y, NoiseVector& a, NoiseVector& b) const {
        a = of(x, y, first.dimension), b = of(x, y, second);
    }
};

/// A mask's entries at the pixels, and white bits to fill up the ranks.
struct MaskEntries {
    MaskEntries(const NoiseMask& of_noise, const RandomAddress& first, uint32_t period, uint32_t sample_in_period)
        : mask(of_noise), place(place_in_mask(mask, first, period)) {
        const uint32_t slices = (1u << (mask.rank_bits - 2 * mask.extent_bits)) - 1;
        slice = ((place.slice + sample_in_period) & slices) << (2 * mask.extent_bits);
        key = mix_bits(place.key ^ sample_in_period);
    }

    HWY_INLINE hn::Vec<hn::RebindToSigned<NoiseTag>> entry(NoiseVector x, NoiseVector y) const {
        const auto wrap = noise_set((1u << mask.extent_bits) - 1);
        const auto column = hn::And(hn::Add(x, noise_set(place.x)), wrap), row = hn::And(hn::Add(y, noise_set(place.y)), wrap);
        const auto in_slice = hn::Add(column, hn::ShiftLeftSame(row, mask.extent_bits));
        return hn::BitCast(hn::RebindToSigned<NoiseTag>(), hn::Add(in_slice, noise_set(slice)));
    }
    HWY_INLINE NoiseVector white_bits(NoiseVector x, NoiseVector y) const {
        return mix_bits_v(hn::Xor(hn::Add(x, hn::ShiftLeft<16>(y)), noise_set(key)));
    }
    /// Ranks on top of the upper bits of `white`.
    template <class Entries>
    HWY_INLINE NoiseVector number(std::span<const uint32_t> ranks, Entries at, NoiseVector white, uint32_t flip) const {
        const auto rank = hn::GatherIndex(NoiseTag(), ranks.data(), at);
        const auto low = hn::ShiftRightSame(white, mask.rank_bits);
        return hn::Xor(hn::Or(hn::ShiftLeftSame(rank, 32 - mask.rank_bits), low), noise_set(flip));
    }
    HWY_INLINE NoiseVector one(NoiseVector x, NoiseVector y) const {
        return number(mask.first, entry(x, y), white_bits(x, y), place.flip_a);
    }
    HWY_INLINE void pair(NoiseVector x, NoiseVector y, NoiseVector& a, NoiseVector& b) const {
        const auto at = entry(x, y);
        const auto white = white_bits(x, y);
        a = number(mask.first, at, white, place.flip_a);
        b = number(mask.second, at, mix_bits_v(white), place.flip_b);
    }

    const NoiseMask& mask;
    MaskPlace place;
    uint32_t slice;  ///< offset
    uint32_t key;
};

/// A mask at sample 0, from which Kronecker sequences start.
struct BlueSource {
    BlueSource(const RandomAddress& first, Dimension second)
        : starts(blue_mask(), first, 0, 0), offset_a(kronecker_offset(first, first.dimension)), offset_b(kronecker_offset(first, second)) {}

    HWY_INLINE NoiseVector one(NoiseVector x, NoiseVector y) const { return hn::Add(starts.one(x, y), noise_set(offset_a)); }
    HWY_INLINE void pair(NoiseVector x, NoiseVector y, NoiseVector& a, NoiseVector& b) const {
        starts.pair(x, y, a, b);
        a = hn::Add(a, noise_set(offset_a));
        b = hn::Add(b, noise_set(offset_b));
    }

    MaskEntries starts;
    uint32_t offset_a, offset_b;
};

/// A mask with one slice a sample, placed anew when its slices are used up.
struct StbnSource : MaskEntries {
    explicit StbnSource(const RandomAddress& first)
        : MaskEntries(stbn_mask(), first, first.sample / kStbnDepth, first.sample % kStbnDepth) {}
};

HWY_INLINE void store_number(NoiseVector bits, size_t i, WaveFloat& numbers) {
    hn::Store(unit_float_v(NoiseTag(), bits), hn::Rebind<float, NoiseTag>(), numbers.lane + i);
}

/// Calls number(i, x, y) with the pixels of lane i and of those that follow in a vector.
template <class Source>
HWY_INLINE void store_numbers(const RandomAddress& first, const Source& source, WaveFloat& numbers) {
    const NoiseTag d;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        store_number(source.one(columns_v(d, first.x, i), rows_v(d, first.y, i)), i, numbers);
    }
}
template <class Source>
HWY_INLINE void store_pairs(const RandomAddress& first, const Source& source, WaveFloat& a, WaveFloat& b) {
    const NoiseTag d;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        auto bits_a = hn::Zero(d), bits_b = hn::Zero(d);
        source.pair(columns_v(d, first.x, i), rows_v(d, first.y, i), bits_a, bits_b);
        store_number(bits_a, i, a);
        store_number(bits_b, i, b);
    }
}

/// Numbers without relation.
HWY_INLINE void white_lanes(const RandomAddress& first, Dimension dimension, WaveFloat& numbers) {
    random_wave(shared_state(first, dimension, first.sample), first.x, first.y, numbers);
}

/// noise_wave and noise_pair_wave for code that is compiled for this instruction set.
HWY_INLINE void noise_lanes(Noise noise, const RandomAddress& first, WaveFloat& numbers) {
    switch (noise) {
        case Noise::White: return white_lanes(first, first.dimension, numbers);
        case Noise::Sobol: return store_numbers(first, SobolSource(first), numbers);
        case Noise::R2: return store_numbers(first, R2Source{first, first.dimension}, numbers);
        case Noise::Blue: return store_numbers(first, BlueSource(first, first.dimension), numbers);
        case Noise::Stbn: return store_numbers(first, StbnSource(first), numbers);
    }
}
HWY_INLINE void noise_pair_lanes(Noise noise, const RandomAddress& first, Dimension second, WaveFloat& a, WaveFloat& b) {
    switch (noise) {
        case Noise::White: white_lanes(first, first.dimension, a); return white_lanes(first, second, b);
        case Noise::Sobol: return store_pairs(first, SobolSource(first), a, b);
        case Noise::R2: return store_pairs(first, R2Source{first, second}, a, b);
        case Noise::Blue: return store_pairs(first, BlueSource(first, second), a, b);
        case Noise::Stbn: return store_pairs(first, StbnSource(first), a, b);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_NOISE_INL_H_
