// One draw of a case: the level, the probe, the signs and the texel along each axis, each with a number of its own.
#ifndef DRAW_GLSL
#define DRAW_GLSL
#include "lookup.glsl"
#include "positivization.glsl"
#include "random.glsl"
#include "stochastic_mip.glsl"

struct DrawNumbers {
    vec3 tap;
    float level, probe, sign_;
    vec3 negative_tap;
    float negative_sign;
};

DrawNumbers case_numbers(uint index) {
    DrawNumbers n;
    n.tap = case_vec3(index, CASE_NUMBER_X);
    n.level = case_float(index, CASE_NUMBER_LEVEL);
    n.probe = case_float(index, CASE_NUMBER_PROBE);
    n.sign_ = case_float(index, CASE_NUMBER_SIGN);
    n.negative_tap = case_vec3(index, CASE_NEGATIVE_X);
    n.negative_sign = case_float(index, CASE_NEGATIVE_SIGN);
    return n;
}

DrawNumbers random_numbers(RandomAddress a) {
    DrawNumbers n;
    n.tap = vec3(random_float(a, DIMENSION_TAP_X), random_float(a, DIMENSION_TAP_Y), random_float(a, DIMENSION_TAP_Z));
    n.level = random_float(a, DIMENSION_LEVEL);
    n.probe = random_float(a, DIMENSION_PROBE);
    n.sign_ = random_float(a, DIMENSION_SIGN);
    n.negative_tap = vec3(random_float(a, DIMENSION_NEGATIVE_X), random_float(a, DIMENSION_NEGATIVE_Y), random_float(a, DIMENSION_NEGATIVE_Z));
    n.negative_sign = random_float(a, DIMENSION_NEGATIVE_SIGN);
    return n;
}

// Where indices lead: x, y, slice; x and y are -1 for the border.
ivec3 drawn_texel(Lookup l, int level, ivec3 i, float third) {
    ivec3 n = extent_at(l.shape, level);
    if (l.shape.cube) {
        int face = l.slice % 6;
        ivec2 texel = i.xy;
        resolve_cube_texel(face, texel, n.x, min(int(third * 3.0), 2));
        return ivec3(texel, l.slice - l.slice % 6 + face);
    }
    ivec3 w = ivec3(wrap_index(l.wrap.x, i.x, n.x), wrap_index(l.wrap.y, i.y, n.y), is_volume(l) ? wrap_index(l.wrap.z, i.z, n.z) : l.slice);
    return w.x < 0 || w.y < 0 || w.z < 0 ? ivec3(-1, -1, 0) : w;
}

vec4 drawn_value(Lookup l, int level, ivec3 texel) { return texel.x < 0 ? l.border : texel_at(l.shape, level, texel.z, texel.x, texel.y); }

Result draw_ellipse(Lookup l, DrawNumbers n) {
    Footprint f = footprint_of(l.dx, l.dy, vec2(l.shape.extent.xy));
    Lookup drawn = l;
    if (is_finite(l.hybrid_bias) && f.finite) {
        // A level as much finer than the coarsest that leaves room for the minor axis.
        float least = l.ellipse * f.scale * f.scale * singular_axes(f).minor2, roomy = 0.5 * log2(1.0 + 4.0 * least);
        float level = clamp(roomy - l.hybrid_bias, 0.0, float(l.shape.levels - 1)), finer = floor(level);
        bool coarser = finer + 1.0 <= roomy && n.level < level - finer;
        drawn.min_lod = max(l.min_lod, coarser ? finer + 1.0 : finer);
    }
    PlacedEllipse placed = place_ellipse(drawn);
    Ellipse e = placed.ellipse;
    int level = placed.level;
    vec2 at = vec2(axis_coordinate(l, 0, level, 0.0), axis_coordinate(l, 1, level, 0.0)), corner = floor(at);
    vec2 to = floor(at - corner + draw_ellipse_offset(e, n.tap.xy)) + corner;
    Result r = no_result();
    r.weight = 1.0;
    ivec3 texel = drawn_texel(l, level, ivec3(ivec2(to), 0), 0.0);
    r.texel = ivec4(texel, level);
    r.value = drawn_value(l, level, texel);
    return r;
}

