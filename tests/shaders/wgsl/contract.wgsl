// The bindings of ports in WGSL: those of docs/porting.md without push constants; every case is answered in one dispatch.
// include "addressing.wgsl"

@group(0) @binding(0) var<storage, read> case_words: array<u32>;
@group(0) @binding(1) var<storage, read_write> result_words: array<u32>;
@group(0) @binding(2) var<storage, read> texture_words: array<u32>;
@group(0) @binding(3) var<storage, read> texels: array<vec4f>;
@group(0) @binding(4) var<storage, read> stored_words: array<u32>;

fn case_count() -> u32 {
    return arrayLength(&case_words) / 64u;
}

const OP_WRAP_INDEX = 0u;
const OP_SAMPLE = 1u;
const OP_DRAW = 2u;
const OP_MEAN = 3u;
const OP_SHADE = 4u;
const OP_SRGB_DECODE = 5u;
const OP_SRGB_ENCODE = 6u;
const OP_BLOCK_TEXEL = 7u;
const OP_RANDOM = 8u;
const OP_NOISE_PAIR = 9u;
const OP_PLANE = 10u;
const ESTIMATOR_ALL = 0u;
const ESTIMATOR_RESERVOIR = 1u;
const ESTIMATOR_JITTER = 2u;
const ESTIMATOR_ABS_WEIGHT = 3u;

// Words of a case, by the names that docs/porting.md has.
const CASE_OP = 0u;
const CASE_TEXTURE = 1u;
const CASE_WRAP_S = 2u;
const CASE_WRAP_T = 3u;
const CASE_WRAP_R = 4u;
const CASE_MINIFY = 5u;
const CASE_MAGNIFY = 8u;
const CASE_ESTIMATOR = 11u;
const CASE_MIP = 12u;
const CASE_LOD_RULE = 13u;
const CASE_PROBES = 14u;
const CASE_PROBE_VARIANCE = 15u;
const CASE_ELLIPSE = 16u;
const CASE_HYBRID_BIAS = 17u;
const CASE_LOD_BIAS = 18u;
const CASE_MIN_LOD = 19u;
const CASE_MAX_LOD = 20u;
const CASE_BORDER = 21u;
const CASE_AT = 25u;
const CASE_DX = 28u;
const CASE_DY = 31u;
const CASE_LAYER = 34u;
const CASE_NUMBER_X = 35u;
const CASE_NUMBER_LEVEL = 38u;
const CASE_NUMBER_PROBE = 39u;
const CASE_NUMBER_SIGN = 40u;
const CASE_NEGATIVE_X = 41u;
const CASE_NEGATIVE_SIGN = 44u;
const CASE_INDEX = 45u;
const CASE_EXTENT = 46u;
const CASE_PIXEL_X = 47u;
const CASE_PIXEL_Y = 48u;
const CASE_SAMPLE = 49u;
const CASE_SURFACE = 50u;
const CASE_DIMENSION = 51u;
const CASE_SEED = 52u;
const CASE_NOISE = 53u;
const CASE_SECOND_DIMENSION = 54u;
const CASE_COUNT = 55u;
const CASE_ORDER = 56u;
const CASE_SHADER = 57u;

fn case_uint(index: u32, word: u32) -> u32 {
    return case_words[64u * index + word];
}

fn case_int(index: u32, word: u32) -> i32 {
    return bitcast<i32>(case_uint(index, word));
}

fn case_float(index: u32, word: u32) -> f32 {
    return bitcast<f32>(case_uint(index, word));
}

fn case_vec3(index: u32, word: u32) -> vec3f {
    return vec3f(case_float(index, word), case_float(index, word + 1u), case_float(index, word + 2u));
}

struct Result {
    texel: vec4i,  // x, y, slice, level
    weight: f32,
    negative_texel: vec3i,
    negative_weight: f32,
    lod: f32,
    probes: i32,
    bits: u32,
    value: vec4f,
}

fn no_result() -> Result {
    return Result(vec4i(), 0.0, vec3i(), 0.0, 0.0, 0, 0u, vec4f());
}

fn write_result(index: u32, r: Result) {
    let to = 16u * index;
    for (var i = 0u; i < 4u; i++) {
        result_words[to + i] = bitcast<u32>(r.texel[i]);
        result_words[to + 12u + i] = bitcast<u32>(r.value[i]);
    }
    for (var i = 0u; i < 3u; i++) {
        result_words[to + 5u + i] = bitcast<u32>(r.negative_texel[i]);
    }
    result_words[to + 4u] = bitcast<u32>(r.weight);
    result_words[to + 8u] = bitcast<u32>(r.negative_weight);
    result_words[to + 9u] = bitcast<u32>(r.lod);
    result_words[to + 10u] = bitcast<u32>(r.probes);
    result_words[to + 11u] = r.bits;
}

struct TextureShape {
    extent: vec3i,
    layers: i32,
    levels: i32,
    cube: bool,
    record: u32,
}

fn texture_shape(number: u32) -> TextureShape {
    let at = 32u * number;
    return TextureShape(vec3i(i32(texture_words[at]), i32(texture_words[at + 1u]), i32(texture_words[at + 2u])), i32(texture_words[at + 3u]),
                        i32(texture_words[at + 4u]), texture_words[at + 5u] != 0u, at);
}

fn texture_format(number: u32) -> u32 {
    return texture_words[32u * number + 6u];
}

fn texture_first_word(number: u32) -> u32 {
    return texture_words[32u * number + 7u];
}

fn extent_at(t: TextureShape, level: i32) -> vec3i {
    return vec3i(level_extent(t.extent.x, level), level_extent(t.extent.y, level), level_extent(t.extent.z, level));
}

// Linear RGBA of a texel inside the level.
fn texel_at(t: TextureShape, level: i32, slice: i32, x: i32, y: i32) -> vec4f {
    let n = extent_at(t, level);
    return texels[texture_words[t.record + 8u + u32(level)] + u32((slice * n.y + y) * n.x + x)];
}
