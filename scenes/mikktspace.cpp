#include "scenes/mikktspace.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cfloat>
#include <cmath>
#include <numeric>

namespace rawtexel::scenes {
namespace {

constexpr int kNone = -1;

/// Single precision and this notion of zero throughout: normal maps are baked against tangents that were computed so.
bool is_nonzero(float x) { return std::fabs(x) > FLT_MIN; }
bool is_nonzero(const glm::vec3& v) { return is_nonzero(v.x) || is_nonzero(v.y) || is_nonzero(v.z); }

glm::vec3 normalized(const glm::vec3& v) { return is_nonzero(v) ? v * (1.0f / std::sqrt(glm::dot(v, v))) : v; }

/// The direction of `v` in the plane of the unit vector `normal`.
glm::vec3 projected(const glm::vec3& normal, const glm::vec3& v) { return normalized(v - normal * glm::dot(normal, v)); }

struct Triangle {
    std::array<int, 3> vertex{};                        ///< welded
    std::array<int, 3> neighbour{kNone, kNone, kNone};  ///< across the edge from corner k to k + 1
    std::array<int, 3> group{kNone, kNone, kNone};
    glm::vec3 tangent{0.0f};  ///< unit, along increasing u
    bool keeps_orientation = false;
    bool joins_any = true;    ///< no area in the texture: takes the orientation of its first group
    bool degenerate = false;  ///< two corners in one place
};

/// Triangles around a vertex that share a tangent.
struct Group {
    int vertex;
    bool keeps_orientation;
    std::vector<int> triangles;
};

class TangentSpace {
  public:
    explicit TangentSpace(const TangentGeometry& geometry) : geometry_(geometry), triangles_(geometry.indices.size() / 3) {
        weld();
        for (size_t t = 0; t < triangles_.size(); ++t) set_up(triangles_[t]);
        connect();
        gather_groups();
    }

    std::vector<glm::vec4> corner_tangents() const {
        std::vector<glm::vec4> tangents(geometry_.indices.size(), glm::vec4(0.0f));
        for (const Group& group : groups_) {
            const glm::vec4 shared(group_tangent(group), group.keeps_orientation ? 1.0f : -1.0f);
            for (const int t : group.triangles) tangents[3 * size_t(t) + size_t(corner_of(triangles_[size_t(t)], group.vertex))] = shared;
        }
        fill_degenerate(tangents);
        return tangents;
    }

  private:
    glm::vec3 position(int vertex) const { return geometry_.positions[size_t(vertex)]; }
    glm::vec3 normal(int vertex) const { return geometry_.normals[size_t(vertex)]; }
    glm::vec2 uv(int vertex) const { return geometry_.uv[size_t(vertex)]; }

    static int corner_of(const Triangle& triangle, int vertex) {
        return int(std::ranges::find(triangle.vertex, vertex) - triangle.vertex.begin());
    }

    /// Vertices that agree in everything become one: the first of them. Compared by their bits, which order even numbers that are none.
    void weld() {
        const auto bits = [](float x) { return std::bit_cast<uint32_t>(x + 0.0f); };  // -0 is 0
        const auto key = [&](int v) {
            const glm::vec3 p = position(v), n = normal(v);
            const glm::vec2 t = uv(v);
            return std::array{bits(p.x), bits(p.y), bits(p.z), bits(n.x), bits(n.y), bits(n.z), bits(t.x), bits(t.y)};
        };
        std::vector<int> order(geometry_.positions.size()), representative(order.size());
        std::iota(order.begin(), order.end(), 0);
        std::ranges::sort(order, [&](int a, int b) {
            const auto ka = key(a), kb = key(b);
            return ka < kb || (ka == kb && a < b);
        });
        for (size_t i = 0; i < order.size(); ++i) {
            const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
            representative[size_t(order[i])] = same ? representative[size_t(order[i - 1])] : order[i];
        }
        for (size_t i = 0; i < geometry_.indices.size(); ++i) triangles_[i / 3].vertex[i % 3] = representative[geometry_.indices[i]];
    }

    /// Tangent and orientation of one triangle: equations 18 and 19 of the thesis.
    void set_up(Triangle& triangle) const {
        const auto [a, b, c] = triangle.vertex;
        const glm::vec3 d1 = position(b) - position(a), d2 = position(c) - position(a);
        const glm::vec2 t21 = uv(b) - uv(a), t31 = uv(c) - uv(a);
        triangle.degenerate = position(a) == position(b) || position(a) == position(c) || position(b) == position(c);

        const float signed_area = t21.x * t31.y - t21.y * t31.x;  // twice, in the texture
        triangle.keeps_orientation = signed_area > 0.0f;
        if (!is_nonzero(signed_area)) return;
        const glm::vec3 along_u = t31.y * d1 - t21.y * d2, along_v = -t31.x * d1 + t21.x * d2;
        const float length_u = std::sqrt(glm::dot(along_u, along_u)), length_v = std::sqrt(glm::dot(along_v, along_v));
        const float sign = triangle.keeps_orientation ? 1.0f : -1.0f, area = std::fabs(signed_area);
        if (is_nonzero(length_u)) triangle.tangent = along_u * (sign / length_u);
        triangle.joins_any = !(is_nonzero(length_u / area) && is_nonzero(length_v / area));
    }

