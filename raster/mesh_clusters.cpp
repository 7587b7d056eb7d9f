#include "raster/mesh_clusters.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace rawtexel::raster {

namespace {

constexpr int kCellBits = 9;              // of a triangle's place along each axis of the mesh's box
constexpr uint32_t kFewestOfAFacing = 8;  // a cluster ends where the facing changes, unless it would be smaller than this

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// The lowest ten bits of `value` three apart.
uint32_t spread_bits(uint32_t value) {
    value = (value | value << 16) & 0x030000FFu;
    value = (value | value << 8) & 0x0300F00Fu;
    value = (value | value << 4) & 0x030C30C3u;
    return (value | value << 2) & 0x09249249u;
}

struct Corners {
    glm::dvec3 p[3];
    glm::dvec3 normal() const { return glm::cross(p[1] - p[0], p[2] - p[0]); }  ///< twice the area long
    bool identical() const { return p[0] == p[1] || p[1] == p[2] || p[2] == p[0]; }
};

/// Which of the six directions along the axes a normal is nearest to.
uint32_t facing_of(const glm::dvec3& normal) {
    const glm::dvec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return uint32_t(2 * axis) + (normal[axis] < 0.0);
}

class Builder {
  public:
    Builder(std::span<const glm::vec3> positions, std::span<const uint32_t> indices) : positions_(positions), indices_(indices) {
        for (const glm::vec3& p : positions_) {
            if (!is_finite(p)) continue;
            lower_ = glm::min(lower_, p);
            upper_ = glm::max(upper_, p);
        }
        // The same for all axes, so that clusters are as wide as they are long.
        const glm::dvec3 extent = glm::dvec3(upper_) - glm::dvec3(lower_);
        const double longest = std::max({extent.x, extent.y, extent.z});
        cells_per_unit_ = longest > 0 ? (1 << kCellBits) / longest : 0.0;
    }

    MeshClusters build() {
        const uint32_t count = uint32_t(indices_.size() / 3);
        std::vector<uint64_t> order(count);
        for (uint32_t t = 0; t < count; ++t) order[t] = uint64_t{place_of(t)} << 32 | t;
        if (count > kClusterTriangles) sort_by_place(order);
        reserve(count);
        uint32_t begin = 0;
        while (begin < count) {
            uint32_t end = begin + 1;
            while (end < count && end - begin < kClusterTriangles &&
                   (end - begin < kFewestOfAFacing || facing(order[end]) == facing(order[end - 1])))
                ++end;
            add_cluster({order.data() + begin, end - begin});
            begin = end;
        }
        return std::move(out_);
    }

  private:
    static constexpr uint32_t kNowhere = std::numeric_limits<uint32_t>::max();
    static uint64_t facing(uint64_t place_and_triangle) { return place_and_triangle >> (32 + 3 * kCellBits); }

    Corners corners_of(uint32_t triangle) const {
        Corners corners;
        for (size_t i = 0; i < 3; ++i) {
            const uint32_t index = indices_[3 * size_t{triangle} + i];
            assert(index < positions_.size());
            corners.p[i] = positions_[index];
        }
        return corners;
    }

    /// Where a triangle comes in the order: by what it faces, then along a Morton curve through the mesh's box.
    uint32_t place_of(uint32_t triangle) const {
        const Corners corners = corners_of(triangle);
        const glm::dvec3 middle = (corners.p[0] + corners.p[1] + corners.p[2]) / 3.0;
        if (!is_finite(middle)) return 0;
        uint32_t place = facing_of(corners.normal()) << (3 * kCellBits);
        for (int axis = 0; axis < 3; ++axis) {
            const double cell = (middle[axis] - double(lower_[axis])) * cells_per_unit_;
            place |= spread_bits(uint32_t(std::clamp(cell, 0.0, double((1 << kCellBits) - 1)))) << axis;
        }
        return place;
    }

    /// Least significant digit first, so that triangles of one place keep their order.
    static void sort_by_place(std::vector<uint64_t>& order) {
        constexpr int kDigitBits = 10;
        std::vector<uint64_t> other(order.size());
        for (int shift = 32; shift < 32 + 3 * kCellBits + 3; shift += kDigitBits) {
            std::array<uint32_t, 1 << kDigitBits> start{};
            const auto digit = [&](uint64_t value) { return size_t(value >> shift & ((1u << kDigitBits) - 1)); };
            for (const uint64_t value : order) ++start[digit(value)];
            uint32_t sum = 0;
            for (uint32_t& first : start) sum += std::exchange(first, sum);
            for (const uint64_t value : order) other[start[digit(value)]++] = value;
            order.swap(other);
        }
    }

