// Noises: how the numbers of an address are related over the samples of a pixel and over neighbouring pixels. The masks of blue and stbn are
// the ranks in the suite's words (docs/porting.md): stbn's two of 64*64*32, then blue's two of 128*128.
// include "contract.wgsl"
// include "random.wgsl"

const NOISE_WHITE: u32 = 0u;
const NOISE_SOBOL: u32 = 1u;
const NOISE_R2: u32 = 2u;
const NOISE_BLUE: u32 = 3u;
const NOISE_STBN: u32 = 4u;

// Owen's nested uniform scrambling of numbers whose bits are reversed (Laine and Karras; Vegdahl's constants).
fn scramble_reversed(bits_given: u32, seed: u32) -> u32 {
    var bits = bits_given;
    bits ^= bits * 0x3D20ADEAu;
    bits += seed;
    bits *= (seed >> 16) | 1u;
    bits ^= bits * 0x05526C56u;
    return bits ^ (bits * 0x53A22864u);
}

// The second dimension of Sobol's sequence, bits reversed: binomials mod 2.
fn second_sobol(index_given: u32) -> u32 {
    var index = index_given;
    index ^= (index >> 1) & 0x55555555u;
    index ^= (index >> 2) & 0x33333333u;
    index ^= (index >> 4) & 0x0F0F0F0Fu;
    index ^= (index >> 8) & 0x00FF00FFu;
    return index ^ ((index >> 16) & 0x0000FFFFu);
}

fn pixel_bits(a_given: RandomAddress, dimension: u32, sample_index: u32) -> u32 {
    var a = a_given;
    a.dimension = dimension;
    a.sample_index = sample_index;
    return random_bits(a);
}

fn sobol_pair(a: RandomAddress) -> vec2u {
    let key: u32 = pixel_bits(a, a.dimension, 0u);
    let index: u32 = reverseBits(scramble_reversed(reverseBits(a.sample_index), key));
    let key_a: u32 = mix_bits(~key);
    let key_b: u32 = mix_bits(~key_a);
    return vec2u(reverseBits(scramble_reversed(index, key_a)), reverseBits(scramble_reversed(second_sobol(index), key_b)));
}

// Steps of the Kronecker sequences in units of 2^-32, by dimension.
const KRONECKER_STEPS: array<u32, 16> = array<u32, 16>(3242174889u, 2447445413u, 0x381124E3u, 0x69A03383u, 0x6B91306Bu, 2654435769u, 0xA4103207u, 0x72B19DBBu, 0x8F7D0B45u, 0x4B76AC7Bu, 0x633D2267u, 0x9BA82E39u, 0x3A90FDEFu, 0x5F015069u, 0x3687BC87u, 0x4F8CFF13u);

fn kronecker_offset(a: RandomAddress, dimension: u32) -> u32 {
    let step_: u32 = KRONECKER_STEPS[dimension % 16u];
    let order: u32 = a.surface ^ ((dimension / 16u) * RANDOM_START);
    if (order == 0u) {
        return a.sample_index * step_;
    }
    let key: u32 = mix_bits(mix_bits(RANDOM_START ^ a.seed) ^ order);
    return reverseBits(scramble_reversed(reverseBits(a.sample_index), key)) * step_;
}

struct Mask {
    first_word: u32,
    extent_bits: u32,
    rank_bits: u32,
}
const STBN_DEPTH: u32 = 32u;

fn mask_pair(mask: Mask, a: RandomAddress, period: u32, sample_in_period: u32) -> vec2u {
    let shift: u32 = mix_bits(mix_bits(mix_bits(RANDOM_START ^ a.seed) + period) ^ a.surface);
    let own: u32 = mix_bits(shift ^ ((a.dimension + 1u) * RANDOM_START));
    let cell_bits: u32 = mask.extent_bits - 2u;
    let half_cell: u32 = (1u << u32(cell_bits - 1u)) - 1u;
    let wrap: u32 = (1u << u32(mask.extent_bits)) - 1u;
    let slices: u32 = (1u << u32(mask.rank_bits - (2u * mask.extent_bits))) - 1u;
    let x: u32 = ((a.pixel.x + shift) + ((a.dimension & 3u) << u32(cell_bits))) + (own & half_cell);
    let y: u32 = ((a.pixel.y + (shift >> 16)) + (((a.dimension >> 2) & 3u) << u32(cell_bits))) + ((own >> 8) & half_cell);
    let slice: u32 = ((own >> 16) + sample_in_period) & slices;
    let at: u32 = ((x & wrap) + ((y & wrap) << u32(mask.extent_bits))) + (slice << u32(2u * mask.extent_bits));
    // White bits fill up the ranks.
    let white: u32 = mix_bits((a.pixel.x + (a.pixel.y << 16)) ^ mix_bits(mix_bits(own) ^ sample_in_period));
    let size: u32 = 1u << u32(mask.rank_bits);
    let up: u32 = 32u - mask.rank_bits;
    let first: u32 = (stored_words[mask.first_word + at] << u32(up)) | (white >> u32(mask.rank_bits));
    let second: u32 = (stored_words[(mask.first_word + size) + at] << u32(up)) | (mix_bits(white) >> u32(mask.rank_bits));
    // Half of the places run downwards.
    return vec2u(first ^ (0u - ((own >> 30) & 1u)), second ^ (0u - (own >> 31)));
}

// Bits of the numbers of two dimensions that are used together.
fn noise_pair(noise: u32, a: RandomAddress, second: u32) -> vec2u {
    if (noise == NOISE_SOBOL) {
        return sobol_pair(a);
    }
    if (noise == NOISE_STBN) {
        return mask_pair(Mask(0u, 6u, 17u), a, a.sample_index / STBN_DEPTH, a.sample_index % STBN_DEPTH);
    }
    let offset: vec2u = vec2u(kronecker_offset(a, a.dimension), kronecker_offset(a, second));
    if (noise == NOISE_BLUE) {
        return mask_pair(Mask(262144u, 7u, 14u), a, 0u, 0u) + offset;
    }
    if (noise == NOISE_R2) {
        return vec2u(pixel_bits(a, a.dimension, 0u), pixel_bits(a, second, 0u)) + offset;
    }
    return vec2u(pixel_bits(a, a.dimension, a.sample_index), pixel_bits(a, second, a.sample_index));
}
