// The port of suite triplanar: planes, weighed and drawn.
// include "each_case.wgsl"
// include "triplanar.wgsl"

fn answer(op: u32, index: u32) -> Result {
    var r: Result = no_result();
    if (op == OP_PLANE) {
        let weights: vec3f = plane_weights(case_vec3(index, CASE_AT), case_uint(index, CASE_COUNT));
        r.texel.x = draw_plane(weights, case_float(index, CASE_NUMBER_X));
        r.value = vec4f(weights, 0.0);
    }
    return r;
}
