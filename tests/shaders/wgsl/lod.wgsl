// The level of detail of a footprint (Vulkan "Level-of-Detail Operation", D3D11.3 7.18.11).
// include "addressing.wgsl"

const MIP_NONE: u32 = 0u;
const MIP_NEAREST: u32 = 1u;
const MIP_LINEAR: u32 = 2u;

// Derivatives in texels of level 0, divided by `scale` so that no square overflows.
struct Footprint {
    dx: vec2f,
    dy: vec2f,
    scale: f32,
    finite: bool,
}

fn footprint_of(dx: vec2f, dy: vec2f, extent: vec2f) -> Footprint {
    var f: Footprint;
    f.dx = dx * extent;
    f.dy = dy * extent;
    f.finite = ((is_finite(f.dx.x) && is_finite(f.dx.y)) && is_finite(f.dy.x)) && is_finite(f.dy.y);
    f.scale = 1.0;
    if (!f.finite) {
        return f;
    }
    let largest: f32 = max(max(abs(f.dx.x), abs(f.dx.y)), max(abs(f.dy.x), abs(f.dy.y)));
    if (largest > 1.0e-30) {
        f.scale = largest;
    }
    f.dx /= f.scale;
    f.dy /= f.scale;
    return f;
}

// Axes of the ellipse: squared lengths, and the longer axis.
struct Axes {
    major2: f32,
    minor2: f32,
    major: vec2f,
}

// The longer and the shorter derivative.
fn derivative_axes(f: Footprint) -> Axes {
    let x2: f32 = dot(f.dx, f.dx);
    let y2: f32 = dot(f.dy, f.dy);
    return Axes(max(x2, y2), min(x2, y2), select(f.dx, f.dy, x2 < y2));
}

// Singular values of the derivatives.
fn singular_axes(f: Footprint) -> Axes {
    let p: f32 = (f.dx.x * f.dx.x) + (f.dy.x * f.dy.x);
    let r: f32 = (f.dx.y * f.dx.y) + (f.dy.y * f.dy.y);
    let q: f32 = (f.dx.x * f.dx.y) + (f.dy.x * f.dy.y);
    let half_difference: f32 = 0.5 * (p - r);
    let root: f32 = sqrt((half_difference * half_difference) + (q * q));
    let det: f32 = (f.dx.x * f.dy.y) - (f.dy.x * f.dx.y);
    var a: Axes;
    a.major2 = (0.5 * (p + r)) + root;
    a.minor2 = select(0.0, min((det * det) / a.major2, a.major2), a.major2 > 0.0);
    let along: f32 = abs(half_difference) + root;
    let direction: vec2f = select(vec2f(q, along), vec2f(along, q), half_difference >= 0.0);
    let length2: f32 = dot(direction, direction);
    a.major = select(vec2f(sqrt(a.major2), 0.0), direction * sqrt(a.major2 / length2), length2 > 1.0e-30);
    return a;
}
const BEYOND_ALL_LEVELS: f32 = 4096.0;

// log2 of the length whose square is given, in units of f.scale.
fn log2_length(f: Footprint, squared: f32) -> f32 {
    if (!f.finite) {
        return BEYOND_ALL_LEVELS;
    }
    return (0.5 * log2(max(squared, 1.0e-37))) + log2(f.scale);
}

// Bias first, then the bounds, of which the lower one wins.
fn bound_lod(lambda: f32, bias: f32, min_lod: f32, max_lod: f32) -> f32 {
    return max(min(lambda + bias, max_lod), min_lod);
}

// One level, or two and the share of the coarser one. lambda is clamped to the levels there are before it is split.
struct Levels {
    finer: i32,
    coarser: i32,
    fraction: f32,
    lod: f32,
}

fn choose_levels(mip: u32, lambda: f32, levels: i32) -> Levels {
    var l: Levels;
    l.lod = clamp(lambda, 0.0, f32(levels - 1));
    l.fraction = 0.0;
    if (mip == MIP_NONE) {
        l.finer = 0;
    } else if (mip == MIP_NEAREST) {
        l.finer = i32(ceil(l.lod + 0.5)) - 1;
    } else {
        l.finer = i32(floor(l.lod));
        l.fraction = l.lod - f32(l.finer);
    }
    l.coarser = select(l.finer, l.finer + 1, l.fraction > 0.0);
    return l;
}
