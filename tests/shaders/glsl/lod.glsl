// The level of detail of a footprint (Vulkan "Level-of-Detail Operation", D3D11.3 7.18.11).
#ifndef LOD_GLSL
#define LOD_GLSL
#include "addressing.glsl"

const uint MIP_NONE = 0u, MIP_NEAREST = 1u, MIP_LINEAR = 2u;

// Derivatives in texels of level 0, divided by `scale` so that no square overflows.
struct Footprint {
    vec2 dx, dy;
    float scale;
    bool finite;
};

Footprint footprint_of(vec2 dx, vec2 dy, vec2 extent) {
    Footprint f;
    f.dx = dx * extent;
    f.dy = dy * extent;
    f.finite = is_finite(f.dx.x) && is_finite(f.dx.y) && is_finite(f.dy.x) && is_finite(f.dy.y);
    f.scale = 1.0;
    if (!f.finite) return f;
    float largest = max(max(abs(f.dx.x), abs(f.dx.y)), max(abs(f.dy.x), abs(f.dy.y)));
    if (largest > 1.0e-30) f.scale = largest;
    f.dx /= f.scale;
    f.dy /= f.scale;
    return f;
}

// Axes of the ellipse: squared lengths, and the longer axis.
struct Axes {
    float major2, minor2;
    vec2 major;
};

// The longer and the shorter derivative.
Axes derivative_axes(Footprint f) {
    float x2 = dot(f.dx, f.dx), y2 = dot(f.dy, f.dy);
    return Axes(max(x2, y2), min(x2, y2), x2 < y2 ? f.dy : f.dx);
}

// Singular values of the derivatives.
Axes singular_axes(Footprint f) {
    float p = f.dx.x * f.dx.x + f.dy.x * f.dy.x, r = f.dx.y * f.dx.y + f.dy.y * f.dy.y, q = f.dx.x * f.dx.y + f.dy.x * f.dy.y;
    float half_difference = 0.5 * (p - r), root = sqrt(half_difference * half_difference + q * q);
    float det = f.dx.x * f.dy.y - f.dy.x * f.dx.y;
    Axes a;
    a.major2 = 0.5 * (p + r) + root;
    a.minor2 = a.major2 > 0.0 ? min(det * det / a.major2, a.major2) : 0.0;
    float along = abs(half_difference) + root;
    vec2 direction = half_difference >= 0.0 ? vec2(along, q) : vec2(q, along);
    float length2 = dot(direction, direction);
    a.major = length2 > 1.0e-30 ? direction * sqrt(a.major2 / length2) : vec2(sqrt(a.major2), 0.0);
    return a;
}

const float BEYOND_ALL_LEVELS = 4096.0;

// log2 of the length whose square is given, in units of f.scale.
float log2_length(Footprint f, float squared) {
    if (!f.finite) return BEYOND_ALL_LEVELS;
    return 0.5 * log2(max(squared, 1.0e-37)) + log2(f.scale);
}

// Bias first, then the bounds, of which the lower one wins.
float bound_lod(float lambda, float bias, float min_lod, float max_lod) { return max(min(lambda + bias, max_lod), min_lod); }

// One level, or two and the share of the coarser one. lambda is clamped to the levels there are before it is split.
struct Levels {
    int finer, coarser;
    float fraction;
    float lod;
};

Levels choose_levels(uint mip, float lambda, int levels) {
    Levels l;
    l.lod = clamp(lambda, 0.0, float(levels - 1));
    l.fraction = 0.0;
    if (mip == MIP_NONE) {
        l.finer = 0;
    } else if (mip == MIP_NEAREST) {
        l.finer = int(ceil(l.lod + 0.5)) - 1;
    } else {
        l.finer = int(floor(l.lod));
        l.fraction = l.lod - float(l.finer);
    }
    l.coarser = l.fraction > 0.0 ? l.finer + 1 : l.finer;
    return l;
}

#endif
