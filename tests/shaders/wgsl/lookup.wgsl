// A whole lookup of a case: sampler, coordinates, level, probes; then every tap weighed.
// include "anisotropic_probe.wgsl"
// include "contract.wgsl"
// include "cube.wgsl"
// include "elliptical.wgsl"

struct Lookup {
    shape: TextureShape,
    wrap: vec3u,
    minify: Kernel,
    magnify: Kernel,
    estimator: u32,
    mip: u32,
    lod_rule: u32,
    most_probes: i32,
    probe_variance: f32,
    ellipse: f32,
    hybrid_bias: f32,
    lod_bias: f32,
    min_lod: f32,
    max_lod: f32,
    border: vec4f,
    at: vec3f,
    dx: vec2f,
    dy: vec2f,
    slice: i32,  // layer, or 6*cube + face
}

fn case_kernel(index: u32, word: u32) -> Kernel {
    return Kernel(case_uint(index, word), case_float(index, word + 1u), case_float(index, word + 2u));
}

fn is_volume(l: Lookup) -> bool {
    return l.shape.extent.z > 1;
}

// Of three derivatives a flat footprint with the same lengths: its dx and dy.
fn flatten(l: Lookup, dx: vec3f, dy: vec3f) -> vec4f {
    let n: vec3f = vec3f(l.shape.extent);
    let x: vec3f = dx * n;
    let y: vec3f = dy * n;
    let xx: f32 = dot(x, x);
    let yy: f32 = dot(y, y);
    let xy: f32 = dot(x, y);
    var rho_x: f32 = sqrt(xx);
    var rho_y: f32 = sqrt(yy);
    if (l.lod_rule == 1u) {
        let difference: f32 = 0.5 * (xx - yy);
        rho_x = sqrt((0.5 * (xx + yy)) + sqrt((difference * difference) + (xy * xy)));
        rho_y = 0.0;
    }
    return vec4f(rho_x / n.x, 0.0, 0.0, rho_y / n.y);
}

fn load_lookup(index: u32) -> Lookup {
    var l: Lookup;
    l.shape = texture_shape(case_uint(index, CASE_TEXTURE));
    l.wrap = vec3u(case_uint(index, CASE_WRAP_S), case_uint(index, CASE_WRAP_T), case_uint(index, CASE_WRAP_R));
    l.minify = case_kernel(index, CASE_MINIFY);
    l.magnify = case_kernel(index, CASE_MAGNIFY);
    l.estimator = case_uint(index, CASE_ESTIMATOR);
    l.mip = case_uint(index, CASE_MIP);
    l.lod_rule = case_uint(index, CASE_LOD_RULE);
    l.most_probes = case_int(index, CASE_PROBES);
    l.probe_variance = case_float(index, CASE_PROBE_VARIANCE);
    l.ellipse = case_float(index, CASE_ELLIPSE);
    l.hybrid_bias = case_float(index, CASE_HYBRID_BIAS);
    l.lod_bias = case_float(index, CASE_LOD_BIAS);
    l.min_lod = case_float(index, CASE_MIN_LOD);
    l.max_lod = case_float(index, CASE_MAX_LOD);
    l.border = vec4f(case_vec3(index, CASE_BORDER), case_float(index, CASE_BORDER + 3u));
    l.at = case_vec3(index, CASE_AT);
    let dx: vec3f = case_vec3(index, CASE_DX);
    let dy: vec3f = case_vec3(index, CASE_DY);
    l.dx = dx.xy;
    l.dy = dy.xy;
    // The nearest layer, ties to even, within the array.
    let layer: f32 = case_float(index, CASE_LAYER);
    let members: i32 = l.shape.layers / (select(1, 6, l.shape.cube));
    l.slice = i32(round(clamp(select(0.0, layer, is_finite(layer)), 0.0, f32(members - 1))));
    if (is_volume(l)) {
        let flat_footprint: vec4f = flatten(l, dx, dy);
        l.dx = flat_footprint.xy;
        l.dy = flat_footprint.zw;
        l.slice = 0;
    } else if (l.shape.cube) {
        let place: FacePlace = project_direction(l.at, dx, dy);
        l.at = vec3f(place.at, 0.0);
        l.dx = place.dx;
        l.dy = place.dy;
        l.slice = (6 * l.slice) + place.face;
    }
    return l;
}

