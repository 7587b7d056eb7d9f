// The port of suite addressing: indices and coordinates wrapped.
// include "lookup.wgsl"

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
    if (op == OP_WRAP_INDEX) {
        r.texel.x = wrap_index(case_uint(index, 2u), case_int(index, 45u), case_int(index, 46u));
    }
    write_result(index, r);
}
