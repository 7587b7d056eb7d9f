// Random numbers by address: a number is a hash of (pixel, sample, surface, dimension, seed), never the next of a stream.
const DIMENSION_TAP_X: u32 = 2u;
const DIMENSION_TAP_Y: u32 = 3u;
const DIMENSION_TAP_Z: u32 = 4u;
const DIMENSION_LEVEL: u32 = 5u;
const DIMENSION_PROBE: u32 = 6u;
const DIMENSION_SIGN: u32 = 7u;
const DIMENSION_PLANE: u32 = 11u;
const DIMENSION_NEGATIVE_X: u32 = 12u;
const DIMENSION_NEGATIVE_Y: u32 = 13u;
const DIMENSION_NEGATIVE_Z: u32 = 14u;
const DIMENSION_NEGATIVE_SIGN: u32 = 15u;
const RANDOM_START: u32 = 0x9E3779B9u;

struct RandomAddress {
    pixel: vec2u,
    sample_index: u32,
    surface: u32,
    dimension: u32,
    seed: u32,
}

// Wellons' lowbias32.
fn mix_bits(bits_given: u32) -> u32 {
    var bits = bits_given;
    bits = (bits ^ (bits >> 16)) * 0x7FEB352Du;
    bits = (bits ^ (bits >> 15)) * 0x846CA68Bu;
    return bits ^ (bits >> 16);
}

fn spread_dimension(dimension: u32) -> u32 {
    return (dimension + 1u) * RANDOM_START;
}

fn random_state(seed: u32, sample_index: u32, surface: u32, dimension: u32) -> u32 {
    let state: u32 = mix_bits(mix_bits(RANDOM_START ^ seed) ^ sample_index);
    return mix_bits(mix_bits(state ^ surface) ^ spread_dimension(dimension));
}

fn random_bits(a: RandomAddress) -> u32 {
    return mix_bits(mix_bits(random_state(a.seed, a.sample_index, a.surface, a.dimension) ^ a.pixel.x) ^ a.pixel.y);
}

// In [0, 1): the upper 24 bits. All 32 would round up to 1.
fn unit_float(bits: u32) -> f32 {
    return f32(bits >> 8) * (1.0 / 16777216.0);
}

fn random_float(a_given: RandomAddress, dimension: u32) -> f32 {
    var a = a_given;
    a.dimension = dimension;
    return unit_float(random_bits(a));
}
