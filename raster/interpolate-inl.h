// Barycentrics of 32 lanes at once; the scalar meaning is `barycentrics` in raster/interpolate.h.
#if defined(RAWTEXEL_RASTER_INTERPOLATE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_RASTER_INTERPOLATE_INL_H
#undef RAWTEXEL_RASTER_INTERPOLATE_INL_H
#else
#define RAWTEXEL_RASTER_INTERPOLATE_INL_H
#endif

#include "raster/interpolate.h"

#include <hwy/highway.h>

#include <bit>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::raster {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Reads every plane coefficient of one triangle as the same value in all lanes.
class BroadcastPlanes {
  public:
    explicit BroadcastPlanes(const InterpolationPlanes& planes) : planes_(planes) {}
    template <class D>
    auto a(D d, int i, size_t) const {
        return hn::Set(d, planes_.plane[i].a);
    }
    template <class D>
    auto b(D d, int i, size_t) const {
        return hn::Set(d, planes_.plane[i].b);
    }
    template <class D>
    auto c(D d, int i, size_t) const {
        return hn::Set(d, planes_.plane[i].c);
    }
    template <class D>
    auto scale(D d, int i, size_t) const {
        return hn::Set(d, planes_.scale[i]);
    }

  private:
    const InterpolationPlanes& planes_;
};

/// At most 8 lanes, so that a vector never leaves its row.
using SampleLanes = hn::CappedTag<double, 8>;

/// Every lane its own triangle: the coefficients are laid out by lane first, as `interpolation_planes` has them.
class PlanesByLane {
  public:
    PlanesByLane(const Frame& frame, const uint32_t* setup_index, uint32_t mask) {
        Corners corners;
        // Lanes without a triangle repeat what another lane has, so that no lane computes with garbage.
        const uint32_t spare = setup_index[std::countr_zero(mask)];
        for (int lane = 0; lane < 32; ++lane) take_corners(frame.triangle(mask >> lane & 1u ? setup_index[lane] : spare), lane, corners);
        for (size_t lane = 0; lane < 32; lane += hn::Lanes(SampleLanes())) find_edges(corners, lane);
        for (uint32_t pieces = corners.pieces; pieces != 0; pieces &= pieces - 1) {
            const int lane = std::countr_zero(pieces);
            take_planes(interpolation_planes(frame.triangle(mask >> lane & 1u ? setup_index[lane] : spare)), lane);
        }
    }
    template <class D>
    auto a(D d, int i, size_t lane) const {
        return hn::Load(d, a_[i] + lane);
    }
    template <class D>
    auto b(D d, int i, size_t lane) const {
        return hn::Load(d, b_[i] + lane);
    }
    template <class D>
    auto c(D d, int i, size_t lane) const {
        return hn::Load(d, c_[i] + lane);
    }
    template <class D>
    auto scale(D d, int i, size_t lane) const {
        return hn::Load(d, scale_[i] + lane);
    }

  private:
    /// Positions in the triangle's order, corner 0 first.
    struct Corners {
        alignas(64) int32_t x[3][32], y[3][32];
        alignas(64) int64_t turned[32];  ///< -1 where corner 2 comes second
        uint32_t pieces = 0;             ///< lanes that see a piece of what clipping cut
    };

    void take_corners(const SetupTriangle& triangle, int lane, Corners& corners) {
        // Pieces have no corners; take_planes() has the last word on their lanes.
        const bool piece = triangle.bary_over_w != nullptr;
        const size_t first = piece ? 0 : size_t(triangle.corner[1] == 0) + 2 * size_t(triangle.corner[2] == 0);
        const size_t second = first == 2 ? 0 : first + 1, third = second == 2 ? 0 : second + 1;
        const bool turned = triangle.corner[second] != 1;
        const size_t order[] = {first, second, third};
        for (size_t i = 0; i < 3; ++i) {
            corners.x[i][lane] = triangle.x[order[i]];
            corners.y[i][lane] = triangle.y[order[i]];
        }
        corners.turned[lane] = -int64_t{turned};
        scale_[0][lane] = triangle.inverse_w[first];
        scale_[1][lane] = triangle.inverse_w[turned ? third : second];
        scale_[2][lane] = triangle.inverse_w[turned ? second : third];
        corners.pieces |= uint32_t{piece} << lane;
    }

