#version 450
#extension GL_GOOGLE_include_directive : require
// The device's own texture unit, asked for every case of suite hardware: the runner binds the case's image and sampler. Four neighbouring
// lanes ask each case together, as the 2x2 pixels of a quad would: some devices take footprints from the differences between lanes, whatever
// gradients they are given. The answer is that of the upper left one.
#include "contract.glsl"

layout(set = 0, binding = 5) uniform sampler2D image;

void main() {
    uint lane = gl_GlobalInvocationID.x, first_of_quad = lane & ~3u;
    vec2 pixel = vec2(lane & 1u, lane >> 1 & 1u);
    for (uint turn = 0u; turn < 4u; ++turn) {
        uint index = first_case + min(first_of_quad + turn, case_count - 1u);
        vec2 at = case_vec3(index, 25u).xy, dx = case_vec3(index, 28u).xy, dy = case_vec3(index, 31u).xy;
        Result r = no_result();
        r.value = textureGrad(image, at + pixel.x * dx + pixel.y * dy, dx, dy);
        if (lane == first_of_quad && lane + turn < case_count) write_result(index, r);
    }
}
