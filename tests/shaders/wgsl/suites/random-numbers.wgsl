// The port of suite random-numbers: hashes of addresses.
// include "draw.wgsl"

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let index = id.x;
    if (index >= case_count()) {
        return;
    }
    let op: u32 = case_uint(index, 0u);
    var r: Result = no_result();
    if (op == OP_RANDOM) {
        r.bits = random_bits(case_address(index));
        r.value.x = unit_float(r.bits);
    }
    write_result(index, r);
}