    /// The exact lines through the edges that face the corners.
    HWY_ATTR void find_edges(const Corners& corners, size_t lane) {
        const SampleLanes d;
        const hn::Rebind<int32_t, SampleLanes> di;
        const hn::Rebind<int64_t, SampleLanes> dl;
        using V = hn::Vec<SampleLanes>;
        V x[3], y[3], a[3], b[3], c[3];
        for (int i = 0; i < 3; ++i) {
            x[i] = hn::PromoteTo(d, hn::Load(di, corners.x[i] + lane));
            y[i] = hn::PromoteTo(d, hn::Load(di, corners.y[i] + lane));
        }
        for (int i = 0; i < 3; ++i) {
            const int j = i == 2 ? 0 : i + 1, k = j == 2 ? 0 : j + 1;
            const V dx = hn::Sub(x[k], x[j]), dy = hn::Sub(y[k], y[j]);
            a[i] = hn::Neg(dy);
            b[i] = dx;
            c[i] = hn::Mul(hn::Sub(hn::Mul(dy, x[j]), hn::Mul(dx, y[j])), hn::Set(d, 1.0 / kSubpixelOne));
        }
        const auto turned = hn::MaskFromVec(hn::BitCast(d, hn::Load(dl, corners.turned + lane)));
        const auto store = [&](const V(&value)[3], double(&to)[3][32]) HWY_ATTR __attribute__((always_inline)) {
            hn::Store(value[0], d, to[0] + lane);
            hn::Store(hn::IfThenElse(turned, value[2], value[1]), d, to[1] + lane);
            hn::Store(hn::IfThenElse(turned, value[1], value[2]), d, to[2] + lane);
        };
        store(a, a_);
        store(b, b_);
        store(c, c_);
    }

    void take_planes(const InterpolationPlanes& planes, int lane) {
        for (int i = 0; i < 3; ++i) {
            a_[i][lane] = planes.plane[i].a;
            b_[i][lane] = planes.plane[i].b;
            c_[i][lane] = planes.plane[i].c;
            scale_[i][lane] = planes.scale[i];
        }
    }

    alignas(64) double a_[3][32], b_[3][32], c_[3][32], scale_[3][32];
};

/// Every term is a multiple of 2^-9, so that nothing rounds.
HWY_INLINE void sample_points(const BlockPoints& points, double* px, double* py) {
    const SampleLanes d;
    const hn::Rebind<int32_t, SampleLanes> di;
    static_assert(sizeof(SampleOffset) == 2 * sizeof(int32_t) && kBlockWidth == 8);
    const auto scale = hn::Set(d, 1.0 / kSampleOne);
    for (size_t lane = 0; lane < 32; lane += hn::Lanes(d)) {
        hn::Vec<decltype(di)> of_x, of_y;
        hn::LoadInterleaved2(di, &points.offset[lane].x, of_x, of_y);
        const auto column = hn::Iota(d, double(points.x + int(lane % kBlockWidth)));
        hn::Store(hn::Add(column, hn::Mul(hn::PromoteTo(d, of_x), scale)), d, px + lane);
        hn::Store(hn::Add(hn::Set(d, double(points.y + int(lane / kBlockWidth))), hn::Mul(hn::PromoteTo(d, of_y), scale)), d, py + lane);
    }
}

/// Lanes whose triangle is `index`.
HWY_INLINE uint32_t lanes_of_triangle(const uint32_t* setup_index, uint32_t index) {
    const hn::CappedTag<uint32_t, 32> d;
    uint32_t lanes = 0;
    for (size_t lane = 0; lane < 32; lane += hn::Lanes(d)) {
        alignas(8) uint8_t bits[8] = {};
        hn::StoreMaskBits(d, hn::Eq(hn::LoadU(d, setup_index + lane), hn::Set(d, index)), bits);
        uint32_t some;
        hwy::CopyBytes<4>(bits, &some);
        lanes |= (hn::Lanes(d) >= 32 ? some : some & ((1u << hn::Lanes(d)) - 1)) << lane;
    }
    return lanes;
}

