#version 450
#extension GL_GOOGLE_include_directive : require
// The port of suite lod: levels of detail.
#include "each_case.glsl"
#include "lookup.glsl"

Result answer(uint op, uint index) {
    if (op == OP_SAMPLE) return filter_case(index);
    return no_result();
}