    struct Edge {
        int low, high, triangle, corner;
        bool ascending;  ///< runs from low to high
    };

    /// Pairs edges that run in opposite directions between the same two vertices; where more than two meet, in the order of triangles.
    void connect() {
        std::vector<Edge> edges;
        edges.reserve(geometry_.indices.size());
        for (int t = 0; t < int(triangles_.size()); ++t) {
            const Triangle& triangle = triangles_[size_t(t)];
            if (triangle.degenerate) continue;
            for (int k = 0; k < 3; ++k) {
                const int from = triangle.vertex[size_t(k)], to = triangle.vertex[size_t(k + 1) % 3];
                edges.push_back({std::min(from, to), std::max(from, to), t, k, from < to});
            }
        }
        std::ranges::sort(edges, {}, [](const Edge& e) { return std::array{e.low, e.high, e.triangle, e.corner}; });
        std::vector<Edge> waiting;  // of one direction: a pair leaves as soon as it meets
        size_t first_waiting = 0;
        for (const Edge& edge : edges) {
            const bool same_place = first_waiting < waiting.size() && waiting.back().low == edge.low && waiting.back().high == edge.high;
            if (!same_place) {
                waiting.clear();
                first_waiting = 0;
            }
            if (same_place && waiting.back().ascending != edge.ascending)
                join(waiting[first_waiting++], edge);
            else
                waiting.push_back(edge);
        }
    }

    void join(const Edge& a, const Edge& b) {
        triangles_[size_t(a.triangle)].neighbour[size_t(a.corner)] = b.triangle;
        triangles_[size_t(b.triangle)].neighbour[size_t(b.corner)] = a.triangle;
    }

    void gather_groups() {
        for (int t = 0; t < int(triangles_.size()); ++t) {
            if (triangles_[size_t(t)].degenerate || triangles_[size_t(t)].joins_any) continue;
            for (size_t k = 0; k < 3; ++k) {
                if (triangles_[size_t(t)].group[k] != kNone) continue;
                groups_.push_back({triangles_[size_t(t)].vertex[k], triangles_[size_t(t)].keeps_orientation, {}});
                grow(int(groups_.size()) - 1, t);
            }
        }
    }

    /// Takes in what hangs together around the group's vertex, depth first.
    void grow(int group_index, int first_triangle) {
        Group& group = groups_[size_t(group_index)];
        std::vector<int> open = {first_triangle};
        while (!open.empty()) {
            const int t = open.back();
            open.pop_back();
            Triangle& triangle = triangles_[size_t(t)];
            const size_t corner = size_t(corner_of(triangle, group.vertex));
            if (triangle.group[corner] != kNone) continue;
            const bool undecided = triangle.joins_any && std::ranges::count(triangle.group, kNone) == 3;
            if (undecided) triangle.keeps_orientation = group.keeps_orientation;
            if (triangle.keeps_orientation != group.keeps_orientation) continue;
            triangle.group[corner] = group_index;
            group.triangles.push_back(t);
            for (const size_t edge : {(corner + 2) % 3, corner})
                if (triangle.neighbour[edge] != kNone) open.push_back(triangle.neighbour[edge]);
        }
    }

    glm::vec3 group_tangent(const Group& group) const {
        const glm::vec3 n = normal(group.vertex);
        // Summed in the order of the triangles, so that the order of the walk plays no part.
        std::vector<int> members = group.triangles;
        std::ranges::sort(members);
        glm::vec3 sum(0.0f);
        for (const int t : members) {
            const Triangle& triangle = triangles_[size_t(t)];
            if (triangle.joins_any) continue;
            const size_t corner = size_t(corner_of(triangle, group.vertex));
            const glm::vec3 here = position(triangle.vertex[corner]);
            const glm::vec3 to_last = projected(n, position(triangle.vertex[(corner + 2) % 3]) - here);
            const glm::vec3 to_next = projected(n, position(triangle.vertex[(corner + 1) % 3]) - here);
            const float cosine = std::clamp(glm::dot(to_last, to_next), -1.0f, 1.0f);
            const float angle = float(std::acos(double(cosine)));
            sum += angle * projected(n, triangle.tangent);
        }
        return normalized(sum);
    }

    /// Corners of triangles without an area in space follow any other corner at their vertex.
    void fill_degenerate(std::vector<glm::vec4>& tangents) const {
        std::vector<int> corner_at(geometry_.positions.size(), kNone);
        for (size_t i = geometry_.indices.size(); i-- > 0;)
            if (!triangles_[i / 3].degenerate) corner_at[size_t(triangles_[i / 3].vertex[i % 3])] = int(i);
        for (size_t i = 0; i < geometry_.indices.size(); ++i) {
            const Triangle& triangle = triangles_[i / 3];
            const int source = triangle.degenerate ? corner_at[size_t(triangle.vertex[i % 3])] : kNone;
            if (source != kNone) tangents[i] = tangents[size_t(source)];
        }
    }

    TangentGeometry geometry_;
    std::vector<Triangle> triangles_;
    std::vector<Group> groups_;
};

}  // namespace

std::vector<glm::vec4> mikktspace_tangents(const TangentGeometry& geometry) { return TangentSpace(geometry).corner_tangents(); }

}  // namespace rawtexel::scenes
