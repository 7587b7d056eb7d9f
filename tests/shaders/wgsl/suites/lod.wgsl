// The port of suite lod: levels of detail.
// include "each_case.wgsl"
// include "lookup.wgsl"

fn answer(op: u32, index: u32) -> Result {
    if (op == OP_SAMPLE) {
        return filter_case(index);
    }
    return no_result();
}
