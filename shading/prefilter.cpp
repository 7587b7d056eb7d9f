#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/prefilter.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "shading/environment-inl.h"
#include "shading/latlong_tree.h"
#include "shading/octahedral.h"
#include "shading/brdf.h"
#include "shading/prefilter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#ifndef RAWTEXEL_SHADING_PREFILTER_ONCE_
#define RAWTEXEL_SHADING_PREFILTER_ONCE_
namespace rawtexel::shading {

/// Outputs are made in squares of 8x8 texels, which share one walk of the tree.
inline constexpr int kBlock = 8, kBlockTexels = kBlock * kBlock;

struct OutputBlock {
    alignas(64) float x[kBlockTexels], y[kBlockTexels], z[kBlockTexels];           ///< directions
    alignas(64) float red[kBlockTexels], green[kBlockTexels], blue[kBlockTexels];  ///< means
};

}  // namespace rawtexel::shading
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// Sums kernel(n.l) * flux over the nodes for all outputs of a block: lanes are outputs, so the order of a sum is that of the nodes on
/// every target. A node's directions vary: the mean of the kernel over it is taken to second order,  K(c) + var(c)/2 K''(c)  with c the
/// mean of n.l, var(c) = n^T C n,  K = c/g^2,  K''/2 = (2 b + 3 b^2 c/g)/g^3,  g = offset - b c.
inline void gather_block(const LightNode* nodes, size_t count, const LobeKernel& kernel, OutputBlock& block) {
    const hn::ScalableTag<float> d;
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f), two = hn::Set(d, 2.0f), three = hn::Set(d, 3.0f);
    const auto normalisation = hn::Set(d, float(kernel.normalisation));
    const auto offset = hn::Set(d, float(kernel.offset)), slope = hn::Set(d, float(kernel.slope));
    for (size_t i = 0; i < size_t(kBlockTexels); i += hn::Lanes(d)) {
        const auto x = hn::Load(d, block.x + i), y = hn::Load(d, block.y + i), z = hn::Load(d, block.z + i);
        const auto xx = hn::Mul(x, x), yy = hn::Mul(y, y), zz = hn::Mul(z, z);
        const auto xy = hn::Mul(hn::Mul(x, y), two), yz = hn::Mul(hn::Mul(y, z), two), zx = hn::Mul(hn::Mul(z, x), two);
        auto red = zero, green = zero, blue = zero;
        for (size_t k = 0; k < count; ++k) {
            const LightNode& node = nodes[k];
            const auto in_plane = hn::Add(hn::Mul(x, hn::Set(d, node.direction.x)), hn::Mul(y, hn::Set(d, node.direction.y)));
            const auto cosine = hn::Max(hn::Add(in_plane, hn::Mul(z, hn::Set(d, node.direction.z))), zero);
            auto variance = hn::Add(hn::Mul(xx, hn::Set(d, node.spread.xx)), hn::Mul(yy, hn::Set(d, node.spread.yy)));
            variance = hn::Add(variance, hn::Mul(zz, hn::Set(d, node.spread.zz)));
            variance = hn::Add(variance, hn::Mul(xy, hn::Set(d, node.spread.xy)));
            variance = hn::Add(variance, hn::Mul(yz, hn::Set(d, node.spread.yz)));
            variance = hn::Add(variance, hn::Mul(zx, hn::Set(d, node.spread.zx)));
            const auto inverse = hn::Div(one, hn::Sub(offset, hn::Mul(slope, cosine)));
            const auto bend = hn::Mul(slope, inverse);
            const auto curvature = hn::Mul(bend, hn::Add(hn::Mul(hn::Mul(bend, cosine), three), two));
            const auto weight = hn::Mul(hn::Mul(hn::Add(cosine, hn::Mul(variance, curvature)), inverse), inverse);
            red = hn::Add(red, hn::Mul(weight, hn::Set(d, node.flux.r)));
            green = hn::Add(green, hn::Mul(weight, hn::Set(d, node.flux.g)));
            blue = hn::Add(blue, hn::Mul(weight, hn::Set(d, node.flux.b)));
        }
        hn::Store(hn::Mul(red, normalisation), d, block.red + i);
        hn::Store(hn::Mul(green, normalisation), d, block.green + i);
        hn::Store(hn::Mul(blue, normalisation), d, block.blue + i);
    }
}

