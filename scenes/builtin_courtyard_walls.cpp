#include "scenes/builtin_arcade.h"
#include "scenes/builtin_courtyard.h"
#include "scenes/builtin_fittings.h"
#include "scenes/procedural_noise.h"
#include "scenes/shapes.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace rawtexel::scenes {
namespace {

constexpr int kBays = 5;
constexpr ArcadeBay kBay{.width = 2.0f * kCourt / float(kBays), .height = kUpperFloor - kArcadeFloor};

glm::mat4 moved(glm::vec3 by) { return glm::translate(glm::mat4(1.0f), by); }

/// The two sides that have arcades: local x along the side from corner to end, local z = 0 its front, facing the court.
glm::mat4 back_side() { return moved({0.0f, 0.0f, -kCourt}); }
glm::mat4 left_side() { return glm::rotate(moved({-kCourt, 0.0f, 0.0f}), glm::half_pi<float>(), glm::vec3(0, 1, 0)); }

/// Under the arches the sky is seen through the openings only, the less the deeper and the higher one is. `p` in a side's frame.
float under_arcade(glm::vec3 p, glm::vec3 normal) {
    const float depth = std::clamp(-p.z / kArcadeDepth, 0.0f, 1.0f), rise = std::clamp(p.y / kBay.height, 0.0f, 1.0f);
    const float outwards = 0.8f + 0.2f * normal.z;
    return (0.80f - 0.30f * depth) * (1.0f - 0.35f * rise * depth) * outwards;
}

float bay_openness(glm::vec3 p, glm::vec3 normal) {
    return p.z > -0.01f && normal.z > 0.5f ? 0.92f - 0.25f * smooth_step(-0.45f, 0.0f, p.y - kBay.height) : under_arcade(p, normal) + 0.08f;
}

float column_openness(glm::vec3 p, glm::vec3 normal) {
    const float foot = smooth_step(-0.1f, 0.5f, p.y);
    return (0.68f + 0.24f * normal.z) * (0.7f + 0.3f * foot) * (normal.y < -0.5f ? 0.5f : 1.0f);
}

void place_on_sides(Courtyard& court, uint32_t mesh, const glm::mat4& in_side) {
    court.place(mesh, back_side() * in_side);
    court.place(mesh, left_side() * in_side);
}

void build_bays(Courtyard& court) {
    constexpr int kVoussoirs = 17;
    const CourtyardMaterials& m = court.materials();
    shading::Mesh spandrels, stone, brick, column;
    append_spandrels(spandrels, kBay, 4.0f);
    append_voussoirs(stone, kBay, kVoussoirs, 0, 2.0f);
    append_voussoirs(brick, kBay, kVoussoirs, 1, 1.0f);
    append_column(column, kBay.spring, 0.145f);
    const std::array<uint32_t, 3> parts{court.add("spandrels", m.plaster, std::move(spandrels), bay_openness),
                                        court.add("pale voussoirs", m.limestone, std::move(stone), bay_openness),
                                        court.add("red voussoirs", m.brick, std::move(brick), bay_openness)};
    const uint32_t column_mesh = court.add("column", m.limestone, std::move(column), column_openness);
    for (int i = 0; i < kBays; ++i) {
        const float x = (float(i) + 0.5f) * kBay.width - kCourt;
        for (const uint32_t part : parts) {
            place_on_sides(court, part, moved({x, kArcadeFloor, 0.0f}));
        }
    }
    const float axis = -0.5f * kBay.thickness;
    for (int i = 1; i <= kBays; ++i) {
        court.place(column_mesh, back_side() * moved({float(i) * kBay.width - kCourt, kArcadeFloor, axis}));
        court.place(column_mesh, left_side() * moved({kCourt - float(i) * kBay.width, kArcadeFloor, axis}));
    }
    // The column in the corner carries both sides; the block above it closes the angle of the walls.
    court.place(column_mesh, moved({-kCourt + axis, kArcadeFloor, -kCourt + axis}));
    shading::Mesh corner;
    const float corner_height = 0.5f * (kBay.height - kBay.spring);
    append_rounded_box(corner, {-kCourt + axis, kArcadeFloor + kBay.spring + corner_height, -kCourt + axis},
                       {-axis - 0.001f, corner_height, -axis - 0.001f}, 0.01f, 4.0f);
    court.add_and_place("corner", m.plaster, std::move(corner), [](glm::vec3, glm::vec3) { return 0.7f; });
}

/// A stone band along the front of a side: a moulding that throws a line of shadow.
shading::Mesh moulding(float y, float height, float depth) {
    shading::Mesh mesh;
    for (int i = 0; i < kBays; ++i) {
        const float x = (float(i) + 0.5f) * kBay.width - kCourt;
        append_rounded_box(mesh, {x, y + 0.5f * height, 0.5f * depth - 0.1f},
                           {0.5f * kBay.width - 0.002f, 0.5f * height, 0.5f * depth + 0.1f}, 0.015f, 2.0f);
    }
    return mesh;
}

float moulding_openness(glm::vec3, glm::vec3 normal) { return normal.y < -0.3f ? 0.45f : 0.9f; }

/// The passage behind the arches: inner wall with a tiled dado, floor, beamed ceiling. In the frame of a side, ends open.
struct Passage {
    shading::Mesh wall, dado, rail, floor, ceiling, beams;
};

Passage make_passage(float left, float right, float wall_right) {
    Passage passage;
    const float width = right - left, wall_width = wall_right - left, back = -kArcadeDepth, top = kUpperFloor - 0.05f;
    constexpr float kDado = 1.05f;
    const auto grid = [&](shading::Mesh& mesh, glm::vec3 corner, glm::vec3 along, glm::vec3 up, glm::vec3 normal, float metres_per_uv) {
        append_patch(mesh, 24, 8, [&](float s, float t) {
            const glm::vec2 metres(s * glm::length(along), -t * glm::length(up));
            return ShapePoint{corner + s * along + t * up, normal, along, metres / metres_per_uv};
        });
    };
    grid(passage.wall, {left, kArcadeFloor + kDado, back}, {wall_width, 0, 0}, {0, top - kArcadeFloor - kDado, 0}, {0, 0, 1}, 4.0f);
    grid(passage.dado, {left, kArcadeFloor, back + 0.015f}, {wall_width, 0, 0}, {0, kDado, 0}, {0, 0, 1}, 1.2f);
    append_rounded_box(passage.rail, {left + 0.5f * wall_width, kArcadeFloor + kDado + 0.03f, back + 0.02f},
                       {0.5f * wall_width, 0.03f, 0.035f}, 0.01f, 2.0f);
    grid(passage.floor, {left, kArcadeFloor, 0.06f}, {width, 0, 0}, {0, 0, back - 0.06f}, {0, 1, 0}, 1.6f);
    grid(passage.floor, {left, 0.0f, 0.06f}, {width, 0, 0}, {0, kArcadeFloor, 0}, {0, 0, 1}, 1.6f);
    grid(passage.ceiling, {left, top, back}, {width, 0, 0}, {0, 0, -back}, {0, -1, 0}, 1.2f);
    for (float x = left + 0.3f; x < right; x += 0.6f) {
        append_rounded_box(passage.beams, {x, top - 0.09f, 0.5f * back - 0.2f}, {0.07f, 0.09f, -0.5f * back - 0.2f}, 0.012f, 1.2f);
    }
    return passage;
}

void build_passages(Courtyard& court) {
    const CourtyardMaterials& m = court.materials();
    const auto place = [&](Passage passage, const glm::mat4& side) {
        court.place(court.add("passage wall", m.plaster, std::move(passage.wall), under_arcade), side);
        court.place(court.add("dado", m.tiles, std::move(passage.dado), under_arcade), side);
        court.place(court.add("dado rail", m.limestone, std::move(passage.rail), under_arcade), side);
        court.place(court.add("passage floor", m.ashlar, std::move(passage.floor),
                              [](glm::vec3 p, glm::vec3 n) { return p.z > 0.0f ? 0.8f : under_arcade(p, n) + 0.12f; }),
                    side);
        court.place(court.add("ceiling", m.oak, std::move(passage.ceiling), under_arcade), side);
        court.place(court.add("beams", m.oak, std::move(passage.beams), under_arcade), side);
    };
    // In the frame of the left side the corner is at +x. The back passage runs through it, the left one lends it a wall.
    place(make_passage(-kCourt - kArcadeDepth, kCourt + 0.6f, kCourt + 0.6f), back_side());
    place(make_passage(-kCourt - 0.6f, kCourt, kCourt + kArcadeDepth), left_side());
}

/// A studded door in a stone frame, in the plane z = 0, its threshold's middle at the origin.
void build_door(Courtyard& court, const glm::mat4& place) {
    constexpr float kHalfWidth = 0.72f, kHeight = 2.35f, kFrame = 0.11f;
    const CourtyardMaterials& m = court.materials();
    shading::Mesh leaf, frame, fittings;
    append_rounded_box(leaf, {0.0f, 0.5f * kHeight, 0.03f}, {kHalfWidth, 0.5f * kHeight, 0.03f}, 0.01f, 1.2f);
    for (const float side : {-1.0f, 1.0f}) {
        append_rounded_box(frame, {side * (kHalfWidth + kFrame), 0.5f * kHeight, 0.05f}, {kFrame, 0.5f * kHeight, 0.07f}, 0.015f, 2.0f);
    }
    append_rounded_box(frame, {0.0f, kHeight + kFrame, 0.05f}, {kHalfWidth + 2.0f * kFrame, kFrame, 0.08f}, 0.015f, 2.0f);
    for (const float y : {0.4f, 1.2f, 2.0f}) {
        append_rounded_box(fittings, {-0.1f, y, 0.068f}, {kHalfWidth - 0.12f, 0.035f, 0.010f}, 0.006f, 1.0f);
    }
    shading::Mesh ring;
    append_torus(ring, 0.075f, 0.012f, 24, 8, {3.0f, 0.3f});
    append_mesh(fittings, ring, glm::rotate(moved({0.5f, 1.12f, 0.085f}), glm::half_pi<float>(), glm::vec3(1, 0, 0)));
    const Openness dim = [](glm::vec3 p, glm::vec3 n) { return 0.30f + 0.12f * n.z - 0.05f * p.y; };
    court.place(court.add("door", m.oak, std::move(leaf), dim), place);
    court.place(court.add("door frame", m.limestone, std::move(frame), dim), place);
    court.place(court.add("door fittings", m.iron, std::move(fittings), dim), place);
}

/// A window with a sill, a lintel and open shutters; its sill's middle at the origin, the wall's plane z = 0.
struct Window {
    uint32_t stone, pane, shutters, bars;
};

Window make_window(Courtyard& court) {
    constexpr float kHalfWidth = 0.46f, kHeight = 1.35f;
    const CourtyardMaterials& m = court.materials();
    shading::Mesh stone, pane, shutters, bars;
    append_rounded_box(stone, {0.0f, -0.05f, 0.08f}, {kHalfWidth + 0.18f, 0.05f, 0.12f}, 0.015f, 2.0f);
    append_rounded_box(stone, {0.0f, kHeight + 0.08f, 0.03f}, {kHalfWidth + 0.12f, 0.08f, 0.06f}, 0.015f, 2.0f);
    for (const float side : {-1.0f, 1.0f}) {
        append_rounded_box(stone, {side * (kHalfWidth + 0.05f), 0.5f * kHeight, 0.02f}, {0.05f, 0.5f * kHeight, 0.05f}, 0.012f, 2.0f);
        // Folded back against the wall, not quite flat.
        shading::Mesh shutter;
        append_rounded_box(shutter, {0.0f, 0.5f * kHeight, 0.0f}, {0.5f * kHalfWidth, 0.5f * kHeight, 0.02f}, 0.006f, 1.2f);
        const glm::mat4 hinge =
            glm::rotate(moved({side * (kHalfWidth + 0.10f), 0.0f, 0.06f}), side * glm::radians(-16.0f), glm::vec3(0, 1, 0));
        append_mesh(shutters, shutter, hinge * moved({side * 0.5f * kHalfWidth, 0.0f, 0.0f}));
    }
    append_rectangle(pane, {-kHalfWidth, 0.0f, 0.005f}, {2.0f * kHalfWidth, 0, 0}, {0, kHeight, 0}, {0, 1}, {1, 0});
    append_rounded_box(bars, {0.0f, 0.5f * kHeight, 0.015f}, {0.02f, 0.5f * kHeight, 0.012f}, 0.004f, 1.2f);
    for (const float y : {0.45f, 0.9f}) {
        append_rounded_box(bars, {0.0f, y, 0.014f}, {kHalfWidth, 0.016f, 0.010f}, 0.004f, 1.2f);
    }
    const Openness open = [](glm::vec3 p, glm::vec3 n) { return n.y < -0.5f ? 0.4f : p.z < 0.03f ? 0.6f : 0.85f; };
    return {court.add("window stone", m.limestone, std::move(stone), open), court.add("window pane", m.dark, std::move(pane), open),
            court.add("shutters", m.shutter, std::move(shutters), open), court.add("window bars", m.shutter, std::move(bars), open)};
}

/// Tiles over boards and rafters that stand out from the walls.
void build_roofs(Courtyard& court) {
    constexpr float kPitch = 0.20f, kRun = 2.2f, kRise = 0.85f, kOverhang = 0.46f, kEaves = kCornice + 0.10f;
    const CourtyardMaterials& m = court.materials();
    shading::Mesh tiles, boards;
    append_roof(tiles, int((2.0f * kCourt + 2.2f) / kPitch), kPitch, kRun, kRise);
    append_rounded_box(boards, {0.5f, kEaves - 0.02f, kOverhang - 0.35f}, {kCourt + 0.7f, 0.02f, 0.32f}, 0.008f, 1.2f);
    for (float x = -kCourt + 0.2f; x < kCourt + 1.0f; x += 0.5f) {
        append_rounded_box(boards, {x, kEaves - 0.085f, kOverhang - 0.36f}, {0.045f, 0.05f, 0.30f}, 0.01f, 1.2f);
    }
    const uint32_t roof = court.add("roof", m.roof, std::move(tiles), [](glm::vec3, glm::vec3) { return 0.95f; });
    const uint32_t eaves = court.add("eaves", m.oak, std::move(boards), [](glm::vec3, glm::vec3 n) { return 0.55f + 0.25f * n.z; });
    for (const glm::mat4& side : {back_side() * moved({-0.1f, 0.0f, 0.0f}), left_side() * moved({-0.6f, 0.004f, 0.0f})}) {
        court.place(roof, side * moved({-kCourt - 1.0f, kEaves, kOverhang - kRun}));
        court.place(eaves, side);
    }
}

}  // namespace

