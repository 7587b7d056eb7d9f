#include "texunit/ellipse.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace rawtexel::texunit {
namespace {

// Abramowitz and Stegun, table 25.4, moved from [-1, 1] to [0, 1].
constexpr Quadrature kFourNodes = {4,
                                   {0.069431844202973712, 0.330009478207571868, 0.669990521792428132, 0.930568155797026288},
                                   {0.173927422568726929, 0.326072577431273071, 0.326072577431273071, 0.173927422568726929}};
constexpr Quadrature kSixNodes = {
    6,
    {0.033765242898423987, 0.169395306766867743, 0.380690406958401546, 0.619309593041598454, 0.830604693233132257, 0.966234757101576013},
    {0.085662246189585173, 0.180380786524069304, 0.233956967286345524, 0.233956967286345524, 0.180380786524069304, 0.085662246189585173}};
constexpr Quadrature kEightNodes = {8,
                                    {0.019855071751231884, 0.101666761293186630, 0.237233795041835507, 0.408282678752175098,
                                     0.591717321247824902, 0.762766204958164493, 0.898333238706813370, 0.980144928248768116},
                                    {0.050614268145188130, 0.111190517226687235, 0.156853322938943644, 0.181341891689180991,
                                     0.181341891689180991, 0.156853322938943644, 0.111190517226687235, 0.050614268145188130}};

/// Enough nodes for 2^-24 of the peak: a texel is `sigmas` standard deviations high where the Gaussian falls fastest.
const Quadrature& quadrature_for(double sigmas) { return sigmas <= 1 ? kFourNodes : sigmas <= 2 ? kSixNodes : kEightNodes; }

/// J*J^T = [p q; q r] in texels^2 of level 0, and its eigenvalues.
struct Shear {
    double p = 0, q = 0, r = 0, most = 0, least = 0;
};

constexpr double kLargestDerivative = 0x1p40;  ///< texels a pixel: beyond every level

/// False when a derivative is not finite.
bool shear_of(const LevelTable& table, const EllipseLookup& at, Shear& shear) {
    const double width = table.width[0], height = table.height[0];
    double sx = at.dudx * width, tx = at.dvdx * height, sy = at.dudy * width, ty = at.dvdy * height;
    if (!std::isfinite(sx + tx + sy + ty)) return false;
    const double largest = std::max({std::abs(sx), std::abs(tx), std::abs(sy), std::abs(ty)});
    if (largest > kLargestDerivative) {
        const double scale = kLargestDerivative / largest;
        sx *= scale, tx *= scale, sy *= scale, ty *= scale;
    }
    shear = {sx * sx + sy * sy, sx * tx + sy * ty, tx * tx + ty * ty, 0, 0};
    shear.most = (shear.p + shear.r) / 2 + std::hypot((shear.p - shear.r) / 2, shear.q);
    const double det = sx * ty - sy * tx;
    shear.least = shear.most > 0 ? std::min(det * det / shear.most, shear.most) : 0;
    return true;
}

/// Texels that the cut ellipse touches: its area and half the boxes along its outline.
double texels_touched(const Ellipse& e) {
    const double area = std::numbers::pi * kEllipseReach * kEllipseReach * std::sqrt(e.determinant);
    return area + 2 * kEllipseReach * (std::sqrt(e.a) + std::sqrt(e.c));
}

void set_covariance(const LevelTable& table, double s2, const Shear& shear, int level, Ellipse& e) {
    const double boxes = std::ldexp(1.0, 2 * level);
    const double removed = std::min((2 * boxes - 3) / 12, s2 * shear.least - boxes / 12);
    const auto l = size_t(level);
    const double x = double(table.width[l]) / table.width[0], y = double(table.height[l]) / table.height[0];
    e.level = level;
    e.a = (s2 * shear.p - removed) * x * x;
    e.b = s2 * shear.q * x * y;
    e.c = (s2 * shear.r - removed) * y * y;
    e.determinant = (s2 * shear.most - removed) * (s2 * shear.least - removed) * x * x * y * y;
}

/// What lies beyond the last level: as large as the bound on texels allows.
void shrink(Ellipse& e) {
    while (texels_touched(e) > double(kMostEllipseTexels)) e.a /= 4, e.b /= 4, e.c /= 4, e.determinant /= 16;
}

double coordinate_in_period(Wrap wrap, float coordinate) {
    if (!std::isfinite(coordinate)) return 0;
    switch (wrap) {
        case Wrap::Repeat: return coordinate - std::trunc(coordinate);
        case Wrap::MirroredRepeat: return std::fmod(coordinate, 2.0f);
        default: return std::clamp(coordinate, -10.0f, 10.0f);
    }
}

void set_centre(const LevelTable& table, const SamplerState& sampler, const EllipseLookup& at, Ellipse& e) {
    const auto l = size_t(e.level);
    const double x = coordinate_in_period(sampler.wrap_s, at.u) * table.width[l];
    const double y = coordinate_in_period(sampler.wrap_t, at.v) * table.height[l];
    e.column = int64_t(std::floor(x));
    e.row = int64_t(std::floor(y));
    e.x = x - std::floor(x);
    e.y = y - std::floor(y);
}

/// The largest value of side*slope*y + sqrt(...) of the cut ellipse for y in [low, high]: its outline on that side, which is concave.
double outline(const Ellipse& e, double low, double high, double side) {
    const double extreme = side * kEllipseReach * e.b / std::sqrt(e.a);
    const double y = std::clamp(extreme, low, high);
    return side * e.slope * y + std::sqrt(std::max(kEllipseReach * kEllipseReach - y * y / e.c, 0.0)) / e.inverse_sigma;
}

}  // namespace

