// A whole lookup of a case: sampler, coordinates, level, probes; then every tap weighed.
#ifndef LOOKUP_GLSL
#define LOOKUP_GLSL
#include "anisotropic_probe.glsl"
#include "contract.glsl"
#include "cube.glsl"
#include "elliptical.glsl"

struct Lookup {
    TextureShape shape;
    uvec3 wrap;
    Kernel minify, magnify;
    uint estimator, mip, lod_rule;
    int most_probes;
    float probe_variance, ellipse, hybrid_bias;
    float lod_bias, min_lod, max_lod;
    vec4 border;
    vec3 at;
    vec2 dx, dy;
    int slice;  // layer, or 6*cube + face
};

Kernel case_kernel(uint index, uint word) {
    return Kernel(case_uint(index, word), case_float(index, word + 1u), case_float(index, word + 2u));
}

bool is_volume(Lookup l) { return l.shape.extent.z > 1; }

// Of three derivatives a flat footprint with the same lengths: its dx and dy.
vec4 flatten(Lookup l, vec3 dx, vec3 dy) {
    vec3 n = vec3(l.shape.extent), x = dx * n, y = dy * n;
    float xx = dot(x, x), yy = dot(y, y), xy = dot(x, y), rho_x = sqrt(xx), rho_y = sqrt(yy);
    if (l.lod_rule == 1u) {
        float difference = 0.5 * (xx - yy);
        rho_x = sqrt(0.5 * (xx + yy) + sqrt(difference * difference + xy * xy));
        rho_y = 0.0;
    }
    return vec4(rho_x / n.x, 0.0, 0.0, rho_y / n.y);
}

Lookup load_lookup(uint index) {
    Lookup l;
    l.shape = texture_shape(case_uint(index, CASE_TEXTURE));
    l.wrap = uvec3(case_uint(index, CASE_WRAP_S), case_uint(index, CASE_WRAP_T), case_uint(index, CASE_WRAP_R));
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
    l.border = vec4(case_vec3(index, CASE_BORDER), case_float(index, CASE_BORDER + 3u));
    l.at = case_vec3(index, CASE_AT);
    vec3 dx = case_vec3(index, CASE_DX), dy = case_vec3(index, CASE_DY);
    l.dx = dx.xy;
    l.dy = dy.xy;
    // The nearest layer, ties to even, within the array.
    float layer = case_float(index, CASE_LAYER);
    int members = l.shape.layers / (l.shape.cube ? 6 : 1);
    l.slice = int(roundEven(clamp(is_finite(layer) ? layer : 0.0, 0.0, float(members - 1))));
    if (is_volume(l)) {
        vec4 flat_footprint = flatten(l, dx, dy);
        l.dx = flat_footprint.xy;
        l.dy = flat_footprint.zw;
        l.slice = 0;
    } else if (l.shape.cube) {
        FacePlace place = project_direction(l.at, dx, dy);
        l.at = vec3(place.at, 0.0);
        l.dx = place.dx;
        l.dy = place.dy;
        l.slice = 6 * l.slice + place.face;
    }
    return l;
}

// What a lookup decides before it reads a texel.
struct Decision {
    Levels levels;
    bool magnified;
    int probes;
    vec2 axis;
};

Decision decide(Lookup l) {
    vec2 extent = vec2(l.shape.extent.xy);
    Footprint f = footprint_of(l.dx, l.dy, extent);
    Decision d;
    d.probes = 1;
    d.axis = vec2(0.0);
    float lambda, magnified;
    bool solid = is_volume(l) || l.shape.cube;
    if (solid || (l.most_probes == 1 && l.probe_variance <= 0.0)) {
        float longer2 = l.lod_rule == 1u ? singular_axes(f).major2 : derivative_axes(f).major2;
        lambda = bound_lod(log2_length(f, longer2), l.lod_bias, l.min_lod, l.max_lod);
        magnified = lambda;
    } else {
        bool normal = l.probe_variance > 0.0;
        Axes axes;
        if (normal || l.lod_rule == 1u) axes = singular_axes(f);
        else axes = derivative_axes(f);
        ProbeLine line;
        if (normal) line = variance_line(f, axes, l.most_probes, l.probe_variance, extent);
        else line = ratio_line(f, axes, l.most_probes, extent);
        lambda = bound_lod(line.lambda, l.lod_bias, l.min_lod, l.max_lod);
        magnified = bound_lod(line.magnified_lambda, l.lod_bias, l.min_lod, l.max_lod);
        d.probes = line.count;
        d.axis = line.axis;
    }
    d.magnified = magnified <= 0.0;
    d.levels = choose_levels(l.mip, lambda, l.shape.levels);
    // Where the last level is one texel, every probe reads that.
    ivec3 last = extent_at(l.shape, l.shape.levels - 1);
    bool bordered = l.wrap.x == WRAP_BORDER || l.wrap.y == WRAP_BORDER;
    if (last.x == 1 && last.y == 1 && !bordered && d.levels.finer == l.shape.levels - 1) d.probes = 1;
    return d;
}

