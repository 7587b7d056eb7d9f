// The exact elliptical filter: a Gaussian over the pixel's ellipse, integrated over the boxes of level-0 texels (texunit/ellipse.h). One
// pixel at a time; the lanes of the vectors are texels, taken row by row in groups of 32 whatever the vector's width.
#include "texunit/count-inl.h"
#include "texunit/ellipse.h"
#include "texunit/fetch-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_ELLIPTICAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_ELLIPTICAL_INL_H_
#undef RAWTEXEL_TEXUNIT_ELLIPTICAL_INL_H_
#else
#define RAWTEXEL_TEXUNIT_ELLIPTICAL_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// e^-x for x >= 0, to 2^-22 of it; below the smallest normal float it ends at 2^-126.
template <class V>
HWY_INLINE V exp_of_negative(V x) {
    const hn::DFromV<V> d;
    const hn::RebindToSigned<decltype(d)> di;
    // e^-x = 2^-n * e^-r with |r| <= ln(2)/2; ln(2) in two terms, so that n*ln(2) cancels without loss.
    const V limited = hn::Min(x, hn::Set(d, 87.0f));
    const V n = round_small(hn::Mul(limited, hn::Set(d, 1.44269504f)));
    const V r = hn::Sub(hn::Sub(limited, hn::Mul(n, hn::Set(d, 0x1.62E4p-1f))), hn::Mul(n, hn::Set(d, 1.42860677e-6f)));
    V series = hn::Set(d, -1.0f / 5040);
    for (const float term : {1.0f / 720, -1.0f / 120, 1.0f / 24, -1.0f / 6, 0.5f, -1.0f, 1.0f}) {
        series = hn::Add(hn::Mul(series, r), hn::Set(d, term));
    }
    const auto exponent = hn::Sub(hn::Set(di, 127), hn::ConvertTo(di, n));
    return hn::Mul(series, hn::BitCast(d, hn::ShiftLeft<23>(hn::Max(exponent, hn::Set(di, 1)))));
}

/// Upper tail of the normal distribution at z >= 0: e^(-z^2/2) times a polynomial in 1/(1 + 0.3z), a Chebyshev fit of degree 8 over [0, 8],
/// good to 1.1e-7 of the tail.
template <class V>
HWY_INLINE V normal_tail(V z) {
    const hn::DFromV<V> d;
    const V one = hn::Set(d, 1.0f);
    const V t = hn::Div(one, hn::Add(one, hn::Mul(hn::Set(d, 0.3f), z)));
    V series = hn::Set(d, 0.03170533718f);
    for (const float term :
         {-0.1353225888f, 0.1552414076f, 0.01235022517f, 0.07700051554f, 0.1248102088f, 0.1134981503f, 0.1207960362f, -7.92852694e-05f}) {
        series = hn::Add(hn::Mul(series, t), hn::Set(d, term));
    }
    return hn::Mul(series, exp_of_negative(hn::Mul(hn::Mul(z, z), hn::Set(d, 0.5f))));
}

/// Probability of [low, low + width] under the standard normal distribution. Taken on the side of the smaller tail, where it keeps its
/// bits.
template <class V>
HWY_INLINE V normal_probability(V low, V width) {
    const hn::DFromV<V> d;
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const V high = hn::Add(low, width);
    const auto right = hn::Add(low, high) > zero;
    const V near = hn::IfThenElse(right, low, hn::Neg(high));  // of the mirrored interval [near, far], far >= |near|
    const V far = hn::IfThenElse(right, high, hn::Neg(low));
    const V tail = normal_tail(hn::Abs(near));
    const V above_near = hn::IfThenElse(near < zero, hn::Sub(one, tail), tail);
    return hn::Max(hn::Sub(above_near, normal_tail(far)), zero);
}

/// Up to 32 texels of an ellipse: where they lie and what their weights need.
struct EllipseChunk {
    WaveInt level, slice, x, y;
    WaveFloat edge[kMostEllipseNodes];   ///< left edge in the row's standard deviations, for each node across the row's height
    WaveFloat depth[kMostEllipseNodes];  ///< y^2/(2c) of each node
    WaveMask border = 0;                 ///< taps beyond the edges of a ClampToBorder texture
    int used = 0;
};

