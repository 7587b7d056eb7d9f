#version 450
#extension GL_GOOGLE_include_directive : require
// The port of suite random-numbers: hashes of addresses.
#include "draw.glsl"

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= case_count) return;
    index += first_case;
    uint op = case_uint(index, 0u);
    Result r = no_result();
    if (op == OP_RANDOM) {
        r.bits = random_bits(case_address(index));
        r.value.x = unit_float(r.bits);
    }
    write_result(index, r);
}
