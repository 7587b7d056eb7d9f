#include "shading/latlong_tree.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace rawtexel::shading {
namespace {

/// Finest nodes around the horizon, at least and at most; half as many from pole to pole.
constexpr int kFewestColumns = 512, kMostColumns = 2048;

/// How the finest level relates to the texels along one axis: each texel split into several cells, and several cells merged into one node.
struct LeafAxis {
    int split, merge, cells, nodes;

    LeafAxis(int texels, int fewest, int most)
        : split((fewest + texels - 1) / texels),
          merge((texels + most - 1) / most),
          cells(texels * split),
          nodes((cells + merge - 1) / merge) {}
};

/// A sum of light on the way to a node. Black patches keep a direction through a weight that no light notices.
class Patch {
  public:
    void add(const LightNode& part) {
        const glm::dvec3 mean(part.direction), light(part.flux);
        const double w = light.x + light.y + light.z + part.solid_angle * 1e-12;
        const Covariance& c = part.spread;
        moment_ += mean * w;
        squares_ += (mean * mean + glm::dvec3(c.xx, c.yy, c.zz)) * w;
        products_ += (products_of(mean) + glm::dvec3(c.xy, c.yz, c.zx)) * w;
        weight_ += w;
        flux_ += light;
        solid_angle_ += part.solid_angle;
    }
    LightNode node(double radius) const {
        const glm::dvec3 mean = moment_ / weight_, s = squares_ / weight_ - mean * mean, p = products_ / weight_ - products_of(mean);
        const Covariance spread{float(s.x), float(s.y), float(s.z), float(p.x), float(p.y), float(p.z)};
        return {glm::vec3(mean), float(radius), glm::vec3(flux_), float(solid_angle_), spread};
    }

  private:
    static glm::dvec3 products_of(const glm::dvec3& d) { return {d.x * d.y, d.y * d.z, d.z * d.x}; }

    glm::dvec3 moment_{0.0}, squares_{0.0}, products_{0.0}, flux_{0.0};
    double weight_ = 0.0, solid_angle_ = 0.0;
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

/// Horizontal unit vectors (x, z) towards the middles of a row's cells, the same for all rows.
std::vector<glm::dvec2> cell_azimuths(int cells) {
    std::vector<glm::dvec2> azimuths;
    for (int i = 0; i < cells; ++i) {
        const glm::dvec3 d = latlong_direction((i + 0.5) / cells, 0.5);
        azimuths.emplace_back(d.x, d.z);
    }
    return azimuths;
}

/// Moments of the directions in the cells of one row, uniform over the solid angle, in the frame (outwards, along the row, up).
struct CellRow {
    double solid_angle;
    double outwards, up;  ///< mean direction; none along the row
    double var_outwards, var_along, var_up, cov_outwards_up;

    CellRow(int row, int rows, int columns) {
        const double top = std::numbers::pi * row / rows, bottom = std::numbers::pi * (row + 1) / rows,
                     width = 2.0 * std::numbers::pi / columns;
        const double y0 = std::cos(top), y1 = std::cos(bottom), s0 = std::sin(top), s1 = std::sin(bottom);
        solid_angle = (y0 - y1) * width;
        // Means over the polar angle: the solid angle is uniform in y.
        const double sine = (0.5 * (bottom - top) - 0.5 * (s1 * y1 - s0 * y0)) / (y0 - y1), y_square = (y0 * y0 + y0 * y1 + y1 * y1) / 3.0;
        const double sine_y = (s1 * s1 * s1 - s0 * s0 * s0) / (3.0 * (y0 - y1));
        // Means over the azimuth, measured from the cell's middle: cos is sin(w/2)/(w/2), cos^2 is (1 + sin(w)/w)/2.
        const double cosine = std::sin(0.5 * width) / (0.5 * width), cosine_square = 0.5 + 0.5 * std::sin(width) / width;
        outwards = sine * cosine;
        up = 0.5 * (y0 + y1);
        var_outwards = (1.0 - y_square) * cosine_square - outwards * outwards;
        var_along = (1.0 - y_square) * (1.0 - cosine_square);
        var_up = y_square - up * up;
        cov_outwards_up = sine_y * cosine - outwards * up;
    }