// What a lookup decides before it reads a texel.
struct Decision {
    levels: Levels,
    magnified: bool,
    probes: i32,
    axis: vec2f,
}

fn decide(l: Lookup) -> Decision {
    let extent: vec2f = vec2f(l.shape.extent.xy);
    let f: Footprint = footprint_of(l.dx, l.dy, extent);
    var d: Decision;
    d.probes = 1;
    d.axis = vec2f(0.0);
    var lambda: f32;
    var magnified: f32;
    let solid: bool = is_volume(l) || l.shape.cube;
    if (solid || ((l.most_probes == 1) && (l.probe_variance <= 0.0))) {
        let longer2: f32 = select(derivative_axes(f).major2, singular_axes(f).major2, l.lod_rule == 1u);
        lambda = bound_lod(log2_length(f, longer2), l.lod_bias, l.min_lod, l.max_lod);
        magnified = lambda;
    } else {
        let normal: bool = l.probe_variance > 0.0;
        var axes: Axes;
        if (normal || (l.lod_rule == 1u)) {
            axes = singular_axes(f);
        } else {
            axes = derivative_axes(f);
        }
        var line: ProbeLine;
        if (normal) {
            line = variance_line(f, axes, l.most_probes, l.probe_variance, extent);
        } else {
            line = ratio_line(f, axes, l.most_probes, extent);
        }
        lambda = bound_lod(line.lambda, l.lod_bias, l.min_lod, l.max_lod);
        magnified = bound_lod(line.magnified_lambda, l.lod_bias, l.min_lod, l.max_lod);
        d.probes = line.count;
        d.axis = line.axis;
    }
    d.magnified = magnified <= 0.0;
    d.levels = choose_levels(l.mip, lambda, l.shape.levels);
    // Where the last level is one texel, every probe reads that.
    let last: vec3i = extent_at(l.shape, l.shape.levels - 1);
    let bordered: bool = (l.wrap.x == WRAP_BORDER) || (l.wrap.y == WRAP_BORDER);
    if ((((last.x == 1) && (last.y == 1)) && !bordered) && (d.levels.finer == (l.shape.levels - 1))) {
        d.probes = 1;
    }
    return d;
}

// A texel by indices that are not wrapped yet.
fn read_texel(l: Lookup, level: i32, i: vec3i) -> vec4f {
    let n: vec3i = extent_at(l.shape, level);
    if (l.shape.cube) {
        let thirds: i32 = select(1, 3, beyond_corner(i.xy, n.x));
        var sum: vec4f = vec4f(0.0);
        for (var third: i32 = 0; third < thirds; third++) {
            var face: i32 = l.slice % 6;
            var texel: vec2i = i.xy;
            resolve_cube_texel(&face, &texel, n.x, third);
            sum += texel_at(l.shape, level, (l.slice - (l.slice % 6)) + face, texel.x, texel.y);
        }
        return sum / f32(thirds);
    }
    let x: i32 = wrap_index(l.wrap.x, i.x, n.x);
    let y: i32 = wrap_index(l.wrap.y, i.y, n.y);
    let z: i32 = select(l.slice, wrap_index(l.wrap.z, i.z, n.z), is_volume(l));
    if (((x < 0) || (y < 0)) || (z < 0)) {
        return l.border;
    }
    return texel_at(l.shape, level, z, x, y);
}

// Texel-space coordinate along an axis of a level. `moved` is added in texture space after whole periods are taken away.
fn axis_coordinate(l: Lookup, axis: i32, level: i32, moved: f32) -> f32 {
    let n: i32 = extent_at(l.shape, level)[axis];
    if (l.shape.cube) {
        let x: f32 = l.at[axis] * f32(n);
        // One texel never leaves the face: a coordinate of 1 belongs to the last.
        return x;
    }
    return (reduce_coordinate(l.wrap[axis], l.at[axis]) + moved) * f32(n);
}

