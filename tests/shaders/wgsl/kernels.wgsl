// Reconstruction kernels: the weights of the taps along one axis, from where the coordinate lies among the texels. Separable.
const KERNEL_NEAREST: u32 = 0u;
const KERNEL_BILINEAR: u32 = 1u;
const KERNEL_QUADRATIC: u32 = 2u;
const KERNEL_BSPLINE: u32 = 3u;
const KERNEL_MITCHELL: u32 = 4u;
const KERNEL_CATMULL_ROM: u32 = 5u;
const KERNEL_LANCZOS2: u32 = 6u;
const KERNEL_LANCZOS3: u32 = 7u;
const KERNEL_GAUSSIAN: u32 = 8u;
const KERNEL_GAUSSIAN_POINT: u32 = 9u;

struct Kernel {
    kind: u32,
    b: f32,
    c: f32,  // Mitchell's B and C; b is the sigma of Gaussians, in texels
}

// Taps first, first + 1, ...; their weights sum to 1. What weighs less than LEAST_WEIGHT weighs nothing: rounding noise draws no texel.
const MOST_TAPS: i32 = 12;

// of Gaussians up to a sigma of 1.25
const LEAST_WEIGHT: f32 = 1.1920929e-7;

struct AxisTaps {
    first: i32,
    count: i32,
    weight: array<f32, MOST_TAPS>,
}

fn has_negative_lobes(k: Kernel) -> bool {
    if (k.kind == KERNEL_MITCHELL) {
        if (((k.c > 0.0) || (k.b < 0.0)) || (k.b > 3.0)) {
            return true;
        }
        let square: f32 = ((2.0 * k.b) + k.c) - 3.0;
        let cube: f32 = (2.0 - (1.5 * k.b)) - k.c;
        let lowest: f32 = (-2.0 * square) / (3.0 * cube);
        return ((lowest > 0.0) && (lowest < 1.0)) && (((1.0 - (k.b / 3.0)) + (((square * lowest) * lowest) / 3.0)) < 0.0);
    }
    return ((k.kind == KERNEL_CATMULL_ROM) || (k.kind == KERNEL_LANCZOS2)) || (k.kind == KERNEL_LANCZOS3);
}

fn mitchell_weight(b: f32, c: f32, x: f32) -> f32 {
    if (x < 1.0) {
        return (((((((2.0 - (1.5 * b)) - c) * x) * x) * x) + (((((2.0 * b) + c) - 3.0) * x) * x)) + 1.0) - (b / 3.0);
    }
    let s: f32 = 2.0 - x;
    return select(0.0, (s * s) * ((((b / 6.0) + c) * s) - c), s > 0.0);
}

// sin(pi*x) of |x| <= 1/2 by its series: the sines of Vulkan are only good to 2^-11.
fn sin_pi(x: f32) -> f32 {
    let a: f32 = x * 3.14159265;
    let q: f32 = a * a;
    return a * (1.0 + (q * ((-1.0 / 6.0) + (q * ((1.0 / 120.0) + (q * ((-1.0 / 5040.0) + (q * ((1.0 / 362880.0) - (q / 39916800.0))))))))));
}

// Raw: taps have to be normalised, for raw weights do not sum to 1.
fn lanczos_weight(lobes: f32, x: f32) -> f32 {
    if (x < 1.0e-4) {
        return 1.0;
    }
    if (x >= lobes) {
        return 0.0;
    }
    // sin(pi*x) by the distance from the nearest whole number, sin(pi*x/lobes) by its own symmetry.
    let n: f32 = floor(x + 0.5);
    var a: f32 = sin_pi(x - n);
    let y: f32 = x / lobes;
    if ((n % 2.0) == 1.0) {
        a = -a;
    }
    let b: f32 = sin_pi(select(y, 1.0 - y, y > 0.5));
    return ((lobes * a) * b) / ((9.8696044 * x) * x);
}

// Mass of the normal distribution, cut at 4 sigma and renormalised, from its mean to t*sqrt(2)*sigma; erf by Chebyshev interpolants good
// to 2^-24.
fn normal_mass(t: f32) -> f32 {
    let x: f32 = min(abs(t), 2.82842712);
    var mass: f32;
    if (x <= 1.0) {
        let q: f32 = x * x;
        mass = x * (0.564225322 + (q * (-0.188075048 + (q * (0.0564215612 + (q * (-0.013428015 + (q * (0.00259482033 + (q * (-0.000400968148 + (q * 3.94149822e-05))))))))))));
    } else {
        let y: f32 = x - 1.91421354;
        mass = 0.5 - (0.00336216558 + (y * (-0.0144579898 + (y * (0.0276752822 + (y * (-0.0304960717 + (y * (0.0199680694 + (y * (-0.00615501888 + (y * (-0.00142238754 + (y * (0.00228298214 + (y * (-0.000732886796 + (y * (-0.000179221185 + (y * 0.000142815503))))))))))))))))))));
    }
    return select(mass, -mass, t < 0.0);
}

