#version 450
#extension GL_GOOGLE_include_directive : require
// The port of suite positivization: kernels with negative lobes, drawn.
#include "each_case.glsl"
#include "draw.glsl"

Result answer(uint op, uint index) {
    if (op == OP_DRAW) return draw_case(index);
    return no_result();
}
