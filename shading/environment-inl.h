// Looking up an Environment in vectors. Own arc tangent, plain products and sums: the same bits on every instruction set.
#if defined(RAWTEXEL_SHADING_ENVIRONMENT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_ENVIRONMENT_INL_H_
#undef RAWTEXEL_SHADING_ENVIRONMENT_INL_H_
#else
#define RAWTEXEL_SHADING_ENVIRONMENT_INL_H_
#endif

#include "shading/brdf.h"
#include "shading/environment_tables.h"
#include "shading/vector3-inl.h"
#include "texunit/gather-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// atan2(y, x) within 3e-7, in [-pi, pi]; 0 at the origin.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V arc_tangent(D d, V y, V x) {
    const V one = hn::Set(d, 1.0f), zero = hn::Zero(d);
    const V ax = hn::Abs(x), ay = hn::Abs(y);
    const V large = hn::Max(ax, ay), small = hn::Min(ax, ay);
    const V t = hn::Div(small, hn::Max(large, hn::Set(d, 1e-30f)));

    // atan(t) = pi/4 + atan((t - 1) / (t + 1)) brings t into [-tan(pi/8), tan(pi/8)].
    const auto upper = hn::Gt(t, hn::Set(d, 0.414213562f));
    const V reduced = hn::IfThenElse(upper, hn::Div(hn::Sub(t, one), hn::Add(t, one)), t);
    // Minimax polynomial of Moshier, Cephes atanf.
    const V z = hn::Mul(reduced, reduced);
    V p = hn::Sub(hn::Mul(hn::Set(d, 8.05374449538e-2f), z), hn::Set(d, 1.38776856032e-1f));
    p = hn::Add(hn::Mul(p, z), hn::Set(d, 1.99777106478e-1f));
    p = hn::Sub(hn::Mul(p, z), hn::Set(d, 3.33329491539e-1f));
    const V small_angle = hn::Add(hn::Mul(hn::Mul(p, z), reduced), reduced);
    const V octant = hn::Add(small_angle, hn::IfThenElseZero(upper, hn::Set(d, 0.785398163f)));

    const V quadrant = hn::IfThenElse(hn::Gt(ay, ax), hn::Sub(hn::Set(d, 1.57079633f), octant), octant);
    const V half_turn = hn::IfThenElse(hn::Lt(x, zero), hn::Sub(hn::Set(d, 3.14159265f), quadrant), quadrant);
    return hn::CopySign(half_turn, y);
}

/// Four neighbouring texels and the point between them, 0..1.
template <class V>
struct Bilinear {
    V right, down;
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE V mixed(D d, const Bilinear<V>& at, V upper_left, V upper_right, V lower_left, V lower_right) {
    const V one = hn::Set(d, 1.0f);
    const V left = hn::Sub(one, at.right), up = hn::Sub(one, at.down);
    const V upper = hn::Add(hn::Mul(upper_left, left), hn::Mul(upper_right, at.right));
    const V lower = hn::Add(hn::Mul(lower_left, left), hn::Mul(lower_right, at.right));
    return hn::Add(hn::Mul(upper, up), hn::Mul(lower, at.down));
}

/// Integer part of `x` held in [low, high]; NaN gives either end.
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Vec<hn::RebindToSigned<D>> held_integer(D d, V x, int low, int high) {
    const hn::RebindToSigned<D> di;
    const auto integer = hn::ConvertTo(di, hn::Min(hn::Max(x, hn::Set(d, float(low))), hn::Set(d, float(high))));
    return hn::Min(hn::Max(integer, hn::Set(di, low)), hn::Set(di, high));
}

/// Radiance of the lat-long image from unit `direction`, bilinear: columns wrap, the first and last rows hold up to the poles.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Vector3<V> latlong_radiance(D d, const Environment::Tables& tables, const Vector3<V>& direction) {
    const hn::RebindToSigned<D> di;
    const V half = hn::Set(d, 0.5f), zero = hn::Zero(d);
    const V azimuth = arc_tangent(d, direction.x, hn::Neg(direction.z));
    const V horizontal = hn::Sqrt(hn::Add(hn::Mul(direction.x, direction.x), hn::Mul(direction.z, direction.z)));
    const V polar = arc_tangent(d, horizontal, direction.y);
    const V u = hn::Add(hn::Mul(azimuth, hn::Set(d, 0.159154943f)), half);
    const V v = hn::Mul(polar, hn::Set(d, kInversePi));

