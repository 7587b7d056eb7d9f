// Filter importance sampling: the coordinate moves by a drawn offset, then the nearest texel is read. The offset's density, convolved with
// the texel's box, is the kernel. Inverse distributions rise with their number, so that filter reservoir sampling draws the same texel.
#ifndef FIS_GLSL
#define FIS_GLSL
#include "kernels.glsl"

// Tent of radius 1.
float tent_offset(float number) { return number < 0.5 ? sqrt(2.0 * number) - 1.0 : 1.0 - sqrt(2.0 - 2.0 * number); }

// Where a rising cubic distribution reaches `mass`, by halving [0, reach]: (cube*x + square)*x^2 in the tail, (cube*x^2 + linear)*x within.
float invert_cubic(float cube, float other, bool tail, float reach, float mass) {
    float below = 0.0, width = reach;
    for (int bit = 0; bit < 25; ++bit) {
        width *= 0.5;
        float x = below + width, q = x * x;
        if ((tail ? q * (cube * x + other) : x * (cube * q + other)) < mass) below = x;
    }
    return below;
}

// Of Mitchell's cubics that are a density convolved with a box, radius 3/2; B = 1, C = 0 is the quadratic B-spline, whose convolution is
// the cubic one.
float mitchell_offset(float b, float c, float number) {
    float side = abs(number - 0.5), outside = 0.5 - side, x;
    if (outside < b / 6.0) {
        x = 1.5 - invert_cubic(b / 6.0 + c, -c, true, 1.0, outside);
    } else {
        x = invert_cubic((5.0 * b + 6.0 * c - 6.0) / 3.0, 1.5 - 0.75 * b - 0.5 * c, false, 0.5, side);
    }
    return number < 0.5 ? -x : x;
}

// Inverse error function (Giles 2010).
float inverse_erf(float x) {
    float w = -log((1.0 - x) * (1.0 + x));
    if (w < 5.0) {
        w -= 2.5;
        return x * (1.50140941 + w * (0.246640727 + w * (-0.00417768164 + w * (-0.00125372503 + w * (0.00021858087 + w * (-4.39150654e-06 +
               w * (-3.5233877e-06 + w * (3.43273939e-07 + w * 2.81022636e-08))))))));
    }
    w = sqrt(w) - 3.0;
    return x * (2.83297682 + w * (1.00167406 + w * (0.00943887047 + w * (-0.0076224613 + w * (0.00573950773 + w * (-0.00367342844 +
           w * (0.00134934322 + w * (0.000100950558 + w * -0.000200214257))))))));
}

// The standard normal distribution cut at 4 sigma. No logarithm of 0: the number is scaled to the mass within the cut first.
float normal_offset(float number) {
    float t = inverse_erf((number - 0.5) * 1.999873315);
    float density = exp(-t * t) * 0.564225322;
    t -= (normal_mass(t) - (number - 0.5)) / density;
    return clamp(t, -2.82842712, 2.82842712) * 1.41421356;
}

float jitter_offset(Kernel k, float number) {
    if (k.kind == KERNEL_BILINEAR) return number - 0.5;
    if (k.kind == KERNEL_QUADRATIC) return tent_offset(number);
    if (k.kind == KERNEL_BSPLINE) return mitchell_offset(1.0, 0.0, number);
    if (k.kind == KERNEL_MITCHELL) return mitchell_offset(k.b, k.c, number);
    if (k.kind == KERNEL_GAUSSIAN) return k.b * normal_offset(number);
    return 0.0;
}

// The index, not wrapped yet, of the texel that is drawn along one axis.
int jitter_texel(Kernel k, float x, float number) { return int(floor(x + jitter_offset(k, number))); }

#endif
