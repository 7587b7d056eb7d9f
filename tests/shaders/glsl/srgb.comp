#version 450
#extension GL_GOOGLE_include_directive : require
// The port of suite srgb: codes decoded and encoded, and filtered.
#include "lookup.glsl"
#include "srgb.glsl"

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= case_count) return;
    index += first_case;
    uint op = case_uint(index, 0u);
    Result r = no_result();
    if (op == OP_SAMPLE) r = filter_case(index);
    if (op == OP_SRGB_DECODE) r.value.x = srgb_to_linear(float(case_int(index, 45u)) / 255.0);
    if (op == OP_SRGB_ENCODE) r.bits = encode_srgb8(case_float(index, 25u));
    write_result(index, r);
}
