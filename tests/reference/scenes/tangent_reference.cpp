#include "tests/reference/scenes/tangent_reference.h"

#include <algorithm>
#include <cmath>

namespace rawtexel::reference {
namespace {

struct Surface {
    std::span<const glm::vec3> positions, normals;
    std::span<const glm::vec2> uv;
    std::span<const uint32_t> indices;

    glm::dvec3 position(size_t corner) const { return positions[indices[corner]]; }
    glm::dvec3 normal(size_t corner) const { return normals[indices[corner]]; }
    glm::dvec2 coordinate(size_t corner) const { return uv[indices[corner]]; }
    bool same_vertex(size_t a, size_t b) const {
        return position(a) == position(b) && normal(a) == normal(b) && coordinate(a) == coordinate(b);
    }
};

double texture_area(const Surface& s, size_t triangle) {
    const glm::dvec2 a = s.coordinate(3 * triangle + 1) - s.coordinate(3 * triangle),
                     b = s.coordinate(3 * triangle + 2) - s.coordinate(3 * triangle);
    return a.x * b.y - a.y * b.x;
}

/// The direction in which u grows on the triangle: the solution of  e1 = u1*T + v1*B, e2 = u2*T + v2*B  for T.
glm::dvec3 direction_of_u(const Surface& s, size_t triangle) {
    const size_t c = 3 * triangle;
    const glm::dvec3 e1 = s.position(c + 1) - s.position(c), e2 = s.position(c + 2) - s.position(c);
    const glm::dvec2 t1 = s.coordinate(c + 1) - s.coordinate(c), t2 = s.coordinate(c + 2) - s.coordinate(c);
    return (e1 * t2.y - e2 * t1.y) / texture_area(s, triangle);
}

bool counts(const Surface& s, size_t triangle) {
    const size_t c = 3 * triangle;
    const bool has_corners =
        s.position(c) != s.position(c + 1) && s.position(c) != s.position(c + 2) && s.position(c + 1) != s.position(c + 2);
    return has_corners && texture_area(s, triangle) != 0.0;
}

glm::dvec3 in_plane(const glm::dvec3& normal, const glm::dvec3& v) {
    const glm::dvec3 flat = v - normal * glm::dot(normal, v);
    const double length = glm::length(flat);
    return length > 0.0 ? flat / length : flat;
}

size_t after(size_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
size_t before(size_t corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }

/// Two corners at one vertex whose triangles share an edge from it, run through in opposite directions.
bool adjoin(const Surface& s, size_t a, size_t b) {
    if (!s.same_vertex(a, b)) return false;
    return s.same_vertex(after(a), before(b)) || s.same_vertex(before(a), after(b));
}

}  // namespace

std::vector<glm::dvec4> corner_tangents(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                                        std::span<const glm::vec2> uv, std::span<const uint32_t> indices) {
    const Surface s{positions, normals, uv, indices};
    std::vector<glm::dvec4> tangents(indices.size(), glm::dvec4(0.0));
    for (size_t corner = 0; corner < indices.size(); ++corner) {
        if (!counts(s, corner / 3)) continue;
        const bool keeps = texture_area(s, corner / 3) > 0.0;
        // All corners that hang together with this one, in any number of steps.
        std::vector<size_t> group = {corner};
        for (size_t next = 0; next < group.size(); ++next)
            for (size_t other = 0; other < indices.size(); ++other) {
                const bool joins = counts(s, other / 3) && (texture_area(s, other / 3) > 0.0) == keeps && adjoin(s, group[next], other);
                if (joins && std::ranges::find(group, other) == group.end()) group.push_back(other);
            }
        glm::dvec3 sum(0.0);
        const glm::dvec3 n = s.normal(corner);
        for (const size_t member : group) {
            const glm::dvec3 a = in_plane(n, s.position(before(member)) - s.position(member));
            const glm::dvec3 b = in_plane(n, s.position(after(member)) - s.position(member));
            const double angle = std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
            sum += angle * in_plane(n, direction_of_u(s, member / 3));
        }
        tangents[corner] = glm::dvec4(glm::normalize(sum), keeps ? 1.0 : -1.0);
    }
    return tangents;
}

}  // namespace rawtexel::reference
