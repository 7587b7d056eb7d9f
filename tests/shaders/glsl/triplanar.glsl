// Triplanar mapping: planes weigh |n|^sharpness, and one of them is drawn for a third of the fetches.
#ifndef TRIPLANAR_GLSL
#define TRIPLANAR_GLSL

float whole_power(float base, uint exponent) {
    float power = 1.0;
    while (exponent > 0u) {
        if ((exponent & 1u) != 0u) power *= base;
        exponent >>= 1;
        base *= base;
    }
    return power;
}

// They sum to 1. Without a normal the plane across z is seen.
vec3 plane_weights(vec3 normal, uint sharpness) {
    vec3 n = abs(normal);
    float largest = max(n.x, max(n.y, n.z));
    if (!(largest > 0.0)) return vec3(0.0, 0.0, 1.0);
    n /= largest;
    vec3 w = vec3(whole_power(n.x, sharpness), whole_power(n.y, sharpness), whole_power(n.z, sharpness));
    return w / (w.x + w.y + w.z);
}

// 0, 1, 2: the plane across x, y or z. A plane that weighs nothing is not drawn.
int draw_plane(vec3 weights, float number) {
    if (number < weights.x) return 0;
    return number < weights.x + weights.y || weights.z == 0.0 ? 1 : 2;
}

#endif
