// Reconstruction kernels: the weights of the taps along one axis, from where the coordinate lies among the texels. Separable.
#ifndef KERNELS_GLSL
#define KERNELS_GLSL

const uint KERNEL_NEAREST = 0u, KERNEL_BILINEAR = 1u, KERNEL_QUADRATIC = 2u, KERNEL_BSPLINE = 3u, KERNEL_MITCHELL = 4u, KERNEL_CATMULL_ROM = 5u,
           KERNEL_LANCZOS2 = 6u, KERNEL_LANCZOS3 = 7u, KERNEL_GAUSSIAN = 8u, KERNEL_GAUSSIAN_POINT = 9u;

struct Kernel {
    uint kind;
    float b, c;  // Mitchell's B and C; b is the sigma of Gaussians, in texels
};

// Taps first, first + 1, ...; their weights sum to 1. What weighs less than LEAST_WEIGHT weighs nothing: rounding noise draws no texel.
const int MOST_TAPS = 12;  // of Gaussians up to a sigma of 1.25
const float LEAST_WEIGHT = 1.1920929e-7;
struct AxisTaps {
    int first, count;
    float weight[MOST_TAPS];
};

bool has_negative_lobes(Kernel k) {
    if (k.kind == KERNEL_MITCHELL) {
        if (k.c > 0.0 || k.b < 0.0 || k.b > 3.0) return true;
        float square = 2.0 * k.b + k.c - 3.0, cube = 2.0 - 1.5 * k.b - k.c, lowest = -2.0 * square / (3.0 * cube);
        return lowest > 0.0 && lowest < 1.0 && 1.0 - k.b / 3.0 + square * lowest * lowest / 3.0 < 0.0;
    }
    return k.kind == KERNEL_CATMULL_ROM || k.kind == KERNEL_LANCZOS2 || k.kind == KERNEL_LANCZOS3;
}

float mitchell_weight(float b, float c, float x) {
    if (x < 1.0) return (2.0 - 1.5 * b - c) * x * x * x + (2.0 * b + c - 3.0) * x * x + 1.0 - b / 3.0;
    float s = 2.0 - x;
    return s > 0.0 ? s * s * ((b / 6.0 + c) * s - c) : 0.0;
}

// sin(pi*x) of |x| <= 1/2 by its series: the sines of Vulkan are only good to 2^-11.
float sin_pi(float x) {
    float a = x * 3.14159265, q = a * a;
    return a * (1.0 + q * (-1.0 / 6.0 + q * (1.0 / 120.0 + q * (-1.0 / 5040.0 + q * (1.0 / 362880.0 - q / 39916800.0)))));
}

// Raw: taps have to be normalised, for raw weights do not sum to 1.
float lanczos_weight(float lobes, float x) {
    if (x < 1.0e-4) return 1.0;
    if (x >= lobes) return 0.0;
    // sin(pi*x) by the distance from the nearest whole number, sin(pi*x/lobes) by its own symmetry.
    float n = floor(x + 0.5), a = sin_pi(x - n), y = x / lobes;
    if (mod(n, 2.0) == 1.0) a = -a;
    float b = sin_pi(y > 0.5 ? 1.0 - y : y);
    return lobes * a * b / (9.8696044 * x * x);
}

// Mass of the normal distribution, cut at 4 sigma and renormalised, from its mean to t*sqrt(2)*sigma; erf by Chebyshev interpolants good
// to 2^-24.
float normal_mass(float t) {
    float x = min(abs(t), 2.82842712), mass;
    if (x <= 1.0) {
        float q = x * x;
        mass = x * (0.564225322 + q * (-0.188075048 + q * (0.0564215612 + q * (-0.013428015 + q * (0.00259482033 + q * (-0.000400968148 + q * 3.94149822e-05))))));
    } else {
        float y = x - 1.91421354;
        mass = 0.5 - (0.00336216558 + y * (-0.0144579898 + y * (0.0276752822 + y * (-0.0304960717 + y * (0.0199680694 + y * (-0.00615501888 +
               y * (-0.00142238754 + y * (0.00228298214 + y * (-0.000732886796 + y * (-0.000179221185 + y * 0.000142815503))))))))));
    }
    return t < 0.0 ? -mass : mass;
}

