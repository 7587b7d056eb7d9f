// Gathers of 32-bit words by 32-bit indices.
#include "texunit/lanes-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_GATHER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_GATHER_INL_H_
#undef RAWTEXEL_TEXUNIT_GATHER_INL_H_
#else
#define RAWTEXEL_TEXUNIT_GATHER_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Whether plain loads, put together, serve better than the instruction for gathers, which takes AMD's Zen 4 twice as long
/// (docs/performance.md), and Intel's processors longer since their microcode guards it (CVE-2022-40982).
constexpr bool gathers_by_loads(size_t lanes) { return (HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2) && lanes >= 8; }

#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2
/// Words base[at[k]] for k = 0 .. n - 1, n a power of two up to 16.
template <size_t n, class T>
HWY_INLINE auto load_words(const T* base, const int32_t* at) {
    const hn::CappedTag<T, n> d;
    if constexpr (n == 1) {
        return hn::LoadU(d, base + uint32_t(*at));
    } else {
        return hn::Combine(d, load_words<n / 2>(base, at + n / 2), load_words<n / 2>(base, at));
    }
}

/// A row of a transposition, `rows` times four words: the records at base[at[0]], base[at[4]], base[at[8]] …, padded to four words.
template <int words, size_t rows, class T>
HWY_INLINE auto load_records(const T* base, const int32_t* at) {
    static_assert(words == 3 || words == 4);
    if constexpr (rows == 1) {
        const hn::CappedTag<T, 4> d;
        if constexpr (words == 4) return hn::LoadU(d, base + uint32_t(*at));
        // Nothing beyond the record is read.
        if constexpr (words == 3) return hn::MaskedLoad(hn::FirstN(d, 3), d, base + uint32_t(*at));
    } else {
        const hn::CappedTag<T, 4 * rows> d;
        return hn::Combine(d, load_records<words, rows / 2>(base, at + 2 * rows), load_records<words, rows / 2>(base, at));
    }
}
#endif

/// base[index] of every lane; no index is negative.
template <class T, class VI>
HWY_INLINE hn::Vec<hn::Rebind<T, hn::DFromV<VI>>> gather_from(const T* base, VI index) {
    static_assert(sizeof(T) == 4);
    const hn::DFromV<VI> di;
    const hn::Rebind<T, decltype(di)> d;
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2
    if constexpr (gathers_by_loads(hn::MaxLanes(d))) {
        alignas(64) int32_t at[hn::MaxLanes(d)];
        hn::Store(index, di, at);
        return load_words<hn::MaxLanes(d)>(base, at);
    }
#endif
    return hn::GatherIndex(d, base, index);
}

/// Records of `words` = 1 to 4 words a lane, word k of base[index] … to out[k].
template <int words, class T, class VI>
HWY_INLINE void gather_records(const T* base, VI index, hn::Vec<hn::Rebind<T, hn::DFromV<VI>>> (&out)[words]) {
    static_assert(sizeof(T) == 4 && words >= 1 && words <= 4);
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2
    const hn::DFromV<VI> di;
    const hn::Rebind<T, decltype(di)> d;
    if constexpr (words >= 3 && gathers_by_loads(hn::MaxLanes(d))) {
        constexpr size_t kRows = hn::MaxLanes(d) / 4;
        const hn::RepartitionToWide<decltype(d)> wide;
        alignas(64) int32_t at[hn::MaxLanes(d)];
        hn::Store(index, di, at);
        const auto row = [&](int r) HWY_ATTR __attribute__((always_inline)) {
            return hn::BitCast(d, load_records<words, kRows>(base, at + r));
        };
        const auto row0 = row(0), row1 = row(1), row2 = row(2), row3 = row(3);
        const auto low01 = hn::BitCast(wide, hn::InterleaveLower(d, row0, row1)),
                   low23 = hn::BitCast(wide, hn::InterleaveLower(d, row2, row3));
        const auto high01 = hn::BitCast(wide, hn::InterleaveUpper(d, row0, row1)),
                   high23 = hn::BitCast(wide, hn::InterleaveUpper(d, row2, row3));
        out[0] = hn::BitCast(d, hn::InterleaveLower(wide, low01, low23));
        out[1] = hn::BitCast(d, hn::InterleaveUpper(wide, low01, low23));
        out[2] = hn::BitCast(d, hn::InterleaveLower(wide, high01, high23));
        if constexpr (words == 4) out[3] = hn::BitCast(d, hn::InterleaveUpper(wide, high01, high23));
        return;
    }
#endif
    for (int k = 0; k < words; ++k) out[k] = gather_from(base + k, index);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_GATHER_INL_H_