    const V x = hn::Sub(hn::Mul(u, hn::Set(d, float(tables.width))), half);
    const V y = hn::Min(hn::Max(hn::Sub(hn::Mul(v, hn::Set(d, float(tables.height))), half), zero), hn::Set(d, float(tables.height - 1)));
    const V column = hn::Floor(x), row = hn::Floor(y);
    const Bilinear<V> at{hn::Sub(x, column), hn::Sub(y, row)};

    // x lies in [-0.5, width - 0.5]: the left column may be -1 and the right one `width`.
    const auto last = hn::Set(di, tables.width - 1), extent = hn::Set(di, tables.width);
    const auto left_raw = held_integer(d, column, -1, tables.width - 1);
    const auto left = hn::IfThenElse(hn::Lt(left_raw, hn::Zero(di)), last, left_raw);
    const auto right_raw = hn::Add(left, hn::Set(di, 1));
    const auto right = hn::IfThenElse(hn::Eq(right_raw, extent), hn::Zero(di), right_raw);
    const auto upper = held_integer(d, row, 0, tables.height - 1);
    const auto lower = hn::Min(hn::Add(upper, hn::Set(di, 1)), hn::Set(di, tables.height - 1));

    const auto texel = [&](auto tx, auto ty) HWY_ATTR { return hn::Mul(hn::Add(hn::Mul(ty, extent), tx), hn::Set(di, 3)); };
    const auto i00 = texel(left, upper), i10 = texel(right, upper), i01 = texel(left, lower), i11 = texel(right, lower);
    const auto channel = [&](int c) HWY_ATTR {
        const float* base = tables.latlong.data() + c;
        return mixed(d, at, texunit::HWY_NAMESPACE::gather_from(base, i00), texunit::HWY_NAMESPACE::gather_from(base, i10),
                     texunit::HWY_NAMESPACE::gather_from(base, i01), texunit::HWY_NAMESPACE::gather_from(base, i11));
    };
    return {channel(0), channel(1), channel(2)};
}

/// Square coordinates in [0, 1]^2 on the octahedral map: octahedral_from_direction of octahedral.h.
template <class V>
struct OctahedralPoint {
    V x, y;
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE OctahedralPoint<V> octahedral_point(D d, const Vector3<V>& direction) {
    const V one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f);
    const V length = hn::Add(hn::Add(hn::Abs(direction.x), hn::Abs(direction.y)), hn::Abs(direction.z));
    const V inverse = hn::Div(one, hn::Max(length, hn::Set(d, 1e-30f)));
    const V px = hn::Mul(direction.x, inverse), py = hn::Mul(direction.z, inverse);
    const auto lower = hn::Lt(direction.y, hn::Zero(d));
    const V fx = hn::CopySign(hn::Sub(one, hn::Abs(py)), px), fy = hn::CopySign(hn::Sub(one, hn::Abs(px)), py);
    return {hn::Add(hn::Mul(hn::IfThenElse(lower, fx, px), half), half), hn::Add(hn::Mul(hn::IfThenElse(lower, fy, py), half), half)};
}

/// One level of the prefiltered maps, bilinear. `level` is an integer in [0, kSpecularLevels).
template <class D, class V = hn::Vec<D>, class VI = hn::Vec<hn::RebindToSigned<D>>>
HWY_INLINE Vector3<V> level_radiance(D d, const Environment::Tables& tables, const OctahedralPoint<V>& point, VI level) {
    const hn::RebindToSigned<D> di;
    const hn::RebindToUnsigned<D> du;
    const VI extent = texunit::HWY_NAMESPACE::gather_from(tables.extent.data(), level),
             start = texunit::HWY_NAMESPACE::gather_from(tables.start.data(), level);
    const V size = hn::ConvertTo(d, extent), half = hn::Set(d, 0.5f);

    // Texel centres lie at halves; the border's texel -1 is column 0 in memory.
    const V x = hn::Add(hn::Mul(point.x, size), half), y = hn::Add(hn::Mul(point.y, size), half);
    const V limit = hn::Add(size, hn::Set(d, 0.5f));
    const V held_x = hn::Min(hn::Max(x, half), limit), held_y = hn::Min(hn::Max(y, half), limit);
    const V column = hn::Floor(held_x), row = hn::Floor(held_y);
    const Bilinear<V> at{hn::Sub(held_x, column), hn::Sub(held_y, row)};
    const VI pitch = hn::Add(extent, hn::Set(di, 2));
    const VI zero = hn::Zero(di);
    const VI cx = hn::Min(hn::Max(hn::ConvertTo(di, column), zero), extent), cy = hn::Min(hn::Max(hn::ConvertTo(di, row), zero), extent);

    const VI i00 = hn::Add(start, hn::Add(hn::Mul(cy, pitch), cx));
    const auto* words = reinterpret_cast<const int32_t*>(tables.texels.data());
    const auto texel = [&](VI index) HWY_ATTR {
        const VI word = hn::Add(index, index);
        const auto rg = hn::BitCast(du, texunit::HWY_NAMESPACE::gather_from(words, word)),
                   bg = hn::BitCast(du, texunit::HWY_NAMESPACE::gather_from(words + 1, word));
        const auto red = hn::ShiftLeft<10>(hn::ShiftRight<11>(rg)), blue = hn::ShiftLeft<10>(hn::ShiftRight<11>(bg));
        const auto green = hn::Or(hn::ShiftLeft<20>(hn::And(rg, hn::Set(du, 0x7FFu))), hn::ShiftLeft<10>(hn::And(bg, hn::Set(du, 0x3FFu))));
        return Vector3<V>{hn::BitCast(d, red), hn::BitCast(d, green), hn::BitCast(d, blue)};
    };
    const VI next = hn::Set(di, 1);
    const Vector3<V> t00 = texel(i00), t10 = texel(hn::Add(i00, next));
    const VI i01 = hn::Add(i00, pitch);
    const Vector3<V> t01 = texel(i01), t11 = texel(hn::Add(i01, next));
    return {mixed(d, at, t00.x, t10.x, t01.x, t11.x), mixed(d, at, t00.y, t10.y, t01.y, t11.y), mixed(d, at, t00.z, t10.z, t01.z, t11.z)};
}