fn lookup_taps(l: Lookup, k: Kernel, axis: i32, level: i32, moved: f32) -> AxisTaps {
    var taps: AxisTaps = axis_taps(k, axis_coordinate(l, axis, level, moved));
    if (l.shape.cube && (k.kind == KERNEL_NEAREST)) {
        taps.first = clamp(taps.first, 0, extent_at(l.shape, level)[axis] - 1);
    }
    return taps;
}

fn shade_texel(shader: u32, texel: vec4f) -> vec4f {
    if (shader == 1u) {
        return texel * texel;
    }
    if (shader == 2u) {
        return vec4f(0.04 + (texel.a * (texel.rgb - 0.04)), texel.a);
    }
    return texel;
}

// Taps along x, y and z of one level; one of weight 1 along an axis that there is not.
fn level_taps(l: Lookup, k: Kernel, level: i32, moved: vec2f) -> array<AxisTaps, 3> {
    var taps: array<AxisTaps, 3>;
    taps[2].first = 0;
    taps[2].count = 1;
    taps[2].weight[0] = 1.0;
    let axes: i32 = select(2, 3, is_volume(l));
    for (var axis: i32 = 0; axis < axes; axis++) {
        taps[axis] = lookup_taps(l, k, axis, level, select(0.0, moved[axis], axis < 2));
    }
    return taps;
}

// Every tap of one probe in one level. A tap that weighs nothing is not read: 0 times infinity is not a number.
fn filter_level(l: Lookup, k: Kernel, level: i32, moved: vec2f, shader: u32) -> vec4f {
    let taps: array<AxisTaps, 3> = level_taps(l, k, level, moved);
    var sum: vec4f = vec4f(0.0);
    for (var c: i32 = 0; c < taps[2].count; c++) {
        for (var b: i32 = 0; b < taps[1].count; b++) {
            for (var a: i32 = 0; a < taps[0].count; a++) {
                let weight: f32 = (taps[0].weight[a] * taps[1].weight[b]) * taps[2].weight[c];
                if (weight == 0.0) {
                    continue;
                }
                let index: vec3i = vec3i(taps[0].first + a, taps[1].first + b, taps[2].first + c);
                sum += weight * shade_texel(shader, read_texel(l, level, index));
            }
        }
    }
    return sum;
}

// The texel that nearest reads, for lookups of one texel.
fn nearest_texel(l: Lookup, level: i32) -> vec4i {
    let n: vec3i = extent_at(l.shape, level);
    var i: vec3i = vec3i(0);
    for (var axis: i32 = 0; axis < 3; axis++) {
        i[axis] = i32(floor(axis_coordinate(l, axis, level, 0.0)));
    }
    if (l.shape.cube) {
        return vec4i(clamp(i.xy, vec2i(0), n.xy - 1), l.slice, level);
    }
    let x: i32 = wrap_index(l.wrap.x, i.x, n.x);
    let y: i32 = wrap_index(l.wrap.y, i.y, n.y);
    let z: i32 = select(l.slice, wrap_index(l.wrap.z, i.z, n.z), is_volume(l));
    if (((x < 0) || (y < 0)) || (z < 0)) {
        return vec4i(-1, -1, 0, level);
    }
    return vec4i(x, y, z, level);
}

// The ellipse of a lookup and its level.
struct PlacedEllipse {
    ellipse: Ellipse,
    level: i32,
}

