// The port of suite adversarial: the known pitfalls.
// include "each_case.wgsl"
// include "draw.wgsl"

fn answer(op: u32, index: u32) -> Result {
    var r: Result = no_result();
    if ((op == OP_SAMPLE) || (op == OP_SHADE)) {
        r = filter_case(index);
    }
    if ((op == OP_DRAW) || (op == OP_MEAN)) {
        r = draw_case(index);
    }
    if (op == OP_RANDOM) {
        r.bits = random_bits(case_address(index));
        r.value.x = unit_float(r.bits);
    }
    return r;
}