// x in texel space, texel i spanning i to i + 1.
AxisTaps axis_taps(Kernel k, float x) {
    AxisTaps taps;
    for (int i = 0; i < MOST_TAPS; ++i) taps.weight[i] = 0.0;
    float centre = x - 0.5;  // texel i has its centre at i
    int before = int(floor(centre));
    float f = centre - float(before);
    if (k.kind == KERNEL_NEAREST) {
        taps.first = int(floor(x));
        taps.count = 1;
        taps.weight[0] = 1.0;
        return taps;
    }
    if (k.kind == KERNEL_BILINEAR) {
        taps.first = before;
        taps.count = 2;
        taps.weight[0] = 1.0 - f;
        taps.weight[1] = f;
    } else if (k.kind == KERNEL_QUADRATIC) {
        int nearest = int(floor(x));
        float d = centre - float(nearest);
        taps.first = nearest - 1;
        taps.count = 3;
        taps.weight[0] = 0.5 * (0.5 - d) * (0.5 - d);
        taps.weight[1] = 0.75 - d * d;
        taps.weight[2] = 0.5 * (0.5 + d) * (0.5 + d);
    } else if (k.kind == KERNEL_BSPLINE) {
        float g = 1.0 - f;
        taps.first = before - 1;
        taps.count = 4;
        taps.weight[0] = g * g * g / 6.0;
        taps.weight[1] = 2.0 / 3.0 - 0.5 * f * f * (2.0 - f);
        taps.weight[2] = 2.0 / 3.0 - 0.5 * g * g * (2.0 - g);
        taps.weight[3] = f * f * f / 6.0;
    } else if (k.kind == KERNEL_MITCHELL || k.kind == KERNEL_CATMULL_ROM) {
        float b = k.kind == KERNEL_MITCHELL ? k.b : 0.0, c = k.kind == KERNEL_MITCHELL ? k.c : 0.5;
        taps.first = before - 1;
        taps.count = 4;
        taps.weight[0] = mitchell_weight(b, c, 1.0 + f);
        taps.weight[1] = mitchell_weight(b, c, f);
        taps.weight[2] = mitchell_weight(b, c, 1.0 - f);
        taps.weight[3] = mitchell_weight(b, c, 2.0 - f);
    } else if (k.kind == KERNEL_LANCZOS2 || k.kind == KERNEL_LANCZOS3) {
        int lobes = k.kind == KERNEL_LANCZOS2 ? 2 : 3;
        taps.first = before - lobes + 1;
        taps.count = 2 * lobes;
        float sum = 0.0;
        for (int i = 0; i < 2 * lobes; ++i) {
            taps.weight[i] = lanczos_weight(float(lobes), abs(float(i - lobes + 1) - f));
            sum += taps.weight[i];
        }
        for (int i = 0; i < 2 * lobes; ++i) taps.weight[i] /= sum;
    } else if (k.kind == KERNEL_GAUSSIAN) {
        // The normal cut at 4 sigma, convolved with the texel's box: differences of its distribution between texel edges.
        float scale = 0.70710678 / k.b;
        taps.first = int(floor(x - 4.0 * k.b));
        taps.count = int(ceil(8.0 * k.b)) + 1;
        float mass = normal_mass((float(taps.first) - x) * scale);
        for (int i = 0; i < taps.count; ++i) {
            float after = normal_mass((float(taps.first + i + 1) - x) * scale);
            taps.weight[i] = after - mass;
            mass = after;
        }
    } else {
        // The normal density at the centres within 4 sigma, and at the nearest in any case.
        int nearest = int(floor(x));
        taps.first = min(int(ceil(centre - 4.0 * k.b)), nearest);
        taps.count = int(floor(8.0 * k.b)) + 1;
        float sum = 0.0, to_nearest = float(nearest) - centre;
        for (int i = 0; i < taps.count; ++i) {
            float d = float(taps.first + i) - centre;
            bool counts = d <= 4.0 * k.b || taps.first + i == nearest;
            taps.weight[i] = counts ? exp((to_nearest * to_nearest - d * d) / (2.0 * k.b * k.b)) : 0.0;
            sum += taps.weight[i];
        }
        for (int i = 0; i < taps.count; ++i) taps.weight[i] /= sum;
    }
    for (int i = 0; i < MOST_TAPS; ++i) {
        if (abs(taps.weight[i]) < LEAST_WEIGHT) taps.weight[i] = 0.0;
    }
    return taps;
}

#endif
