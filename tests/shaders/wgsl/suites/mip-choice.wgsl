// The port of suite mip-choice: levels drawn.
// include "each_case.wgsl"
// include "draw.wgsl"

fn answer(op: u32, index: u32) -> Result {
    if (op == OP_DRAW) {
        return draw_case(index);
    }
    return no_result();
}