void build_arcades(Courtyard& court) {
    build_bays(court);
    build_passages(court);
    build_door(court, back_side() * moved({-3.65f, kArcadeFloor, -kArcadeDepth + 0.015f}));

    Lantern lantern = make_lantern();
    const CourtyardMaterials& m = court.materials();
    const Openness dim = [](glm::vec3, glm::vec3) { return 0.55f; };
    const std::array<uint32_t, 3> parts{court.add("lantern", m.iron, std::move(lantern.metal), dim),
                                        court.add("lantern glass", m.glass, std::move(lantern.glass), dim),
                                        court.add("lantern flame", m.flame, std::move(lantern.flame), dim)};
    for (int i = 0; i < kBays; ++i) {
        const float x = (float(i) + 0.5f) * kBay.width - kCourt;
        for (const uint32_t part : parts) {
            place_on_sides(court, part, moved({x, kArcadeFloor + kBay.spring + kBay.radius, -0.5f * kBay.thickness}));
        }
    }
}

void build_upper_storey(Courtyard& court) {
    const CourtyardMaterials& m = court.materials();
    const float height = kCornice - kUpperFloor;
    shading::Mesh wall;
    append_patch(wall, 30, 10, [&](float s, float t) {
        const glm::vec2 p(glm::mix(-kCourt, kCourt, s), kUpperFloor + t * height);
        return ShapePoint{{p.x, p.y, 0.0f}, {0, 0, 1}, {1, 0, 0}, glm::vec2(p.x, -p.y) / 4.0f};
    });
    const Openness open = [](glm::vec3 p, glm::vec3) { return 0.95f - 0.40f * smooth_step(kCornice - 0.7f, kCornice, p.y); };
    const std::array<uint32_t, 3> parts{
        court.add("upper wall", m.plaster, std::move(wall), open),
        court.add("string course", m.limestone, moulding(kUpperFloor - 0.06f, 0.13f, 0.09f), moulding_openness),
        court.add("cornice", m.limestone, moulding(kCornice - 0.10f, 0.16f, 0.16f), moulding_openness)};
    for (const uint32_t part : parts) {
        place_on_sides(court, part, glm::mat4(1.0f));
    }

    const Window window = make_window(court);
    for (int i = 0; i < kBays; ++i) {
        const glm::mat4 at = moved({(float(i) + 0.5f) * kBay.width - kCourt, kUpperFloor + 0.62f, 0.0f});
        for (const uint32_t part : {window.stone, window.pane, window.shutters, window.bars}) {
            place_on_sides(court, part, at);
        }
    }
    build_roofs(court);
}

