// The sRGB transfer function (IEC 61966-2-1). Texels are decoded one by one, before anything is weighed.
// include "addressing.wgsl"

fn srgb_to_linear(encoded: f32) -> f32 {
    return select(pow((encoded + 0.055) / 1.055, 2.4), encoded / 12.92, encoded <= 0.04045);
}

fn linear_to_srgb(linear: f32) -> f32 {
    return select((1.055 * pow(linear, 1.0 / 2.4)) - 0.055, linear * 12.92, linear <= 0.0031308);
}

// The nearest 8-bit code; outside of 0 to 1 the ends, not a number is 0.
fn encode_srgb8(linear: f32) -> u32 {
    let bits: u32 = bitcast<u32>(linear);
    let not_a_number: bool = (bits & 0x7FFFFFFFu) > 0x7F800000u;
    if (not_a_number || ((bits & 0x80000000u) != 0u)) {
        return 0u;
    }
    return u32(floor((linear_to_srgb(min(linear, 1.0)) * 255.0) + 0.5));
}
