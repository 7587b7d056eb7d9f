// Answers every case of a suite by the function `answer` of the shader that includes this.
// include "contract.wgsl"

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let index = id.x;
    if (index >= case_count()) {
        return;
    }
    write_result(index, answer(case_uint(index, CASE_OP), index));
}
