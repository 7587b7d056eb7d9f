// The port of suite positivization: kernels with negative lobes, drawn.
// include "draw.wgsl"

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let index = id.x;
    if (index >= case_count()) {
        return;
    }
    let op: u32 = case_uint(index, 0u);
    var r: Result = no_result();
    if (op == OP_DRAW) {
        r = draw_case(index);
    }
    write_result(index, r);
}
