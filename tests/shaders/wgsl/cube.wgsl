// Cube maps: directions as coordinates on a face, and texels beyond an edge, which are those of the neighbouring face. Offsets are texels of
// a face, never of the direction.
// include "addressing.wgsl"

// Faces +X, -X, +Y, -Y, +Z, -Z: where columns, rows and the face itself point (Vulkan "Cube Map Face Selection").
const CUBE_RIGHT: array<vec3i, 6> = array<vec3i, 6>(vec3i(0, 0, -1), vec3i(0, 0, 1), vec3i(1, 0, 0), vec3i(1, 0, 0), vec3i(1, 0, 0), vec3i(-1, 0, 0));
const CUBE_DOWN: array<vec3i, 6> = array<vec3i, 6>(vec3i(0, -1, 0), vec3i(0, -1, 0), vec3i(0, 0, 1), vec3i(0, 0, -1), vec3i(0, -1, 0), vec3i(0, -1, 0));
const CUBE_OUTWARD: array<vec3i, 6> = array<vec3i, 6>(vec3i(1, 0, 0), vec3i(-1, 0, 0), vec3i(0, 1, 0), vec3i(0, -1, 0), vec3i(0, 0, 1), vec3i(0, 0, -1));

struct FacePlace {
    face: i32,
    at: vec2f,  // 0 to 1
    dx: vec2f,
    dy: vec2f,  // its derivatives
}

// Where components tie Z beats Y beats X. What is not finite reads as 0; no direction at all is +Z.
fn project_direction(p_given: vec3f, dx: vec3f, dy: vec3f) -> FacePlace {
    var p = p_given;
    for (var i: i32 = 0; i < 3; i++) {
        p[i] = select(0.0, p[i], is_finite(p[i]));
    }
    let m: vec3f = abs(p);
    let axis: i32 = select(select(0, 1, m.y >= m.x), 2, (m.z >= m.x) && (m.z >= m.y));
    var place: FacePlace;
    place.face = (2 * axis) + (select(0, 1, p[axis] < 0.0));
    let right: vec3f = vec3f(CUBE_RIGHT[place.face]);
    let down: vec3f = vec3f(CUBE_DOWN[place.face]);
    let outward: vec3f = vec3f(CUBE_OUTWARD[place.face]);
    let size: f32 = m[axis];
    let q: vec2f = select(vec2f(0.0), vec2f(dot(right, p), dot(down, p)) / size, size > 0.0);
    place.at = 0.5 * (q + 1.0);
    // By the quotient rule.
    place.dx = (0.5 * (vec2f(dot(right, dx), dot(down, dx)) - (q * dot(outward, dx)))) / size;
    place.dy = (0.5 * (vec2f(dot(right, dy), dot(down, dy)) - (q * dot(outward, dy)))) / size;
    return place;
}

fn idot(a: vec3i, b: vec3i) -> i32 {
    return ((a.x * b.x) + (a.y * b.y)) + (a.z * b.z);
}

fn beyond(i: i32, n: i32) -> bool {
    return (i < 0) || (i >= n);
}

// A texel beyond one edge of its face, on the face where it lies.
fn step_across(face: ptr<function, i32>, texel: ptr<function, vec2i>, n: i32) {
    let in_x: bool = beyond((*texel).x, n);
    let across: i32 = select((*texel).y, (*texel).x, in_x);
    let along: i32 = select((*texel).x, (*texel).y, in_x);
    let depth: i32 = select(across - n, -1 - across, across < 0);
    let right: vec3i = CUBE_RIGHT[(*face)];
    let down: vec3i = CUBE_DOWN[(*face)];
    let outward: vec3i = CUBE_OUTWARD[(*face)];
    let towards: vec3i = (select(down, right, in_x)) * (select(1, -1, across < 0));
    let sideways: vec3i = select(right, down, in_x);
    var there: i32 = 0;
    while (idot(CUBE_OUTWARD[there], towards) != 1) {
        there++;
    }
    // Deeper into the other face is away from where this one looks.
    let other_right: vec3i = CUBE_RIGHT[there];
    let other_down: vec3i = CUBE_DOWN[there];
    let x_out: i32 = idot(other_right, outward);
    let y_out: i32 = idot(other_down, outward);
    let x_is_depth: bool = x_out != 0;
    var moved: vec2i = select(vec2i(along, depth), vec2i(depth, along), x_is_depth);
    if ((x_out > 0) || (idot(other_right, sideways) < 0)) {
        moved.x = (n - 1) - moved.x;
    }
    if ((y_out > 0) || (idot(other_down, sideways) < 0)) {
        moved.y = (n - 1) - moved.y;
    }
    (*face) = there;
    (*texel) = moved;
}

fn fold_onto_faces(face: ptr<function, i32>, texel: ptr<function, vec2i>, n: i32) {
    for (var steps: i32 = 0; (steps < 64) && (beyond((*texel).x, n) != beyond((*texel).y, n)); steps++) {
        step_across(face, texel, n);
    }
}

// Beyond a corner there is no texel; `third` picks one of the three that meet there (0, 1, 2).
fn resolve_cube_texel(face: ptr<function, i32>, texel: ptr<function, vec2i>, n: i32, third: i32) {
    if (beyond((*texel).x, n) && beyond((*texel).y, n)) {
        let inside: vec2i = clamp((*texel), vec2i(0), vec2i(n - 1));
        let just_out: vec2i = clamp((*texel), vec2i(-1), vec2i(n));
        (*texel) = select(select(vec2i(inside.x, just_out.y), vec2i(just_out.x, inside.y), third == 1), inside, third == 0);
    }
    fold_onto_faces(face, texel, n);
}

fn beyond_corner(texel: vec2i, n: i32) -> bool {
    return beyond(texel.x, n) && beyond(texel.y, n);
}
