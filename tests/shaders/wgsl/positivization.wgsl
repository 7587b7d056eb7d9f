// Kernels with negative lobes: one texel drawn from the positive weights and one from the magnitudes of the negative ones. The estimate is
// positive_weight*S(positive) - negative_weight*S(negative), each texel shaded by itself; positive_weight = 1 + negative_weight, so that a
// constant has no variance.
// include "frs.wgsl"

struct SignedMasses {
    positive: vec3f,
    negative: vec3f,  // of either sign along the axes; (1, 0) of an axis that there is not
}

// The mass of negative products.
fn negative_mass(m: SignedMasses) -> f32 {
    let p: vec3f = m.positive;
    let n: vec3f = m.negative;
    return ((((p.x * n.y) * p.z) + ((n.x * p.y) * p.z)) + ((p.x * p.y) * n.z)) + ((n.x * n.y) * n.z);
}

// Signs that the axes' weights can have, drawn in this order: first those of positive product, then those of negative.
const SIGNS: array<vec3<bool>, 8> = array<vec3<bool>, 8>(vec3<bool>(false, false, false), vec3<bool>(true, true, false), vec3<bool>(false, true, true), vec3<bool>(true, false, true), vec3<bool>(false, true, false), vec3<bool>(true, false, false), vec3<bool>(false, false, true), vec3<bool>(true, true, true));

// Which axes take their negative weights.
fn draw_signs(m: SignedMasses, negative: bool, number: f32) -> vec3<bool> {
    var share: array<f32, 4>;
    var sum: f32 = 0.0;
    let first: i32 = select(0, 4, negative);
    for (var n: i32 = 0; n < 4; n++) {
        let s: vec3<bool> = SIGNS[first + n];
        share[n] = ((select(m.positive.x, m.negative.x, s.x)) * (select(m.positive.y, m.negative.y, s.y))) * (select(m.positive.z, m.negative.z, s.z));
        sum += share[n];
    }
    var drawn: vec3<bool> = SIGNS[first];
    var before: f32 = 0.0;
    for (var n: i32 = 0; n < 4; n++) {
        if ((share[n] > 0.0) && ((number * sum) >= before)) {
            drawn = SIGNS[first + n];
        }
        before += share[n];
    }
    return drawn;
}

fn signed_texel(taps: AxisTaps, negative: bool, number: f32) -> i32 {
    return taps.first + reservoir_tap(taps, select(LOBES_POSITIVE, LOBES_NEGATIVE, negative), number);
}