// A texel by indices that are not wrapped yet.
vec4 read_texel(Lookup l, int level, ivec3 i) {
    ivec3 n = extent_at(l.shape, level);
    if (l.shape.cube) {
        int thirds = beyond_corner(i.xy, n.x) ? 3 : 1;
        vec4 sum = vec4(0.0);
        for (int third = 0; third < thirds; ++third) {
            int face = l.slice % 6;
            ivec2 texel = i.xy;
            resolve_cube_texel(face, texel, n.x, third);
            sum += texel_at(l.shape, level, l.slice - l.slice % 6 + face, texel.x, texel.y);
        }
        return sum / float(thirds);
    }
    int x = wrap_index(l.wrap.x, i.x, n.x), y = wrap_index(l.wrap.y, i.y, n.y), z = is_volume(l) ? wrap_index(l.wrap.z, i.z, n.z) : l.slice;
    if (x < 0 || y < 0 || z < 0) return l.border;
    return texel_at(l.shape, level, z, x, y);
}

// Texel-space coordinate along an axis of a level. `moved` is added in texture space after whole periods are taken away.
float axis_coordinate(Lookup l, int axis, int level, float moved) {
    int n = extent_at(l.shape, level)[axis];
    if (l.shape.cube) {
        float x = l.at[axis] * float(n);
        // One texel never leaves the face: a coordinate of 1 belongs to the last.
        return x;
    }
    return (reduce_coordinate(l.wrap[axis], l.at[axis]) + moved) * float(n);
}

AxisTaps lookup_taps(Lookup l, Kernel k, int axis, int level, float moved) {
    AxisTaps taps = axis_taps(k, axis_coordinate(l, axis, level, moved));
    if (l.shape.cube && k.kind == KERNEL_NEAREST) taps.first = clamp(taps.first, 0, extent_at(l.shape, level)[axis] - 1);
    return taps;
}

vec4 shade_texel(uint shader, vec4 texel) {
    if (shader == 1u) return texel * texel;
    if (shader == 2u) return vec4(0.04 + texel.a * (texel.rgb - 0.04), texel.a);
    return texel;
}

// Taps along x, y and z of one level; one of weight 1 along an axis that there is not.
AxisTaps[3] level_taps(Lookup l, Kernel k, int level, vec2 moved) {
    AxisTaps taps[3];
    taps[2].first = 0;
    taps[2].count = 1;
    taps[2].weight[0] = 1.0;
    int axes = is_volume(l) ? 3 : 2;
    for (int axis = 0; axis < axes; ++axis) taps[axis] = lookup_taps(l, k, axis, level, axis < 2 ? moved[axis] : 0.0);
    return taps;
}

// Every tap of one probe in one level. A tap that weighs nothing is not read: 0 times infinity is not a number.
vec4 filter_level(Lookup l, Kernel k, int level, vec2 moved, uint shader) {
    AxisTaps taps[3] = level_taps(l, k, level, moved);
    vec4 sum = vec4(0.0);
    for (int c = 0; c < taps[2].count; ++c) {
        for (int b = 0; b < taps[1].count; ++b) {
            for (int a = 0; a < taps[0].count; ++a) {
                float weight = taps[0].weight[a] * taps[1].weight[b] * taps[2].weight[c];
                if (weight == 0.0) continue;
                ivec3 index = ivec3(taps[0].first + a, taps[1].first + b, taps[2].first + c);
                sum += weight * shade_texel(shader, read_texel(l, level, index));
            }
        }
    }
    return sum;
}

// The texel that nearest reads, for lookups of one texel.
ivec4 nearest_texel(Lookup l, int level) {
    ivec3 n = extent_at(l.shape, level), i = ivec3(0);
    for (int axis = 0; axis < 3; ++axis) i[axis] = int(floor(axis_coordinate(l, axis, level, 0.0)));
    if (l.shape.cube) return ivec4(clamp(i.xy, ivec2(0), n.xy - 1), l.slice, level);
    int x = wrap_index(l.wrap.x, i.x, n.x), y = wrap_index(l.wrap.y, i.y, n.y), z = is_volume(l) ? wrap_index(l.wrap.z, i.z, n.z) : l.slice;
    if (x < 0 || y < 0 || z < 0) return ivec4(-1, -1, 0, level);
    return ivec4(x, y, z, level);
}

