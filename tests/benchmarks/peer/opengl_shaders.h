// The shaders of the other side: glTF 2.0's metallic-roughness model, as shading/brdf.h has it, for one directional light.
#pragma once

namespace rawtexel::peer {

inline constexpr const char* kVertexShader = R"(
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec4 a_tangent;
layout(location = 3) in vec2 a_uv0;
layout(location = 4) in vec2 a_uv1;
layout(location = 5) in vec4 a_color;
uniform mat4 clip_from_world, world_from_object;
uniform mat3 normal_from_object;
out vec3 world, normal;
out vec4 tangent, color;
out vec2 uv0, uv1;
void main() {
    vec4 p = world_from_object * vec4(a_position, 1);
    world = p.xyz;
    normal = normal_from_object * a_normal;
    tangent = vec4(mat3(world_from_object) * a_tangent.xyz, a_tangent.w * sign(determinant(mat3(world_from_object))));
    uv0 = a_uv0, uv1 = a_uv1, color = a_color;
    gl_Position = clip_from_world * p;
})";

/// A program for each kind of material, as viewers compile them: FILTER 0 by the texture unit, 1 sixteen taps of a cubic B-spline, 2 one of
/// them, drawn; MAPS and UV1 are bits of the maps that there are and of those of texture coordinate set 1.
inline constexpr const char* kFragmentShader = R"(
in vec3 world, normal;
in vec4 tangent, color;
in vec2 uv0, uv1;
uniform sampler2D map0, map1, map2, map3, map4;
uniform ivec2 wrap[5];  // 0 repeat, 1 mirror, 2 clamp
uniform mat3x2 uv_from_vertex[5];
uniform vec4 base_color;
uniform vec3 emission, eye, to_light, light;
uniform float metallic, roughness, normal_scale, occlusion_strength, cutoff, ambient;
uniform uint frame;
layout(location = 0) out vec4 radiance;

const float kPi = 3.14159265;
int folded(int i, int n, int rule) {
    if (rule == 2) return clamp(i, 0, n - 1);
    int period = rule == 1 ? 2 * n : n;
    i -= int(floor(float(i) / float(period))) * period;
    return i < n ? i : 2 * n - 1 - i;
}
uint mixed(uint bits) {
    bits = (bits ^ bits >> 16) * 0x7FEB352Du;
    bits = (bits ^ bits >> 15) * 0x846CA68Bu;
    return bits ^ bits >> 16;
}
vec4 weights_of(float f) {
    float r = 1 - f;
    return vec4(r * r * r, 4 - 6 * f * f + 3 * f * f * f, 4 - 6 * r * r + 3 * r * r * r, f * f * f) / 6;
}
int drawn(vec4 weights, float number) {
    return int(number >= weights.x) + int(number >= weights.x + weights.y) + int(number >= 1 - weights.w);
}
vec4 look_up(sampler2D map, int k) {
    vec2 uv = uv_from_vertex[k] * vec3((UV1 >> k & 1) == 0 ? uv0 : uv1, 1);
#if FILTER == 0
    return texture(map, uv);
#else
    ivec2 size = textureSize(map, 0);
    vec2 at = uv * vec2(size) - 0.5, first = floor(at), f = at - first;
    vec4 x = weights_of(f.x), y = weights_of(f.y);
    ivec2 origin = ivec2(first) - 1;
#if FILTER == 2
    uint bits = mixed(mixed(mixed(frame) ^ uint(gl_FragCoord.x)) ^ uint(gl_FragCoord.y));
    ivec2 tap = ivec2(drawn(x, float(bits >> 8) * 5.9604645e-8), drawn(y, float(mixed(bits) >> 8) * 5.9604645e-8));
    return texelFetch(map, ivec2(folded(origin.x + tap.x, size.x, wrap[k].x), folded(origin.y + tap.y, size.y, wrap[k].y)), 0);
#else
    vec4 sum = vec4(0);
    for (int j = 0; j < 4; ++j) {
        int row = folded(origin.y + j, size.y, wrap[k].y);
        for (int i = 0; i < 4; ++i) sum += x[i] * y[j] * texelFetch(map, ivec2(folded(origin.x + i, size.x, wrap[k].x), row), 0);
    }
    return sum;
#endif
#endif
}
vec3 mapped_normal(vec3 n) {
    vec3 code = look_up(map2, 2).xyz * 2 - 1;
    vec3 t = tangent.xyz;
    vec3 b = cross(n, t) * tangent.w;
    return normalize(t * code.x * normal_scale + b * code.y * normal_scale + n * code.z);
}
void main() {
    vec4 base = base_color * color;
#if (MAPS & 1) != 0
    base *= look_up(map0, 0);
#endif
#if ALPHA_TEST
    if (base.a < cutoff) discard;
#endif
    radiance.a = 1;
#if UNLIT
    radiance.rgb = base.rgb;
#else
#if NORMALS
    vec3 n = normalize(normal);
#if (MAPS & 4) != 0 && TANGENTS
    n = mapped_normal(n);
#endif
    if (!gl_FrontFacing) n = -n;
#else
    vec3 n = normalize(cross(dFdx(world), dFdy(world)));
#endif
    float rough = roughness, metal = metallic, occlusion = 1;
#if (MAPS & 2) != 0
    vec4 surface = look_up(map1, 1);
    rough *= surface.g, metal *= surface.b;
#endif
#if (MAPS & 8) != 0
    occlusion += occlusion_strength * (look_up(map3, 3).r - 1);
#endif
    vec3 glow = emission;
#if (MAPS & 16) != 0
    glow *= look_up(map4, 4).rgb;
#endif
    vec3 sum = base.rgb * ambient * occlusion + glow;
    vec3 v = normalize(eye - world), h = v + to_light;
    float n_l = dot(n, to_light);
    if (n_l > 0) {
        float alpha = max(rough * rough, 1e-3), a2 = alpha * alpha, n_v = max(dot(n, v), 1e-4);
        h /= max(length(h), 1e-6);
        float n_h = dot(n, h), v_h = max(dot(v, h), 0);
        vec3 tilt = cross(n, h);
        float spread = n_h > 0 ? dot(tilt, tilt) + n_h * n_h * a2 : 1;
        float d = a2 / (kPi * spread * spread);
        float smith = n_l * sqrt(n_v * n_v * (1 - a2) + a2) + n_v * sqrt(n_l * n_l * (1 - a2) + a2) + 1e-7;
        vec3 f0 = mix(vec3(0.04), base.rgb, metal), fresnel = f0 + (1 - f0) * pow(1 - v_h, 5);
        sum += ((1 - fresnel) * (1 - metal) * base.rgb / kPi + fresnel * d * 0.5 / smith) * n_l * light;
    }
    radiance.rgb = sum;
#endif
})";

}  // namespace rawtexel::peer