/// What is the same wherever a triangle is looked at: the slopes of b/w along x and y, and of their sum.
template <class V>
struct BarycentricSlopes {
    V dx1, dx2, dy1, dy2, sum_dx, sum_dy;
};
template <class Planes>
HWY_INLINE auto barycentric_slopes(const Planes& planes, size_t lane) {
    const SampleLanes d;
    using V = hn::Vec<SampleLanes>;
    const auto slope_x = [&](int i) HWY_ATTR { return hn::Mul(planes.scale(d, i, lane), planes.a(d, i, lane)); };
    const auto slope_y = [&](int i) HWY_ATTR { return hn::Mul(planes.scale(d, i, lane), planes.b(d, i, lane)); };
    const V dx1 = slope_x(1), dx2 = slope_x(2), dy1 = slope_y(1), dy2 = slope_y(2);
    const V sum_dx = hn::Add(hn::Add(slope_x(0), dx1), dx2), sum_dy = hn::Add(hn::Add(slope_y(0), dy1), dy2);
    return BarycentricSlopes<V>{dx1, dx2, dy1, dy2, sum_dx, sum_dy};
}

/// b/w of some lanes: of corners 1 and 2, and w.
template <class V>
struct BarycentricTerms {
    V n1, n2, w;
};
template <class V>
HWY_INLINE BarycentricTerms<V> barycentric_terms(V n0, V n1, V n2) {
    return {n1, n2, hn::Div(hn::Set(SampleLanes(), 1.0), hn::Add(hn::Add(n0, n1), n2))};
}

/// Of some lanes, in the order of a BarycentricWave.
template <class V>
struct BarycentricQuotients {
    V value[6];
};
/// In the order of operations of `barycentrics`.
template <class V>
HWY_INLINE BarycentricQuotients<V> barycentric_quotients(const BarycentricTerms<V>& terms, const BarycentricSlopes<V>& slopes) {
    const V w = terms.w, b1 = hn::Mul(terms.n1, w), b2 = hn::Mul(terms.n2, w);
    const auto quotient = [&](V slope, V weight, V sum) HWY_ATTR { return hn::Mul(hn::Sub(slope, hn::Mul(weight, sum)), w); };
    return {{b1, b2, quotient(slopes.dx1, b1, slopes.sum_dx), quotient(slopes.dx2, b2, slopes.sum_dx),
             quotient(slopes.dy1, b1, slopes.sum_dy), quotient(slopes.dy2, b2, slopes.sum_dy)}};
}

/// Calls store(k, lanes) with quotient k's 32 lanes.
template <class Store>
HWY_INLINE void for_each_quotient(BarycentricWave& out, const Store& store) {
    float* const lanes[] = {out.b1, out.b2, out.db1_dx, out.db2_dx, out.db1_dy, out.db2_dy};
    for (int k = 0; k < 6; ++k) store(k, lanes[k]);
}

template <class V>
HWY_INLINE void store_quotients(const BarycentricQuotients<V>& quotients, size_t lane, BarycentricWave& out) {
    const hn::Rebind<float, SampleLanes> df;
    for_each_quotient(out, [&](int k, float* to) HWY_ATTR { hn::Store(hn::DemoteTo(df, quotients.value[k]), df, to + lane); });
}

/// Of two rows, one below the other. Where a vector holds both, it is stored at once: it is soon loaded at once, too.
template <class V>
HWY_INLINE void store_rows(const BarycentricQuotients<V>& upper, const BarycentricQuotients<V>& lower, size_t lane, BarycentricWave& out) {
#if HWY_MAX_BYTES == 64
    const hn::Rebind<float, SampleLanes> df;
    const hn::Twice<decltype(df)> both;
    for_each_quotient(out, [&](int k, float* to) HWY_ATTR {
        hn::Store(hn::Combine(both, hn::DemoteTo(df, lower.value[k]), hn::DemoteTo(df, upper.value[k])), both, to + lane);
    });
#else
    store_quotients(upper, lane, out);
    store_quotients(lower, lane + kBlockWidth, out);
#endif
}

