// Cube maps: directions as coordinates on a face, and texels beyond an edge, which are those of the neighbouring face. Offsets are texels of
// a face, never of the direction.
#ifndef CUBE_GLSL
#define CUBE_GLSL
#include "addressing.glsl"

// Faces +X, -X, +Y, -Y, +Z, -Z: where columns, rows and the face itself point (Vulkan "Cube Map Face Selection").
const ivec3 CUBE_RIGHT[6] = ivec3[6](ivec3(0, 0, -1), ivec3(0, 0, 1), ivec3(1, 0, 0), ivec3(1, 0, 0), ivec3(1, 0, 0), ivec3(-1, 0, 0));
const ivec3 CUBE_DOWN[6] = ivec3[6](ivec3(0, -1, 0), ivec3(0, -1, 0), ivec3(0, 0, 1), ivec3(0, 0, -1), ivec3(0, -1, 0), ivec3(0, -1, 0));
const ivec3 CUBE_OUTWARD[6] = ivec3[6](ivec3(1, 0, 0), ivec3(-1, 0, 0), ivec3(0, 1, 0), ivec3(0, -1, 0), ivec3(0, 0, 1), ivec3(0, 0, -1));

struct FacePlace {
    int face;
    vec2 at;      // 0 to 1
    vec2 dx, dy;  // its derivatives
};

// Where components tie Z beats Y beats X. What is not finite reads as 0; no direction at all is +Z.
FacePlace project_direction(vec3 p, vec3 dx, vec3 dy) {
    for (int i = 0; i < 3; ++i) p[i] = is_finite(p[i]) ? p[i] : 0.0;
    vec3 m = abs(p);
    int axis = m.z >= m.x && m.z >= m.y ? 2 : m.y >= m.x ? 1 : 0;
    FacePlace place;
    place.face = 2 * axis + (p[axis] < 0.0 ? 1 : 0);
    vec3 right = vec3(CUBE_RIGHT[place.face]), down = vec3(CUBE_DOWN[place.face]), outward = vec3(CUBE_OUTWARD[place.face]);
    float size = m[axis];
    vec2 q = size > 0.0 ? vec2(dot(right, p), dot(down, p)) / size : vec2(0.0);
    place.at = 0.5 * (q + 1.0);
    // By the quotient rule.
    place.dx = 0.5 * (vec2(dot(right, dx), dot(down, dx)) - q * dot(outward, dx)) / size;
    place.dy = 0.5 * (vec2(dot(right, dy), dot(down, dy)) - q * dot(outward, dy)) / size;
    return place;
}

int idot(ivec3 a, ivec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

bool beyond(int i, int n) { return i < 0 || i >= n; }

// A texel beyond one edge of its face, on the face where it lies.
void step_across(inout int face, inout ivec2 texel, int n) {
    bool in_x = beyond(texel.x, n);
    int across = in_x ? texel.x : texel.y, along = in_x ? texel.y : texel.x;
    int depth = across < 0 ? -1 - across : across - n;
    ivec3 right = CUBE_RIGHT[face], down = CUBE_DOWN[face], outward = CUBE_OUTWARD[face];
    ivec3 towards = (in_x ? right : down) * (across < 0 ? -1 : 1), sideways = in_x ? down : right;
    int there = 0;
    while (idot(CUBE_OUTWARD[there], towards) != 1) ++there;
    // Deeper into the other face is away from where this one looks.
    ivec3 other_right = CUBE_RIGHT[there], other_down = CUBE_DOWN[there];
    int x_out = idot(other_right, outward), y_out = idot(other_down, outward);
    bool x_is_depth = x_out != 0;
    ivec2 moved = x_is_depth ? ivec2(depth, along) : ivec2(along, depth);
    if (x_out > 0 || idot(other_right, sideways) < 0) moved.x = n - 1 - moved.x;
    if (y_out > 0 || idot(other_down, sideways) < 0) moved.y = n - 1 - moved.y;
    face = there;
    texel = moved;
}

void fold_onto_faces(inout int face, inout ivec2 texel, int n) {
    for (int steps = 0; steps < 64 && beyond(texel.x, n) != beyond(texel.y, n); ++steps) step_across(face, texel, n);
}

// Beyond a corner there is no texel; `third` picks one of the three that meet there (0, 1, 2).
void resolve_cube_texel(inout int face, inout ivec2 texel, int n, int third) {
    if (beyond(texel.x, n) && beyond(texel.y, n)) {
        ivec2 inside = clamp(texel, ivec2(0), ivec2(n - 1)), just_out = clamp(texel, ivec2(-1), ivec2(n));
        texel = third == 0 ? inside : third == 1 ? ivec2(just_out.x, inside.y) : ivec2(inside.x, just_out.y);
    }
    fold_onto_faces(face, texel, n);
}

bool beyond_corner(ivec2 texel, int n) { return beyond(texel.x, n) && beyond(texel.y, n); }

#endif
