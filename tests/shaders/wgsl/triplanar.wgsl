// Triplanar mapping: planes weigh |n|^sharpness, and one of them is drawn for a third of the fetches.
fn whole_power(base_given: f32, exponent_given: u32) -> f32 {
    var base = base_given;
    var exponent = exponent_given;
    var power: f32 = 1.0;
    while (exponent > 0u) {
        if ((exponent & 1u) != 0u) {
            power *= base;
        }
        exponent >>= 1;
        base *= base;
    }
    return power;
}

// They sum to 1. Without a normal the plane across z is seen.
fn plane_weights(normal: vec3f, sharpness: u32) -> vec3f {
    var n: vec3f = abs(normal);
    let largest: f32 = max(n.x, max(n.y, n.z));
    if (!(largest > 0.0)) {
        return vec3f(0.0, 0.0, 1.0);
    }
    n /= largest;
    let w: vec3f = vec3f(whole_power(n.x, sharpness), whole_power(n.y, sharpness), whole_power(n.z, sharpness));
    return w / ((w.x + w.y) + w.z);
}

// 0, 1, 2: the plane across x, y or z. A plane that weighs nothing is not drawn.
fn draw_plane(weights: vec3f, number: f32) -> i32 {
    if (number < weights.x) {
        return 0;
    }
    return select(2, 1, (number < (weights.x + weights.y)) || (weights.z == 0.0));
}
