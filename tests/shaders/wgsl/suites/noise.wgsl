// The port of suite noise: numbers of two dimensions.
// include "each_case.wgsl"
// include "noise.wgsl"

fn answer(op: u32, index: u32) -> Result {
    var r: Result = no_result();
    if (op == OP_NOISE_PAIR) {
        let a: RandomAddress = RandomAddress(vec2u(case_uint(index, 47u), case_uint(index, 48u)), case_uint(index, 49u), case_uint(index, 50u), case_uint(index, 51u), case_uint(index, 52u));
        let bits: vec2u = noise_pair(case_uint(index, 53u), a, case_uint(index, 54u));
        r.value = vec4f(unit_float(bits.x), unit_float(bits.y), 0.0, 0.0);
    }
    return r;
}
