#include "texunit/legal_interval.h"

#include "texunit/colour_search.h"
#include "texunit/kernel_value.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace rawtexel::texunit {
namespace {

/// One step of a mantissa of `bits` bits at `value`.
double float_error(double value, int bits) { return value == 0 ? 0 : std::ldexp(1.0, std::ilogb(value) - bits); }
Range with_float_error(double value, int bits) {
    const double error = float_error(value, bits);
    return {value - error, value + error};
}

/// Smallest and largest magnitude in a range.
Range magnitude(Range r) {
    const double low = std::abs(r.low), high = std::abs(r.high);
    return {r.low <= 0 && r.high >= 0 ? 0 : std::min(low, high), std::max(low, high)};
}

/// Legal scale factors rho_max (Vulkan "Scale Factor Operation").
Range scale_factors(const JudgedTexture& texture, const SamplerState& sampler, const JudgedLookup& at, const LegalPrecision& precision) {
    const auto component = [&](double derivative, int extent) {
        const Range r = magnitude(with_float_error(derivative, precision.derivative_bits));
        return Range{r.low * extent, r.high * extent};
    };
    const Range sx = component(at.dudx, texture.width), tx = component(at.dvdx, texture.height);
    const Range sy = component(at.dudy, texture.width), ty = component(at.dvdy, texture.height);
    if (precision.approximate_scale) {
        const double sum = std::max(sx.high, sy.high) + std::max(tx.high, ty.high);
        return {std::max({sx.low, tx.low, sy.low, ty.low}), std::numbers::sqrt2 * sum};
    }
    const Range x{std::hypot(sx.low, tx.low), std::hypot(sx.high, tx.high)}, y{std::hypot(sy.low, ty.low), std::hypot(sy.high, ty.high)};
    if (sampler.lod_rule == LodRule::D3d) return {std::max(x.low, y.low), std::max(x.high, y.high)};
    // The largest singular value is at least the longer column and at most that of the magnitudes.
    const double mixed = sx.high * sy.high + tx.high * ty.high;
    const double half_sum = (x.high * x.high + y.high * y.high) / 2, half_difference = (x.high * x.high - y.high * y.high) / 2;
    return {std::max(x.low, y.low), std::sqrt(half_sum + std::hypot(half_difference, mixed))};
}

/// Legal levels of detail after bias and bounds. Bounds are as exact as the level of detail's bits.
Range lods(const JudgedTexture& texture, const SamplerState& sampler, const JudgedLookup& at, const LegalPrecision& precision) {
    const double step = std::ldexp(1.0, -precision.lod_bits);
    const double bias = double(sampler.lod_bias);
    Range lod{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    if (std::isfinite(at.dudx) && std::isfinite(at.dvdx) && std::isfinite(at.dudy) && std::isfinite(at.dvdy)) {
        const Range rho = scale_factors(texture, sampler, at, precision);
        lod = {std::log2(rho.low) - step + bias, std::log2(rho.high) + step + bias};
    }
    const Range least{std::floor(double(sampler.min_lod) / step) * step, std::ceil(double(sampler.min_lod) / step) * step};
    const Range most{std::floor(double(sampler.max_lod) / step) * step, std::ceil(double(sampler.max_lod) / step) * step};
    return {std::max(std::min(lod.low, most.low), least.low), std::max(std::min(lod.high, most.high), least.high)};
}

/// Texel-space coordinates that an axis may be read at, far outside less the part that makes no difference.
Range texel_space(Wrap wrap, double coordinate, int extent, const LegalPrecision& precision) {
    const double u = std::isfinite(coordinate) ? coordinate : 0;
    const double error = float_error(u, precision.coordinate_bits) * extent + std::ldexp(1.0, -precision.subtexel_bits);
    const bool repeats = wrap == Wrap::Repeat || wrap == Wrap::MirroredRepeat;
    const double reduced = repeats ? std::fmod(u, 2.0) : std::clamp(u, -1000.0, 1000.0);
    return {reduced * extent - error, reduced * extent + error};
}

constexpr int kBorder = -1;

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

/// A stretch of an axis over which every weight is linear in the coordinate: the weights at its two ends. Neighbouring stretches meet,
/// but where texels change abruptly they do not agree there.
struct Stretch {
    std::vector<WeightedTexel> from, to;
};

/// The weights of smooth kernels pass for linear over a stretch this long, in texels: their curvature is below 16 a texel^2, so that they
/// are off by 2e-6. Wide ranges, of low precision, are cut into this many stretches at most.
constexpr double kLongestStretch = 1.0 / 1024;
constexpr double kMostStretches = 24;

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
    const double longest = std::max(kLongestStretch, (x.high - x.low) / kMostStretches);
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

class PatchMaker {
  public:
    PatchMaker(const JudgedTexture& texture, const SamplerState& sampler, const JudgedLookup& at, const LegalPrecision& precision)
        : texture_(texture), sampler_(sampler), at_(at), precision_(precision) {}

    std::vector<ColourPatch> patches(const Kernel& kernel, int level) const {
        const int width = std::max(1, texture_.width >> level), height = std::max(1, texture_.height >> level);
        const auto columns = stretches(kernel, texel_space(sampler_.wrap_s, at_.u, width, precision_));
        const auto rows = stretches(kernel, texel_space(sampler_.wrap_t, at_.v, height, precision_));
        std::vector<ColourPatch> all;
        for (const Stretch& row : rows) {
            for (const Stretch& column : columns) {
                const auto corner = [&](const auto& x, const auto& y) { return colour(level, width, height, x, y); };
                all.push_back(
                    {{corner(column.from, row.from), corner(column.to, row.from), corner(column.from, row.to), corner(column.to, row.to)}});
            }
        }
        return all;
    }

  private:
    Colour colour(int level, int width, int height, const std::vector<WeightedTexel>& columns,
                  const std::vector<WeightedTexel>& rows) const {
        Colour sum{};
        for (const WeightedTexel& row : rows) {
            const int y = wrap_index(sampler_.wrap_t, row.texel, height);
            for (const WeightedTexel& column : columns) {
                const int x = wrap_index(sampler_.wrap_s, column.texel, width);
                const bool border = x == kBorder || y == kBorder;
                const Colour texel = border ? Colour{sampler_.border[0], sampler_.border[1], sampler_.border[2], sampler_.border[3]}
                                            : texture_.texel(level, x, y);
                for (size_t c = 0; c < 4; ++c) sum[c] += row.weight * column.weight * texel[c];
            }
        }
        return sum;
    }

    const JudgedTexture& texture_;
    const SamplerState& sampler_;
    const JudgedLookup& at_;
    const LegalPrecision& precision_;
};

/// All colours that a kernel gives for legal levels of detail `lod`.
void search_levels(const PatchMaker& maker, const Kernel& kernel, MipMode mip, int levels, Range lod, ColourSearch& search) {
    const auto one_level = [&](int level) {
        for (const ColourPatch& patch : maker.patches(kernel, level)) search.visit(patch);
    };
    const double last = levels - 1;
    const Range d{std::clamp(lod.low, 0.0, last), std::clamp(lod.high, 0.0, last)};
    if (mip == MipMode::None) return one_level(0);
    if (mip == MipMode::Nearest) {
        // Half-way either level is legal (Vulkan "Image Level(s) Selection").
        const int first = int(std::ceil(d.low + 0.5)) - 1, end = std::min(int(std::floor(d.high + 0.5)), levels - 1);
        for (int level = first; level <= end; ++level) one_level(level);
        return;
    }
    for (int level = int(std::floor(d.low)); level <= int(std::floor(d.high)); ++level) {
        const Range share{std::clamp(d.low - level, 0.0, 1.0), std::clamp(d.high - level, 0.0, 1.0)};
        if (level == levels - 1 || share.high == 0) {
            one_level(level);
            continue;
        }
        const auto coarser = maker.patches(kernel, level + 1);
        for (const ColourPatch& patch : maker.patches(kernel, level)) {
            for (const ColourPatch& second : coarser) search.visit(patch, second, share);
        }
    }
}

}  // namespace

LegalVerdict judge_lookup(const JudgedTexture& texture, const SamplerState& sampler, const JudgedLookup& lookup, const Colour& colour,
                          const LegalPrecision& precision) {
    assert(sampler.probes == 1 && sampler.ellipse == 0);
    const Range lod = lods(texture, sampler, lookup, precision);
    const PatchMaker maker(texture, sampler, lookup, precision);
    ColourSearch search(colour, precision.colour_threshold);
    const bool magnifies = lod.low <= 0, minifies = lod.high > 0;
    if (sampler.magnify == sampler.minify) {
        search_levels(maker, sampler.magnify, sampler.mip, texture.levels, lod, search);
    } else {
        if (magnifies) {
            search_levels(maker, sampler.magnify, sampler.mip, texture.levels, {lod.low, std::min(lod.high, 0.0)}, search);
        }
        if (minifies) search_levels(maker, sampler.minify, sampler.mip, texture.levels, {std::max(lod.low, 0.0), lod.high}, search);
    }
    LegalVerdict verdict;
    verdict.legal = search.excess() <= 1;
    verdict.least = search.least(), verdict.most = search.most();
    verdict.closest = search.closest();
    verdict.excess = search.excess();
    verdict.least_lod = lod.low, verdict.most_lod = lod.high;
    return verdict;
}

std::string to_string(const LegalVerdict& verdict, const Colour& colour) {
    std::ostringstream text;
    text.precision(7);
    const auto put = [&](const Colour& c) -> std::ostream& { return text << c[0] << ' ' << c[1] << ' ' << c[2] << ' ' << c[3]; };
    text << (verdict.legal ? "legal: " : "not legal: ");
    put(colour) << "; legal are ";
    put(verdict.least) << " to ";
    put(verdict.most) << ", closest ";
    put(verdict.closest) << " (" << verdict.excess << " thresholds off), level of detail " << verdict.least_lod << " to "
                         << verdict.most_lod;
    return text.str();
}

}  // namespace rawtexel::texunit
