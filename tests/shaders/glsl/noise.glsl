// Noises: how the numbers of an address are related over the samples of a pixel and over neighbouring pixels. The masks of blue and stbn are
// the ranks in the suite's words (docs/porting.md): stbn's two of 64*64*32, then blue's two of 128*128.
#ifndef NOISE_GLSL
#define NOISE_GLSL
#include "contract.glsl"
#include "random.glsl"

const uint NOISE_WHITE = 0u, NOISE_SOBOL = 1u, NOISE_R2 = 2u, NOISE_BLUE = 3u, NOISE_STBN = 4u;

// Owen's nested uniform scrambling of numbers whose bits are reversed (Laine and Karras; Vegdahl's constants).
uint scramble_reversed(uint bits, uint seed) {
    bits ^= bits * 0x3D20ADEAu;
    bits += seed;
    bits *= seed >> 16 | 1u;
    bits ^= bits * 0x05526C56u;
    return bits ^ bits * 0x53A22864u;
}

// The second dimension of Sobol's sequence, bits reversed: binomials mod 2.
uint second_sobol(uint index) {
    index ^= index >> 1 & 0x55555555u;
    index ^= index >> 2 & 0x33333333u;
    index ^= index >> 4 & 0x0F0F0F0Fu;
    index ^= index >> 8 & 0x00FF00FFu;
    return index ^ (index >> 16 & 0x0000FFFFu);
}

uint pixel_bits(RandomAddress a, uint dimension, uint sample_index) {
    a.dimension = dimension;
    a.sample_index = sample_index;
    return random_bits(a);
}

uvec2 sobol_pair(RandomAddress a) {
    uint key = pixel_bits(a, a.dimension, 0u);
    uint index = bitfieldReverse(scramble_reversed(bitfieldReverse(a.sample_index), key));
    uint key_a = mix_bits(~key), key_b = mix_bits(~key_a);
    return uvec2(bitfieldReverse(scramble_reversed(index, key_a)), bitfieldReverse(scramble_reversed(second_sobol(index), key_b)));
}

// Steps of the Kronecker sequences in units of 2^-32, by dimension.
const uint KRONECKER_STEPS[16] = uint[16](3242174889u, 2447445413u, 0x381124E3u, 0x69A03383u, 0x6B91306Bu, 2654435769u, 0xA4103207u, 0x72B19DBBu,
                                          0x8F7D0B45u, 0x4B76AC7Bu, 0x633D2267u, 0x9BA82E39u, 0x3A90FDEFu, 0x5F015069u, 0x3687BC87u, 0x4F8CFF13u);

uint kronecker_offset(RandomAddress a, uint dimension) {
    uint step_ = KRONECKER_STEPS[dimension % 16u], order = a.surface ^ dimension / 16u * RANDOM_START;
    if (order == 0u) return a.sample_index * step_;
    uint key = mix_bits(mix_bits(RANDOM_START ^ a.seed) ^ order);
    return bitfieldReverse(scramble_reversed(bitfieldReverse(a.sample_index), key)) * step_;
}

struct Mask {
    uint first_word, extent_bits, rank_bits;
};
const uint STBN_DEPTH = 32u;

uvec2 mask_pair(Mask mask, RandomAddress a, uint period, uint sample_in_period) {
    uint shift = mix_bits(mix_bits(mix_bits(RANDOM_START ^ a.seed) + period) ^ a.surface);
    uint own = mix_bits(shift ^ (a.dimension + 1u) * RANDOM_START);
    uint cell_bits = mask.extent_bits - 2u, half_cell = (1u << (cell_bits - 1u)) - 1u, wrap = (1u << mask.extent_bits) - 1u;
    uint slices = (1u << (mask.rank_bits - 2u * mask.extent_bits)) - 1u;
    uint x = a.pixel.x + shift + ((a.dimension & 3u) << cell_bits) + (own & half_cell);
    uint y = a.pixel.y + (shift >> 16) + ((a.dimension >> 2 & 3u) << cell_bits) + (own >> 8 & half_cell);
    uint slice = (own >> 16) + sample_in_period & slices;
    uint at = (x & wrap) + ((y & wrap) << mask.extent_bits) + (slice << 2u * mask.extent_bits);
    // White bits fill up the ranks.
    uint white = mix_bits(a.pixel.x + (a.pixel.y << 16) ^ mix_bits(mix_bits(own) ^ sample_in_period));
    uint size = 1u << mask.rank_bits, up = 32u - mask.rank_bits;
    uint first = stored_words[mask.first_word + at] << up | white >> mask.rank_bits;
    uint second = stored_words[mask.first_word + size + at] << up | mix_bits(white) >> mask.rank_bits;
    // Half of the places run downwards.
    return uvec2(first ^ (0u - (own >> 30 & 1u)), second ^ (0u - (own >> 31)));
}

// Bits of the numbers of two dimensions that are used together.
uvec2 noise_pair(uint noise, RandomAddress a, uint second) {
    if (noise == NOISE_SOBOL) return sobol_pair(a);
    if (noise == NOISE_STBN) {
        return mask_pair(Mask(0u, 6u, 17u), a, a.sample_index / STBN_DEPTH, a.sample_index % STBN_DEPTH);
    }
    uvec2 offset = uvec2(kronecker_offset(a, a.dimension), kronecker_offset(a, second));
    if (noise == NOISE_BLUE) return mask_pair(Mask(262144u, 7u, 14u), a, 0u, 0u) + offset;
    if (noise == NOISE_R2) return uvec2(pixel_bits(a, a.dimension, 0u), pixel_bits(a, second, 0u)) + offset;
    return uvec2(pixel_bits(a, a.dimension, a.sample_index), pixel_bits(a, second, a.sample_index));
}

#endif
