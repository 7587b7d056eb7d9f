// The exact elliptical filter: a Gaussian of covariance S2*J*J^T + I/12 over the texels, each integrated over its box, which adds the other
// I/12. Weighed over every texel it reaches, or drawn at any ratio of its axes for one.
#ifndef ELLIPTICAL_GLSL
#define ELLIPTICAL_GLSL
#include "fis.glsl"
#include "lod.glsl"

const float ELLIPSE_REACH = 5.0;  // standard deviations

struct Ellipse {
    float a, b, c;  // covariance [a b; b c], texels^2 of the level
    float slope;    // how far the rows' centres move per texel
    float sigma;    // of x within a row
};

// Of a level's own texels: what its boxes have filtered already is taken off, as far as the minor axis has it.
Ellipse ellipse_of(Footprint f, Axes singular, float s2, int level, vec2 level_extent_over_first) {
    float area = s2 * f.scale * f.scale, boxes = exp2(2.0 * float(level));
    float most = area * singular.major2, least = area * singular.minor2;
    float removed = min((2.0 * boxes - 3.0) / 12.0, least - boxes / 12.0);
    vec2 k = level_extent_over_first;
    Ellipse e;
    e.a = (area * (f.dx.x * f.dx.x + f.dy.x * f.dy.x) - removed) * k.x * k.x;
    e.b = area * (f.dx.x * f.dx.y + f.dy.x * f.dy.y) * k.x * k.y;
    e.c = (area * (f.dx.y * f.dx.y + f.dy.y * f.dy.y) - removed) * k.y * k.y;
    float determinant = (most - removed) * (least - removed) * k.x * k.x * k.y * k.y;
    e.slope = e.b / e.c;
    e.sigma = sqrt(determinant / e.c);
    return e;
}

// Beyond all levels: a point of the last one.
Ellipse point_ellipse() { return Ellipse(1.0 / 12.0, 0.0, 1.0 / 12.0, 0.0, 0.288675135); }

// Footprints that touch more texels than this read a coarser level.
const float MOST_ELLIPSE_TEXELS = 262144.0;

// Texels that the cut ellipse touches: its area and half the boxes along its outline.
float texels_touched(Ellipse e) {
    return 3.14159265 * ELLIPSE_REACH * ELLIPSE_REACH * e.sigma * sqrt(e.c) + 2.0 * ELLIPSE_REACH * (sqrt(e.a) + sqrt(e.c));
}

// As large as the bound allows, where there is no coarser level.
Ellipse shrink(Ellipse e) {
    while (texels_touched(e) > MOST_ELLIPSE_TEXELS) e = Ellipse(e.a / 4.0, e.b / 4.0, e.c / 4.0, e.slope, e.sigma / 2.0);
    return e;
}

// erf to 2^-22: normal_mass without its cut.
float ellipse_mass(float t) { return normal_mass(t) * 1.999873315; }

// Integral over the box of texel (column, row), relative to the texel that holds the centre; `centre` is the place in that texel.
float texel_mass(Ellipse e, vec2 centre, int column, int row) {
    const float NODE[6] = float[6](0.0337652429, 0.1693953068, 0.3806904070, 0.6193095930, 0.8306046932, 0.9662347571);
    const float WEIGHT[6] = float[6](0.0856622462, 0.1803807865, 0.2339569673, 0.2339569673, 0.1803807865, 0.0856622462);
    float sum = 0.0, scale = 0.70710678 / e.sigma;
    for (int n = 0; n < 6; ++n) {
        float y = float(row) + NODE[n] - centre.y, x = float(column) - centre.x - e.slope * y;
        sum += WEIGHT[n] * exp(-0.5 * y * y / e.c) * (ellipse_mass((x + 1.0) * scale) - ellipse_mass(x * scale));
    }
    return sum;
}

// The standard normal distribution, not cut: numbers are multiples of 2^-24, taken in the middle of what they stand for.
float standard_normal(float number) { return 1.41421356 * inverse_erf(2.0 * number - 1.0 + 5.9604645e-8); }

vec2 draw_ellipse_offset(Ellipse e, vec2 numbers) {
    float y = sqrt(e.c) * standard_normal(numbers.y);
    return vec2(e.slope * y + e.sigma * standard_normal(numbers.x), y);
}

#endif
