// Filter reservoir sampling: one tap drawn from the discrete weights of an axis.
// include "kernels.wgsl"

// Which of a kernel's weights count.
const LOBES_ALL: i32 = 0;
const LOBES_POSITIVE: i32 = 1;
const LOBES_NEGATIVE: i32 = 2;
const LOBES_MAGNITUDE: i32 = 3;

fn lobe_weight(weight: f32, lobes: i32) -> f32 {
    if (lobes == LOBES_POSITIVE) {
        return max(weight, 0.0);
    }
    if (lobes == LOBES_NEGATIVE) {
        return max(-weight, 0.0);
    }
    return select(weight, abs(weight), lobes == LOBES_MAGNITUDE);
}

fn lobe_mass(taps: AxisTaps, lobes: i32) -> f32 {
    var sum: f32 = 0.0;
    for (var i: i32 = 0; i < taps.count; i++) {
        sum += lobe_weight(taps.weight[i], lobes);
    }
    return sum;
}

// Of the taps that weigh anything the last one before which the probabilities sum to no more than the number: never a tap of weight 0,
// whatever the number and however the weights round.
fn reservoir_tap(taps: AxisTaps, lobes: i32, number: f32) -> i32 {
    let at: f32 = number * (select(lobe_mass(taps, lobes), 1.0, lobes == LOBES_ALL));
    var before: f32 = 0.0;
    var drawn: i32 = 0;
    for (var i: i32 = 0; i < taps.count; i++) {
        let weight: f32 = lobe_weight(taps.weight[i], lobes);
        if ((weight > 0.0) && (at >= before)) {
            drawn = i;
        }
        before += weight;
    }
    return drawn;
}

// The index, not wrapped yet, of the texel that is drawn along one axis.
fn reservoir_texel(k: Kernel, x: f32, number: f32) -> i32 {
    let taps: AxisTaps = axis_taps(k, x);
    return taps.first + reservoir_tap(taps, LOBES_ALL, number);
}