Result draw_lookup(Lookup l, DrawNumbers n) {
    if (l.ellipse > 0.0 && !l.shape.cube && !is_volume(l)) return draw_ellipse(l, n);
    Decision d = decide(l);
    Result r = no_result();
    r.lod = d.levels.lod;
    r.probes = d.probes;
    Kernel k = l.minify;
    if (d.magnified) k = l.magnify;
    int level = draw_level(d.levels, n.level), axes = is_volume(l) ? 3 : 2;
    vec2 moved = vec2(0.0);
    if (d.probes > 1) {
        bool normal = l.probe_variance > 0.0;
        moved = probe_of(normal, draw_probe(normal, d.probes, n.probe), d.probes).x * d.axis;
    }
    ivec3 i = ivec3(0);
    if (l.estimator == ESTIMATOR_JITTER) {
        ivec3 extent = extent_at(l.shape, level);
        for (int axis = 0; axis < axes; ++axis) {
            i[axis] = jitter_texel(k, axis_coordinate(l, axis, level, axis < 2 ? moved[axis] : 0.0), n.tap[axis]);
            if (l.shape.cube && k.kind == KERNEL_NEAREST) i[axis] = clamp(i[axis], 0, extent[axis] - 1);
        }
        r.weight = 1.0;
    } else {
        AxisTaps taps[3] = level_taps(l, k, level, moved);
        bool lobes = has_negative_lobes(k);
        if (!lobes || l.estimator == ESTIMATOR_ABS_WEIGHT) {
            int by = l.estimator == ESTIMATOR_ABS_WEIGHT ? LOBES_MAGNITUDE : LOBES_ALL;
            ivec3 tap;
            for (int axis = 0; axis < 3; ++axis) {
                tap[axis] = reservoir_tap(taps[axis], by, n.tap[axis]);
                i[axis] = taps[axis].first + tap[axis];
            }
            r.weight = 1.0;
            if (by == LOBES_MAGNITUDE) {
                // By the magnitude of its weight, with its sign: noisy even on a constant.
                for (int axis = 0; axis < 3; ++axis) r.weight *= sign(taps[axis].weight[tap[axis]]) * lobe_mass(taps[axis], by);
            }
        } else {
            SignedMasses m;
            for (int axis = 0; axis < 3; ++axis) {
                m.positive[axis] = lobe_mass(taps[axis], LOBES_POSITIVE);
                m.negative[axis] = lobe_mass(taps[axis], LOBES_NEGATIVE);
            }
            r.negative_weight = negative_mass(m);
            r.weight = 1.0 + r.negative_weight;
            // The positive texel, and where there is a negative weight a texel for that.
            ivec3 j = ivec3(0);
            for (int side = 0; side < (r.negative_weight > 0.0 ? 2 : 1); ++side) {
                bool negative = side == 1;
                bvec3 s = draw_signs(m, negative, negative ? n.negative_sign : n.sign_);
                for (int axis = 0; axis < 3; ++axis)
                    j[axis] = signed_texel(taps[axis], s[axis], negative ? n.negative_tap[axis] : n.tap[axis]);
                if (!negative) i = j;
            }
            if (r.negative_weight > 0.0) {
                r.negative_texel = drawn_texel(l, level, j, n.negative_tap.z);
                r.value = -r.negative_weight * drawn_value(l, level, r.negative_texel);
            }
        }
    }
    ivec3 texel = drawn_texel(l, level, i, n.tap.z);
    r.texel = ivec4(texel, level);
    vec4 value = drawn_value(l, level, texel);
    // A raw texel keeps its bits.
    if (r.weight == 1.0 && r.negative_weight == 0.0) r.value = value;
    else r.value += r.weight * value;
    return r;
}

RandomAddress case_address(uint index) {
    return RandomAddress(uvec2(case_uint(index, CASE_PIXEL_X), case_uint(index, CASE_PIXEL_Y)), case_uint(index, CASE_SAMPLE),
                         case_uint(index, CASE_SURFACE), case_uint(index, CASE_DIMENSION), case_uint(index, CASE_SEED));
}

// OP_DRAW, and OP_MEAN: the mean of draws with the numbers of samples s, s + 1, ...
Result draw_case(uint index) {
    Lookup l = load_lookup(index);
    bool mean = case_uint(index, CASE_OP) == OP_MEAN;
    RandomAddress a = case_address(index);
    uint count = mean ? case_uint(index, CASE_COUNT) : 1u;
    vec4 sum = vec4(0.0);
    Result r = no_result();
    for (uint s = 0u; s < count; ++s) {
        DrawNumbers numbers = case_numbers(index);
        if (mean) numbers = random_numbers(a);
        r = draw_lookup(l, numbers);
        sum += r.value;
        ++a.sample_index;
    }
    if (mean) r.value = sum / float(count);
    return r;
}

#endif
