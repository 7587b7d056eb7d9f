// Anisotropic probes along the major axis: how many, where, at which level; and one of them drawn, for which any ratio costs one texel.
// include "lod.wgsl"

struct ProbeLine {
    count: i32,
    axis: vec2f,  // what places are measured in, in texture coordinates
    lambda: f32,  // before bias and bounds
    magnified_lambda: f32,  // that of the shorter axis: magnification is decided by it
}

// ceil, but what exceeds a whole number by next to nothing is rounding noise.
fn round_up(count: f32) -> i32 {
    return i32(ceil(count * (1.0 - 0.95367432e-6)));
}

// Vulkan and D3D: eta = longer/shorter, at most `most`; lambda = log2(longer/eta); ceil(eta) probes. An axis shorter than a texel takes
// fewer (D3D11.3 7.18.11).
fn ratio_line(f: Footprint, a: Axes, most: i32, extent: vec2f) -> ProbeLine {
    var line: ProbeLine;
    let most2: f32 = f32(most * most);
    let capped: bool = (a.minor2 * most2) < a.major2;
    let eta2: f32 = select(select(1.0, a.major2 / a.minor2, a.minor2 > 0.0), most2, capped);
    let minor2: f32 = select(a.minor2, a.major2 / most2, capped);
    let minor: f32 = sqrt(minor2) * f.scale;
    let eta: f32 = sqrt(eta2);
    line.count = select(1, clamp(round_up(max(eta * min(minor, 1.0), 1.0)), 1, most), f.finite);
    line.lambda = log2_length(f, minor2);
    line.magnified_lambda = line.lambda;
    line.axis = (a.major * f.scale) / extent;
    return line;
}

// Normal probes: equal steps over +-2 standard deviations; places in standard deviations of the weighted places themselves.
const NORMAL_REACH: f32 = 2.0;

fn raw_normal_place(i: i32, n: i32) -> f32 {
    return NORMAL_REACH * ((((2.0 * f32(i)) + 1.0) / f32(n)) - 1.0);
}

fn normal_density(x: f32) -> f32 {
    return exp((-0.5 * x) * x);
}

struct ProbePlaces {
    total: f32,
    deviation: f32,  // sum of densities, standard deviation of raw places
}

fn normal_places(n: i32) -> ProbePlaces {
    var p: ProbePlaces = ProbePlaces(0.0, 1.0);
    var squares: f32 = 0.0;
    for (var i: i32 = 0; i < n; i++) {
        let x: f32 = raw_normal_place(i, n);
        let d: f32 = normal_density(x);
        p.total += d;
        squares += (d * x) * x;
    }
    if (n > 1) {
        p.deviation = sqrt(squares / p.total);
    }
    return p;
}

fn normal_gap(n: i32) -> f32 {
    return select(0.0, (((2.0 * NORMAL_REACH) / f32(n)) * 1.0) / normal_places(n).deviation, n > 1);
}

// Place and weight of probe i of n.
fn probe_of(normal: bool, i: i32, n: i32) -> vec2f {
    if (!normal) {
        return vec2f(((f32(i) + 0.5) / f32(n)) - 0.5, 1.0 / f32(n));
    }
    let p: ProbePlaces = normal_places(n);
    let x: f32 = raw_normal_place(i, n);
    return vec2f(x / p.deviation, normal_density(x) / p.total);
}

// Variance of the filter of level l, read bilinearly: 4^l*(1 + 3*fraction) = 4*variance + 1/3.
fn lod_of_variance(variance: f32) -> f32 {
    let quarters: f32 = max((4.0 * variance) + (1.0 / 3.0), 1.0);
    var level: f32 = floor(0.5 * log2(quarters));
    var in_level: f32 = quarters * exp2(-2.0 * level);
    if (in_level >= 4.0) {
        level += 1.0;
        in_level *= 0.25;
    }
    if (in_level < 1.0) {
        level -= 1.0;
        in_level *= 4.0;
    }
    return level + min((in_level - 1.0) / 3.0, 0.99999994);
}

// Probes and level that together have the covariance s2*J*J^T + I/6.
fn variance_line(f: Footprint, a: Axes, most: i32, s2: f32, extent: vec2f) -> ProbeLine {
    var line: ProbeLine;
    let area: f32 = f.scale * f.scale;
    let wanted_minor: f32 = ((s2 * area) * a.minor2) + (1.0 / 6.0);
    let wanted_extra: f32 = (s2 * area) * (a.major2 - a.minor2);
    let probes: f32 = clamp(2.05 * sqrt(wanted_extra / wanted_minor), 1.0, f32(most));
    line.count = select(1, min(round_up(probes), most), f.finite);
    // Probes far apart leave holes: the level takes over part of the extra variance. A single probe shares it evenly.
    let gap: f32 = normal_gap(line.count) / 2.5;
    let filled: f32 = select((gap * gap) * wanted_extra, wanted_minor + (0.5 * wanted_extra), line.count == 1);
    let level_variance: f32 = max(filled, wanted_minor);
    let extra: f32 = max(wanted_extra - (level_variance - wanted_minor), 0.0);
    line.lambda = select(BEYOND_ALL_LEVELS, lod_of_variance(level_variance), f.finite);
    line.magnified_lambda = log2_length(f, a.minor2);
    let length2: f32 = area * a.major2;
    line.axis = select(vec2f(0.0), ((a.major * f.scale) * sqrt(extra / length2)) / extent, length2 > 0.0);
    return line;
}

fn draw_probe(normal: bool, n: i32, number: f32) -> i32 {
    if (!normal) {
        return min(i32(number * f32(n)), n - 1);
    }
    let p: ProbePlaces = normal_places(n);
    var before: f32 = 0.0;
    let at: f32 = number * p.total;
    var drawn: i32 = 0;
    for (var i: i32 = 0; i < n; i++) {
        if (at >= before) {
            drawn = i;
        }
        before += normal_density(raw_normal_place(i, n));
    }
    return drawn;
}
