#include "texunit/legal_patches.h"

#include "texunit/cube_map.h"
#include "texunit/kernel_value.h"

#include <algorithm>
#include <cmath>

namespace rawtexel::texunit {
namespace {

constexpr int kBorder = -1;
constexpr double kWidestError = 32;  ///< texels

/// Vulkan "Wrapping Operation".
int wrap_index(Wrap wrap, int64_t i, int extent) {
    const auto modulo = [](int64_t a, int64_t n) { return (a % n + n) % n; };
    switch (wrap) {
        case Wrap::Repeat: return int(modulo(i, extent));
        case Wrap::MirroredRepeat: {
            const int64_t place = modulo(i, 2 * int64_t{extent});
            return int(std::min(place, 2 * int64_t{extent} - 1 - place));
        }
        case Wrap::ClampToEdge: return int(std::clamp<int64_t>(i, 0, extent - 1));
        case Wrap::ClampToBorder: return i < 0 || i >= extent ? kBorder : int(i);
        case Wrap::MirrorOnce: return int(std::clamp<int64_t>(i < 0 ? -1 - i : i, 0, extent - 1));
    }
    return 0;
}

struct FaceTexel {
    int face;
    int64_t x, y;
};

/// The texel that an index beyond the edges of one axis means, across as many faces as it takes.
FaceTexel fold_onto_faces(FaceTexel at, int extent) {
    while (at.x < 0 || at.x >= extent || at.y < 0 || at.y >= extent) {
        const bool beside = at.x < 0 || at.x >= extent;
        const int64_t across = beside ? at.x : at.y, along = beside ? at.y : at.x;
        const int64_t depth = across < 0 ? -1 - across : across - extent;
        const CubeEdge edge = cube_edge(at.face, (beside ? 0 : 2) + (across < 0 ? 0 : 1));
        const int64_t x = edge.x_is_depth ? depth : along, y = edge.x_is_depth ? along : depth;
        at = {edge.face, edge.flip_x ? extent - 1 - x : x, edge.flip_y ? extent - 1 - y : y};
    }
    return at;
}

/// One texel, or beyond a corner the three that meet there.
std::vector<FaceTexel> face_texels(const FaceTexel& at, int extent) {
    const auto outside = [&](int64_t i) { return i < 0 || i >= extent; };
    if (!outside(at.x) || !outside(at.y)) return {fold_onto_faces(at, extent)};
    const auto inside = [&](int64_t i) { return std::clamp<int64_t>(i, 0, extent - 1); };
    const auto just_beyond = [&](int64_t i) { return std::clamp<int64_t>(i, -1, extent); };
    return {{at.face, inside(at.x), inside(at.y)},
            fold_onto_faces({at.face, just_beyond(at.x), inside(at.y)}, extent),
            fold_onto_faces({at.face, inside(at.x), just_beyond(at.y)}, extent)};
}

/// A stretch of an axis over which every weight is linear in the coordinate: the weights at its two ends. Neighbouring stretches meet,
/// but where texels change abruptly they do not agree there.
struct Stretch {
    std::vector<WeightedTexel> from, to;
};

/// The weights of smooth kernels pass for linear over a stretch this long, in texels: their curvature is below 16 a texel^2, of B-splines
/// at most 2, so that they are off by 2e-6. Wide ranges, of low precision or far from the origin, are cut into this many stretches at most.
constexpr double kMostStretches = 24;
constexpr bool is_spline(const Kernel& kernel) { return kernel.kind == KernelKind::Quadratic || kernel.kind == KernelKind::BSpline; }
constexpr double longest_stretch(const Kernel& kernel, Range x) {
    return std::max(is_spline(kernel) ? 1.0 / 354 : 1.0 / 1024, (x.high - x.low) / kMostStretches);
}

/// How far the weights of longer stretches than that are off, summed over the taps.
double bend_of(const Kernel& kernel, Range x) {
    if (kernel.kind == KernelKind::Nearest || kernel.kind == KernelKind::Bilinear) return 0;
    const double longest = longest_stretch(kernel, x), curvature = is_spline(kernel) ? 2 : 16;
    return longest > (x.high - x.low) / kMostStretches ? 0 : curvature * longest * longest / 8;
}

/// Where the weights of a kernel, as functions of the coordinate, bend or jump: at texel edges and centres, and where a Gaussian's interval
/// of 4 sigma ends at one.
std::vector<double> breaks_within(const Kernel& kernel, Range x) {
    std::vector<double> breaks = {x.low, x.high};
    const auto add = [&](double first, double step) {
        for (double at = first + std::ceil((x.low - first) / step) * step; at < x.high; at += step) breaks.push_back(at);
    };
    add(0, 0.5);
    if (kernel.kind == KernelKind::Gaussian || kernel.kind == KernelKind::GaussianPoint) {
        const double centre = kernel.kind == KernelKind::Gaussian ? 0 : 0.5;
        add(centre - 4 * double(kernel.b), 1);
        add(centre + 4 * double(kernel.b), 1);
    }
    std::sort(breaks.begin(), breaks.end());
    breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
    return breaks;
}

std::vector<Stretch> stretches(const Kernel& kernel, Range x) {
    const std::vector<double> breaks = breaks_within(kernel, x);
    const double longest = longest_stretch(kernel, x);
    std::vector<Stretch> all;
    for (size_t n = 1; n < breaks.size(); ++n) {
        const double low = breaks[n - 1], high = breaks[n];
        if (kernel.kind == KernelKind::Nearest) {
            const auto taps = axis_weights(kernel, (low + high) / 2);
            all.push_back({taps, taps});
            continue;
        }
        // Just inside the ends, so that both lie on the same side of a break.
        const int parts = kernel.kind == KernelKind::Bilinear ? 1 : int(std::ceil((high - low) / longest));
        const double inset = std::min(1e-10, (high - low) / 4);
        const auto at = [&](int part) { return std::clamp(low + (high - low) * part / std::max(parts, 1), low + inset, high - inset); };
        for (int part = 0; part < std::max(parts, 1); ++part)
            all.push_back({axis_weights(kernel, at(part)), axis_weights(kernel, at(part + 1))});
    }
    // At the very ends of 4 sigma both outermost texels count, which neither neighbouring stretch shows; snapped coordinates fall there.
    if (kernel.kind == KernelKind::GaussianPoint) {
        for (const double at : breaks) all.push_back({axis_weights(kernel, at), axis_weights(kernel, at)});
    }
    return all;
}

/// The texels that some stretches weigh, read once.
class TexelGrid {
  public:
    template <class Read>
    TexelGrid(const std::array<std::vector<Stretch>, 3>& axes, const Read& read) {
        for (size_t axis = 0; axis < 3; ++axis) {
            int64_t last = first_[axis] = axes[axis].front().from.front().texel;
            for (const Stretch& stretch : axes[axis]) {
                first_[axis] = std::min({first_[axis], stretch.from.front().texel, stretch.to.front().texel});
                last = std::max({last, stretch.from.back().texel, stretch.to.back().texel});
            }
            count_[axis] = last - first_[axis] + 1;
        }
        texels_.reserve(size_t(count_[0] * count_[1] * count_[2]));
        for (int64_t z = 0; z < count_[2]; ++z) {
            for (int64_t y = 0; y < count_[1]; ++y) {
                for (int64_t x = 0; x < count_[0]; ++x) texels_.push_back(read({first_[0] + x, first_[1] + y, first_[2] + z}));
            }
        }
    }

