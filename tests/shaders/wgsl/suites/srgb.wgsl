// The port of suite srgb: codes decoded and encoded, and filtered.
// include "each_case.wgsl"
// include "lookup.wgsl"
// include "srgb.wgsl"

fn answer(op: u32, index: u32) -> Result {
    var r: Result = no_result();
    if (op == OP_SAMPLE) {
        r = filter_case(index);
    }
    if (op == OP_SRGB_DECODE) {
        r.value.x = srgb_to_linear(f32(case_int(index, CASE_INDEX)) / 255.0);
    }
    if (op == OP_SRGB_ENCODE) {
        r.bits = encode_srgb8(case_float(index, CASE_AT));
    }
    return r;
}
