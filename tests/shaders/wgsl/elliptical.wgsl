// The exact elliptical filter: a Gaussian of covariance S2*J*J^T + I/12 over the texels, each integrated over its box, which adds the other
// I/12. Weighed over every texel it reaches, or drawn at any ratio of its axes for one.
// include "fis.wgsl"
// include "lod.wgsl"

const ELLIPSE_REACH: f32 = 5.0;

// standard deviations
struct Ellipse {
    a: f32,
    b: f32,
    c: f32,  // covariance [a b; b c], texels^2 of the level
    slope: f32,  // how far the rows' centres move per texel
    sigma: f32,  // of x within a row
}

// Of a level's own texels: what its boxes have filtered already is taken off, as far as the minor axis has it.
fn ellipse_of(f: Footprint, singular: Axes, s2: f32, level: i32, level_extent_over_first: vec2f) -> Ellipse {
    let area: f32 = (s2 * f.scale) * f.scale;
    let boxes: f32 = exp2(2.0 * f32(level));
    let most: f32 = area * singular.major2;
    let least: f32 = area * singular.minor2;
    let removed: f32 = min(((2.0 * boxes) - 3.0) / 12.0, least - (boxes / 12.0));
    let k: vec2f = level_extent_over_first;
    var e: Ellipse;
    e.a = (((area * ((f.dx.x * f.dx.x) + (f.dy.x * f.dy.x))) - removed) * k.x) * k.x;
    e.b = ((area * ((f.dx.x * f.dx.y) + (f.dy.x * f.dy.y))) * k.x) * k.y;
    e.c = (((area * ((f.dx.y * f.dx.y) + (f.dy.y * f.dy.y))) - removed) * k.y) * k.y;
    let determinant: f32 = (((((most - removed) * (least - removed)) * k.x) * k.x) * k.y) * k.y;
    e.slope = e.b / e.c;
    e.sigma = sqrt(determinant / e.c);
    return e;
}

// Beyond all levels: a point of the last one.
fn point_ellipse() -> Ellipse {
    return Ellipse(1.0 / 12.0, 0.0, 1.0 / 12.0, 0.0, 0.288675135);
}

// Footprints that touch more texels than this read a coarser level.
const MOST_ELLIPSE_TEXELS: f32 = 262144.0;

// Texels that the cut ellipse touches: its area and half the boxes along its outline.
fn texels_touched(e: Ellipse) -> f32 {
    return ((((3.14159265 * ELLIPSE_REACH) * ELLIPSE_REACH) * e.sigma) * sqrt(e.c)) + ((2.0 * ELLIPSE_REACH) * (sqrt(e.a) + sqrt(e.c)));
}

// As large as the bound allows, where there is no coarser level.
fn shrink(e_given: Ellipse) -> Ellipse {
    var e = e_given;
    while (texels_touched(e) > MOST_ELLIPSE_TEXELS) {
        e = Ellipse(e.a / 4.0, e.b / 4.0, e.c / 4.0, e.slope, e.sigma / 2.0);
    }
    return e;
}

// erf to 2^-22: normal_mass without its cut.
fn ellipse_mass(t: f32) -> f32 {
    return normal_mass(t) * 1.999873315;
}

// Integral over the box of texel (column, row), relative to the texel that holds the centre; `centre` is the place in that texel.
fn texel_mass(e: Ellipse, centre: vec2f, column: i32, row: i32) -> f32 {
    const NODE: array<f32, 6> = array<f32, 6>(0.0337652429, 0.1693953068, 0.3806904070, 0.6193095930, 0.8306046932, 0.9662347571);
    const WEIGHT: array<f32, 6> = array<f32, 6>(0.0856622462, 0.1803807865, 0.2339569673, 0.2339569673, 0.1803807865, 0.0856622462);
    var sum: f32 = 0.0;
    let scale: f32 = 0.70710678 / e.sigma;
    for (var n: i32 = 0; n < 6; n++) {
        let y: f32 = (f32(row) + NODE[n]) - centre.y;
        let x: f32 = (f32(column) - centre.x) - (e.slope * y);
        sum += (WEIGHT[n] * exp(((-0.5 * y) * y) / e.c)) * (ellipse_mass((x + 1.0) * scale) - ellipse_mass(x * scale));
    }
    return sum;
}

// The standard normal distribution, not cut: numbers are multiples of 2^-24, taken in the middle of what they stand for.
fn standard_normal(number: f32) -> f32 {
    return 1.41421356 * inverse_erf(((2.0 * number) - 1.0) + 5.9604645e-8);
}

fn draw_ellipse_offset(e: Ellipse, numbers: vec2f) -> vec2f {
    let y: f32 = sqrt(e.c) * standard_normal(numbers.y);
    return vec2f((e.slope * y) + (e.sigma * standard_normal(numbers.x)), y);
}