fn place_ellipse(l: Lookup) -> PlacedEllipse {
    let last: i32 = l.shape.levels - 1;
    let f: Footprint = footprint_of(l.dx, l.dy, vec2f(l.shape.extent.xy));
    if (!f.finite) {
        return PlacedEllipse(point_ellipse(), last);
    }
    let axes: Axes = singular_axes(f);
    var p: PlacedEllipse;
    p.level = i32(clamp(l.min_lod, 0.0, f32(last))) - 1;
    loop {
        p.level++;
        let k: vec2f = vec2f(extent_at(l.shape, p.level).xy) / vec2f(l.shape.extent.xy);
        p.ellipse = ellipse_of(f, axes, l.ellipse, p.level, k);
        if (!((p.level < last) && (texels_touched(p.ellipse) > MOST_ELLIPSE_TEXELS))) {
            break;
        }
    }
    let n: vec3i = extent_at(l.shape, p.level);
    let one_texel: bool = (((n.x == 1) && (n.y == 1)) && (l.wrap.x != WRAP_BORDER)) && (l.wrap.y != WRAP_BORDER);
    if (one_texel) {
        p.ellipse = point_ellipse();
    } else {
        p.ellipse = shrink(p.ellipse);
    }
    return p;
}

fn filter_ellipse(l: Lookup) -> vec4f {
    let placed: PlacedEllipse = place_ellipse(l);
    let e: Ellipse = placed.ellipse;
    let level: i32 = placed.level;
    let at: vec2f = vec2f(axis_coordinate(l, 0, level, 0.0), axis_coordinate(l, 1, level, 0.0));
    let corner: vec2f = floor(at);
    let centre: vec2f = at - corner;
    let high: f32 = ELLIPSE_REACH * sqrt(e.c);
    var sum: f32 = 0.0;
    var value: vec4f = vec4f(0.0);
    for (var row: i32 = i32(floor(centre.y - high)); row <= i32(floor(centre.y + high)); row++) {
        // The row's centre moves by the slope over its height.
        let middle: f32 = centre.x + (e.slope * ((f32(row) + 0.5) - centre.y));
        let wide: f32 = (ELLIPSE_REACH * e.sigma) + (0.5 * abs(e.slope));
        for (var column: i32 = i32(floor(middle - wide)); column <= i32(floor(middle + wide)); column++) {
            let weight: f32 = texel_mass(e, centre, column, row);
            if (weight <= 0.0) {
                continue;
            }
            sum += weight;
            value += weight * read_texel(l, level, vec3i(vec2i(corner) + vec2i(column, row), 0));
        }
    }
    return value / sum;
}

// The shader of every tap, weighed.
fn filter_lookup(l: Lookup, d: Decision, shader: u32) -> vec4f {
    if (((l.ellipse > 0.0) && !l.shape.cube) && !is_volume(l)) {
        return filter_ellipse(l);
    }
    var k: Kernel = l.minify;
    if (d.magnified) {
        k = l.magnify;
    }
    let levels: i32 = select(1, 2, d.levels.fraction > 0.0);
    var sum: vec4f = vec4f(0.0);
    for (var i: i32 = 0; i < (d.probes * levels); i++) {
        let probe: vec2f = select(probe_of(l.probe_variance > 0.0, i / levels, d.probes), vec2f(0.0, 1.0), d.probes == 1);
        let coarser: bool = (i % levels) == 1;
        let share: f32 = probe.y * (select(1.0 - d.levels.fraction, d.levels.fraction, coarser));
        sum += share * filter_level(l, k, select(d.levels.finer, d.levels.coarser, coarser), probe.x * d.axis, shader);
    }
    return sum;
}

// OP_SAMPLE, and OP_SHADE: order 0 is the shader of the mean, order 1 the mean of the shader.
fn filter_case(index: u32) -> Result {
    let l: Lookup = load_lookup(index);
    let d: Decision = decide(l);
    var r: Result = no_result();
    var k: Kernel = l.minify;
    if (d.magnified) {
        k = l.magnify;
    }
    r.texel = vec4i(0, 0, l.slice, d.levels.finer);
    if (k.kind == KERNEL_NEAREST) {
        r.texel = nearest_texel(l, d.levels.finer);
    }
    r.lod = d.levels.lod;
    r.probes = d.probes;
    let shades: bool = case_uint(index, CASE_OP) == OP_SHADE;
    let after: bool = case_uint(index, CASE_ORDER) == 1u;
    let shader: u32 = select(0u, case_uint(index, CASE_SHADER), shades);
    r.value = filter_lookup(l, d, select(0u, shader, after));
    if (!after) {
        r.value = shade_texel(shader, r.value);
    }
    return r;
}
