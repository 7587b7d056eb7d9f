// Bilinear filtering of words of four fields, in registers from texel to colour: the lookup that most frames are made of. Its bits are
// those of fetch() and filter().
#include "texunit/filter-inl.h"
#include "texunit/packed_texels-inl.h"
#include "texunit/texel_window-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_PACKED_BILINEAR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_PACKED_BILINEAR_INL_H_
#undef RAWTEXEL_TEXUNIT_PACKED_BILINEAR_INL_H_
#else
#define RAWTEXEL_TEXUNIT_PACKED_BILINEAR_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Along x, then along y, as filter(); read(tap, i, value) gives lanes i .. of a tap's four channels.
template <class Read>
HWY_INLINE void filter_values(const TapWave<2>& taps, const Read& read, WaveColor& out) {
    const FloatTag d;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto x = hn::Load(d, taps.fraction_x.lane + i), y = hn::Load(d, taps.fraction_y.lane + i);
        FloatVec left[4], right[4], upper[4];
        read(0, i, left);
        read(1, i, right);
        for (int c = 0; c < 4; ++c) upper[c] = lerp(x, left[c], right[c]);
        read(2, i, left);
        read(3, i, right);
        for (int c = 0; c < 4; ++c) hn::Store(lerp(y, upper[c], lerp(x, left[c], right[c])), d, out.channel[c].lane + i);
    }
}

template <PackedFields fields>
HWY_NOINLINE void filter_packed_taps(const Texture& texture, const WaveInt (&index)[4], const TapWave<2>& taps, WaveColor& out) {
    const PackedDecoder<fields> decoder(texture.texel_layout());
    const auto* const base = reinterpret_cast<const uint32_t*>(texture.texels());
    const auto read = [&](int tap, size_t i, FloatVec(&value)[4])
                          HWY_ATTR { decoder.values(gather_from(base, hn::Load(IntTag(), index[tap].lane + i)), value); };
    filter_values(taps, read, out);
}

/// Where all taps fall into a window: its texels are unpacked once.
template <PackedFields fields, int registers>
HWY_NOINLINE void filter_packed_window(Texture& texture, const TexelWindow& window, const TapWave<2>& taps, WaveColor& out) {
    const IntTag di;
    const PackedDecoder<fields> decoder(texture.texel_layout());
    const auto* const base = reinterpret_cast<const uint32_t*>(texture.texels());
    IntVec index[registers];
    ensure_window<StorageClass::Packed32>(texture, window, *taps.level, index);
    FloatVec texel[4][registers];
    for (int r = 0; r < registers; ++r) {
        FloatVec value[4];
        decoder.values(gather_from(base, index[r]), value);
        for (int c = 0; c < 4; ++c) texel[c][r] = value[c];
    }
    const auto read = [&](int tap, size_t i, FloatVec(&value)[4]) HWY_ATTR {
        const auto at = in_window(window, hn::Load(di, taps.x[tap % 2].lane + i), hn::Load(di, taps.y[tap / 2].lane + i));
        for (int c = 0; c < 4; ++c) value[c] = pick(texel[c], at);
    };
    filter_values(taps, read, out);
}

/// The most registers of a window that take less time than reading the taps one by one.
inline constexpr int kBilinearWindowRegisters = 2;

/// Filters taps that fit into a window; false where they do not.
template <StorageClass storage>
HWY_INLINE bool filter_bilinear_window(Texture& texture, const TapWave<2>& taps, WaveColor& out) {
    if constexpr (has_windows(storage)) {
        TexelWindow window;
        if (taps.slice != nullptr || !find_window(texture, *taps.level, taps.x, 2, taps.y, 2, kBilinearWindowRegisters, window))
            return false;
        with_fields(texture.texel_layout().fields, [&](auto constant) HWY_ATTR {
            constexpr PackedFields kFields = decltype(constant)::value;
            static_assert(kBilinearWindowRegisters == 2);
            if (window.registers == 1) return filter_packed_window<kFields, 1>(texture, window, taps, out);
            filter_packed_window<kFields, 2>(texture, window, taps, out);
        });
        return true;
    }
    return false;
}

/// Ensures, gathers and filters taps of which none lies beyond an edge.
HWY_NOINLINE inline void filter_packed_bilinear(Texture& texture, const TapWave<2>& taps, WaveColor& out) {
    constexpr StorageClass kStorage = StorageClass::Packed32;
    if (filter_bilinear_window<kStorage>(texture, taps, out)) return;
    WaveInt index[4];
    tap_indices<kStorage>(texture.levels(), taps, index);
    ensure(texture, *taps.level, index);
    with_fields(texture.texel_layout().fields,
                [&](auto constant) HWY_ATTR { filter_packed_taps<decltype(constant)::value>(texture, index, taps, out); });
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_PACKED_BILINEAR_INL_H_