    void reserve(uint32_t count) {
        out_.primitive.reserve(count);
        for (std::vector<uint8_t>& corner : out_.corner) corner.reserve(count);
        out_.clusters.reserve(count / kClusterTriangles + 8);
    }

    void add_cluster(std::span<const uint64_t> triangles) {
        Cluster cluster;
        cluster.first_triangle = uint32_t(out_.primitive.size());
        cluster.first_vertex = uint32_t(out_.x.size());
        cluster.triangle_count = uint8_t(triangles.size());
        slot_.fill(kNowhere);
        uint32_t vertices = 0;
        for (const uint64_t entry : triangles) {
            const uint32_t triangle = uint32_t(entry);
            out_.primitive.push_back(triangle);
            for (size_t i = 0; i < 3; ++i) out_.corner[i].push_back(local_vertex(indices_[3 * size_t{triangle} + i], vertices));
        }
        cluster.vertex_count = uint8_t(vertices);
        while (out_.x.size() % kVertexAlignment != 0) {
            for (std::vector<float>* values : {&out_.x, &out_.y, &out_.z}) values->push_back(float(values->back()));
        }
        bound(triangles, cluster);
        out_.clusters.push_back(cluster);
    }

    uint8_t local_vertex(uint32_t index, uint32_t& vertices) {
        size_t slot = (index * 0x9E3779B1u) >> 23;
        while (slot_[slot] != kNowhere && slot_[slot] != index) slot = (slot + 1) % slot_.size();
        if (slot_[slot] == kNowhere) {
            slot_[slot] = index;
            local_[slot] = uint8_t(vertices++);
            out_.x.push_back(positions_[index].x);
            out_.y.push_back(positions_[index].y);
            out_.z.push_back(positions_[index].z);
        }
        return local_[slot];
    }

    void bound(std::span<const uint64_t> triangles, Cluster& cluster) const {
        cluster.lower = glm::vec3(std::numeric_limits<float>::max());
        cluster.upper = -cluster.lower;
        glm::dvec3 sum(0.0);
        double least_inradius = std::numeric_limits<double>::max();
        for (const uint64_t entry : triangles) {
            const Corners corners = corners_of(uint32_t(entry));
            for (const glm::dvec3& p : corners.p) {
                if (!is_finite(p)) return;
                cluster.lower = glm::min(cluster.lower, glm::vec3(p));
                cluster.upper = glm::max(cluster.upper, glm::vec3(p));
            }
            if (corners.identical()) {
                ++cluster.identical;
                continue;
            }
            const glm::dvec3 normal = corners.normal();
            const double length = glm::length(normal);
            const double perimeter = glm::distance(corners.p[0], corners.p[1]) + glm::distance(corners.p[1], corners.p[2]) +
                                     glm::distance(corners.p[2], corners.p[0]);
            least_inradius = std::min(least_inradius, length / perimeter);
            if (length > 0) sum += normal / length;
        }
        cluster.finite = true;
        if (cluster.identical == cluster.triangle_count) return;
        cluster.least_inradius = float(least_inradius * (1.0 - 1e-6));
        set_cone(triangles, sum, cluster);
    }

    void set_cone(std::span<const uint64_t> triangles, const glm::dvec3& sum, Cluster& cluster) const {
        const double length = glm::length(sum);
        if (!(length > 1e-3) || !(cluster.least_inradius > 0.0f)) return;
        cluster.cone_axis = glm::vec3(sum / length);
        const glm::dvec3 axis = glm::normalize(glm::dvec3(cluster.cone_axis));
        double cosine = 1.0;
        for (const uint64_t entry : triangles) {
            const Corners corners = corners_of(uint32_t(entry));
            if (!corners.identical()) cosine = std::min(cosine, glm::dot(axis, glm::normalize(corners.normal())));
        }
        // Wider by more than what the normals' own rounding, of small triangles far from the origin, can come to.
        cluster.cone_cosine = float(cosine - 1e-5);
    }

    std::span<const glm::vec3> positions_;
    std::span<const uint32_t> indices_;
    glm::vec3 lower_{std::numeric_limits<float>::max()}, upper_{-std::numeric_limits<float>::max()};
    double cells_per_unit_;
    std::array<uint32_t, 512> slot_;  // vertices of the cluster at hand, by hash of their index
    std::array<uint8_t, 512> local_;
    MeshClusters out_;
};

}  // namespace

MeshClusters make_clusters(std::span<const glm::vec3> positions, std::span<const uint32_t> indices) {
    return Builder(positions, indices).build();
}

}  // namespace rawtexel::raster
