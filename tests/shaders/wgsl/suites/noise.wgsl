// The port of suite noise: numbers of two dimensions.
// include "each_case.wgsl"
// include "noise.wgsl"

fn answer(op: u32, index: u32) -> Result {
    var r: Result = no_result();
    if (op == OP_NOISE_PAIR) {
        let a: RandomAddress = RandomAddress(vec2u(case_uint(index, CASE_PIXEL_X), case_uint(index, CASE_PIXEL_Y)), case_uint(index, CASE_SAMPLE), case_uint(index, CASE_SURFACE), case_uint(index, CASE_DIMENSION), case_uint(index, CASE_SEED));
        let bits: vec2u = noise_pair(case_uint(index, CASE_NOISE), a, case_uint(index, CASE_SECOND_DIMENSION));
        r.value = vec4f(unit_float(bits.x), unit_float(bits.y), 0.0, 0.0);
    }
    return r;
}
