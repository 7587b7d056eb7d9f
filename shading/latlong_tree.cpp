#include "shading/latlong_tree.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace rawtexel::shading {
namespace {

/// Finest nodes along a row of the image, at least and at most.
constexpr int kFewestColumns = 1024, kMostColumns = 2048;

/// How the finest level relates to the texels: `split` nodes per texel along each axis, or `merge` texels per node.
struct LeafGrid {
    int split = 1, merge = 1;
    int nodes(int texels) const { return (texels * split + merge - 1) / merge; }
};

LeafGrid leaf_grid(int width) {
    LeafGrid grid;
    grid.split = std::clamp(kFewestColumns / width, 1, 8);
    grid.merge = (width + kMostColumns - 1) / kMostColumns;
    return grid;
}

/// A sum of light on the way to a node. Black patches keep a direction through a weight that no light notices.
struct Patch {
    glm::dvec3 moment{0.0}, flux{0.0};
    double weight = 0.0, solid_angle = 0.0;

    void add(const glm::dvec3& direction, const glm::dvec3& light, double angle) {
        const double w = light.x + light.y + light.z + angle * 1e-12;
        moment += direction * w;
        weight += w;
        flux += light;
        solid_angle += angle;
    }
    LightNode node(double radius) const {
        return {glm::vec3(moment / weight), float(radius), glm::vec3(flux), float(solid_angle)};
    }
};

/// Bilinear texel of the image at continuous texel coordinates: columns wrap, rows hold.
glm::dvec3 bilinear(const Image& image, double x, double y) {
    const double fx = std::floor(x), fy = std::floor(y);
    const auto texel = [&](int dx, int dy) {
        const int column = (int(fx) + dx + image.width) % image.width, row = std::clamp(int(fy) + dy, 0, image.height - 1);
        const float* p = image.pixel(column, row);
        return glm::dvec3(p[0], p[1], p[2]);
    };
    return glm::mix(glm::mix(texel(0, 0), texel(1, 0), x - fx), glm::mix(texel(0, 1), texel(1, 1), x - fx), y - fy);
}

/// Sines and cosines of the azimuths of the cells' centres, shared by all rows.
struct Azimuths {
    std::vector<glm::dvec2> direction;   ///< (x, z) of a horizontal unit vector
    explicit Azimuths(int cells) {
        for (int i = 0; i < cells; ++i) {
            const glm::dvec3 d = latlong_direction((i + 0.5) / cells, 0.5);
            direction.emplace_back(d.x, d.z);
        }
    }
};

/// Half the diagonal of a patch between two polar angles that is `azimuth` wide.
double patch_radius(double polar_top, double polar_bottom, double azimuth) {
    const double widest = polar_top < 0.5 * std::numbers::pi && polar_bottom > 0.5 * std::numbers::pi ? 1.0
                                                                                                     : std::max(std::sin(polar_top), std::sin(polar_bottom));
    return 0.5 * std::hypot(polar_bottom - polar_top, azimuth * widest);
}

/// One row of the finest level: every cell of `split` per texel adds to the node that it falls in.
void make_leaf_row(const Image& image, const LeafGrid& grid, const Azimuths& azimuths, int row, LightLevel& level) {
    const int cells_x = image.width * grid.split, cells_y = image.height * grid.split;
    const int first = row * grid.merge, end = std::min(first + grid.merge, cells_y);
    std::vector<Patch> patches(size_t(level.width));
    for (int y = first; y < end; ++y) {
        const double top = std::numbers::pi * y / cells_y, bottom = std::numbers::pi * (y + 1) / cells_y, middle = 0.5 * (top + bottom);
        const double angle = (std::cos(top) - std::cos(bottom)) * 2.0 * std::numbers::pi / cells_x;
        for (int x = 0; x < cells_x; ++x) {
            const float* texel = image.pixel(x / grid.split, y / grid.split);
            const glm::dvec3 light = grid.split == 1
                                         ? glm::dvec3(texel[0], texel[1], texel[2])
                                         : bilinear(image, (x + 0.5) / grid.split - 0.5, (y + 0.5) / grid.split - 0.5);
            const glm::dvec2 azimuth = azimuths.direction[size_t(x)] * std::sin(middle);
            patches[size_t(x / grid.merge)].add({azimuth.x, std::cos(middle), azimuth.y}, light * angle, angle);
        }
    }
    const double step = std::numbers::pi / cells_y;
    const double radius = patch_radius(first * step, end * step, 2.0 * std::numbers::pi * grid.merge / cells_x);
    for (int x = 0; x < level.width; ++x) level.nodes[size_t(row) * size_t(level.width) + size_t(x)] = patches[size_t(x)].node(radius);
}

/// One row of a coarser level: sums of up to four children. A patch's radius is at most that of its finest parts taken together.
void make_parent_row(const LightLevel& finer, int row, LightLevel& level) {
    for (int x = 0; x < level.width; ++x) {
        Patch patch;
        double radius = 0.0;
        for (int y = 2 * row; y < std::min(2 * row + 2, finer.height); ++y)
            for (int i = 2 * x; i < std::min(2 * x + 2, finer.width); ++i) {
                const LightNode& child = finer.at(i, y);
                patch.add(child.direction, child.flux, child.solid_angle);
                radius = std::max(radius, 2.0 * child.radius);
            }
        level.nodes[size_t(row) * size_t(level.width) + size_t(x)] = patch.node(radius);
    }
}

LightLevel sized_level(int width, int height) {
    LightLevel level;
    level.width = width;
    level.height = height;
    level.nodes.resize(size_t(width) * size_t(height));
    return level;
}

}  // namespace

glm::dvec3 latlong_direction(double u, double v) {
    const double azimuth = (u - 0.5) * 2.0 * std::numbers::pi, polar = v * std::numbers::pi;
    return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
}

std::vector<LightLevel> make_light_tree(const Image& latlong, Executor& executor) {
    assert(latlong.channels == 3 && latlong.width > 0 && latlong.height > 0);
    const LeafGrid grid = leaf_grid(latlong.width);
    const Azimuths azimuths(latlong.width * grid.split);
    std::vector<LightLevel> tree;
    tree.push_back(sized_level(grid.nodes(latlong.width), grid.nodes(latlong.height)));
    executor.parallel_for(tree[0].height, [&](int64_t row, int) { make_leaf_row(latlong, grid, azimuths, int(row), tree[0]); });
    while (tree.back().width > 1 || tree.back().height > 1) {
        const LightLevel& finer = tree.back();
        LightLevel level = sized_level((finer.width + 1) / 2, (finer.height + 1) / 2);
        executor.parallel_for(level.height, [&](int64_t row, int) { make_parent_row(finer, int(row), level); });
        tree.push_back(std::move(level));
    }
    return tree;
}

}  // namespace rawtexel::shading
