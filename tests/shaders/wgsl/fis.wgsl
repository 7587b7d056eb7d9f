// Filter importance sampling: the coordinate moves by a drawn offset, then the nearest texel is read. The offset's density, convolved with
// the texel's box, is the kernel. Inverse distributions rise with their number, so that filter reservoir sampling draws the same texel.
// include "kernels.wgsl"

// Tent of radius 1.
fn tent_offset(number: f32) -> f32 {
    return select(1.0 - sqrt(2.0 - (2.0 * number)), sqrt(2.0 * number) - 1.0, number < 0.5);
}

// Where a rising cubic distribution reaches `mass`, by halving [0, reach]: (cube*x + square)*x^2 in the tail, (cube*x^2 + linear)*x within.
fn invert_cubic(cube: f32, other: f32, tail: bool, reach: f32, mass: f32) -> f32 {
    var below: f32 = 0.0;
    var width: f32 = reach;
    for (var bit: i32 = 0; bit < 25; bit++) {
        width *= 0.5;
        let x: f32 = below + width;
        let q: f32 = x * x;
        if ((select(x * ((cube * q) + other), q * ((cube * x) + other), tail)) < mass) {
            below = x;
        }
    }
    return below;
}

// Of Mitchell's cubics that are a density convolved with a box, radius 3/2; B = 1, C = 0 is the quadratic B-spline, whose convolution is
// the cubic one.
fn mitchell_offset(b: f32, c: f32, number: f32) -> f32 {
    let side: f32 = abs(number - 0.5);
    let outside: f32 = 0.5 - side;
    var x: f32;
    if (outside < (b / 6.0)) {
        x = 1.5 - invert_cubic((b / 6.0) + c, -c, true, 1.0, outside);
    } else {
        x = invert_cubic((((5.0 * b) + (6.0 * c)) - 6.0) / 3.0, (1.5 - (0.75 * b)) - (0.5 * c), false, 0.5, side);
    }
    return select(x, -x, number < 0.5);
}

// Inverse error function (Giles 2010).
fn inverse_erf(x: f32) -> f32 {
    var w: f32 = -log((1.0 - x) * (1.0 + x));
    if (w < 5.0) {
        w -= 2.5;
        return x * (1.50140941 + (w * (0.246640727 + (w * (-0.00417768164 + (w * (-0.00125372503 + (w * (0.00021858087 + (w * (-4.39150654e-06 + (w * (-3.5233877e-06 + (w * (3.43273939e-07 + (w * 2.81022636e-08))))))))))))))));
    }
    w = sqrt(w) - 3.0;
    return x * (2.83297682 + (w * (1.00167406 + (w * (0.00943887047 + (w * (-0.0076224613 + (w * (0.00573950773 + (w * (-0.00367342844 + (w * (0.00134934322 + (w * (0.000100950558 + (w * -0.000200214257))))))))))))))));
}

// The standard normal distribution cut at 4 sigma. No logarithm of 0: the number is scaled to the mass within the cut first.
fn normal_offset(number: f32) -> f32 {
    var t: f32 = inverse_erf((number - 0.5) * 1.999873315);
    let density: f32 = exp(-t * t) * 0.564225322;
    t -= (normal_mass(t) - (number - 0.5)) / density;
    return clamp(t, -2.82842712, 2.82842712) * 1.41421356;
}

fn jitter_offset(k: Kernel, number: f32) -> f32 {
    if (k.kind == KERNEL_BILINEAR) {
        return number - 0.5;
    }
    if (k.kind == KERNEL_QUADRATIC) {
        return tent_offset(number);
    }
    if (k.kind == KERNEL_BSPLINE) {
        return mitchell_offset(1.0, 0.0, number);
    }
    if (k.kind == KERNEL_MITCHELL) {
        return mitchell_offset(k.b, k.c, number);
    }
    if (k.kind == KERNEL_GAUSSIAN) {
        return k.b * normal_offset(number);
    }
    return 0.0;
}

// The index, not wrapped yet, of the texel that is drawn along one axis.
fn jitter_texel(k: Kernel, x: f32, number: f32) -> i32 {
    return i32(floor(x + jitter_offset(k, number)));
}
