// The port of suite srgb: codes decoded and encoded, and filtered.
// include "lookup.wgsl"

// include "srgb.wgsl"

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let index = id.x;
    if (index >= case_count()) {
        return;
    }
    let op: u32 = case_uint(index, 0u);
    var r: Result = no_result();
    if (op == OP_SAMPLE) {
        r = filter_case(index);
    }
    if (op == OP_SRGB_DECODE) {
        r.value.x = srgb_to_linear(f32(case_int(index, 45u)) / 255.0);
    }
    if (op == OP_SRGB_ENCODE) {
        r.bits = encode_srgb8(case_float(index, 25u));
    }
    write_result(index, r);
}