// x in texel space, texel i spanning i to i + 1.
fn axis_taps(k: Kernel, x: f32) -> AxisTaps {
    var taps: AxisTaps;
    for (var i: i32 = 0; i < MOST_TAPS; i++) {
        taps.weight[i] = 0.0;
    }
    let centre: f32 = x - 0.5;
    // texel i has its centre at i
    let before: i32 = i32(floor(centre));
    let f: f32 = centre - f32(before);
    if (k.kind == KERNEL_NEAREST) {
        taps.first = i32(floor(x));
        taps.count = 1;
        taps.weight[0] = 1.0;
        return taps;
    }
    if (k.kind == KERNEL_BILINEAR) {
        taps.first = before;
        taps.count = 2;
        taps.weight[0] = 1.0 - f;
        taps.weight[1] = f;
    } else if (k.kind == KERNEL_QUADRATIC) {
        var nearest: i32 = i32(floor(x));
        var d: f32 = centre - f32(nearest);
        taps.first = nearest - 1;
        taps.count = 3;
        taps.weight[0] = (0.5 * (0.5 - d)) * (0.5 - d);
        taps.weight[1] = 0.75 - (d * d);
        taps.weight[2] = (0.5 * (0.5 + d)) * (0.5 + d);
    } else if (k.kind == KERNEL_BSPLINE) {
        let g: f32 = 1.0 - f;
        taps.first = before - 1;
        taps.count = 4;
        taps.weight[0] = ((g * g) * g) / 6.0;
        taps.weight[1] = (2.0 / 3.0) - (((0.5 * f) * f) * (2.0 - f));
        taps.weight[2] = (2.0 / 3.0) - (((0.5 * g) * g) * (2.0 - g));
        taps.weight[3] = ((f * f) * f) / 6.0;
    } else if ((k.kind == KERNEL_MITCHELL) || (k.kind == KERNEL_CATMULL_ROM)) {
        let b: f32 = select(0.0, k.b, k.kind == KERNEL_MITCHELL);
        let c: f32 = select(0.5, k.c, k.kind == KERNEL_MITCHELL);
        taps.first = before - 1;
        taps.count = 4;
        taps.weight[0] = mitchell_weight(b, c, 1.0 + f);
        taps.weight[1] = mitchell_weight(b, c, f);
        taps.weight[2] = mitchell_weight(b, c, 1.0 - f);
        taps.weight[3] = mitchell_weight(b, c, 2.0 - f);
    } else if ((k.kind == KERNEL_LANCZOS2) || (k.kind == KERNEL_LANCZOS3)) {
        let lobes: i32 = select(3, 2, k.kind == KERNEL_LANCZOS2);
        taps.first = (before - lobes) + 1;
        taps.count = 2 * lobes;
        var sum: f32 = 0.0;
        for (var i: i32 = 0; i < (2 * lobes); i++) {
            taps.weight[i] = lanczos_weight(f32(lobes), abs(f32((i - lobes) + 1) - f));
            sum += taps.weight[i];
        }
        for (var i: i32 = 0; i < (2 * lobes); i++) {
            taps.weight[i] /= sum;
        }
    } else if (k.kind == KERNEL_GAUSSIAN) {
        // The normal cut at 4 sigma, convolved with the texel's box: differences of its distribution between texel edges.
        let scale: f32 = 0.70710678 / k.b;
        taps.first = i32(floor(x - (4.0 * k.b)));
        taps.count = i32(ceil(8.0 * k.b)) + 1;
        var mass: f32 = normal_mass((f32(taps.first) - x) * scale);
        for (var i: i32 = 0; i < taps.count; i++) {
            let after: f32 = normal_mass((f32((taps.first + i) + 1) - x) * scale);
            taps.weight[i] = after - mass;
            mass = after;
        }
    } else {
        // The normal density at the centres within 4 sigma, and at the nearest in any case.
        var nearest: i32 = i32(floor(x));
        taps.first = min(i32(ceil(centre - (4.0 * k.b))), nearest);
        taps.count = i32(floor(8.0 * k.b)) + 1;
        var sum: f32 = 0.0;
        let to_nearest: f32 = f32(nearest) - centre;
        for (var i: i32 = 0; i < taps.count; i++) {
            var d: f32 = f32(taps.first + i) - centre;
            let counts: bool = (d <= (4.0 * k.b)) || ((taps.first + i) == nearest);
            taps.weight[i] = select(0.0, exp(((to_nearest * to_nearest) - (d * d)) / ((2.0 * k.b) * k.b)), counts);
            sum += taps.weight[i];
        }
        for (var i: i32 = 0; i < taps.count; i++) {
            taps.weight[i] /= sum;
        }
    }
    for (var i: i32 = 0; i < MOST_TAPS; i++) {
        if (abs(taps.weight[i]) < LEAST_WEIGHT) {
            taps.weight[i] = 0.0;
        }
    }
    return taps;
}