// The ellipse of a lookup and its level.
struct PlacedEllipse {
    Ellipse ellipse;
    int level;
};

PlacedEllipse place_ellipse(Lookup l) {
    int last = l.shape.levels - 1;
    Footprint f = footprint_of(l.dx, l.dy, vec2(l.shape.extent.xy));
    if (!f.finite) return PlacedEllipse(point_ellipse(), last);
    Axes axes = singular_axes(f);
    PlacedEllipse p;
    p.level = int(clamp(l.min_lod, 0.0, float(last))) - 1;
    do {
        ++p.level;
        vec2 k = vec2(extent_at(l.shape, p.level).xy) / vec2(l.shape.extent.xy);
        p.ellipse = ellipse_of(f, axes, l.ellipse, p.level, k);
    } while (p.level < last && texels_touched(p.ellipse) > MOST_ELLIPSE_TEXELS);
    ivec3 n = extent_at(l.shape, p.level);
    bool one_texel = n.x == 1 && n.y == 1 && l.wrap.x != WRAP_BORDER && l.wrap.y != WRAP_BORDER;
    if (one_texel) p.ellipse = point_ellipse();
    else p.ellipse = shrink(p.ellipse);
    return p;
}

vec4 filter_ellipse(Lookup l) {
    PlacedEllipse placed = place_ellipse(l);
    Ellipse e = placed.ellipse;
    int level = placed.level;
    vec2 at = vec2(axis_coordinate(l, 0, level, 0.0), axis_coordinate(l, 1, level, 0.0)), corner = floor(at), centre = at - corner;
    float high = ELLIPSE_REACH * sqrt(e.c), sum = 0.0;
    vec4 value = vec4(0.0);
    for (int row = int(floor(centre.y - high)); row <= int(floor(centre.y + high)); ++row) {
        // The row's centre moves by the slope over its height.
        float middle = centre.x + e.slope * (float(row) + 0.5 - centre.y), wide = ELLIPSE_REACH * e.sigma + 0.5 * abs(e.slope);
        for (int column = int(floor(middle - wide)); column <= int(floor(middle + wide)); ++column) {
            float weight = texel_mass(e, centre, column, row);
            if (weight <= 0.0) continue;
            sum += weight;
            value += weight * read_texel(l, level, ivec3(ivec2(corner) + ivec2(column, row), 0));
        }
    }
    return value / sum;
}

// The shader of every tap, weighed.
vec4 filter_lookup(Lookup l, Decision d, uint shader) {
    if (l.ellipse > 0.0 && !l.shape.cube && !is_volume(l)) return filter_ellipse(l);
    Kernel k = l.minify;
    if (d.magnified) k = l.magnify;
    int levels = d.levels.fraction > 0.0 ? 2 : 1;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < d.probes * levels; ++i) {
        vec2 probe = d.probes == 1 ? vec2(0.0, 1.0) : probe_of(l.probe_variance > 0.0, i / levels, d.probes);
        bool coarser = i % levels == 1;
        float share = probe.y * (coarser ? d.levels.fraction : 1.0 - d.levels.fraction);
        sum += share * filter_level(l, k, coarser ? d.levels.coarser : d.levels.finer, probe.x * d.axis, shader);
    }
    return sum;
}

// OP_SAMPLE, and OP_SHADE: order 0 is the shader of the mean, order 1 the mean of the shader.
Result filter_case(uint index) {
    Lookup l = load_lookup(index);
    Decision d = decide(l);
    Result r = no_result();
    Kernel k = l.minify;
    if (d.magnified) k = l.magnify;
    r.texel = ivec4(0, 0, l.slice, d.levels.finer);
    if (k.kind == KERNEL_NEAREST) r.texel = nearest_texel(l, d.levels.finer);
    r.lod = d.levels.lod;
    r.probes = d.probes;
    bool shades = case_uint(index, CASE_OP) == OP_SHADE, after = case_uint(index, CASE_ORDER) == 1u;
    uint shader = shades ? case_uint(index, CASE_SHADER) : 0u;
    r.value = filter_lookup(l, d, after ? shader : 0u);
    if (!after) r.value = shade_texel(shader, r.value);
    return r;
}

#endif
