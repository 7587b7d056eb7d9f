// Addressing in the integer domain: taps are selected first, then each index wraps by itself (Vulkan "Wrapping Operation").
#ifndef ADDRESSING_GLSL
#define ADDRESSING_GLSL

const uint WRAP_REPEAT = 0u, WRAP_MIRROR = 1u, WRAP_CLAMP = 2u, WRAP_BORDER = 3u, WRAP_MIRROR_ONCE = 4u;

bool is_finite(float x) { return (floatBitsToUint(x) & 0x7F800000u) != 0x7F800000u; }

// i mod n for any i, n > 0. Division of negative numbers is not defined alike everywhere, so none is made.
int modulo(int i, int n) { return i >= 0 ? i % n : n - 1 - (-1 - i) % n; }

// The texel in 0..n-1 that index i means, or -1 for the border.
int wrap_index(uint wrap, int i, int n) {
    if (wrap == WRAP_REPEAT) return modulo(i, n);
    if (wrap == WRAP_MIRROR) {
        int place = modulo(i, 2 * n);
        return min(place, 2 * n - 1 - place);
    }
    if (wrap == WRAP_CLAMP) return clamp(i, 0, n - 1);
    if (wrap == WRAP_BORDER) return i < 0 || i >= n ? -1 : i;
    return min(i < 0 ? -1 - i : i, n - 1);
}

// A coordinate with its whole periods taken away, which is exact, before it is scaled: in 32-bit floats u*n loses the fraction of large u.
// Not finite reads as 0.
float reduce_coordinate(uint wrap, float u) {
    if (!is_finite(u)) return 0.0;
    if (wrap == WRAP_REPEAT) return u - trunc(u);
    if (wrap == WRAP_MIRROR) return u - 2.0 * trunc(u * 0.5);
    return clamp(u, -80.0, 80.0);
}

// Texel space: texel i spans i to i + 1.
float texel_space(uint wrap, float u, int n) { return reduce_coordinate(wrap, u) * float(n); }

int level_extent(int n, int level) { return max(1, n >> level); }

#endif
