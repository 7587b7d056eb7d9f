// Filter reservoir sampling: one tap drawn from the discrete weights of an axis.
#ifndef FRS_GLSL
#define FRS_GLSL
#include "kernels.glsl"

// Which of a kernel's weights count.
const int LOBES_ALL = 0, LOBES_POSITIVE = 1, LOBES_NEGATIVE = 2, LOBES_MAGNITUDE = 3;

float lobe_weight(float weight, int lobes) {
    if (lobes == LOBES_POSITIVE) return max(weight, 0.0);
    if (lobes == LOBES_NEGATIVE) return max(-weight, 0.0);
    return lobes == LOBES_MAGNITUDE ? abs(weight) : weight;
}

float lobe_mass(AxisTaps taps, int lobes) {
    float sum = 0.0;
    for (int i = 0; i < taps.count; ++i) sum += lobe_weight(taps.weight[i], lobes);
    return sum;
}

// Of the taps that weigh anything the last one before which the probabilities sum to no more than the number: never a tap of weight 0,
// whatever the number and however the weights round.
int reservoir_tap(AxisTaps taps, int lobes, float number) {
    float at = number * (lobes == LOBES_ALL ? 1.0 : lobe_mass(taps, lobes)), before = 0.0;
    int drawn = 0;
    for (int i = 0; i < taps.count; ++i) {
        float weight = lobe_weight(taps.weight[i], lobes);
        if (weight > 0.0 && at >= before) drawn = i;
        before += weight;
    }
    return drawn;
}

// The index, not wrapped yet, of the texel that is drawn along one axis.
int reservoir_texel(Kernel k, float x, float number) {
    AxisTaps taps = axis_taps(k, x);
    return taps.first + reservoir_tap(taps, LOBES_ALL, number);
}

#endif