    Colour sum(const std::vector<WeightedTexel>& columns, const std::vector<WeightedTexel>& rows,
               const std::vector<WeightedTexel>& slices) const {
        Colour sum{};
        for (const WeightedTexel& slice : slices) {
            for (const WeightedTexel& row : rows) {
                const int64_t line = ((slice.texel - first_[2]) * count_[1] + row.texel - first_[1]) * count_[0] - first_[0];
                for (const WeightedTexel& column : columns) {
                    const double weight = slice.weight * row.weight * column.weight;
                    const Colour& texel = texels_[size_t(line + column.texel)];
                    for (size_t c = 0; c < 4; ++c) sum[c] += weight * texel[c];
                }
            }
        }
        return sum;
    }

    /// Of the texels' values, in the channel where they differ most.
    double spread() const {
        double spread = 0;
        for (size_t c = 0; c < 4; ++c) {
            const auto by_channel = [c](const Colour& a, const Colour& b) { return a[c] < b[c]; };
            const auto [least, most] = std::minmax_element(texels_.begin(), texels_.end(), by_channel);
            spread = std::max(spread, (*most)[c] - (*least)[c]);
        }
        return spread;
    }

  private:
    std::array<int64_t, 3> first_{}, count_{};
    std::vector<Colour> texels_;
};

}  // namespace

bool LegalPatches::is_open(const LegalPlace& place, int level) const {
    const Shape& shape = texture_.shape;
    const std::array<int, 3> extents{shape.width, shape.height, shape.depth};
    for (size_t axis = 0; axis < (shape.depth > 1 ? 3 : 2); ++axis)
        if (!(place.at[axis].error * level_extent(extents[axis], level) < kWidestError)) return true;
    return false;
}

/// Texel-space coordinates that an axis may be read at, far outside less the part that makes no difference.
Range LegalPatches::texel_space(Wrap wrap, const LegalCoordinate& coordinate, int extent, double shift) const {
    const double error = coordinate.error * extent + std::ldexp(1.0, -precision_.subtexel_bits);
    const bool repeats = wrap == Wrap::Repeat || wrap == Wrap::MirroredRepeat;
    const double reduced = repeats ? std::fmod(coordinate.value, 2.0) : std::clamp(coordinate.value, -1000.0, 1000.0);
    return {reduced * extent + shift - error, reduced * extent + shift + error};
}

Colour LegalPatches::texel_at(int level, const LegalPlace& place, const std::array<int64_t, 3>& index) const {
    const Shape& shape = texture_.shape;
    const int width = level_extent(shape.width, level), height = level_extent(shape.height, level);
    if (!shape.cube) {
        const int x = wrap_index(sampler_.wrap_s, index[0], width), y = wrap_index(sampler_.wrap_t, index[1], height);
        const int z = shape.depth > 1 ? wrap_index(sampler_.wrap_r, index[2], level_extent(shape.depth, level)) : place.slice;
        if (x != kBorder && y != kBorder && z != kBorder) return texture_.texel(level, z, x, y);
        return {sampler_.border[0], sampler_.border[1], sampler_.border[2], sampler_.border[3]};
    }
    const int first = place.slice / 6 * 6;
    FaceTexel at{place.slice % 6, index[0], index[1]};
    if (!suspicion_.seamless) at.x = std::clamp<int64_t>(at.x, 0, width - 1), at.y = std::clamp<int64_t>(at.y, 0, height - 1);
    Colour mean{};
    const std::vector<FaceTexel> texels = face_texels(at, width);
    for (const FaceTexel& one : texels) {
        const Colour texel = texture_.texel(level, first + one.face, int(one.x), int(one.y));
        for (size_t c = 0; c < 4; ++c) mean[c] += texel[c] / double(texels.size());
    }
    return mean;
}

std::vector<ColourPatch> LegalPatches::at(const LegalPlace& place, const Kernel& kernel, int level) const {
    const Shape& shape = texture_.shape;
    const bool is_volume = shape.depth > 1;
    const std::array<int, 3> extents{level_extent(shape.width, level), level_extent(shape.height, level), level_extent(shape.depth, level)};
    const std::array<Wrap, 3> wraps{sampler_.wrap_s, sampler_.wrap_t, sampler_.wrap_r};
    std::array<std::vector<Stretch>, 3> axes;
    double bend = 0;
    for (size_t axis = 0; axis < (is_volume ? 3 : 2); ++axis) {
        // Coordinates on a face have no wrap.
        const Wrap wrap = shape.cube ? Wrap::ClampToEdge : wraps[axis];
        const Range x = texel_space(wrap, place.at[axis], extents[axis], suspicion_.shift[axis]);
        axes[axis] = stretches(kernel, x);
        bend += bend_of(kernel, x);
    }
    const std::vector<WeightedTexel> one{{0, 1.0}};
    if (!is_volume) axes[2] = {{one, one}};

    const TexelGrid grid(axes, [&](const std::array<int64_t, 3>& index) { return texel_at(level, place, index); });
    if (bend > 0) bend *= grid.spread();
    std::vector<ColourPatch> patches;
    for (const Stretch& z : axes[2]) {
        for (const Stretch& y : axes[1]) {
            for (const Stretch& x : axes[0]) {
                ColourPatch patch{.sides = is_volume ? size_t{3} : size_t{2}, .corner = {}, .bend = bend};
                for (size_t n = 0; n < patch.corners(); ++n)
                    patch.corner[n] = grid.sum((n & 1) != 0 ? x.to : x.from, (n & 2) != 0 ? y.to : y.from, (n & 4) != 0 ? z.to : z.from);
                patch.find_bounds();
                patches.push_back(patch);
            }
        }
    }
    return patches;
}

}  // namespace rawtexel::texunit
