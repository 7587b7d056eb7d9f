// Kernels with negative lobes: one texel drawn from the positive weights and one from the magnitudes of the negative ones. The estimate is
// positive_weight*S(positive) - negative_weight*S(negative), each texel shaded by itself; positive_weight = 1 + negative_weight, so that a
// constant has no variance.
#ifndef POSITIVIZATION_GLSL
#define POSITIVIZATION_GLSL
#include "frs.glsl"

struct SignedMasses {
    vec3 positive, negative;  // of either sign along the axes; (1, 0) of an axis that there is not
};

// The mass of negative products.
float negative_mass(SignedMasses m) {
    vec3 p = m.positive, n = m.negative;
    return p.x * n.y * p.z + n.x * p.y * p.z + p.x * p.y * n.z + n.x * n.y * n.z;
}

// Signs that the axes' weights can have, drawn in this order: first those of positive product, then those of negative.
const bvec3 SIGNS[8] = bvec3[8](bvec3(false, false, false), bvec3(true, true, false), bvec3(false, true, true), bvec3(true, false, true),
                                bvec3(false, true, false), bvec3(true, false, false), bvec3(false, false, true), bvec3(true, true, true));

// Which axes take their negative weights.
bvec3 draw_signs(SignedMasses m, bool negative, float number) {
    float share[4], sum = 0.0;
    int first = negative ? 4 : 0;
    for (int n = 0; n < 4; ++n) {
        bvec3 s = SIGNS[first + n];
        share[n] = (s.x ? m.negative.x : m.positive.x) * (s.y ? m.negative.y : m.positive.y) * (s.z ? m.negative.z : m.positive.z);
        sum += share[n];
    }
    bvec3 drawn = SIGNS[first];
    float before = 0.0;
    for (int n = 0; n < 4; ++n) {
        if (share[n] > 0.0 && number * sum >= before) drawn = SIGNS[first + n];
        before += share[n];
    }
    return drawn;
}

int signed_texel(AxisTaps taps, bool negative, float number) {
    return taps.first + reservoir_tap(taps, negative ? LOBES_NEGATIVE : LOBES_POSITIVE, number);
}

#endif
