#version 450
#extension GL_GOOGLE_include_directive : require
// The port of suite noise: numbers of two dimensions.
#include "each_case.glsl"
#include "noise.glsl"

Result answer(uint op, uint index) {
    Result r = no_result();
    if (op == OP_NOISE_PAIR) {
        RandomAddress a = RandomAddress(uvec2(case_uint(index, CASE_PIXEL_X), case_uint(index, CASE_PIXEL_Y)), case_uint(index, CASE_SAMPLE),
                                        case_uint(index, CASE_SURFACE), case_uint(index, CASE_DIMENSION), case_uint(index, CASE_SEED));
        uvec2 bits = noise_pair(case_uint(index, CASE_NOISE), a, case_uint(index, CASE_SECOND_DIMENSION));
        r.value = vec4(unit_float(bits.x), unit_float(bits.y), 0.0, 0.0);
    }
    return r;
}
