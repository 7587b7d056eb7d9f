// The port of suite triplanar: planes, weighed and drawn.
// include "contract.wgsl"

// include "triplanar.wgsl"

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let index = id.x;
    if (index >= case_count()) {
        return;
    }
    let op: u32 = case_uint(index, 0u);
    var r: Result = no_result();
    if (op == OP_PLANE) {
        let weights: vec3f = plane_weights(case_vec3(index, 25u), case_uint(index, 55u));
        r.texel.x = draw_plane(weights, case_float(index, 35u));
        r.value = vec4f(weights, 0.0);
    }
    write_result(index, r);
}