/// Level of detail of a roughness in [0, kFlatRoughness]: see RoughnessScale.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V roughness_level(D d, const RoughnessScale& scale, V roughness) {
    const float first = scale.first, bend = RoughnessScale::kBend;
    const V one = hn::Set(d, 1.0f), offset = hn::Sub(roughness, hn::Set(d, first));
    const float slope = float(kCosineLevel - 1) * (1.0f + bend) / (1.0f - first);
    const V wide = hn::Add(hn::Div(hn::Mul(offset, hn::Set(d, slope)), hn::Add(roughness, hn::Set(d, bend))), one);
    const V ratio = hn::Mul(roughness, hn::Set(d, 1.0f / first));
    const V narrow = hn::Mul(hn::Mul(ratio, ratio), hn::Sqrt(ratio));
    const V flat = hn::Add(hn::Sub(roughness, one), hn::Set(d, float(kCosineLevel)));
    return hn::IfThenElse(hn::Lt(offset, hn::Zero(d)), narrow, hn::IfThenElse(hn::Gt(roughness, one), flat, wide));
}

/// Mean radiance over the GGX lobe (n = v = r) about `direction` (of any length).
template <class D, class V = hn::Vec<D>>
HWY_INLINE Vector3<V> specular_radiance(D d, const Environment::Tables& tables, const Vector3<V>& direction, V roughness) {
    const hn::RebindToSigned<D> di;
    const OctahedralPoint<V> point = octahedral_point(d, direction);
    const V level = roughness_level(d, tables.scale, roughness);
    const auto lower = held_integer(d, level, 0, kSpecularLevels - 2);
    const V share = hn::Min(hn::Max(hn::Sub(level, hn::ConvertTo(d, lower)), hn::Zero(d)), hn::Set(d, 1.0f));
    const V rest = hn::Sub(hn::Set(d, 1.0f), share);
    const Vector3<V> a = level_radiance(d, tables, point, lower), b = level_radiance(d, tables, point, hn::Add(lower, hn::Set(di, 1)));
    return add(scale(a, rest), scale(b, share));
}

/// Irradiance / pi about unit `normal`.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Vector3<V> diffuse_radiance(D d, const Environment::Tables& tables, const Vector3<V>& normal) {
    const hn::RebindToSigned<D> di;
    return level_radiance(d, tables, octahedral_point(d, normal), hn::Set(di, kCosineLevel));
}

/// What a camera sees of the environment: the radiance from unit `direction` at the lanes of `mask`.
inline void environment_radiance_lanes(const Environment& environment, const WaveVector& direction, WaveMask mask, WaveVector& out) {
    const hn::ScalableTag<float> d;
    for (size_t i = 0; i < size_t(texunit::kWaveLanes); i += hn::Lanes(d)) {
        if (!any_active(mask, i, hn::Lanes(d))) {
            store3(d, set3(d, glm::vec3(0.0f)), out, i);
            continue;
        }
        store3(d, latlong_radiance(d, environment.tables(), load3(d, direction, i)), out, i);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_SHADING_ENVIRONMENT_INL_H_
