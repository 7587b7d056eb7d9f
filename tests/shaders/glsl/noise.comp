#version 450
#extension GL_GOOGLE_include_directive : require
// The port of suite noise: numbers of two dimensions.
#include "each_case.glsl"
#include "noise.glsl"

Result answer(uint op, uint index) {
    Result r = no_result();
    if (op == OP_NOISE_PAIR) {
        RandomAddress a = RandomAddress(uvec2(case_uint(index, 47u), case_uint(index, 48u)), case_uint(index, 49u), case_uint(index, 50u),
                                        case_uint(index, 51u), case_uint(index, 52u));
        uvec2 bits = noise_pair(case_uint(index, 53u), a, case_uint(index, 54u));
        r.value = vec4(unit_float(bits.x), unit_float(bits.y), 0.0, 0.0);
    }
    return r;
}
