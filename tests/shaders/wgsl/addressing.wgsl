// Addressing in the integer domain: taps are selected first, then each index wraps by itself (Vulkan "Wrapping Operation").
const WRAP_REPEAT: u32 = 0u;
const WRAP_MIRROR: u32 = 1u;
const WRAP_CLAMP: u32 = 2u;
const WRAP_BORDER: u32 = 3u;
const WRAP_MIRROR_ONCE: u32 = 4u;

fn is_finite(x: f32) -> bool {
    return (bitcast<u32>(x) & 0x7F800000u) != 0x7F800000u;
}

// i mod n for any i, n > 0. Division of negative numbers is not defined alike everywhere, so none is made.
fn modulo(i: i32, n: i32) -> i32 {
    return select((n - 1) - ((-1 - i) % n), i % n, i >= 0);
}

// The texel in 0..n-1 that index i means, or -1 for the border.
fn wrap_index(wrap: u32, i: i32, n: i32) -> i32 {
    if (wrap == WRAP_REPEAT) {
        return modulo(i, n);
    }
    if (wrap == WRAP_MIRROR) {
        let place: i32 = modulo(i, 2 * n);
        return min(place, ((2 * n) - 1) - place);
    }
    if (wrap == WRAP_CLAMP) {
        return clamp(i, 0, n - 1);
    }
    if (wrap == WRAP_BORDER) {
        return select(i, -1, (i < 0) || (i >= n));
    }
    return min(select(i, -1 - i, i < 0), n - 1);
}

// A coordinate with its whole periods taken away, which is exact, before it is scaled: in 32-bit floats u*n loses the fraction of large u.
// Not finite reads as 0.
fn reduce_coordinate(wrap: u32, u: f32) -> f32 {
    if (!is_finite(u)) {
        return 0.0;
    }
    if (wrap == WRAP_REPEAT) {
        return u - trunc(u);
    }
    if (wrap == WRAP_MIRROR) {
        return u - (2.0 * trunc(u * 0.5));
    }
    return clamp(u, -80.0, 80.0);
}

// Texel space: texel i spans i to i + 1.
fn texel_space(wrap: u32, u: f32, n: i32) -> f32 {
    return reduce_coordinate(wrap, u) * f32(n);
}

fn level_extent(n: i32, level: i32) -> i32 {
    return max(1, n >> u32(level));
}
