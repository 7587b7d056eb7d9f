#version 450
#extension GL_GOOGLE_include_directive : require
// The device's own texture unit, asked for every case of suite hardware: the runner binds the case's image and sampler. Four neighbouring
// lanes ask each case together, as the 2x2 pixels of a quad would: some devices take footprints from the differences between lanes, whatever
// gradients they are given. The answer is that of the upper left one.
#include "contract.glsl"

layout(set = 0, binding = 5) uniform sampler2D flat_image;
layout(set = 0, binding = 6) uniform sampler2DArray array_image;
layout(set = 0, binding = 7) uniform samplerCube cube_image;
layout(set = 0, binding = 8) uniform sampler3D volume_image;

vec4 ask(TextureShape t, vec3 at, float layer, vec3 dx, vec3 dy) {
    if (t.cube) return textureGrad(cube_image, at, dx, dy);
    if (t.extent.z > 1) return textureGrad(volume_image, at, dx, dy);
    if (t.layers > 1) return textureGrad(array_image, vec3(at.xy, layer), dx.xy, dy.xy);
    return textureGrad(flat_image, at.xy, dx.xy, dy.xy);
}

void main() {
    uint lane = gl_GlobalInvocationID.x, first_of_quad = lane & ~3u;
    vec2 pixel = vec2(lane & 1u, lane >> 1 & 1u);
    // Compilers that cannot tell how often the loop runs do not write it out four times, once for each kind of image.
    for (uint turn = 0u; turn < min(4u, case_count); ++turn) {
        uint index = first_case + min(first_of_quad + turn, case_count - 1u);
        vec3 at = case_vec3(index, CASE_AT), dx = case_vec3(index, CASE_DX), dy = case_vec3(index, CASE_DY);
        Result r = no_result();
        r.value = ask(texture_shape(case_uint(index, CASE_TEXTURE)), at + pixel.x * dx + pixel.y * dy, case_float(index, CASE_LAYER), dx, dy);
        if (lane == first_of_quad && lane + turn < case_count) write_result(index, r);
    }
}
