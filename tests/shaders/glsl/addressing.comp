#version 450
#extension GL_GOOGLE_include_directive : require
// The port of suite addressing: indices and coordinates wrapped.
#include "lookup.glsl"

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= case_count) return;
    index += first_case;
    uint op = case_uint(index, 0u);
    Result r = no_result();
    if (op == OP_SAMPLE) r = filter_case(index);
    if (op == OP_WRAP_INDEX) r.texel.x = wrap_index(case_uint(index, 2u), case_int(index, 45u), case_int(index, 46u));
    write_result(index, r);
}