/// Every lane at a point of its own.
template <class Planes>
HWY_INLINE void barycentric_lanes(const Planes& planes, const double* x, const double* y, size_t lane, BarycentricWave& out) {
    const SampleLanes d;
    const auto px = hn::Load(d, x + lane), py = hn::Load(d, y + lane);
    const auto over_w = [&](int i) HWY_ATTR {
        const auto along = hn::Add(hn::Mul(planes.a(d, i, lane), px), hn::Mul(planes.b(d, i, lane), py));
        return hn::Mul(planes.scale(d, i, lane), hn::Add(planes.c(d, i, lane), along));
    };
    const auto terms = barycentric_terms(over_w(0), over_w(1), over_w(2));
    store_quotients(barycentric_quotients(terms, barycentric_slopes(planes, lane)), lane, out);
}

/// One triangle and one offset: what depends on x is the same in every row, and in a row what depends on y. The rows' divisions come
/// first, so that they overlap.
HWY_INLINE void barycentric_rows(const InterpolationPlanes& planes, const BlockPoints& points, BarycentricWave& out) {
    const SampleLanes d;
    using V = hn::Vec<SampleLanes>;
    const BroadcastPlanes broadcast(planes);
    const auto slopes = barycentric_slopes(broadcast, 0);
    const SampleOffset offset = points.offset[0];
    const double first_y = points.y + double(offset.y) * (1.0 / kSampleOne);
    for (size_t i = 0; i < size_t{kBlockWidth}; i += hn::Lanes(d)) {
        const V x = hn::Add(hn::Iota(d, double(points.x + int(i))), hn::Set(d, double(offset.x) * (1.0 / kSampleOne)));
        const auto along_x = [&](int k) HWY_ATTR { return hn::Mul(broadcast.a(d, k, 0), x); };
        const V along0 = along_x(0), along1 = along_x(1), along2 = along_x(2);
        const auto terms_of = [&](int row) HWY_ATTR {
            const double y = first_y + row;
            const auto over_w = [&](int k, V along) HWY_ATTR {
                const V sum = hn::Add(along, hn::Set(d, planes.plane[k].b * y));
                return hn::Mul(broadcast.scale(d, k, 0), hn::Add(broadcast.c(d, k, 0), sum));
            };
            return barycentric_terms(over_w(0, along0), over_w(1, along1), over_w(2, along2));
        };
        static_assert(kBlockHeight == 4);
        const auto terms0 = terms_of(0), terms1 = terms_of(1), terms2 = terms_of(2), terms3 = terms_of(3);
        store_rows(barycentric_quotients(terms0, slopes), barycentric_quotients(terms1, slopes), i, out);
        store_rows(barycentric_quotients(terms2, slopes), barycentric_quotients(terms3, slopes), 2 * kBlockWidth + i, out);
    }
}

/// Zeroes the lanes outside the mask.
HWY_INLINE void clear_other_lanes(uint32_t mask, BarycentricWave& out) {
    for (uint32_t others = ~mask; others != 0; others &= others - 1) {
        const int lane = std::countr_zero(others);
        for (float* values : {out.b1, out.b2, out.db1_dx, out.db2_dx, out.db1_dy, out.db2_dy}) values[lane] = 0.0f;
    }
}

/// Barycentrics of the lanes of `mask` at the block's points, lane i in setup triangle setup_index[i]. Lanes outside the mask are left
/// zero. `latest`: of this frame.
HWY_ATTR inline void barycentric_wave(const Frame& frame, const uint32_t* setup_index, const BlockPoints& points, uint32_t mask,
                                      LatestPlanes& latest, BarycentricWave& out) {
    if (mask == 0) {
        out = {};
        return;
    }
    const uint32_t first = setup_index[std::countr_zero(mask)];
    const bool one_triangle = (lanes_of_triangle(setup_index, first) & mask) == mask;
    if (one_triangle && points.same_offset) {
        barycentric_rows(latest.of(first), points, out);
    } else {
        alignas(64) double px[32];
        alignas(64) double py[32];
        sample_points(points, px, py);
        const size_t step = hn::Lanes(SampleLanes());
        if (one_triangle) {
            const BroadcastPlanes planes(latest.of(first));
            for (size_t lane = 0; lane < 32; lane += step) barycentric_lanes(planes, px, py, lane, out);
        } else {
            const PlanesByLane planes(frame, setup_index, mask);
            for (size_t lane = 0; lane < 32; lane += step) barycentric_lanes(planes, px, py, lane, out);
        }
    }
    if (mask != 0xFFFFFFFFu) clear_other_lanes(mask, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::raster
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_RASTER_INTERPOLATE_INL_H
