#version 450
#extension GL_GOOGLE_include_directive : require
// A first try at a bilinear sampler, with two faults that docs/porting.md lets verify-shader find.
#include "../glsl/contract.glsl"

int my_wrap(uint wrap, int i, int n) {
    if (wrap == WRAP_REPEAT) return ((i % n) + n) % n;
    if (wrap == WRAP_MIRROR) {
        int m = ((i % (2 * n)) + 2 * n) % (2 * n);
        return m < n ? m : 2 * n - m;
    }
    if (wrap == WRAP_CLAMP) return clamp(i, 0, n - 1);
    if (wrap == WRAP_BORDER) return i < 0 || i >= n ? -1 : i;
    return min(i < 0 ? -1 - i : i, n - 1);
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= case_count) return;
    index += first_case;
    Result r = no_result();
    if (case_uint(index, CASE_OP) == OP_WRAP_INDEX) r.texel.x = my_wrap(case_uint(index, CASE_WRAP_S), case_int(index, CASE_INDEX), case_int(index, CASE_EXTENT));
    if (case_uint(index, CASE_OP) == OP_SAMPLE) {
        TextureShape t = texture_shape(case_uint(index, CASE_TEXTURE));
        vec2 at = case_vec3(index, CASE_AT).xy * vec2(t.extent.xy);
        uint wrap_s = case_uint(index, CASE_WRAP_S), wrap_t = case_uint(index, CASE_WRAP_T);
        bool nearest = case_uint(index, CASE_MINIFY) == 0u;
        vec2 corner = nearest ? floor(at) : floor(at - 0.5), f = nearest ? vec2(0.0) : at - 0.5 - corner;
        for (int k = 0; k < (nearest ? 1 : 4); ++k) {
            int x = my_wrap(wrap_s, int(corner.x) + k % 2, t.extent.x), y = my_wrap(wrap_t, int(corner.y) + k / 2, t.extent.y);
            float weight = (k % 2 == 0 ? 1.0 - f.x : f.x) * (k / 2 == 0 ? 1.0 - f.y : f.y);
            bool border = x < 0 || y < 0;
            vec4 outside = vec4(case_vec3(index, CASE_BORDER), case_float(index, CASE_BORDER + 3u));
            r.value += weight * (border ? outside : texel_at(t, 0, 0, x, y));
            if (nearest) r.texel = border ? ivec4(-1, -1, 0, 0) : ivec4(x, y, 0, 0);
        }
    }
    write_result(index, r);
}
