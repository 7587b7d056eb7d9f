// One draw of a case: the level, the probe, the signs and the texel along each axis, each with a number of its own.
// include "lookup.wgsl"
// include "positivization.wgsl"
// include "random.wgsl"
// include "stochastic_mip.wgsl"

struct DrawNumbers {
    tap: vec3f,
    level: f32,
    probe: f32,
    sign_: f32,
    negative_tap: vec3f,
    negative_sign: f32,
}

fn case_numbers(index: u32) -> DrawNumbers {
    var n: DrawNumbers;
    n.tap = case_vec3(index, CASE_NUMBER_X);
    n.level = case_float(index, CASE_NUMBER_LEVEL);
    n.probe = case_float(index, CASE_NUMBER_PROBE);
    n.sign_ = case_float(index, CASE_NUMBER_SIGN);
    n.negative_tap = case_vec3(index, CASE_NEGATIVE_X);
    n.negative_sign = case_float(index, CASE_NEGATIVE_SIGN);
    return n;
}

fn random_numbers(a: RandomAddress) -> DrawNumbers {
    var n: DrawNumbers;
    n.tap = vec3f(random_float(a, DIMENSION_TAP_X), random_float(a, DIMENSION_TAP_Y), random_float(a, DIMENSION_TAP_Z));
    n.level = random_float(a, DIMENSION_LEVEL);
    n.probe = random_float(a, DIMENSION_PROBE);
    n.sign_ = random_float(a, DIMENSION_SIGN);
    n.negative_tap = vec3f(random_float(a, DIMENSION_NEGATIVE_X), random_float(a, DIMENSION_NEGATIVE_Y), random_float(a, DIMENSION_NEGATIVE_Z));
    n.negative_sign = random_float(a, DIMENSION_NEGATIVE_SIGN);
    return n;
}

// Where indices lead: x, y, slice; x and y are -1 for the border.
fn drawn_texel(l: Lookup, level: i32, i: vec3i, third: f32) -> vec3i {
    let n: vec3i = extent_at(l.shape, level);
    if (l.shape.cube) {
        var face: i32 = l.slice % 6;
        var texel: vec2i = i.xy;
        resolve_cube_texel(&face, &texel, n.x, min(i32(third * 3.0), 2));
        return vec3i(texel, (l.slice - (l.slice % 6)) + face);
    }
    let w: vec3i = vec3i(wrap_index(l.wrap.x, i.x, n.x), wrap_index(l.wrap.y, i.y, n.y), select(l.slice, wrap_index(l.wrap.z, i.z, n.z), is_volume(l)));
    return select(w, vec3i(-1, -1, 0), ((w.x < 0) || (w.y < 0)) || (w.z < 0));
}

fn drawn_value(l: Lookup, level: i32, texel: vec3i) -> vec4f {
    return select(texel_at(l.shape, level, texel.z, texel.x, texel.y), l.border, texel.x < 0);
}

fn draw_ellipse(l: Lookup, n: DrawNumbers) -> Result {
    let f: Footprint = footprint_of(l.dx, l.dy, vec2f(l.shape.extent.xy));
    var drawn: Lookup = l;
    if (is_finite(l.hybrid_bias) && f.finite) {
        // A level as much finer than the coarsest that leaves room for the minor axis.
        let least: f32 = ((l.ellipse * f.scale) * f.scale) * singular_axes(f).minor2;
        let roomy: f32 = 0.5 * log2(1.0 + (4.0 * least));
        var level: f32 = clamp(roomy - l.hybrid_bias, 0.0, f32(l.shape.levels - 1));
        let finer: f32 = floor(level);
        let coarser: bool = ((finer + 1.0) <= roomy) && (n.level < (level - finer));
        drawn.min_lod = max(l.min_lod, select(finer, finer + 1.0, coarser));
    }
    let placed: PlacedEllipse = place_ellipse(drawn);
    let e: Ellipse = placed.ellipse;
    var level: i32 = placed.level;
    let at: vec2f = vec2f(axis_coordinate(l, 0, level, 0.0), axis_coordinate(l, 1, level, 0.0));
    let corner: vec2f = floor(at);
    let to: vec2f = floor((at - corner) + draw_ellipse_offset(e, n.tap.xy)) + corner;
    var r: Result = no_result();
    r.weight = 1.0;
    let texel: vec3i = drawn_texel(l, level, vec3i(vec2i(to), 0), 0.0);
    r.texel = vec4i(texel, level);
    r.value = drawn_value(l, level, texel);
    return r;
}

