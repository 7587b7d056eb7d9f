// An anisotropic lookup: the mean of probes along the major axis of the footprint.
#include "texunit/anisotropy-inl.h"
#include "texunit/count-inl.h"
#include "texunit/select-inl.h"

#include <hwy/highway.h>

// Included once per instruction set (highway's guard for -inl.h files).
#if defined(RAWTEXEL_TEXUNIT_PROBES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_TEXUNIT_PROBES_INL_H_
#undef RAWTEXEL_TEXUNIT_PROBES_INL_H_
#else
#define RAWTEXEL_TEXUNIT_PROBES_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace rawtexel::texunit {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// `coordinate` less its whole periods, where the wrap has any, so that probes near it keep their bits.
HWY_INLINE FloatVec in_period(Wrap wrap, FloatVec coordinate) {
    switch (wrap) {
        case Wrap::Repeat: return reduce_range<EdgeRule::Repeat>(coordinate);
        case Wrap::MirroredRepeat: return reduce_range<EdgeRule::MirroredRepeat>(coordinate);
        default: return hn::IfThenElseZero(hn::IsFinite(coordinate), coordinate);
    }
}

/// Where probe `i` of each lane lies and its share of the running mean. Lanes with fewer probes repeat their last one.
HWY_INLINE void place_probe(const SamplerState& sampler, const ProbeTable& table, const ProbeChoice& probes, const WavePosition& centre,
                            int i, WaveFloat& u, WaveFloat& v, WaveFloat& share) {
    const FloatTag d;
    const IntTag di;
    for (size_t lane = 0; lane < kWaveLanes; lane += hn::Lanes(d)) {
        const auto count = hn::Load(di, probes.count.lane + lane);
        const auto last = hn::Sub(count, hn::Set(di, 1));
        const auto at = hn::Add(hn::Mul(count, hn::Set(di, kMostProbes)), hn::Min(hn::Set(di, i), last));
        const auto place = hn::GatherIndex(d, table.place.data(), at);
        const auto past = hn::RebindMask(d, last < hn::Set(di, i));
        hn::Store(hn::IfThenZeroElse(past, hn::GatherIndex(d, table.share.data(), at)), d, share.lane + lane);
        const auto moved = [&](Wrap wrap, const WaveFloat& from, const WaveFloat& axis) HWY_ATTR {
            return fused_multiply_add(place, hn::Load(d, axis.lane + lane), in_period(wrap, hn::Load(d, from.lane + lane)));
        };
        hn::Store(moved(sampler.wrap_s, *centre.u, probes.axis_u), d, u.lane + lane);
        hn::Store(moved(sampler.wrap_t, *centre.v, probes.axis_v), d, v.lane + lane);
    }
}

/// mean = lerp(share, mean, probe): lanes of share 0 stay as they are.
HWY_INLINE void accumulate_probe(const WaveFloat& share, const WaveColor& probe, WaveColor& mean) {
    const FloatTag d;
    for (size_t i = 0; i < kWaveLanes; i += hn::Lanes(d)) {
        const auto t = hn::Load(d, share.lane + i);
        const auto active = hn::Ne(t, hn::Zero(d));
        for (int c = 0; c < 4; ++c) {
            float* const sum = mean.channel[c].lane + i;
            const auto before = hn::Load(d, sum);
            hn::Store(hn::IfThenElse(active, lerp_unbounded(t, before, hn::Load(d, probe.channel[c].lane + i)), before), d, sum);
        }
    }
}

/// Lanes of `mask` with more than `i` probes.
HWY_INLINE WaveMask lanes_with_probe(const ProbeChoice& probes, int i, WaveMask mask) {
    const IntTag di;
    WaveMask lanes = 0;
    for (size_t lane = 0; lane < kWaveLanes; lane += hn::Lanes(di)) {
        lanes |= wave_mask(di, hn::Set(di, i) < hn::Load(di, probes.count.lane + lane), lane);
    }
    return lanes & mask;
}

/// Tells who listens how much of the whole probe `i` is.
template <class Count>
HWY_INLINE void announce_probe(const ProbeTable& table, const ProbeChoice& probes, int i, Count& count) {
    if constexpr (Count::kRecords) {
        WaveFloat weight;
        for (int lane = 0; lane < kWaveLanes; ++lane) {
            const int n = probes.count[lane];
            weight[lane] = i < n ? table.weight[size_t(kMostProbes * n + i)] : 0.0f;
        }
        begin_probe(weight, count);
    }
}

/// The weighted mean of each lane's probes. sample_at(position, mask, colour) samples one probe of the lanes of `mask`.
template <class Count, class SampleAt>
HWY_INLINE void sample_probes(const SamplerState& sampler, const ProbeChoice& probes, const WavePosition& centre, WaveMask mask,
                              Count& count, const SampleAt& sample_at, WaveColor& out) {
    if (probes.most == 1) return sample_at(centre, mask, out);
    const ProbeTable& table = sampler.probe_variance > 0 ? gaussian_probes() : uniform_probes();
    WaveFloat u, v, share;
    WavePosition position = centre;
    position.u = &u, position.v = &v;
    WaveColor probe;
    for (int i = 0; i < probes.most; ++i) {
        const WaveMask active = lanes_with_probe(probes, i, mask);
        if (active == 0) break;
        place_probe(sampler, table, probes, centre, i, u, v, share);
        announce_probe(table, probes, i, count);
        sample_at(position, active, i == 0 ? out : probe);
        if (Count::kReads && i > 0) accumulate_probe(share, probe, out);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::texunit
HWY_AFTER_NAMESPACE();

#endif  // RAWTEXEL_TEXUNIT_PROBES_INL_H_
