// The binding contract of `rawtexel verify-shader` (docs/porting.md): cases in, answers out, textures as buffers of texels.
#ifndef CONTRACT_GLSL
#define CONTRACT_GLSL
#include "addressing.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer Cases { uint case_words[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Results { uint result_words[]; };
layout(set = 0, binding = 2, std430) readonly buffer Textures { uint texture_words[]; };
layout(set = 0, binding = 3, std430) readonly buffer Texels { vec4 texels[]; };
layout(set = 0, binding = 4, std430) readonly buffer Words { uint stored_words[]; };
layout(push_constant) uniform Range { uint first_case, case_count; };

const uint OP_WRAP_INDEX = 0u, OP_SAMPLE = 1u, OP_DRAW = 2u, OP_MEAN = 3u, OP_SHADE = 4u, OP_SRGB_DECODE = 5u, OP_SRGB_ENCODE = 6u,
           OP_BLOCK_TEXEL = 7u, OP_RANDOM = 8u, OP_NOISE_PAIR = 9u, OP_PLANE = 10u;
const uint ESTIMATOR_ALL = 0u, ESTIMATOR_RESERVOIR = 1u, ESTIMATOR_JITTER = 2u, ESTIMATOR_ABS_WEIGHT = 3u;

// Words of a case, by the names that docs/porting.md has.
const uint CASE_OP = 0u, CASE_TEXTURE = 1u, CASE_WRAP_S = 2u, CASE_WRAP_T = 3u, CASE_WRAP_R = 4u, CASE_MINIFY = 5u, CASE_MAGNIFY = 8u,
           CASE_ESTIMATOR = 11u, CASE_MIP = 12u, CASE_LOD_RULE = 13u, CASE_PROBES = 14u, CASE_PROBE_VARIANCE = 15u, CASE_ELLIPSE = 16u,
           CASE_HYBRID_BIAS = 17u, CASE_LOD_BIAS = 18u, CASE_MIN_LOD = 19u, CASE_MAX_LOD = 20u, CASE_BORDER = 21u, CASE_AT = 25u,
           CASE_DX = 28u, CASE_DY = 31u, CASE_LAYER = 34u, CASE_NUMBER_X = 35u, CASE_NUMBER_LEVEL = 38u, CASE_NUMBER_PROBE = 39u,
           CASE_NUMBER_SIGN = 40u, CASE_NEGATIVE_X = 41u, CASE_NEGATIVE_SIGN = 44u, CASE_INDEX = 45u, CASE_EXTENT = 46u,
           CASE_PIXEL_X = 47u, CASE_PIXEL_Y = 48u, CASE_SAMPLE = 49u, CASE_SURFACE = 50u, CASE_DIMENSION = 51u, CASE_SEED = 52u,
           CASE_NOISE = 53u, CASE_SECOND_DIMENSION = 54u, CASE_COUNT = 55u, CASE_ORDER = 56u, CASE_SHADER = 57u;

uint case_uint(uint index, uint word) { return case_words[64u * index + word]; }
int case_int(uint index, uint word) { return int(case_uint(index, word)); }
float case_float(uint index, uint word) { return uintBitsToFloat(case_uint(index, word)); }
vec3 case_vec3(uint index, uint word) { return vec3(case_float(index, word), case_float(index, word + 1u), case_float(index, word + 2u)); }

struct Result {
    ivec4 texel;  // x, y, slice, level
    float weight;
    ivec3 negative_texel;
    float negative_weight;
    float lod;
    int probes;
    uint bits;
    vec4 value;
};
Result no_result() { return Result(ivec4(0), 0.0, ivec3(0), 0.0, 0.0, 0, 0u, vec4(0.0)); }

void write_result(uint index, Result r) {
    uint to = 16u * index;
    for (uint i = 0u; i < 4u; ++i) result_words[to + i] = uint(r.texel[i]);
    result_words[to + 4u] = floatBitsToUint(r.weight);
    for (uint i = 0u; i < 3u; ++i) result_words[to + 5u + i] = uint(r.negative_texel[i]);
    result_words[to + 8u] = floatBitsToUint(r.negative_weight);
    result_words[to + 9u] = floatBitsToUint(r.lod);
    result_words[to + 10u] = uint(r.probes);
    result_words[to + 11u] = r.bits;
    for (uint i = 0u; i < 4u; ++i) result_words[to + 12u + i] = floatBitsToUint(r.value[i]);
}

struct TextureShape {
    ivec3 extent;
    int layers, levels;
    bool cube;
    uint record;
};
TextureShape texture_shape(uint number) {
    uint at = 32u * number;
    TextureShape t;
    t.extent = ivec3(texture_words[at], texture_words[at + 1u], texture_words[at + 2u]);
    t.layers = int(texture_words[at + 3u]);
    t.levels = int(texture_words[at + 4u]);
    t.cube = texture_words[at + 5u] != 0u;
    t.record = at;
    return t;
}
uint texture_format(uint number) { return texture_words[32u * number + 6u]; }
uint texture_first_word(uint number) { return texture_words[32u * number + 7u]; }

ivec3 extent_at(TextureShape t, int level) {
    return ivec3(level_extent(t.extent.x, level), level_extent(t.extent.y, level), level_extent(t.extent.z, level));
}

// Linear RGBA of a texel inside the level.
vec4 texel_at(TextureShape t, int level, int slice, int x, int y) {
    ivec3 n = extent_at(t, level);
    return texels[texture_words[t.record + 8u + uint(level)] + uint((slice * n.y + y) * n.x + x)];
}

#endif
