// The sRGB transfer function (IEC 61966-2-1). Texels are decoded one by one, before anything is weighed.
#ifndef SRGB_GLSL
#define SRGB_GLSL
#include "addressing.glsl"

float srgb_to_linear(float encoded) { return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4); }

float linear_to_srgb(float linear) { return linear <= 0.0031308 ? linear * 12.92 : 1.055 * pow(linear, 1.0 / 2.4) - 0.055; }

// The nearest 8-bit code; outside of 0 to 1 the ends, not a number is 0.
uint encode_srgb8(float linear) {
    uint bits = floatBitsToUint(linear);
    bool not_a_number = (bits & 0x7FFFFFFFu) > 0x7F800000u;
    if (not_a_number || (bits & 0x80000000u) != 0u) return 0u;
    return uint(floor(linear_to_srgb(min(linear, 1.0)) * 255.0 + 0.5));
}

#endif