/// Adds the image's own radiance at each output's direction.
inline void add_mirrored(const Environment::Tables& tables, OutputBlock& block) {
    const hn::ScalableTag<float> d;
    for (size_t i = 0; i < size_t(kBlockTexels); i += hn::Lanes(d)) {
        const auto light = latlong_radiance(d, tables, {hn::Load(d, block.x + i), hn::Load(d, block.y + i), hn::Load(d, block.z + i)});
        hn::Store(hn::Add(hn::Load(d, block.red + i), light.x), d, block.red + i);
        hn::Store(hn::Add(hn::Load(d, block.green + i), light.y), d, block.green + i);
        hn::Store(hn::Add(hn::Load(d, block.blue + i), light.z), d, block.blue + i);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rawtexel::shading {
HWY_EXPORT(gather_block);
HWY_EXPORT(add_mirrored);
namespace {

/// Largest patch that stands for its parts, as a share of the lobe's scale at its distance.
constexpr float kPatchShare = 0.4f;
/// Lobes wider than kWideAlpha feel their edge at the horizon: patches that straddle it are kept small.
constexpr float kWideAlpha = 0.12f, kWidePatch = 0.07f;
/// Texels of a map per lobe, and the least side of a map: a cosine lobe must not show facets.
constexpr double kTexelsPerLobe = 16.0, kLeastExtent = 112.0;

/// Greatest side of a lobe's map: some texels per texel of small images, fewer for large ones.
double greatest_extent(int width) { return std::clamp(1.5 * width, kLeastExtent, std::clamp(0.75 * width, 384.0, 1024.0)); }

int whole_blocks(double texels) { return int(std::ceil(texels / kBlock)) * kBlock; }

/// Side of the map that holds the image itself.
int mirror_extent(int width) { return whole_blocks(std::clamp(width, 64, 2048)); }

/// Side of a lobe's map, texels: as fine as the lobe needs and the image deserves.
int lobe_extent(double alpha, int width) { return whole_blocks(std::clamp(kTexelsPerLobe / alpha, kLeastExtent, greatest_extent(width))); }

/// Of a lobe's level; infinity: the flattest lobe.
double alpha_of(int level, const RoughnessScale& scale) {
    if (level > kCosineLevel) return std::numeric_limits<double>::infinity();
    const double roughness = scale.roughness_of(level);
    return roughness * roughness;
}

/// Walks the tree for one block of outputs.
class PatchSelection {
  public:
    PatchSelection(const std::vector<LightLevel>& tree, float alpha)
        : tree_(tree), scale2_(4.0f * alpha * alpha), largest_(alpha > kWideAlpha ? kWidePatch : 2.0f) {}

    /// Nodes that together hold all light within 90 degrees of the outputs, which lie within `radius` (chord) of `center`.
    const std::vector<LightNode>& select(const glm::vec3& center, float radius) {
        nodes_.clear();
        center_ = center;
        radius_ = radius;
        visit(tree_.size() - 1, 0, 0);
        return nodes_;
    }

  private:
    void visit(size_t level, int x, int y) {
        const LightNode& node = tree_[level].at(x, y);
        const glm::vec3 offset = node.direction - center_;
        const float distance = std::sqrt(glm::dot(offset, offset)) - radius_;
        // The mean direction may lie anywhere in the patch; at a chord of sqrt(2) it is beyond the horizon of every output.
        if (distance - 2.0f * node.radius > std::numbers::sqrt2_v<float>) return;
        const float gap = std::max(distance - node.radius, 0.0f);
        const bool small = node.radius <= largest_ && node.radius * node.radius <= kPatchShare * kPatchShare * (scale2_ + gap * gap);
        if (small || level == 0) {
            nodes_.push_back(node);
            return;
        }
        const LightLevel& finer = tree_[level - 1];
        for (int cy = 2 * y; cy < std::min(2 * y + 2, finer.height); ++cy)
            for (int cx = 2 * x; cx < std::min(2 * x + 2, finer.width); ++cx) visit(level - 1, cx, cy);
    }

    const std::vector<LightLevel>& tree_;
    float scale2_, largest_;
    glm::vec3 center_{0.0f};
    float radius_ = 0.0f;
    std::vector<LightNode> nodes_;
};

struct LevelMap {
    int extent;
    PackedRadiance* texels;  ///< extent + 2 a side

    PackedRadiance& at(int x, int y) const { return texels[size_t(y + 1) * size_t(extent + 2) + size_t(x + 1)]; }
    glm::vec3 direction(float x, float y) const { return direction_from_octahedral(glm::vec2(x, y) / float(extent)); }
};

/// Directions of a block's texels, `right` and `down` texels from their upper left corners.
void aim_block(const LevelMap& map, int left, int top, float right, float down, OutputBlock& block) {
    for (int i = 0; i < kBlockTexels; ++i) {
        const glm::vec3 n = map.direction(float(left + i % kBlock) + right, float(top + i / kBlock) + down);
        block.x[i] = n.x;
        block.y[i] = n.y;
        block.z[i] = n.z;
    }
}

void store_block(const OutputBlock& block, float factor, const LevelMap& map, int left, int top) {
    for (int i = 0; i < kBlockTexels; ++i)
        map.at(left + i % kBlock, top + i / kBlock) = pack_radiance(glm::vec3(block.red[i], block.green[i], block.blue[i]) * factor);
}

void filter_block(const LevelMap& map, int left, int top, const LobeKernel& kernel, PatchSelection& selection) {
    OutputBlock block;
    aim_block(map, left, top, 0.5f, 0.5f, block);
    const glm::vec3 center = map.direction(float(left + kBlock / 2), float(top + kBlock / 2));
    float radius2 = 0.0f;
    for (int i = 0; i < kBlockTexels; ++i) {
        const glm::vec3 offset = glm::vec3(block.x[i], block.y[i], block.z[i]) - center;
        radius2 = std::max(radius2, glm::dot(offset, offset));
    }
    const std::vector<LightNode>& nodes = selection.select(center, std::sqrt(radius2));
    HWY_DYNAMIC_DISPATCH(gather_block)(nodes.data(), nodes.size(), kernel, block);
    store_block(block, 1.0f, map, left, top);
}

/// The image itself, averaged over each texel where the image is finer than the map.
void mirror_block(const LevelMap& map, int left, int top, const Environment::Tables& tables) {
    const int points = std::clamp((tables.width + map.extent - 1) / map.extent, 1, 8);
    OutputBlock block{};
    for (int j = 0; j < points; ++j)
        for (int i = 0; i < points; ++i) {
            aim_block(map, left, top, (float(i) + 0.5f) / float(points), (float(j) + 0.5f) / float(points), block);
            HWY_DYNAMIC_DISPATCH(add_mirrored)(tables, block);
        }
    store_block(block, 1.0f / float(points * points), map, left, top);
}

void fill_border(const LevelMap& map) {
    const auto copy = [&](int x, int y) {
        const glm::ivec2 inside = octahedral_wrapped(x, y, map.extent);
        map.at(x, y) = map.at(inside.x, inside.y);
    };
    for (int i = -1; i <= map.extent; ++i) {
        copy(i, -1);
        copy(i, map.extent);
        copy(-1, i);
        copy(map.extent, i);
    }
}

}  // namespace

LobeKernel::LobeKernel(double alpha) {
    // 1 - (1 - a^2)(1 + c)/2 = offset - slope*c; divided by a^2/2 where a is infinite.
    const bool flat = std::isinf(alpha);
    slope = flat ? -1.0 : (1.0 - alpha * alpha) / 2.0;
    offset = flat ? 1.0 : 1.0 - slope;
    // The integral of 2 pi c / (offset - slope*c)^2 over c in [0, 1].
    const double integral = std::fabs(slope) < 1e-4
                                ? 0.5 + slope * 5.0 / 3.0
                                : (offset / (offset - slope) - 1.0 + std::log((offset - slope) / offset)) / (slope * slope);
    normalisation = 1.0 / (2.0 * std::numbers::pi * integral);
}

double LobeKernel::density(double cosine) const {
    const double spread = offset - slope * cosine;
    return cosine > 0.0 ? normalisation * cosine / (spread * spread) : 0.0;
}

void prefilter(const Image& latlong, Executor& executor, Environment::Tables& tables) {
    const std::vector<LightLevel> tree = make_light_tree(latlong, executor);

    // The narrowest lobe has an alpha of one finest node: its light is then twice as wide as what the tree resolves.
    const double node = std::numbers::pi * std::max(1.0 / tree[0].height, 2.0 / tree[0].width);
    tables.scale.first = float(std::clamp(std::sqrt(node), double(kMinRoughness), 0.9));

    // Lay the maps out, finest first: the costly rows start early.
    struct Row {
        int level, top;
    };
    std::vector<Row> rows;
    size_t total = 0;
    for (int level = 0; level < kSpecularLevels; ++level) {
        const int extent = level == 0 ? mirror_extent(latlong.width) : lobe_extent(alpha_of(level, tables.scale), latlong.width);
        tables.extent[size_t(level)] = extent;
        tables.start[size_t(level)] = int32_t(total);
        total += size_t(extent + 2) * size_t(extent + 2);
        for (int top = 0; top < extent; top += kBlock) rows.push_back({level, top});
    }
    tables.texels.resize(total);
    const auto map_of = [&](int level) {
        return LevelMap{tables.extent[size_t(level)], tables.texels.data() + tables.start[size_t(level)]};
    };

    executor.parallel_for(int64_t(rows.size()), [&](int64_t index, int) {
        const auto [level, top] = rows[size_t(index)];
        const LevelMap map = map_of(level);
        if (level == 0) {
            for (int left = 0; left < map.extent; left += kBlock) mirror_block(map, left, top, tables);
            return;
        }
        const double alpha = alpha_of(level, tables.scale);
        const LobeKernel kernel(alpha);
        PatchSelection selection(tree, float(alpha));
        for (int left = 0; left < map.extent; left += kBlock) filter_block(map, left, top, kernel, selection);
    });
    for (int level = 0; level < kSpecularLevels; ++level) fill_border(map_of(level));
}

}  // namespace rawtexel::shading
#endif  // HWY_ONCE