/// Weights of the chunk's taps, 0 from `used` on: the bivariate normal over each texel's box, up to a common factor.
HWY_INLINE void ellipse_weights(const Ellipse& ellipse, const EllipseChunk& chunk, WaveFloat& weight) {
    const FloatTag d;
    const auto width = hn::Set(d, float(ellipse.inverse_sigma));
    const WaveMask used = chunk.used == kWaveLanes ? kWaveFull : (1u << chunk.used) - 1;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        auto sum = hn::Zero(d);
        for (int k = 0; k < ellipse.across->count; ++k) {
            const auto density =
                hn::Mul(hn::Set(d, float(ellipse.across->weight[size_t(k)])), exp_of_negative(hn::Load(d, chunk.depth[k].lane + i)));
            sum = hn::Add(sum, hn::Mul(density, normal_probability(hn::Load(d, chunk.edge[k].lane + i), width)));
        }
        hn::Store(hn::IfThenElseZero(lanes_of(d, used, i), sum), d, weight.lane + i);
    }
}

/// Weighted sums over the texels of an ellipse, 32 at a time: of the weights, and of each channel's difference from a base that is the
/// first texel, so that a constant comes back bit for bit.
struct EllipseSums {
    WaveFloat weight{}, difference[4]{}, least[4], most[4];
    float base[4];
    bool empty = true;
};

HWY_INLINE void start_sums(const TexelWave<1>& texels, EllipseSums& sums) {
    const FloatTag d;
    for (int c = 0; c < 4; ++c) {
        const float first = texels.channel[c][0].lane[0];
        sums.base[c] = std::isfinite(first) ? first : 0.0f;
        for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
            hn::Store(hn::Set(d, first), d, sums.least[c].lane + i);
            hn::Store(hn::Set(d, first), d, sums.most[c].lane + i);
        }
    }
    sums.empty = false;
}

HWY_INLINE void add_weighed(const WaveFloat& weight, const TexelWave<1>& texels, EllipseSums& sums) {
    const FloatTag d;
    if (sums.empty) start_sums(texels, sums);
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto w = hn::Load(d, weight.lane + i);
        const auto used = hn::Ne(w, hn::Zero(d));
        hn::Store(hn::Add(hn::Load(d, sums.weight.lane + i), w), d, sums.weight.lane + i);
        for (int c = 0; c < 4; ++c) {
            const auto texel = hn::Load(d, texels.channel[c][0].lane + i);
            const auto weighed = hn::IfThenElseZero(used, hn::Mul(w, hn::Sub(texel, hn::Set(d, sums.base[c]))));
            hn::Store(hn::Add(hn::Load(d, sums.difference[c].lane + i), weighed), d, sums.difference[c].lane + i);
            const auto least = hn::Load(d, sums.least[c].lane + i), most = hn::Load(d, sums.most[c].lane + i);
            hn::Store(hn::IfThenElse(hn::And(used, texel < least), texel, least), d, sums.least[c].lane + i);
            hn::Store(hn::IfThenElse(hn::And(used, texel > most), texel, most), d, sums.most[c].lane + i);
        }
    }
}

/// Combines the 32 lanes pairwise, in an order that no vector width changes.
template <class Combine>
HWY_INLINE float reduce_lanes(const WaveFloat& lanes, const Combine& combine) {
    WaveFloat partial = lanes;
    for (int half = kWaveLanes / 2; half > 0; half /= 2) {
        for (int i = 0; i < half; ++i) partial[i] = combine(partial[i], partial[i + half]);
    }
    return partial[0];
}

/// The weighted mean, within the texels read.
HWY_INLINE float ellipse_mean(const EllipseSums& sums, int c) {
    const auto add = [](float x, float y) { return x + y; };
    const float mean = sums.base[c] + reduce_lanes(sums.difference[c], add) / reduce_lanes(sums.weight, add);
    const float least = reduce_lanes(sums.least[c], [](float x, float y) { return y < x ? y : x; });
    const float most = reduce_lanes(sums.most[c], [](float x, float y) { return y > x ? y : x; });
    return mean < least ? least : mean > most ? most : mean;
}

/// Appends texels [column, column + count) of `row`, both from the centre's texel.
HWY_INLINE void append_texels(const Ellipse& ellipse, int row, int column, int count, int texel_row, WrapWalk& walk, EllipseChunk& chunk) {
    const Quadrature& across = *ellipse.across;
    for (int k = 0; k < across.count; ++k) {
        const double y = row + across.node[size_t(k)] - ellipse.y;
        const double edge = column - ellipse.x - ellipse.slope * y;
        const float depth = float(y * y / (2 * ellipse.c));
        for (int n = 0; n < count; ++n) {
            chunk.edge[k].lane[chunk.used + n] = float((edge + n) * ellipse.inverse_sigma);
            chunk.depth[k].lane[chunk.used + n] = depth;
        }
    }
    for (int n = 0; n < count; ++n, walk.next()) {
        const int slot = chunk.used + n;
        const int texel_column = walk.texel();
        const bool beyond = texel_column < 0 || texel_row < 0;
        chunk.border |= WaveMask{beyond} << slot;
        chunk.x[slot] = beyond ? 0 : texel_column;
        chunk.y[slot] = beyond ? 0 : texel_row;
    }
    chunk.used += count;
}