void build_garden_wall(Courtyard& court) {
    const CourtyardMaterials& m = court.materials();
    constexpr float kLength = 2.0f * kCourt, kThickness = 0.4f;
    shading::Mesh wall, coping;
    append_patch(wall, 24, 8, [&](float s, float t) {
        const glm::vec2 p(kCourt - s * kLength, t * kGardenWall);
        return ShapePoint{{kCourt, p.y, -p.x}, {-1, 0, 0}, {0, 0, 1}, glm::vec2(-p.x, -p.y) / 3.2f};
    });
    for (int i = 0; i < 10; ++i) {
        const float z = -kCourt + (float(i) + 0.5f) * kLength / 10.0f;
        append_rounded_box(coping, {kCourt + 0.5f * kThickness, kGardenWall + 0.05f, z},
                           {0.5f * kThickness + 0.05f, 0.05f, 0.5f * kLength / 10.0f - 0.004f}, 0.02f, 2.0f);
    }
    // Its outer face keeps the sun from shining through.
    append_rectangle(wall, {kCourt + kThickness, 0.0f, kCourt}, {0, 0, -kLength}, {0, kGardenWall, 0}, {0, 0}, {4, -1});
    court.add_and_place("garden wall", m.ashlar, std::move(wall),
                        [](glm::vec3 p, glm::vec3) { return 0.55f + 0.35f * smooth_step(0.0f, 1.2f, p.y); });
    court.add_and_place("coping", m.limestone, std::move(coping), moulding_openness);
}

}  // namespace rawtexel::scenes
