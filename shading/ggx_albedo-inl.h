// Looking up reflections of GGX in vectors.
#if defined(RAWTEXEL_SHADING_GGX_ALBEDO_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_GGX_ALBEDO_INL_H_
#undef RAWTEXEL_SHADING_GGX_ALBEDO_INL_H_
#else
#define RAWTEXEL_SHADING_GGX_ALBEDO_INL_H_
#endif

#include "shading/environment-inl.h"
#include "shading/ggx_albedo.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// The zonal lobe that stands for a reflection, and its weight.
template <class V>
struct GgxLobe {
    V scale, bias;  ///< reflected share of uniform light: F0 * scale + bias
    V lean;         ///< axis: mirror direction + lean * (normal - mirror direction)
    V roughness;
};

/// Bilinear in sqrt(n.v) and roughness, both in [0, 1].
template <class D, class V = hn::Vec<D>>
HWY_INLINE GgxLobe<V> ggx_lobe(D d, const GgxReflectionTable& table, V n_dot_v, V roughness) {
    using Table = GgxReflectionTable;
    const hn::RebindToSigned<D> di;
    const V one = hn::Set(d, 1.0f), zero = hn::Zero(d);
    const V x = hn::Mul(hn::Sqrt(hn::Min(hn::Max(n_dot_v, zero), one)), hn::Set(d, float(Table::kViews - 1)));
    const V y = hn::Mul(hn::Min(hn::Max(roughness, zero), one), hn::Set(d, float(Table::kRoughnesses - 1)));
    const auto column = held_integer(d, x, 0, Table::kViews - 2), row = held_integer(d, y, 0, Table::kRoughnesses - 2);
    const Bilinear<V> at{hn::Sub(x, hn::ConvertTo(d, column)), hn::Sub(y, hn::ConvertTo(d, row))};

    static_assert(Table::kChannels == 4);
    const auto first = hn::ShiftLeft<2>(hn::Add(hn::Mul(row, hn::Set(di, Table::kViews)), column));
    const auto channel = [&](int c) HWY_ATTR {
        const float* row_start = table.values.data() + c;
        const float* below = row_start + Table::kChannels * Table::kViews;
        return mixed(d, at, texunit::HWY_NAMESPACE::gather_from(row_start, first),
                     texunit::HWY_NAMESPACE::gather_from(row_start + Table::kChannels, first),
                     texunit::HWY_NAMESPACE::gather_from(below, first),
                     texunit::HWY_NAMESPACE::gather_from(below + Table::kChannels, first));
    };
    return {channel(Table::kScale), channel(Table::kBias), channel(Table::kLean), channel(Table::kRoughness)};
}

/// Mean of (1 - v.h)^5 over cosine-weighted light: kDiffuseFresnel.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V diffuse_fresnel(D d, V n_dot_v) {
    const V x = hn::Min(n_dot_v, hn::Set(d, 1.0f));
    V sum = hn::Set(d, kDiffuseFresnel[4]);
    for (int k = 3; k >= 0; --k) sum = hn::Add(hn::Mul(sum, x), hn::Set(d, kDiffuseFresnel[k]));
    return sum;
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_SHADING_GGX_ALBEDO_INL_H_
