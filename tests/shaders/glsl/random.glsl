// Random numbers by address: a number is a hash of (pixel, sample, surface, dimension, seed), never the next of a stream.
#ifndef RANDOM_GLSL
#define RANDOM_GLSL

const uint DIMENSION_TAP_X = 2u, DIMENSION_TAP_Y = 3u, DIMENSION_TAP_Z = 4u, DIMENSION_LEVEL = 5u, DIMENSION_PROBE = 6u, DIMENSION_SIGN = 7u,
           DIMENSION_PLANE = 11u, DIMENSION_NEGATIVE_X = 12u, DIMENSION_NEGATIVE_Y = 13u, DIMENSION_NEGATIVE_Z = 14u,
           DIMENSION_NEGATIVE_SIGN = 15u;

const uint RANDOM_START = 0x9E3779B9u;

struct RandomAddress {
    uvec2 pixel;
    uint sample_index, surface, dimension, seed;
};

// Wellons' lowbias32.
uint mix_bits(uint bits) {
    bits = (bits ^ bits >> 16) * 0x7FEB352Du;
    bits = (bits ^ bits >> 15) * 0x846CA68Bu;
    return bits ^ bits >> 16;
}

uint spread_dimension(uint dimension) { return (dimension + 1u) * RANDOM_START; }

uint random_state(uint seed, uint sample_index, uint surface, uint dimension) {
    uint state = mix_bits(mix_bits(RANDOM_START ^ seed) ^ sample_index);
    return mix_bits(mix_bits(state ^ surface) ^ spread_dimension(dimension));
}

uint random_bits(RandomAddress a) {
    return mix_bits(mix_bits(random_state(a.seed, a.sample_index, a.surface, a.dimension) ^ a.pixel.x) ^ a.pixel.y);
}

// In [0, 1): the upper 24 bits. All 32 would round up to 1.
float unit_float(uint bits) { return float(bits >> 8) * (1.0 / 16777216.0); }

float random_float(RandomAddress a, uint dimension) {
    a.dimension = dimension;
    return unit_float(random_bits(a));
}

#endif
