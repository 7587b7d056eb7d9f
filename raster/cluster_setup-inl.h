// Setup of the triangles of clusters in vectors.
#if defined(RAWTEXEL_RASTER_CLUSTER_SETUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_RASTER_CLUSTER_SETUP_INL_H
#undef RAWTEXEL_RASTER_CLUSTER_SETUP_INL_H
#else
#define RAWTEXEL_RASTER_CLUSTER_SETUP_INL_H
#endif

#include "raster/clip.h"
#include "raster/cluster_setup.h"
#include "raster/triangle_setup.h"

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <tuple>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::raster {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using SetupDoubles = hn::CappedTag<double, 8>;
using SetupFloats = hn::Rebind<float, SetupDoubles>;
using SetupWide = hn::Rebind<int64_t, SetupDoubles>;
using SetupInts = hn::Rebind<int32_t, SetupDoubles>;
using Double = hn::Vec<SetupDoubles>;
using Int = hn::Vec<SetupInts>;

/// One bit per lane, of at most 8.
template <class D, class M>
HWY_INLINE uint64_t setup_bits(D d, M mask) {
    uint8_t bits[8] = {};
    hn::StoreMaskBits(d, mask, bits);
    return bits[0] & ((1u << hn::Lanes(d)) - 1);
}

/// A form over object space, (a*x + b*y) + c*z + d in that order, from a row of the matrix.
struct FormLanes {
    HWY_INLINE FormLanes(const glm::mat4& m, int row) {
        const SetupDoubles d;
        for (int column = 0; column < 4; ++column) factor[column] = hn::Set(d, double(m[column][row]));
    }
    HWY_INLINE Double at(Double x, Double y, Double z) const {
        return hn::Add(hn::Add(hn::Add(hn::Mul(factor[0], x), hn::Mul(factor[1], y)), hn::Mul(factor[2], z)), factor[3]);
    }
    Double factor[4];
};

class ClusterSetup {
  public:
    ClusterSetup(const SetupInputs& inputs, SetupBatch& batch)
        : inputs_(inputs),
          grid_(inputs.grid),
          batch_(batch),
          clipped_(inputs.grid, inputs.options.skips.frustum, batch.counts),
          inverse_tile_size_(1.0 / inputs.options.tile_size) {}

    void run(std::span<const VisibleCluster> clusters, uint32_t capacity) {
        size_t triangles = 0;
        for (const VisibleCluster& visible : clusters)
            triangles += inputs_.draws[visible.draw].clusters->clusters[visible.cluster].triangle_count;
        batch_.entries.resize(triangles + triangles / 4 + kClusterTriangles);
        batch_.counts.triangles += triangles;
        for (size_t i = 0; i < clusters.size(); ++i) {
            if (i + 1 < clusters.size()) prefetch(clusters[i + 1]);
            add(clusters[i]);
        }
        append_pieces(capacity);
        batch_.entries.resize(entry_count_);
        hwy::FlushStream();
    }

  private:
    static constexpr size_t kVertices = 3 * kClusterTriangles, kRoom = kClusterTriangles + 8;
    static constexpr size_t kGroup = 16, kCacheLine = 64;
    static_assert(kGroup % 8 == 0);  // lanes, at most

    /// Clusters come from memory, each from many places of it.
    HWY_INLINE void prefetch(const VisibleCluster& visible) const {
        const MeshClusters& mesh = *inputs_.draws[visible.draw].clusters;
        const Cluster& cluster = mesh.clusters[visible.cluster];
        const auto read = [](const auto* first, size_t count) HWY_ATTR {
            const char* const begin = reinterpret_cast<const char*>(first);
            const char* const end = reinterpret_cast<const char*>(first + count);
            for (const char* at = begin; at < end; at += kCacheLine) hwy::Prefetch(at);
            hwy::Prefetch(end - 1);
        };
        for (const std::vector<float>* axis : {&mesh.x, &mesh.y, &mesh.z}) read(axis->data() + cluster.first_vertex, cluster.vertex_count);
        for (const std::vector<uint8_t>& corner : mesh.corner) read(corner.data() + cluster.first_triangle, cluster.triangle_count);
        read(mesh.primitive.data() + cluster.first_triangle, cluster.triangle_count);
    }

    void add(const VisibleCluster& visible) {
        if (draw_ != &inputs_.draws[visible.draw]) begin_draw(visible.draw);
        cluster_ = &mesh_->clusters[visible.cluster];
        transform_vertices();
        const uint32_t count = cluster_->triangle_count;
        uint64_t whole = count == 64 ? ~uint64_t{0} : (uint64_t{1} << count) - 1;
        if (!visible.unclipped && find_codes()) whole &= ~set_apart(whole);
        if (whole != 0) set_up(cull(whole));
    }

    /// Whatever is set up until the next one shares this much.
    void begin_draw(uint32_t index) {
        draw_ = &inputs_.draws[index];
        draw_index_ = index;
        mesh_ = draw_->clusters;
        for (SetupTriangle& triangle : staged_) {
            triangle.draw = index;
            triangle.coverage = draw_->coverage;
            triangle.bary_over_w = nullptr;
        }
    }

    HWY_INLINE void transform_vertices() {
        const SetupDoubles d;
        const SetupFloats df;
        const SetupInts di;
        const glm::mat4& m = draw_->clip_from_object;
        const FormLanes x_form(m, 0), y_form(m, 1), z_form(m, 2), w_form(m, 3);
        const Double half_width = hn::Set(d, 0.5 * inputs_.options.width), half_height = hn::Set(d, 0.5 * inputs_.options.height);
        const Double limit = hn::Set(d, double(kGuardBand) * kSubpixelOne), subpixel = hn::Set(d, double(kSubpixelOne));
        const Double zero = hn::Zero(d), one = hn::Set(d, 1.0);
        const float* const from_x = mesh_->x.data() + cluster_->first_vertex;
        const float* const from_y = mesh_->y.data() + cluster_->first_vertex;
        const float* const from_z = mesh_->z.data() + cluster_->first_vertex;
        for (size_t i = 0; i < cluster_->vertex_count; i += hn::Lanes(d)) {
            const Double px = hn::PromoteTo(d, hn::LoadU(df, from_x + i)), py = hn::PromoteTo(d, hn::LoadU(df, from_y + i)),
                         pz = hn::PromoteTo(d, hn::LoadU(df, from_z + i));
            const Double clip_x = x_form.at(px, py, pz), clip_y = y_form.at(px, py, pz);
            const Double z = z_form.at(px, py, pz), w = w_form.at(px, py, pz);
            const Double x = hn::Mul(hn::Add(w, clip_x), half_width), y = hn::Mul(hn::Sub(w, clip_y), half_height);
            hn::StoreInterleaved2(x, y, d, xy_ + 2 * i);
            hn::StoreInterleaved2(z, w, d, zw_ + 2 * i);
            // As snap() and depth_of() have it; of vertices that a plane clips nobody looks at these.
            const auto snapped = [&](Double v) HWY_ATTR {
                const Double rounded = hn::Round(hn::Mul(hn::Div(v, w), subpixel));
                return hn::DemoteTo(di, hn::Min(hn::Max(rounded, hn::Neg(limit)), limit));
            };
            hn::StoreInterleaved2(snapped(x), snapped(y), di, snapped_ + 2 * i);
            const Double depth = hn::Add(hn::Min(hn::Max(hn::Div(z, w), zero), one), zero);
            hn::StoreInterleaved2(depth, hn::Div(one, w), d, depth_and_inverse_w_ + 2 * i);
        }
    }

    ScreenVertex vertex(size_t i) const { return {xy_[2 * i], xy_[2 * i + 1], zw_[2 * i], zw_[2 * i + 1]}; }

    static constexpr uint32_t kNotFinite = 1u << kClipPlanes;

    /// What planes the vertices are outside of; whether there is any.
    bool find_codes() {
        uint32_t any = 0;
        for (size_t i = 0; i < cluster_->vertex_count; ++i) {
            const ScreenVertex v = vertex(i);
            codes_[i] = uint8_t(is_finite(v) ? outside_planes(v) : kNotFinite);
            any |= codes_[i];
        }
        return any != 0;
    }

    uint8_t corner(size_t triangle, size_t i) const { return mesh_->corner[i][cluster_->first_triangle + triangle]; }

    /// Settles the fate of the triangles that are not wholly inside, and returns them.
    uint64_t set_apart(uint64_t triangles) {
        uint64_t apart = 0;
        for (uint64_t rest = triangles; rest != 0; rest &= rest - 1) {
            const size_t t = size_t(std::countr_zero(rest));
            const size_t corners[3] = {corner(t, 0), corner(t, 1), corner(t, 2)};
            const uint32_t all = codes_[corners[0]] & codes_[corners[1]] & codes_[corners[2]];
            const uint32_t some = codes_[corners[0]] | codes_[corners[1]] | codes_[corners[2]];
            if (some == 0) continue;
            apart |= uint64_t{1} << t;
            if ((some & kNotFinite) != 0) {
                ++batch_.counts.culled_nonfinite;
            } else if (all != 0 && inputs_.options.skips.frustum) {
                ++batch_.counts.culled_frustum;
            } else {
                clipped_.add({vertex(corners[0]), vertex(corners[1]), vertex(corners[2])}, some, origin(t));
            }
        }
        return apart;
    }

    TriangleOrigin origin(size_t t) const {
        const uint32_t primitive = mesh_->primitive[cluster_->first_triangle + t];
        return {draw_->first_triangle_id + primitive, draw_index_, primitive, draw_->coverage, draw_->cull, draw_->front_is_clockwise};
    }

    /// Counts and leaves out what has no area, faces away or reaches no sample; returns the others, those back faces included that are to
    /// be dropped only later.
    HWY_INLINE uint64_t cull(uint64_t whole) {
        const SetupDoubles d;
        const SetupInts di;
        const SampleBox &box = grid_.sample_box(), &support = grid_.support(), &reach = grid_.reach();
        for (size_t t = 0; t < cluster_->triangle_count; ++t) {
            for (size_t i = 0; i < 3; ++i) copy_pair(snapped_, corner(t, i), snapped_of_corner_[i], t);
        }
        uint64_t flat = 0, clockwise = 0, beside = 0, between_support = 0, between_samples = 0;
        for (size_t t = 0; t < cluster_->triangle_count; t += hn::Lanes(d)) {
            Int x[3], y[3];
            for (size_t i = 0; i < 3; ++i) hn::LoadInterleaved2(di, snapped_of_corner_[i] + 2 * t, x[i], y[i]);
            const auto delta = [&](const Int(&v)[3], size_t i) HWY_ATTR { return hn::PromoteTo(d, hn::Sub(v[i], v[0])); };
            const Double area = hn::Sub(hn::Mul(delta(x, 1), delta(y, 2)), hn::Mul(delta(x, 2), delta(y, 1)));
            flat |= setup_bits(d, hn::Eq(area, hn::Zero(d))) << t;
            clockwise |= setup_bits(d, hn::Gt(area, hn::Zero(d))) << t;

            const auto least = [&](const Int(&v)[3]) HWY_ATTR { return hn::ShiftLeft<1>(hn::Min(hn::Min(v[0], v[1]), v[2])); };
            const auto most = [&](const Int(&v)[3]) HWY_ATTR { return hn::ShiftLeft<1>(hn::Max(hn::Max(v[0], v[1]), v[2])); };
            const Int x_min = least(x), x_max = most(x), y_min = least(y), y_max = most(y);
            const auto set = [&](int64_t v) HWY_ATTR { return hn::Set(di, int32_t(v)); };
            beside |= setup_bits(di, hn::Or(hn::Or(hn::Lt(x_max, set(box.x_min)), hn::Gt(x_min, set(box.x_max))),
                                            hn::Or(hn::Lt(y_max, set(box.y_min)), hn::Gt(y_min, set(box.y_max)))))
                      << t;
            // As TileGrid::may_hold_sample has it.
            const auto misses = [&](Int low, Int high, int64_t first, int64_t last) HWY_ATTR {
                const Int pixel = hn::ShiftRight<kSampleBits>(hn::Add(low, set(kSampleOne - 1 - last)));
                return hn::Gt(hn::Add(hn::ShiftLeft<kSampleBits>(pixel), set(first)), high);
            };
            const auto between = [&](const SampleBox& offsets) HWY_ATTR {
                return setup_bits(
                    di, hn::Or(misses(x_min, x_max, offsets.x_min, offsets.x_max), misses(y_min, y_max, offsets.y_min, offsets.y_max)));
            };
            between_support |= between(support) << t;
            between_samples |= between(reach) << t;
        }
        back_ = ~(draw_->front_is_clockwise ? clockwise : ~clockwise);
        late_ = 0;
        FrameCounts& counts = batch_.counts;
        const auto leave_out = [&](uint64_t which, uint64_t FrameCounts::*counter) {
            counts.*counter += uint64_t(std::popcount(whole & which));
            whole &= ~which;
        };
        leave_out(flat, &FrameCounts::culled_degenerate);
        if (draw_->cull == CullMode::Back) {
            if (inputs_.options.skips.backface) {
                leave_out(back_, &FrameCounts::culled_backface);
            } else {
                late_ = back_;
            }
        }
        leave_out(beside, &FrameCounts::culled_frustum);
        leave_out(between_support, &FrameCounts::culled_small);
        leave_out(between_samples, &FrameCounts::culled_unsampled);
        return whole;
    }

    /// Entry `from` of an array of pairs to entry `to` of another one.
    template <class T>
    static HWY_INLINE void copy_pair(const T* source, size_t from, T* target, size_t to) {
        std::memcpy(target + 2 * to, source + 2 * from, 2 * sizeof(T));
    }

    /// A few at a time, so that all there is of them stays in the nearest cache beside the vertices.
    void set_up(uint64_t triangles) {
        if (batch_.entries.size() < entry_count_ + kClusterTriangles) batch_.entries.resize(2 * (entry_count_ + kClusterTriangles));
        while (triangles != 0) triangles = set_up_group(triangles);
    }

    /// Returns those that are left.
    HWY_INLINE uint64_t set_up_group(uint64_t triangles) {
        const SetupDoubles d;
        uint8_t list[kGroup];
        size_t count = 0;
        for (; triangles != 0 && count < kGroup; triangles &= triangles - 1, ++count) {
            const size_t t = size_t(std::countr_zero(triangles));
            list[count] = uint8_t(t);
            for (size_t i = 0; i < 3; ++i) {
                const size_t v = corner(t, i);
                copy_pair(snapped_, v, of_corner_.snapped[i], count);
                copy_pair(xy_, v, of_corner_.xy[i], count);
                copy_pair(depth_and_inverse_w_, v, of_corner_.depth_and_inverse_w[i], count);
            }
        }
        in_one_tile_ = in_no_tile_ = compact_ = 0;
        for (size_t i = 0; i < count; i += hn::Lanes(d)) set_up_lanes_at(list, i, std::min(count - i, hn::Lanes(d)));
        const size_t staged = stage(list, count);
        // Nobody reads them soon: past the caches.
        const hn::CappedTag<uint8_t, 64> du;
        const uint8_t* const from = reinterpret_cast<const uint8_t*>(staged_);
        uint8_t* const to = reinterpret_cast<uint8_t*>(batch_.triangles + batch_.count);
        for (size_t i = 0; i < staged * sizeof(SetupTriangle); i += hn::Lanes(du)) hn::Stream(hn::Load(du, from + i), du, to + i);
        batch_.count += uint32_t(staged);
        batch_.counts.binned += staged;
        return triangles;
    }

    /// Triangles `at` and on of those gathered.
    HWY_INLINE void set_up_lanes_at(const uint8_t* list, size_t at, size_t count) {
        const SetupDoubles d;
        const SetupFloats df;
        const SetupInts di;
        Double raw_x[3], raw_y[3], raw_depth[3], raw_inverse[3];
        for (size_t i = 0; i < 3; ++i) {
            Int x, y;
            hn::LoadInterleaved2(di, of_corner_.snapped[i] + 2 * at, x, y);
            raw_x[i] = hn::PromoteTo(d, x);
            raw_y[i] = hn::PromoteTo(d, y);
            hn::LoadInterleaved2(d, of_corner_.depth_and_inverse_w[i] + 2 * at, raw_depth[i], raw_inverse[i]);
        }
        find_first_corners(list, at, count);
        const SetupWide dw;
        const auto is_second = hn::MaskFromVec(hn::BitCast(d, hn::Load(dw, out_.second + at)));
        const auto is_third = hn::MaskFromVec(hn::BitCast(d, hn::Load(dw, out_.third + at)));
        const Double raw_area = hn::Sub(hn::Mul(hn::Sub(raw_x[1], raw_x[0]), hn::Sub(raw_y[2], raw_y[0])),
                                        hn::Mul(hn::Sub(raw_x[2], raw_x[0]), hn::Sub(raw_y[1], raw_y[0])));
        const auto turned = hn::Lt(raw_area, hn::Zero(d));
        // Positive winding, from the first corner on, so that triangles of the same three positions are alike.
        const auto arrange = [&](const Double(&v)[3], Double(&out)[3]) HWY_ATTR {
            out[0] = hn::IfThenElse(is_third, v[2], hn::IfThenElse(is_second, v[1], v[0]));
            const Double next = hn::IfThenElse(is_third, v[0], hn::IfThenElse(is_second, v[2], v[1]));
            const Double last = hn::IfThenElse(is_third, v[1], hn::IfThenElse(is_second, v[0], v[2]));
            out[1] = hn::IfThenElse(turned, last, next);
            out[2] = hn::IfThenElse(turned, next, last);
        };
        Double x[3], y[3], depth[3], inverse[3];
        arrange(raw_x, x);
        arrange(raw_y, y);
        arrange(raw_depth, depth);
        arrange(raw_inverse, inverse);

        // Gradient of the depth from the snapped positions, so that it is exact at the first vertex and as good as double allows elsewhere.
        const Double dx1 = hn::Sub(x[1], x[0]), dy1 = hn::Sub(y[1], y[0]), dx2 = hn::Sub(x[2], x[0]), dy2 = hn::Sub(y[2], y[0]);
        const Double dz1 = hn::Sub(depth[1], depth[0]), dz2 = hn::Sub(depth[2], depth[0]);
        const Double area = hn::Sub(hn::Mul(dx1, dy2), hn::Mul(dx2, dy1)), subpixel = hn::Set(d, double(kSubpixelOne));
        const Double slope_x = hn::Mul(hn::Div(hn::Sub(hn::Mul(dz1, dy2), hn::Mul(dz2, dy1)), area), subpixel);
        const Double slope_y = hn::Mul(hn::Div(hn::Sub(hn::Mul(dz2, dx1), hn::Mul(dz1, dx2)), area), subpixel);
        const auto least = [&](const Double(&v)[3]) HWY_ATTR { return hn::Min(hn::Min(v[0], v[1]), v[2]); };
        const auto most = [&](const Double(&v)[3]) HWY_ATTR { return hn::Max(hn::Max(v[0], v[1]), v[2]); };

        for (size_t i = 0; i < 3; ++i) {
            hn::Store(hn::DemoteTo(di, x[i]), di, out_.x[i] + at);
            hn::Store(hn::DemoteTo(di, y[i]), di, out_.y[i] + at);
            hn::Store(inverse[i], d, out_.inverse_w[i] + at);
            hn::Store(hn::DemoteTo(df, inverse[i]), df, out_.rounded_inverse_w[i] + at);
        }
        hn::Store(depth[0], d, out_.depth_at_origin + at);
        hn::Store(slope_x, d, out_.depth_dx + at);
        hn::Store(slope_y, d, out_.depth_dy + at);
        hn::Store(hn::DemoteTo(df, least(depth)), df, out_.depth_min + at);
        hn::Store(hn::DemoteTo(df, most(depth)), df, out_.depth_max + at);
        const auto number = [&](auto mask, int64_t value)
                                HWY_ATTR { return hn::And(hn::BitCast(dw, hn::VecFromMask(d, mask)), hn::Set(dw, value)); };
        const auto arrangement = hn::Or(hn::Or(number(is_second, 1), number(is_third, 2)), number(turned, 4));
        hn::Store(arrangement, dw, out_.arrangement + at);
        const Double x_min = least(x), x_max = most(x), y_min = least(y), y_max = most(y);
        const Double extent = hn::Max(hn::Sub(x_max, x_min), hn::Sub(y_max, y_min));
        const auto near_enough = hn::Le(extent, hn::Set(d, double(kCompactExtent * kSubpixelOne)));
        const Double farthest = least(inverse), nearest = most(inverse);
        const auto flat_enough = hn::Le(nearest, hn::Mul(farthest, hn::Set(d, kCompactMostW)));
        const auto within = hn::And(hn::Ge(farthest, hn::Set(d, 1 / kCompactInverseW)), hn::Le(nearest, hn::Set(d, kCompactInverseW)));
        compact_ |= setup_bits(d, hn::And(near_enough, hn::And(flat_enough, within))) << at;
        find_tiles(x_min, x_max, y_min, y_max, at);
    }

    bool precedes(size_t p, size_t q) const {
        const ScreenVertex a = vertex(p), b = vertex(q);
        return std::tie(a.x, a.y, a.z, a.w) < std::tie(b.x, b.y, b.z, b.w);
    }

    /// Which triangles' first corner, in the lexicographic order of homogeneous pixels, is their second one, and which their third.
    HWY_INLINE void find_first_corners(const uint8_t* list, size_t at, size_t count) {
        const SetupDoubles d;
        const SetupWide dw;
        Double x0, x1, x2, y0, y1, y2;
        hn::LoadInterleaved2(d, of_corner_.xy[0] + 2 * at, x0, y0);
        hn::LoadInterleaved2(d, of_corner_.xy[1] + 2 * at, x1, y1);
        hn::LoadInterleaved2(d, of_corner_.xy[2] + 2 * at, x2, y2);
        const auto before = [&](Double px, Double py, Double qx, Double qy)
                                HWY_ATTR { return hn::Or(hn::Lt(px, qx), hn::And(hn::Eq(px, qx), hn::Lt(py, qy))); };
        const auto ties = hn::Or(hn::Or(hn::And(hn::Eq(x0, x1), hn::Eq(y0, y1)), hn::And(hn::Eq(x0, x2), hn::Eq(y0, y2))),
                                 hn::And(hn::Eq(x1, x2), hn::Eq(y1, y2)));
        const auto b10 = before(x1, y1, x0, y0), b20 = before(x2, y2, x0, y0), b21 = before(x2, y2, x1, y1);
        const auto third = hn::Or(hn::And(b10, b21), hn::AndNot(b10, b20)), second = hn::AndNot(b21, b10);
        hn::Store(hn::BitCast(dw, hn::VecFromMask(d, second)), dw, out_.second + at);
        hn::Store(hn::BitCast(dw, hn::VecFromMask(d, third)), dw, out_.third + at);
        for (uint64_t rest = setup_bits(d, ties) & ((1u << count) - 1); rest != 0; rest &= rest - 1) {
            const size_t lane = size_t(std::countr_zero(rest)), t = list[at + lane];
            size_t best = 0;
            for (size_t i = 1; i < 3; ++i) {
                if (precedes(corner(t, i), corner(t, best))) best = i;
            }
            out_.second[at + lane] = best == 1 ? -1 : 0;
            out_.third[at + lane] = best == 2 ? -1 : 0;
        }
    }

    /// The tiles about the boxes, as TileGrid::tiles_over has it.
    HWY_INLINE void find_tiles(Double x_min, Double x_max, Double y_min, Double y_max, size_t at) {
        const SetupDoubles d;
        const SetupInts di;
        const SampleBox& reach = grid_.reach();
        const Double to_pixels = hn::Set(d, 1.0 / kSampleOne), two = hn::Set(d, 2.0), half = hn::Set(d, 0.5);
        const Double per_tile = hn::Set(d, inverse_tile_size_);
        const auto set = [&](int64_t v) HWY_ATTR { return hn::Set(d, double(v)); };
        const auto range = [&](Double low, Double high, int64_t first_offset, int64_t last_offset, int first_tile, int last_tile,
                               int extent, Double& first, Double& last) HWY_ATTR {
            const Double first_pixel = hn::Ceil(hn::Mul(hn::Sub(hn::Mul(low, two), set(last_offset)), to_pixels));
            const Double last_pixel =
                hn::Min(hn::Floor(hn::Mul(hn::Sub(hn::Mul(high, two), set(first_offset)), to_pixels)), set(extent - 1));
            // Half a pixel keeps the quotient's rounding from the whole numbers.
            const auto tile = [&](Double pixel) HWY_ATTR { return hn::Floor(hn::Mul(hn::Add(pixel, half), per_tile)); };
            const auto none = hn::Or(hn::Gt(first_pixel, last_pixel), hn::Lt(last_pixel, hn::Zero(d)));
            first = hn::IfThenElse(none, hn::Zero(d), hn::Max(tile(first_pixel), set(first_tile)));
            last = hn::IfThenElse(none, set(-1), hn::Min(tile(last_pixel), set(last_tile)));
        };
        Double first_column, last_column, first_row, last_row;
        range(x_min, x_max, reach.x_min, reach.x_max, grid_.first_x(), grid_.last_x(), grid_.width(), first_column, last_column);
        range(y_min, y_max, reach.y_min, reach.y_max, grid_.first_y(), grid_.last_y(), grid_.height(), first_row, last_row);
        in_one_tile_ |= setup_bits(d, hn::And(hn::Eq(first_column, last_column), hn::Eq(first_row, last_row))) << at;
        in_no_tile_ |= setup_bits(d, hn::Or(hn::Gt(first_column, last_column), hn::Gt(first_row, last_row))) << at;
        hn::Store(hn::DemoteTo(di, hn::Add(hn::Mul(first_row, set(grid_.tiles_x())), first_column)), di, out_.first_tile + at);
    }

    /// Puts the group's triangles that are not dropped into staged_, with their bin entries; returns how many those are.
    HWY_INLINE size_t stage(const uint8_t* list, size_t count) {
        const uint64_t back = back_, late = late_, in_no_tile = in_no_tile_, in_one_tile = in_one_tile_, compact = compact_;
        const uint32_t* const primitives = mesh_->primitive.data() + cluster_->first_triangle;
        const uint32_t first_id = draw_->first_triangle_id, first_index = batch_.count;
        BinEntry* entry = batch_.entries.data() + entry_count_;
        size_t staged = 0;
        for (size_t i = 0; i < count; ++i) {
            const size_t t = list[i];
            const bool is_late = (late >> t & 1u) != 0;
            if (is_late || (in_no_tile >> i & 1u) != 0) {
                ++(is_late ? batch_.counts.culled_backface : batch_.counts.culled_frustum);
                continue;
            }
            SetupTriangle& to = staged_[staged];
            const uint32_t index = first_index + uint32_t(staged);
            write(i, primitives[t], first_id, (back >> t & 1u) == 0, (compact >> i & 1u) != 0, to);
            if ((in_one_tile >> i & 1u) != 0) {
                *entry++ = {uint32_t(out_.first_tile[i]), index};
            } else {
                entry_count_ = size_t(entry - batch_.entries.data());
                const bool entered = enter_tiles(to, index);
                entry = batch_.entries.data() + entry_count_;
                if (!entered) {
                    ++batch_.counts.culled_frustum;
                    continue;
                }
            }
            ++staged;
        }
        entry_count_ = size_t(entry - batch_.entries.data());
        return staged;
    }

    /// The triangle set up as number i of its group.
    HWY_INLINE void write(size_t i, uint32_t primitive, uint32_t first_id, bool front_facing, bool compact, SetupTriangle& to) {
        for (size_t k = 0; k < 3; ++k) {
            to.x[k] = out_.x[k][i];
            to.y[k] = out_.y[k][i];
            to.inverse_w[k] = out_.inverse_w[k][i];
            to.rounded_inverse_w[k] = out_.rounded_inverse_w[k][i];
        }
        to.depth_at_origin = out_.depth_at_origin[i];
        to.depth_dx = out_.depth_dx[i];
        to.depth_dy = out_.depth_dy[i];
        to.depth_min = out_.depth_min[i];
        to.depth_max = out_.depth_max[i];
        to.primitive = primitive;
        to.triangle_id = first_id + primitive;
        write_flag(front_facing, to.front_facing);
        // By first corner, and winding.
        static constexpr uint8_t kCorners[8][4] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}, {}};
        std::memcpy(to.corner, kCorners[out_.arrangement[i]], 3);
        write_flag(compact, to.compact);
    }

    /// As a byte: assigned, a bit of a mask is written along with others first, and then read again to be cut off.
    static HWY_INLINE void write_flag(bool flag, bool& to) {
        const uint8_t byte = flag;
        std::memcpy(&to, &byte, 1);
    }

    /// Leaves room for the entries of as many triangles as one cluster has.
    bool enter_tiles(const SetupTriangle& triangle, uint32_t index) {
        const size_t before = entry_count_;
        grid_.for_each_touched(triangle, [&](size_t tile) {
            if (entry_count_ + kClusterTriangles >= batch_.entries.size()) batch_.entries.resize(2 * (entry_count_ + kClusterTriangles));
            batch_.entries[entry_count_++] = {uint32_t(tile), index};
            return true;
        });
        return entry_count_ > before;
    }

    void append_pieces(uint32_t capacity) {
        std::vector<SetupTriangle>& pieces = clipped_.pieces();
        if (pieces.empty()) return;
        batch_.piece_planes = std::move(clipped_.planes());
        for (size_t i = 0; i < pieces.size(); ++i) pieces[i].bary_over_w = &batch_.piece_planes[clipped_.plane_of_piece()[i]];
        const size_t fit = std::min<size_t>(pieces.size(), capacity - batch_.count);
        for (size_t i = 0; i < fit; ++i) {
            enter_tiles(pieces[i], batch_.count);
            batch_.triangles[batch_.count++] = pieces[i];
        }
        for (size_t i = fit; i < pieces.size(); ++i) enter_tiles(pieces[i], capacity + uint32_t(i - fit));
        batch_.overflow.assign(pieces.begin() + ptrdiff_t(fit), pieces.end());
    }

    const SetupInputs& inputs_;
    const TileGrid& grid_;
    SetupBatch& batch_;
    ClippedSetup clipped_;
    double inverse_tile_size_;

    // Of the cluster at hand.
    const Draw* draw_ = nullptr;
    uint32_t draw_index_ = 0;
    const MeshClusters* mesh_ = nullptr;
    const Cluster* cluster_ = nullptr;
    // By vertex, in pairs.
    alignas(64) double xy_[2 * kVertices] = {};
    alignas(64) double zw_[2 * kVertices] = {};
    alignas(64) double depth_and_inverse_w_[2 * kVertices] = {};
    alignas(64) int32_t snapped_[2 * kVertices] = {};
    uint8_t codes_[kVertices] = {};
    alignas(64) int32_t snapped_of_corner_[3][2 * kRoom] = {};  // by triangle, all of the cluster's
    // By triangle of the group at hand, of each corner; gathered pair by pair, which takes less than gathering in vectors.
    struct OfCorner {
        alignas(64) double xy[3][2 * kGroup];
        alignas(64) double depth_and_inverse_w[3][2 * kGroup];
        alignas(64) int32_t snapped[3][2 * kGroup];
    } of_corner_{};
    uint64_t back_ = 0, late_ = 0;  // late: to be dropped when they are set up
    struct Lanes {
        alignas(64) double inverse_w[3][kGroup];
        alignas(64) double depth_at_origin[kGroup];
        alignas(64) double depth_dx[kGroup];
        alignas(64) double depth_dy[kGroup];
        alignas(64) int64_t second[kGroup];
        alignas(64) int64_t third[kGroup];
        alignas(64) int64_t arrangement[kGroup];
        alignas(64) float depth_min[kGroup];
        alignas(64) float depth_max[kGroup];
        alignas(64) float rounded_inverse_w[3][kGroup];
        alignas(64) int32_t x[3][kGroup];
        alignas(64) int32_t y[3][kGroup];
        alignas(64) int32_t first_tile[kGroup];
    } out_{};
    uint64_t in_one_tile_ = 0, in_no_tile_ = 0, compact_ = 0;  // bit per triangle of the group
    size_t entry_count_ = 0;
    SetupTriangle staged_[kGroup];
};

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::raster
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_RASTER_CLUSTER_SETUP_INL_H