/// Calls use(chunk) for all texels of the ellipse, row by row.
template <class Use>
HWY_INLINE void for_each_chunk(const LevelTable& table, const SamplerState& sampler, const Ellipse& ellipse, EllipseChunk& chunk,
                               const Use& use) {
    const auto level = size_t(ellipse.level);
    WrapWalk rows(sampler.wrap_t, ellipse.row + ellipse.first_row, table.height[level]);
    chunk.used = 0;
    chunk.border = 0;
    for (int row = ellipse.first_row; row <= ellipse.last_row; ++row, rows.next()) {
        const EllipseSpan span = ellipse_span(ellipse, row);
        WrapWalk columns(sampler.wrap_s, ellipse.column + span.first, table.width[level]);
        for (int column = span.first; column <= span.last;) {
            const int count = std::min(span.last - column + 1, kWaveLanes - chunk.used);
            append_texels(ellipse, row, column, count, rows.texel(), columns, chunk);
            column += count;
            if (chunk.used < kWaveLanes) continue;
            use(chunk);
            chunk.used = 0;
            chunk.border = 0;
        }
    }
    if (chunk.used > 0) use(chunk);
}

/// Slots that no tap uses repeat the last one that is used.
HWY_INLINE void fill_unused(EllipseChunk& chunk) {
    for (int slot = chunk.used; slot < kWaveLanes; ++slot) {
        chunk.x[slot] = chunk.x[chunk.used - 1];
        chunk.y[slot] = chunk.y[chunk.used - 1];
    }
}

HWY_INLINE void set_border(const std::array<float, 4>& border, WaveMask mask, TexelWave<1>& texels) {
    for (; mask != 0; mask &= mask - 1) {
        const auto slot = int(hwy::Num0BitsBelowLS1Bit_Nonzero32(mask));
        for (int c = 0; c < 4; ++c) texels.channel[c][0][slot] = border[size_t(c)];
    }
}

/// Ensures and gathers the chunk's texels.
template <StorageClass storage>
HWY_INLINE void fetch_chunk(Texture& texture, const EllipseChunk& chunk, TexelWave<1>& texels) {
    WaveInt index[1];
    texel_indices<storage>(texture.levels(), chunk.level, &chunk.slice, chunk.x, chunk.y, index[0]);
    ensure(texture, chunk.level, index);
    gather<storage>(texture, index, channels_of(texels));
}

/// Tells the sink of a chunk's taps, one a call: they are all of one pixel, `lane`. `total` is the sum of the ellipse's weights.
HWY_NOINLINE inline void record_chunk(const EllipseChunk& chunk, const WaveFloat& weight, float total, int lane, TapSink& sink) {
    WaveInt level{}, slice{}, x{}, y{};
    WaveFloat share{};
    for (int slot = 0; slot < chunk.used; ++slot) {
        level[lane] = chunk.level[slot], slice[lane] = chunk.slice[slot];
        x[lane] = chunk.x[slot], y[lane] = chunk.y[slot];
        share[lane] = weight[slot] / total;
        const WaveMask self = 1u << lane;
        sink.tap({self, chunk.border >> slot & 1 ? self : 0, &level, &slice, &x, &y, &share});
    }
}

/// Counts a chunk's taps, which are all of one pixel, `lane`.
HWY_INLINE void hear_chunk(const EllipseChunk& chunk, const WaveFloat&, float, int lane, FetchCounter& count) {
    const WaveMask slots = chunk.used == kWaveLanes ? kWaveFull : (1u << chunk.used) - 1;
    const WaveMask texels = slots & ~chunk.border;
    mark_texels(chunk.level, &chunk.slice, chunk.x, chunk.y, texels, count);
    WaveInt counted{};
    counted[lane] = int(hwy::PopCount(texels));
    add_texels(counted, chunk.level, count);
}
HWY_INLINE void hear_chunk(const EllipseChunk& chunk, const WaveFloat& weight, float total, int lane, FetchRecorder& recorder) {
    record_chunk(chunk, weight, total, lane, *recorder.sink);
}

struct EllipseWalk {
    Ellipse ellipse;
    EllipseChunk chunk;
};

HWY_INLINE void begin_walk(const LevelTable& table, const SamplerState& sampler, const EllipseLookup& at, int slice, EllipseWalk& walk) {
    walk.ellipse = make_ellipse(table, sampler, at);
    walk.chunk = {};
    std::fill(walk.chunk.level.lane, walk.chunk.level.lane + kWaveLanes, walk.ellipse.level);
    std::fill(walk.chunk.slice.lane, walk.chunk.slice.lane + kWaveLanes, slice);
}

