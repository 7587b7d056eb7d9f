// The port of suite random-numbers: hashes of addresses.
// include "each_case.wgsl"
// include "draw.wgsl"

fn answer(op: u32, index: u32) -> Result {
    var r: Result = no_result();
    if (op == OP_RANDOM) {
        r.bits = random_bits(case_address(index));
        r.value.x = unit_float(r.bits);
    }
    return r;
}
