#include "texunit/ellipse_draw.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rawtexel::texunit {
namespace {

/// Quotient of two polynomials, coefficients of falling powers; the denominator's last one is 1.
template <size_t n, size_t m>
double ratio(const double (&numerator)[n], const double (&denominator)[m], double x) {
    double top = 0, bottom = 0;
    for (const double c : numerator) top = top * x + c;
    for (const double c : denominator) bottom = bottom * x + c;
    return top / (bottom * x + 1);
}

/// Inverse of the standard normal distribution for 0 < p < 1, to 1.2e-9 of it (Acklam 2003, "An algorithm for computing the inverse normal
/// cumulative distribution function").
double inverse_normal(double p) {
    constexpr double kCentreTop[] = {-39.69683028665376, 220.9460984245205,  -275.9285104469687,
                                     138.3577518672690,  -30.66479806614716, 2.506628277459239};
    constexpr double kCentreBottom[] = {-54.47609879822406, 161.5858368580409, -155.6989798598866, 66.80131188771972, -13.28068155288572};
    constexpr double kTailTop[] = {-0.007784894002430293, -0.3223964580411365, -2.400758277161838,
                                   -2.549732539343734,    4.374664141464968,   2.938163982698783};
    constexpr double kTailBottom[] = {0.007784695709041462, 0.3224671290700398, 2.445134137142996, 3.754408661907416};
    constexpr double kTail = 0.02425;
    if (p < kTail) return ratio(kTailTop, kTailBottom, std::sqrt(-2 * std::log(p)));
    if (p > 1 - kTail) return -ratio(kTailTop, kTailBottom, std::sqrt(-2 * std::log(1 - p)));
    const double q = p - 0.5;
    return q * ratio(kCentreTop, kCentreBottom, q * q);
}

/// Numbers are multiples of 2^-24: taken in the middle of what they stand for, which is never 0.
double standard_normal(float number) { return inverse_normal(double(number) + 0x1p-25); }

void jitter_ellipse(const LevelTable& table, const SamplerState& sampler, const EllipseLookup& at, const DrawNumbers& numbers, int lane,
                    TexelDraw& draw) {
    const SamplerState state = with_drawn_level(table, sampler, at, numbers.level[lane]);
    const Ellipse ellipse = make_ellipse(table, state, at);
    const double y = std::sqrt(ellipse.c) * standard_normal(numbers.y[lane]);
    const double x = ellipse.slope * y + standard_normal(numbers.x[lane]) / ellipse.inverse_sigma;
    const auto level = size_t(ellipse.level);
    const auto texel = [&](Wrap wrap, int64_t centre, double offset, int extent) {
        return WrapWalk(wrap, centre + int64_t(std::floor(offset)), extent).texel();
    };
    const int column = texel(sampler.wrap_s, ellipse.column, ellipse.x + x, table.width[level]);
    const int row = texel(sampler.wrap_t, ellipse.row, ellipse.y + y, table.height[level]);
    const bool beyond = column < 0 || row < 0;
    draw.level[lane] = ellipse.level;
    draw.x[lane] = beyond ? 0 : column;
    draw.y[lane] = beyond ? 0 : row;
    draw.border |= WaveMask{beyond} << lane;
}

}  // namespace

EllipseLookup ellipse_lookup(const WaveCoordinates& at, int lane) {
    return {at.u[lane], at.v[lane], at.dudx[lane], at.dvdx[lane], at.dudy[lane], at.dvdy[lane]};
}

SamplerState with_drawn_level(const LevelTable& table, const SamplerState& sampler, const EllipseLookup& at, float number) {
    SamplerState state = sampler;
    if (!std::isfinite(sampler.hybrid_bias)) return state;
    const double roomy = roomy_level(table, sampler, at);
    const double level = std::clamp(roomy - double(sampler.hybrid_bias), 0.0, double(table.levels - 1));
    const double finer = std::floor(level);
    const bool coarser = finer + 1 <= roomy && double(number) < level - finer;
    const double drawn = coarser ? finer + 1 : finer;
    state.min_lod = std::max(sampler.min_lod, float(drawn));
    return state;
}

void jitter_ellipses(const LevelTable& table, const SamplerState& sampler, const WaveCoordinates& at, WaveMask mask,
                     const DrawNumbers& numbers, TexelDraw& draw) {
    draw.border = 0;
    for (WaveMask rest = mask; rest != 0; rest &= rest - 1) {
        const int lane = std::countr_zero(rest);
        jitter_ellipse(table, sampler, ellipse_lookup(at, lane), numbers, lane, draw);
    }
}

void repeat_first_draw(WaveMask mask, TexelDraw& draw) {
    const int first = std::countr_zero(mask);
    for (int lane = 0; lane < kWaveLanes; ++lane) {
        if ((mask >> lane & 1) != 0) continue;
        draw.level[lane] = draw.level[first], draw.x[lane] = draw.x[first], draw.y[lane] = draw.y[first];
        draw.border |= (draw.border >> first & 1) << lane;
    }
}

}  // namespace rawtexel::texunit
