// Looking up the albedo of GGX in vectors.
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

template <class V>
struct GgxAlbedo {
    V scale, bias;  ///< reflected share of uniform light: F0 * scale + bias
};

/// Bilinear in sqrt(n.v) and roughness, both in [0, 1].
template <class D, class V = hn::Vec<D>>
HWY_INLINE GgxAlbedo<V> ggx_albedo_lanes(D d, const GgxAlbedoTable& table, V n_dot_v, V roughness) {
    const hn::RebindToSigned<D> di;
    constexpr int kViews = GgxAlbedoTable::kViews, kRoughnesses = GgxAlbedoTable::kRoughnesses;
    const V one = hn::Set(d, 1.0f), zero = hn::Zero(d);
    const V x = hn::Mul(hn::Sqrt(hn::Min(hn::Max(n_dot_v, zero), one)), hn::Set(d, float(kViews - 1)));
    const V y = hn::Mul(hn::Min(hn::Max(roughness, zero), one), hn::Set(d, float(kRoughnesses - 1)));
    const auto column = held_integer(d, x, 0, kViews - 2), row = held_integer(d, y, 0, kRoughnesses - 2);
    const Bilinear<V> at{hn::Sub(x, hn::ConvertTo(d, column)), hn::Sub(y, hn::ConvertTo(d, row))};

    const auto first = hn::ShiftLeft<1>(hn::Add(hn::Mul(row, hn::Set(di, kViews)), column));
    const auto channel = [&](int c) HWY_ATTR {
        const float* base = table.values.data() + c;
        const float* below = base + 2 * kViews;
        return mixed(d, at, hn::GatherIndex(d, base, first), hn::GatherIndex(d, base + 2, first), hn::GatherIndex(d, below, first),
                     hn::GatherIndex(d, below + 2, first));
    };
    return {channel(0), channel(1)};
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
