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

/// Along x, then along y, as filter(); read(tap, i, value) gives lanes i .. of a tap's channels. An alpha that is not read is 1.
template <int channels, class Read>
HWY_INLINE void filter_values(const TapWave<2>& taps, const Read& read, WaveColor& out) {
    const FloatTag d;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto x = hn::Load(d, taps.fraction_x.lane + i), y = hn::Load(d, taps.fraction_y.lane + i);
        FloatVec left[channels], right[channels], upper[channels];
        read(0, i, left);
        read(1, i, right);
        for (int c = 0; c < channels; ++c) upper[c] = lerp(x, left[c], right[c]);
        read(2, i, left);
        read(3, i, right);
        for (int c = 0; c < channels; ++c) hn::Store(lerp(y, upper[c], lerp(x, left[c], right[c])), d, out.channel[c].lane + i);
        if constexpr (channels == 3) hn::Store(hn::Set(d, 1.0f), d, out.channel[3].lane + i);
    }
}

template <PackedFields fields, int channels>
HWY_NOINLINE void filter_packed_taps(const Texture& texture, const WaveInt (&index)[4], const TapWave<2>& taps, WaveColor& out) {
    const PackedDecoder<fields> decoder(texture.texel_layout());
    const auto* const base = reinterpret_cast<const uint32_t*>(texture.texels());
    const auto read = [&](int tap, size_t i, FloatVec(&value)[channels])
                          HWY_ATTR { decoder.values(gather_from(base, hn::Load(IntTag(), index[tap].lane + i)), value); };
    filter_values<channels>(taps, read, out);
}

/// Where all taps fall into a window: its texels are unpacked once.
template <PackedFields fields, int channels, int registers>
HWY_NOINLINE void filter_packed_window(Texture& texture, const TexelWindow& window, const TapWave<2>& taps, WaveColor& out) {
    const IntTag di;
    const PackedDecoder<fields> decoder(texture.texel_layout());
    const auto* const base = reinterpret_cast<const uint32_t*>(texture.texels());
    IntVec index[registers];
    ensure_window<StorageClass::Packed32>(texture, window, *taps.level, index);
    FloatVec texel[channels][registers];
    for (int r = 0; r < registers; ++r) {
        FloatVec value[channels];
        decoder.values(gather_from(base, index[r]), value);
        for (int c = 0; c < channels; ++c) texel[c][r] = value[c];
    }
    const auto read = [&](int tap, size_t i, FloatVec(&value)[channels]) HWY_ATTR {
        const auto at = in_window(window, hn::Load(di, taps.x[tap % 2].lane + i), hn::Load(di, taps.y[tap / 2].lane + i));
        for (int c = 0; c < channels; ++c) value[c] = pick(texel[c], at);
    };
    filter_values<channels>(taps, read, out);
}

/// The most registers of a window that take less time than reading the taps one by one.
inline constexpr int kBilinearWindowRegisters = 2;

/// Calls `act` with the fields of a texture's words and the number of channels that are read, both as constants.
template <class Act>
HWY_INLINE void with_fields_and_channels(const Texture& texture, bool reads_alpha, const Act& act) {
    with_fields(texture.texel_layout().fields,
                [&](auto fields) HWY_ATTR { with_channels(reads_alpha, [&](auto channels) HWY_ATTR { act(fields, channels); }); });
}

/// Filters taps that fit into a window; false where they do not.
template <StorageClass storage>
HWY_INLINE bool filter_bilinear_window(Texture& texture, bool reads_alpha, const TapWave<2>& taps, WaveColor& out) {
    if constexpr (has_windows(storage)) {
        TexelWindow window;
        if (taps.slice != nullptr || !find_window(texture, *taps.level, taps.x, 2, taps.y, 2, kBilinearWindowRegisters, window))
            return false;
        with_fields_and_channels(texture, reads_alpha, [&](auto fields, auto channels) HWY_ATTR {
            static_assert(kBilinearWindowRegisters == 2);
            if (window.registers == 1) return filter_packed_window<fields(), channels(), 1>(texture, window, taps, out);
            filter_packed_window<fields(), channels(), 2>(texture, window, taps, out);
        });
        return true;
    }
    return false;
}

/// Ensures, gathers and filters taps of which none lies beyond an edge.
HWY_NOINLINE inline void filter_packed_bilinear(Texture& texture, bool reads_alpha, const TapWave<2>& taps, WaveColor& out) {
    constexpr StorageClass kStorage = StorageClass::Packed32;
    if (filter_bilinear_window<kStorage>(texture, reads_alpha, taps, out)) return;
    WaveInt index[4];
    tap_indices<kStorage>(texture.levels(), taps, index);
    ensure(texture, *taps.level, index);
    with_fields_and_channels(texture, reads_alpha, [&](auto fields, auto channels) HWY_ATTR {
        filter_packed_taps<fields(), channels()>(texture, index, taps, out);
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_PACKED_BILINEAR_INL_H_
