#version 450
#extension GL_GOOGLE_include_directive : require
// The port of suite triplanar: planes, weighed and drawn.
#include "each_case.glsl"
#include "triplanar.glsl"

Result answer(uint op, uint index) {
    Result r = no_result();
    if (op == OP_PLANE) {
        vec3 weights = plane_weights(case_vec3(index, CASE_AT), case_uint(index, CASE_COUNT));
        r.texel.x = draw_plane(weights, case_float(index, CASE_NUMBER_X));
        r.value = vec4(weights, 0.0);
    }
    return r;
}