    /// Spreads the light further: by `polar` and `azimuthal` squared radians over the tangent plane, which shortens the mean.
    void blur(double polar, double azimuthal) {
        var_outwards += polar * up * up;
        var_up += polar * outwards * outwards;
        cov_outwards_up -= polar * outwards * up;
        var_along += azimuthal;
        outwards *= 1.0 - 0.5 * (polar + azimuthal);
        up *= 1.0 - 0.5 * (polar + azimuthal);
    }

    /// The cell whose middle lies at the horizontal unit vector (x, z).
    LightNode cell(const glm::dvec2& azimuth, const glm::dvec3& radiance) const {
        const double x = azimuth.x, z = azimuth.y;
        LightNode node;
        node.direction = glm::vec3(glm::dvec3(x * outwards, up, z * outwards));
        node.radius = 0.0f;
        node.flux = glm::vec3(radiance * solid_angle);
        node.solid_angle = float(solid_angle);
        node.spread.xx = float(x * x * var_outwards + z * z * var_along);
        node.spread.yy = float(var_up);
        node.spread.zz = float(z * z * var_outwards + x * x * var_along);
        node.spread.xy = float(x * cov_outwards_up);
        node.spread.yz = float(z * cov_outwards_up);
        node.spread.zx = float(x * z * (var_outwards - var_along));
        return node;
    }
};

/// Half the diagonal of a patch between two polar angles that is `azimuth` wide.
double patch_radius(double polar_top, double polar_bottom, double azimuth) {
    const double widest = polar_top < 0.5 * std::numbers::pi && polar_bottom > 0.5 * std::numbers::pi
                              ? 1.0
                              : std::max(std::sin(polar_top), std::sin(polar_bottom));
    return 0.5 * std::hypot(polar_bottom - polar_top, azimuth * widest);
}

/// Where the finest level's nodes come from.
struct LeafGrid {
    LeafAxis columns, rows;
    std::vector<glm::dvec2> azimuths;

    explicit LeafGrid(const Image& image)
        : columns(image.width, kFewestColumns, kMostColumns),
          rows(image.height, kFewestColumns / 2, kMostColumns / 2),
          azimuths(cell_azimuths(columns.cells)) {}

    /// Moments of a row of cells. A bilinear texel is a tent of variance 1/6 where a box has 1/12; split texels are sampled from the tent.
    CellRow row(int y) const {
        CellRow cells(y, rows.cells, columns.cells);
        const double height = std::numbers::pi / rows.cells, width = 2.0 * std::numbers::pi / columns.cells * std::sin((y + 0.5) * height);
        cells.blur(rows.split == 1 ? height * height / 12.0 : 0.0, columns.split == 1 ? width * width / 12.0 : 0.0);
        return cells;
    }

    glm::dvec3 radiance(const Image& image, int x, int y) const {
        return bilinear(image, (x + 0.5) / columns.split - 0.5, (y + 0.5) / rows.split - 0.5);
    }
};

/// One row of the finest level: every cell adds to the node that it falls in.
void make_leaf_row(const Image& image, const LeafGrid& grid, int row, LightLevel& level) {
    const int first = row * grid.rows.merge, end = std::min(first + grid.rows.merge, grid.rows.cells);
    std::vector<Patch> patches(size_t(level.width));
    for (int y = first; y < end; ++y) {
        const CellRow cells = grid.row(y);
        for (int x = 0; x < grid.columns.cells; ++x)
            patches[size_t(x / grid.columns.merge)].add(cells.cell(grid.azimuths[size_t(x)], grid.radiance(image, x, y)));
    }
    const double step = std::numbers::pi / grid.rows.cells, width = 2.0 * std::numbers::pi / grid.columns.cells * grid.columns.merge;
    const double radius = patch_radius(first * step, end * step, width);
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
                patch.add(child);
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
    const LeafGrid grid(latlong);
    std::vector<LightLevel> tree;
    tree.push_back(sized_level(grid.columns.nodes, grid.rows.nodes));
    executor.parallel_for(tree[0].height, [&](int64_t row, int) { make_leaf_row(latlong, grid, int(row), tree[0]); });
    while (tree.back().width > 1 || tree.back().height > 1) {
        const LightLevel& finer = tree.back();
        LightLevel level = sized_level((finer.width + 1) / 2, (finer.height + 1) / 2);
        executor.parallel_for(level.height, [&](int64_t row, int) { make_parent_row(finer, int(row), level); });
        tree.push_back(std::move(level));
    }
    return tree;
}

}  // namespace rawtexel::shading