Ellipse make_ellipse(const LevelTable& table, const SamplerState& sampler, const EllipseLookup& at) {
    const int last = table.levels - 1;
    Ellipse e;
    Shear shear;
    if (shear_of(table, at, shear)) {
        e.level = int(std::clamp(sampler.min_lod, 0.0f, float(last)));
        set_covariance(table, double(sampler.ellipse), shear, e.level, e);
        while (e.level < last && texels_touched(e) > double(kMostEllipseTexels)) {
            set_covariance(table, double(sampler.ellipse), shear, e.level + 1, e);
        }
        const auto l = size_t(e.level);
        const bool one_texel =
            table.width[l] == 1 && table.height[l] == 1 && sampler.wrap_s != Wrap::ClampToBorder && sampler.wrap_t != Wrap::ClampToBorder;
        if (one_texel) {
            e.a = e.c = 1.0 / 12, e.b = 0, e.determinant = 1.0 / 144;
        } else {
            shrink(e);
        }
    } else {
        e.level = last;
    }
    set_centre(table, sampler, at, e);

    e.slope = e.b / e.c;
    e.inverse_sigma = std::sqrt(e.c / e.determinant);
    const double high = kEllipseReach * std::sqrt(e.c);
    e.first_row = int(std::floor(e.y - high));
    e.last_row = int(std::floor(e.y + high));
    e.across = &quadrature_for(std::sqrt(e.a / e.determinant));
    return e;
}

double roomy_level(const LevelTable& table, const SamplerState& sampler, const EllipseLookup& at) {
    Shear shear;
    if (!shear_of(table, at, shear)) return std::numeric_limits<double>::infinity();
    // S2*minor^2 - (2*4^l - 3)/12 = 4^l/12.
    return std::log2(1 + 4 * double(sampler.ellipse) * shear.least) / 2;
}

EllipseSpan ellipse_span(const Ellipse& e, int row) {
    const double high = kEllipseReach * std::sqrt(e.c);
    const double low_y = std::max(row - e.y, -high), high_y = std::min(row + 1 - e.y, high);
    if (!(low_y <= high_y)) return {0, -1};
    return {int(std::floor(e.x - outline(e, low_y, high_y, -1))), int(std::floor(e.x + outline(e, low_y, high_y, 1)))};
}

WrapWalk::WrapWalk(Wrap wrap, int64_t index, int extent)
    : wrap_(wrap), place_(index), extent_(extent), period_(wrap == Wrap::MirroredRepeat ? 2 * extent : extent) {
    if (wrap == Wrap::Repeat || wrap == Wrap::MirroredRepeat) place_ = ((index % period_) + period_) % period_;
}

int WrapWalk::texel() const {
    switch (wrap_) {
        case Wrap::Repeat: return int(place_);
        case Wrap::MirroredRepeat: return int(std::min(place_, period_ - 1 - place_));
        case Wrap::ClampToEdge: return int(std::clamp<int64_t>(place_, 0, extent_ - 1));
        case Wrap::ClampToBorder: return place_ < 0 || place_ >= extent_ ? -1 : int(place_);
        case Wrap::MirrorOnce: return int(std::min<int64_t>(place_ >= 0 ? place_ : -1 - place_, extent_ - 1));
    }
    return 0;
}

void WrapWalk::next() {
    ++place_;
    const bool periodic = wrap_ == Wrap::Repeat || wrap_ == Wrap::MirroredRepeat;
    if (periodic && place_ == period_) place_ = 0;
}

}  // namespace rawtexel::texunit
