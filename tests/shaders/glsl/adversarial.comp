#version 450
#extension GL_GOOGLE_include_directive : require
// The port of suite adversarial: the known pitfalls.
#include "each_case.glsl"
#include "draw.glsl"

Result answer(uint op, uint index) {
    Result r = no_result();
    if (op == OP_SAMPLE || op == OP_SHADE) r = filter_case(index);
    if (op == OP_DRAW || op == OP_MEAN) r = draw_case(index);
    if (op == OP_RANDOM) {
        r.bits = random_bits(case_address(index));
        r.value.x = unit_float(r.bits);
    }
    return r;
}