/// One pixel, whose place in the wave is `lane`; returns the level read.
template <StorageClass storage>
HWY_NOINLINE int sample_ellipse(Texture& texture, const SamplerState& sampler, const EllipseLookup& at, int lane, int slice,
                                WaveColor& out) {
    EllipseWalk walk;
    begin_walk(texture.levels(), sampler, at, slice, walk);
    EllipseSums sums;
    WaveFloat weight;
    for_each_chunk(texture.levels(), sampler, walk.ellipse, walk.chunk, [&](EllipseChunk& full) HWY_ATTR {
        fill_unused(full);
        ellipse_weights(walk.ellipse, full, weight);
        TexelWave<1> texels;
        fetch_chunk<storage>(texture, full, texels);
        if (full.border != 0) set_border(sampler.border, full.border, texels);
        add_weighed(weight, texels, sums);
    });
    for (int c = 0; c < 4; ++c) out.channel[c][lane] = ellipse_mean(sums, c);
    return walk.ellipse.level;
}

/// The same for a listener: the sum of the weights, and then every tap's share of it.
template <class Count>
HWY_NOINLINE int hear_ellipse(const LevelTable& table, const SamplerState& sampler, const EllipseLookup& at, int lane, int slice,
                              Count& count) {
    EllipseWalk walk;
    begin_walk(table, sampler, at, slice, walk);
    WaveFloat weight;
    float total = 1;
    if constexpr (Count::kRecords) {
        WaveFloat sum{};
        for_each_chunk(table, sampler, walk.ellipse, walk.chunk, [&](EllipseChunk& full) HWY_ATTR {
            ellipse_weights(walk.ellipse, full, weight);
            for (int slot = 0; slot < full.used; ++slot) sum[slot] += weight[slot];
        });
        total = reduce_lanes(sum, [](float x, float y) { return x + y; });
    }
    for_each_chunk(table, sampler, walk.ellipse, walk.chunk, [&](EllipseChunk& full) HWY_ATTR {
        if constexpr (Count::kRecords) ellipse_weights(walk.ellipse, full, weight);
        hear_chunk(full, weight, total, lane, count);
    });
    return walk.ellipse.level;
}

template <StorageClass storage, class Count>
HWY_NOINLINE void sample_ellipses_stored(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, const WaveInt* slice,
                                         WaveMask mask, Count& count, WaveColor& out, WaveFloat& level) {
    for (WaveMask rest = mask; rest != 0; rest &= rest - 1) {
        const auto lane = int(hwy::Num0BitsBelowLS1Bit_Nonzero32(rest));
        const EllipseLookup lookup{at.u[lane], at.v[lane], at.dudx[lane], at.dvdx[lane], at.dudy[lane], at.dvdy[lane]};
        const int layer = slice == nullptr ? 0 : (*slice)[lane];
        if constexpr (Count::kReads) {
            level[lane] = float(sample_ellipse<storage>(texture, sampler, lookup, lane, layer, out));
        } else {
            level[lane] = float(hear_ellipse(texture.levels(), sampler, lookup, lane, layer, count));
        }
    }
}

/// Filters the lanes of `mask`, which is not 0, by their ellipses (sampler.ellipse > 0); other lanes repeat the first of them. `slice`:
/// array layers, or null. `level` gets the level read.
template <class Count>
HWY_INLINE void sample_ellipses(Texture& texture, const SamplerState& sampler, const WaveCoordinates& at, const WaveInt* slice,
                                WaveMask mask, Count& count, WaveColor& out, WaveFloat& level) {
    const auto sample = [&]<StorageClass storage>()
                            HWY_ATTR { sample_ellipses_stored<storage>(texture, sampler, at, slice, mask, count, out, level); };
    if constexpr (!Count::kReads) {
        sample.template operator()<StorageClass::Packed32>();
    } else {
        switch (texture.texel_layout().storage) {
            case StorageClass::Packed32: sample.template operator()<StorageClass::Packed32>(); break;
            case StorageClass::Packed64: sample.template operator()<StorageClass::Packed64>(); break;
            case StorageClass::Half4: sample.template operator()<StorageClass::Half4>(); break;
            case StorageClass::Float4: sample.template operator()<StorageClass::Float4>(); break;
        }
        for (WaveFloat& channel : out.channel) repeat_first(channel, mask, channel);
    }
    repeat_first(level, mask, level);
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_ELLIPTICAL_INL_H_
