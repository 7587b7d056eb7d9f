// The port of suite noise: numbers of two dimensions.
// include "contract.wgsl"

// include "noise.wgsl"

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let index = id.x;
    if (index >= case_count()) {
        return;
    }
    let op: u32 = case_uint(index, 0u);
    var r: Result = no_result();
    if (op == OP_NOISE_PAIR) {
        let a: RandomAddress = RandomAddress(vec2u(case_uint(index, 47u), case_uint(index, 48u)), case_uint(index, 49u), case_uint(index, 50u), case_uint(index, 51u), case_uint(index, 52u));
        let bits: vec2u = noise_pair(case_uint(index, 53u), a, case_uint(index, 54u));
        r.value = vec4f(unit_float(bits.x), unit_float(bits.y), 0.0, 0.0);
    }
    write_result(index, r);
}
