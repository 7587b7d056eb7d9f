// Anisotropic probes along the major axis: how many, where, at which level; and one of them drawn, for which any ratio costs one texel.
#ifndef ANISOTROPIC_PROBE_GLSL
#define ANISOTROPIC_PROBE_GLSL
#include "lod.glsl"

struct ProbeLine {
    int count;
    vec2 axis;     // what places are measured in, in texture coordinates
    float lambda;  // before bias and bounds
    float magnified_lambda;  // that of the shorter axis: magnification is decided by it
};

// ceil, but what exceeds a whole number by next to nothing is rounding noise.
int round_up(float count) { return int(ceil(count * (1.0 - 0.95367432e-6))); }

// Vulkan and D3D: eta = longer/shorter, at most `most`; lambda = log2(longer/eta); ceil(eta) probes. An axis shorter than a texel takes
// fewer (D3D11.3 7.18.11).
ProbeLine ratio_line(Footprint f, Axes a, int most, vec2 extent) {
    ProbeLine line;
    float most2 = float(most * most);
    bool capped = a.minor2 * most2 < a.major2;
    float eta2 = capped ? most2 : a.minor2 > 0.0 ? a.major2 / a.minor2 : 1.0, minor2 = capped ? a.major2 / most2 : a.minor2;
    float minor = sqrt(minor2) * f.scale, eta = sqrt(eta2);
    line.count = f.finite ? clamp(round_up(max(eta * min(minor, 1.0), 1.0)), 1, most) : 1;
    line.lambda = log2_length(f, minor2);
    line.magnified_lambda = line.lambda;
    line.axis = a.major * f.scale / extent;
    return line;
}

// Normal probes: equal steps over +-2 standard deviations; places in standard deviations of the weighted places themselves.
const float NORMAL_REACH = 2.0;
float raw_normal_place(int i, int n) { return NORMAL_REACH * ((2.0 * float(i) + 1.0) / float(n) - 1.0); }
float normal_density(float x) { return exp(-0.5 * x * x); }

struct ProbePlaces {
    float total, deviation;  // sum of densities, standard deviation of raw places
};
ProbePlaces normal_places(int n) {
    ProbePlaces p = ProbePlaces(0.0, 1.0);
    float squares = 0.0;
    for (int i = 0; i < n; ++i) {
        float x = raw_normal_place(i, n), d = normal_density(x);
        p.total += d;
        squares += d * x * x;
    }
    if (n > 1) p.deviation = sqrt(squares / p.total);
    return p;
}
float normal_gap(int n) { return n > 1 ? 2.0 * NORMAL_REACH / float(n) * 1.0 / normal_places(n).deviation : 0.0; }

// Place and weight of probe i of n.
vec2 probe_of(bool normal, int i, int n) {
    if (!normal) return vec2((float(i) + 0.5) / float(n) - 0.5, 1.0 / float(n));
    ProbePlaces p = normal_places(n);
    float x = raw_normal_place(i, n);
    return vec2(x / p.deviation, normal_density(x) / p.total);
}

// Variance of the filter of level l, read bilinearly: 4^l*(1 + 3*fraction) = 4*variance + 1/3.
float lod_of_variance(float variance) {
    float quarters = max(4.0 * variance + 1.0 / 3.0, 1.0);
    float level = floor(0.5 * log2(quarters)), in_level = quarters * exp2(-2.0 * level);
    if (in_level >= 4.0) { level += 1.0; in_level *= 0.25; }
    if (in_level < 1.0) { level -= 1.0; in_level *= 4.0; }
    return level + min((in_level - 1.0) / 3.0, 0.99999994);
}

// Probes and level that together have the covariance s2*J*J^T + I/6.
ProbeLine variance_line(Footprint f, Axes a, int most, float s2, vec2 extent) {
    ProbeLine line;
    float area = f.scale * f.scale;
    float wanted_minor = s2 * area * a.minor2 + 1.0 / 6.0, wanted_extra = s2 * area * (a.major2 - a.minor2);
    float probes = clamp(2.05 * sqrt(wanted_extra / wanted_minor), 1.0, float(most));
    line.count = f.finite ? min(round_up(probes), most) : 1;
    // Probes far apart leave holes: the level takes over part of the extra variance. A single probe shares it evenly.
    float gap = normal_gap(line.count) / 2.5;
    float filled = line.count == 1 ? wanted_minor + 0.5 * wanted_extra : gap * gap * wanted_extra;
    float level_variance = max(filled, wanted_minor), extra = max(wanted_extra - (level_variance - wanted_minor), 0.0);
    line.lambda = f.finite ? lod_of_variance(level_variance) : BEYOND_ALL_LEVELS;
    line.magnified_lambda = log2_length(f, a.minor2);
    float length2 = area * a.major2;
    line.axis = length2 > 0.0 ? a.major * f.scale * sqrt(extra / length2) / extent : vec2(0.0);
    return line;
}

int draw_probe(bool normal, int n, float number) {
    if (!normal) return min(int(number * float(n)), n - 1);
    ProbePlaces p = normal_places(n);
    float before = 0.0, at = number * p.total;
    int drawn = 0;
    for (int i = 0; i < n; ++i) {
        if (at >= before) drawn = i;
        before += normal_density(raw_normal_place(i, n));
    }
    return drawn;
}

#endif
