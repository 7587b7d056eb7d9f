#version 450
#extension GL_GOOGLE_include_directive : require
// The port of suite srgb: codes decoded and encoded, and filtered.
#include "each_case.glsl"
#include "lookup.glsl"
#include "srgb.glsl"

Result answer(uint op, uint index) {
    Result r = no_result();
    if (op == OP_SAMPLE) r = filter_case(index);
    if (op == OP_SRGB_DECODE) r.value.x = srgb_to_linear(float(case_int(index, CASE_INDEX)) / 255.0);
    if (op == OP_SRGB_ENCODE) r.bits = encode_srgb8(case_float(index, CASE_AT));
    return r;
}
