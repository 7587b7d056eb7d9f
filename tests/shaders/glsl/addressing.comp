#version 450
#extension GL_GOOGLE_include_directive : require
// The port of suite addressing: indices and coordinates wrapped.
#include "each_case.glsl"
#include "lookup.glsl"

Result answer(uint op, uint index) {
    Result r = no_result();
    if (op == OP_SAMPLE) r = filter_case(index);
    if (op == OP_WRAP_INDEX) r.texel.x = wrap_index(case_uint(index, CASE_WRAP_S), case_int(index, CASE_INDEX), case_int(index, CASE_EXTENT));
    return r;
}
