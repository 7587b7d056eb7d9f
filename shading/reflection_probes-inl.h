// Looking up ReflectionProbeTable in vectors.
#if defined(RAWTEXEL_SHADING_REFLECTION_PROBES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_REFLECTION_PROBES_INL_H_
#undef RAWTEXEL_SHADING_REFLECTION_PROBES_INL_H_
#else
#define RAWTEXEL_SHADING_REFLECTION_PROBES_INL_H_
#endif

#include "shading/environment-inl.h"
#include "shading/reflection_probes.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// Members as in ReflectionProbeTable.
template <class V>
struct ReflectionProbe {
    V lean, roughness, scale, bias;
};

/// Four neighbouring nodes of the table: the first word of the upper left one, and the point between them.
template <class V, class VI>
struct ProbeNodes {
    VI first;
    Bilinear<V> at;
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE ProbeNodes<V, hn::Vec<hn::RebindToSigned<D>>> probe_nodes(D d, V n_dot_v, V roughness) {
    using Table = ReflectionProbeTable;
    const hn::RebindToSigned<D> di;
    const V one = hn::Set(d, 1.0f), zero = hn::Zero(d);
    // asin(sqrt(n.v)) of a right triangle's sides.
    const V cosine = hn::Min(hn::Max(n_dot_v, zero), one);
    const V angle = arc_tangent(d, hn::Sqrt(cosine), hn::Sqrt(hn::Sub(one, cosine)));
    const V x = hn::Mul(angle, hn::Set(d, float(Table::kViews - 1) * 0.636619772f));
    const V y = hn::Mul(hn::Min(hn::Max(roughness, zero), one), hn::Set(d, float(Table::kRoughnesses - 1)));
    const auto column = held_integer(d, x, 0, Table::kViews - 2), row = held_integer(d, y, 0, Table::kRoughnesses - 2);
    const auto node = hn::Add(hn::Mul(row, hn::Set(di, Table::kViews)), column);
    return {hn::Mul(node, hn::Set(di, Table::kNodeWords)), {hn::Sub(x, hn::ConvertTo(d, column)), hn::Sub(y, hn::ConvertTo(d, row))}};
}

/// Probe `index`, bilinear.
template <class D, class V = hn::Vec<D>, class VI = hn::Vec<hn::RebindToSigned<D>>>
HWY_INLINE ReflectionProbe<V> reflection_probe(D d, const ReflectionProbeTable& table, const ProbeNodes<V, VI>& nodes, int index) {
    using Table = ReflectionProbeTable;
    const hn::RebindToSigned<D> di;
    const hn::RebindToUnsigned<D> du;
    struct Halves {
        V upper, lower;
    };
    const auto halves = [&](int word) HWY_ATTR {
        const auto* words = reinterpret_cast<const int32_t*>(table.words.data()) + word;
        const auto corner = [&](int view, int roughness) HWY_ATTR {
            const int32_t* start = words + Table::kNodeWords * (view + Table::kViews * roughness);
            const auto packed = hn::BitCast(du, texunit::HWY_NAMESPACE::gather_from(start, nodes.first));
            return Halves{hn::ConvertTo(d, hn::BitCast(di, hn::ShiftRight<16>(packed))),
                          hn::ConvertTo(d, hn::BitCast(di, hn::And(packed, hn::Set(du, 0xFFFFu))))};
        };
        const Halves c00 = corner(0, 0), c10 = corner(1, 0), c01 = corner(0, 1), c11 = corner(1, 1);
        const V unit = hn::Set(d, 1.0f / 65535.0f);
        return Halves{hn::Mul(mixed(d, nodes.at, c00.upper, c10.upper, c01.upper, c11.upper), unit),
                      hn::Mul(mixed(d, nodes.at, c00.lower, c10.lower, c01.lower, c11.lower), unit)};
    };
    const Halves aim = halves(2 * index), shares = halves(2 * index + 1);
    return {hn::Add(hn::Mul(aim.upper, hn::Set(d, Table::kLeanRange)), hn::Set(d, Table::kLeastLean)),
            hn::Mul(aim.lower, hn::Set(d, Table::kRoughnessRange)), shares.upper, shares.lower};
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_SHADING_REFLECTION_PROBES_INL_H_
