#version 450
#extension GL_GOOGLE_include_directive : require
// The port of suite elliptical: ellipses, weighed and drawn.
#include "draw.glsl"

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= case_count) return;
    index += first_case;
    uint op = case_uint(index, 0u);
    Result r = no_result();
    if (op == OP_SAMPLE) r = filter_case(index);
    if (op == OP_DRAW) r = draw_case(index);
    write_result(index, r);
}
