#version 450
#extension GL_GOOGLE_include_directive : require
// The port of suite random-numbers: hashes of addresses.
#include "each_case.glsl"
#include "draw.glsl"

Result answer(uint op, uint index) {
    Result r = no_result();
    if (op == OP_RANDOM) {
        r.bits = random_bits(case_address(index));
        r.value.x = unit_float(r.bits);
    }
    return r;
}