fn draw_lookup(l: Lookup, n: DrawNumbers) -> Result {
    if (((l.ellipse > 0.0) && !l.shape.cube) && !is_volume(l)) {
        return draw_ellipse(l, n);
    }
    let d: Decision = decide(l);
    var r: Result = no_result();
    r.lod = d.levels.lod;
    r.probes = d.probes;
    var k: Kernel = l.minify;
    if (d.magnified) {
        k = l.magnify;
    }
    let level: i32 = draw_level(d.levels, n.level);
    let axes: i32 = select(2, 3, is_volume(l));
    var moved: vec2f = vec2f(0.0);
    if (d.probes > 1) {
        let normal: bool = l.probe_variance > 0.0;
        moved = probe_of(normal, draw_probe(normal, d.probes, n.probe), d.probes).x * d.axis;
    }
    var i: vec3i = vec3i(0);
    if (l.estimator == ESTIMATOR_JITTER) {
        let extent: vec3i = extent_at(l.shape, level);
        for (var axis: i32 = 0; axis < axes; axis++) {
            i[axis] = jitter_texel(k, axis_coordinate(l, axis, level, select(0.0, moved[axis], axis < 2)), n.tap[axis]);
            if (l.shape.cube && (k.kind == KERNEL_NEAREST)) {
                i[axis] = clamp(i[axis], 0, extent[axis] - 1);
            }
        }
        r.weight = 1.0;
    } else {
        let taps: array<AxisTaps, 3> = level_taps(l, k, level, moved);
        let lobes: bool = has_negative_lobes(k);
        if (!lobes || (l.estimator == ESTIMATOR_ABS_WEIGHT)) {
            let by: i32 = select(LOBES_ALL, LOBES_MAGNITUDE, l.estimator == ESTIMATOR_ABS_WEIGHT);
            var tap: vec3i;
            for (var axis: i32 = 0; axis < 3; axis++) {
                tap[axis] = reservoir_tap(taps[axis], by, n.tap[axis]);
                i[axis] = taps[axis].first + tap[axis];
            }
            r.weight = 1.0;
            if (by == LOBES_MAGNITUDE) {
                // By the magnitude of its weight, with its sign: noisy even on a constant.
                for (var axis: i32 = 0; axis < 3; axis++) {
                    r.weight *= sign(taps[axis].weight[tap[axis]]) * lobe_mass(taps[axis], by);
                }
            }
        } else {
            var m: SignedMasses;
            for (var axis: i32 = 0; axis < 3; axis++) {
                m.positive[axis] = lobe_mass(taps[axis], LOBES_POSITIVE);
                m.negative[axis] = lobe_mass(taps[axis], LOBES_NEGATIVE);
            }
            r.negative_weight = negative_mass(m);
            r.weight = 1.0 + r.negative_weight;
            // The positive texel, and where there is a negative weight a texel for that.
            var j: vec3i = vec3i(0);
            for (var side: i32 = 0; side < (select(1, 2, r.negative_weight > 0.0)); side++) {
                let negative: bool = side == 1;
                let s: vec3<bool> = draw_signs(m, negative, select(n.sign_, n.negative_sign, negative));
                for (var axis: i32 = 0; axis < 3; axis++) {
                    j[axis] = signed_texel(taps[axis], s[axis], select(n.tap[axis], n.negative_tap[axis], negative));
                }
                if (!negative) {
                    i = j;
                }
            }
            if (r.negative_weight > 0.0) {
                r.negative_texel = drawn_texel(l, level, j, n.negative_tap.z);
                r.value = -r.negative_weight * drawn_value(l, level, r.negative_texel);
            }
        }
    }
    let texel: vec3i = drawn_texel(l, level, i, n.tap.z);
    r.texel = vec4i(texel, level);
    let value: vec4f = drawn_value(l, level, texel);
    // A raw texel keeps its bits.
    if ((r.weight == 1.0) && (r.negative_weight == 0.0)) {
        r.value = value;
    } else {
        r.value += r.weight * value;
    }
    return r;
}

fn case_address(index: u32) -> RandomAddress {
    return RandomAddress(vec2u(case_uint(index, CASE_PIXEL_X), case_uint(index, CASE_PIXEL_Y)), case_uint(index, CASE_SAMPLE), case_uint(index, CASE_SURFACE), case_uint(index, CASE_DIMENSION), case_uint(index, CASE_SEED));
}

// OP_DRAW, and OP_MEAN: the mean of draws with the numbers of samples s, s + 1, ...
fn draw_case(index: u32) -> Result {
    let l: Lookup = load_lookup(index);
    let mean: bool = case_uint(index, CASE_OP) == OP_MEAN;
    var a: RandomAddress = case_address(index);
    let count: u32 = select(1u, case_uint(index, CASE_COUNT), mean);
    var sum: vec4f = vec4f(0.0);
    var r: Result = no_result();
    for (var s: u32 = 0u; s < count; s++) {
        var numbers: DrawNumbers = case_numbers(index);
        if (mean) {
            numbers = random_numbers(a);
        }
        r = draw_lookup(l, numbers);
        sum += r.value;
        a.sample_index++;
    }
    if (mean) {
        r.value = sum / f32(count);
    }
    return r;
}
