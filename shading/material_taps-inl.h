// The taps of a material: texels drawn for its maps, or every tuple of them, one after the other.
#if defined(RAWTEXEL_SHADING_MATERIAL_TAPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAWTEXEL_SHADING_MATERIAL_TAPS_INL_H_
#undef RAWTEXEL_SHADING_MATERIAL_TAPS_INL_H_
#else
#define RAWTEXEL_SHADING_MATERIAL_TAPS_INL_H_
#endif

#include "shading/draw_state.h"
#include "shading/fragment.h"
#include "shading/lanes-inl.h"
#include "texunit/draw-inl.h"
#include "texunit/lanes-inl.h"

#include <bit>
#include <cmath>
#include <functional>

HWY_BEFORE_NAMESPACE();
namespace rawtexel::shading {
namespace HWY_NAMESPACE {

/// Fragments of one material in a wave, and the address of their numbers.
struct TappedFragments {
    const MaterialState* material = nullptr;
    const texunit::WaveCoordinates* coordinates = nullptr;  ///< as MaterialState::coordinates
    WaveMask lanes = 0;                                     ///< not 0
    int x = 0, y = 0;                                       ///< upper left pixel, in the frame
    uint32_t sample = 0, seed = 0;
    const uint32_t* surface = nullptr;  ///< 32, of texunit::RandomAddress; null: 0
};

/// Hears of every tap; `slot`: of the map that has numbers of its own, -1 for those that share.
struct HeardTap {
    const TapPlan* plan;
    int slot;
    const texunit::SharedTap* tap;
    const texunit::DrawNumbers* numbers;  ///< null: listed
    int number;
};
using HearTap = std::function<void(const HeardTap&)>;

class MaterialTaps {
  public:
    HearTap hear;  ///< may be empty

    /// `fragments` and what it points to outlive the use of the taps.
    HWY_INLINE void begin(const TappedFragments& fragments) {
        fragments_ = fragments;
        if (fragments.lanes != texunit::kWaveFull) fill_inactive();
    }

    /// The plan of one map alone: what alpha asks for.
    static TapPlan only(const TapPlan& plan, MapSlot slot) {
        TapPlan alone;
        if (!plan.holds(slot)) return alone;
        alone.lookups = 1;
        alone.first[0] = slot;
        alone.lookup_of[size_t(slot)] = 0;
        return alone;
    }

    /// use(tap, n) for every tap of draw n, or of all tuples where `enumerates` (n = 0). Weights of a lane's taps sum to 1 for each n.
    template <class Use>
    HWY_INLINE void for_each(const TapPlan& plan, bool enumerates, const Use& use) {
        const texunit::LookupSet& set = lookup_set(plan);
        if (enumerates) {
            return texunit::HWY_NAMESPACE::enumerate_shared_lanes(set, [&](const texunit::SharedTap& tap) {
                if (hear) hear({&plan, -1, &tap, nullptr, 0});
                use(tap, 0);
            });
        }
        for (int n = 0; n < fragments_.material->plans.taps; ++n) {
            find_numbers(n, 0);
            const texunit::DrawNumbers* numbers = &positive_;
            const auto use_tap = [&](const texunit::SharedTap& tap) {
                if (hear) hear({&plan, -1, &tap, numbers, n});
                numbers = &negative_;
                use(tap, n);
            };
            draw(set, use_tap);
        }
    }

    /// The same for numbers of each map's own: use(slot, tap, n) map by map.
    template <class Use>
    HWY_INLINE void for_each_map(const TapPlan& plan, int n, const Use& use) {
        for (int slot = 0; slot < kMapSlots; ++slot) {
            if (!plan.holds(slot)) continue;
            find_numbers(n, 1 + uint32_t(slot));
            const texunit::LookupSet& set = lookup_set(only(plan, MapSlot(slot)));
            const texunit::DrawNumbers* numbers = &positive_;
            const auto use_tap = [&](const texunit::SharedTap& tap) {
                if (hear) hear({&plan, slot, &tap, numbers, n});
                numbers = &negative_;
                use(MapSlot(slot), tap, n);
            };
            draw(set, use_tap);
        }
    }

    /// Numbers of the level that is drawn for all maps, where a material draws levels alone.
    const WaveFloat& level_numbers() {
        find_numbers(0, 0);
        return positive_.level;
    }

    const MaterialState& material() const { return *fragments_.material; }
    WaveMask lanes() const { return fragments_.lanes; }

  private:
    /// Draws from the set with the numbers found last.
    template <class UseTap>
    HWY_INLINE void draw(const texunit::LookupSet& set, const UseTap& use) const {
        // By reference, as a copy would take memory for each wave.
        texunit::HWY_NAMESPACE::draw_shared_lanes(set, positive_, negative_, std::cref(use));
    }

    HWY_NOINLINE void fill_inactive() {
        for (int k = 0; k < material().coordinate_count; ++k)
            texunit::HWY_NAMESPACE::fill_inactive(fragments_.coordinates[k], fragments_.lanes, filled_[k]);
    }

    /// Lasts until it is asked for another plan.
    const texunit::LookupSet& lookup_set(const TapPlan& plan) {
        set_.mask = fragments_.lanes;
        set_.count = plan.lookups;
        const texunit::WaveCoordinates* const at = fragments_.lanes == texunit::kWaveFull ? fragments_.coordinates : filled_;
        for (int k = 0; k < plan.lookups; ++k) {
            const MapState& map = material().maps[plan.first[size_t(k)]];
            set_.lookup[k] = {&map.texture->levels(), &map.sampler, &at[map.coordinates]};
        }
        return set_;
    }

    /// Numbers of draw n; `own`: 0, or which map's own they are.
    HWY_NOINLINE void find_numbers(int n, uint32_t own) {
        if (material().plans.dither != texunit::Dither::None)
            return dither_numbers(material().plans.dither, fragments_.x, fragments_.y, positive_);
        texunit::RandomAddress address{
            .x = uint32_t(fragments_.x),
            .y = uint32_t(fragments_.y),
            .sample = fragments_.sample * uint32_t(material().plans.taps) + uint32_t(n),
            .surface = 0,
            .seed = own == 0 ? fragments_.seed : texunit::mix_bits(fragments_.seed + own * texunit::kRandomStart)};
        if (fragments_.surface == nullptr) return find_numbers(address, positive_, negative_);
        // Lanes that see one surface share an address.
        for (WaveMask rest = fragments_.lanes; rest != 0;) {
            address.surface = fragments_.surface[std::countr_zero(rest)];
            WaveMask lanes = 0;
            for (WaveMask others = rest; others != 0; others &= others - 1) {
                const int lane = std::countr_zero(others);
                lanes |= WaveMask{fragments_.surface[lane] == address.surface} << lane;
            }
            if (lanes == fragments_.lanes) return find_numbers(address, positive_, negative_);
            texunit::DrawNumbers positive{}, negative{};
            find_numbers(address, positive, negative);
            copy_lanes(positive, lanes, positive_);
            copy_lanes(negative, lanes, negative_);
            rest &= ~lanes;
        }
    }

    void find_numbers(const texunit::RandomAddress& address, texunit::DrawNumbers& positive, texunit::DrawNumbers& negative) {
        // Who listens is told of all roles.
        const texunit::NumberRoles roles = hear ? texunit::NumberRoles{} : material().plans.roles;
        texunit::HWY_NAMESPACE::number_lanes(address, false, material().plans.noise, roles, states_, positive);
        // Without negative lobes nobody asks for their numbers.
        if (!material().plans.roles.sign) return;
        if (material().plans.common_numbers) {
            negative = positive;
        } else {
            texunit::HWY_NAMESPACE::number_lanes(address, true, material().plans.noise, roles, states_, negative);
        }
    }

    static void copy_lanes(const texunit::DrawNumbers& from, WaveMask lanes, texunit::DrawNumbers& to) {
        store_wave(from.x, lanes, to.x);
        store_wave(from.y, lanes, to.y);
        store_wave(from.level, lanes, to.level);
        store_wave(from.probe, lanes, to.probe);
        store_wave(from.sign, lanes, to.sign);
    }

    TappedFragments fragments_;
    texunit::WaveCoordinates filled_[kMapSlots];
    texunit::LookupSet set_;
    texunit::DrawNumbers positive_{}, negative_{};
    texunit::RandomStates states_;
};

/// Scales footprints by 2^(U - 1/2), so that their nearest level is one of the two that trilinear filtering mixes, drawn with its weight.
/// `taps` have begun; `at`: coordinates of theirs.
HWY_NOINLINE inline void draw_levels(MaterialTaps& taps, texunit::WaveCoordinates* at, int count) {
    const WaveFloat& number = taps.level_numbers();
    WaveFloat factor;
    for (int lane = 0; lane < texunit::kWaveLanes; ++lane) factor[lane] = std::exp2(number[lane] - 0.5f);
    const FloatLanes d;
    for (int k = 0; k < count; ++k)
        for (WaveFloat* derivative : {&at[k].dudx, &at[k].dvdx, &at[k].dudy, &at[k].dvdy})
            for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d))
                hn::Store(hn::Mul(hn::Load(d, derivative->lane + i), hn::Load(d, factor.lane + i)), d, derivative->lane + i);
}

/// The texels of a tap for the maps of its plan; other maps are left as they were.
HWY_INLINE void read_tap(const MaterialState& material, const TapPlan& plan, const texunit::SharedTap& tap, texunit::WaveColor* maps) {
    for (int slot = 0; slot < kMapSlots; ++slot) {
        if (!plan.holds(slot)) continue;
        const MapState& map = material.maps[size_t(slot)];
        texunit::HWY_NAMESPACE::read_drawn_lanes(*map.texture, map.sampler, tap.draw[plan.lookup_of[size_t(slot)]], maps[slot]);
    }
}

/// sum += weight*factor*texel at `lanes`.
HWY_INLINE void add_weighed(const texunit::WaveColor& texel, const WaveFloat& weight, float factor, WaveMask lanes,
                            texunit::WaveColor& sum) {
    const FloatLanes d;
    for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d)) {
        const auto w = hn::Mul(hn::Load(d, weight.lane + i), hn::Set(d, factor));
        const auto active = wave_mask_lanes(lanes, i);
        for (int c = 0; c < 4; ++c) {
            float* const to = sum.channel[c].lane + i;
            const auto add = hn::IfThenElseZero(active, hn::Mul(w, hn::Load(d, texel.channel[c].lane + i)));
            hn::Store(hn::Add(hn::Load(d, to), add), d, to);
        }
    }
}

/// Values of the maps of `plan`: the mean of their draws.
HWY_NOINLINE inline void average_taps(MaterialTaps& taps, const TapPlan& plan, texunit::WaveColor* maps) {
    const MaterialState& material = taps.material();
    const float share = 1 / float(material.plans.taps);
    for (int slot = 0; slot < kMapSlots; ++slot)
        if (plan.holds(slot)) maps[slot] = {};
    texunit::WaveColor texel;
    const auto add = [&](int slot, const texunit::TexelDraw& draw, const texunit::SharedTap& tap) HWY_ATTR {
        const MapState& map = material.maps[size_t(slot)];
        texunit::HWY_NAMESPACE::read_drawn_lanes(*map.texture, map.sampler, draw, texel);
        add_weighed(texel, tap.weight, share, tap.lanes, maps[slot]);
    };
    if (material.sharing == NumberSharing::PerMap) {
        for (int n = 0; n < material.plans.taps; ++n) {
            taps.for_each_map(plan, n, [&](MapSlot slot, const texunit::SharedTap& tap, int) HWY_ATTR { add(slot, tap.draw[0], tap); });
        }
        return;
    }
    taps.for_each(plan, false, [&](const texunit::SharedTap& tap, int) HWY_ATTR {
        for (int slot = 0; slot < kMapSlots; ++slot)
            if (plan.holds(slot)) add(slot, tap.draw[plan.lookup_of[size_t(slot)]], tap);
    });
}

/// What is shaded of the maps of `plan`: use(weight, lanes) for each tap, whose texels are in `maps`. The weights of a lane sum to 1.
template <class Use>
HWY_INLINE void for_each_shaded_tap(MaterialTaps& taps, const TapPlan& plan, texunit::WaveColor* maps, const Use& use) {
    const MaterialState& material = taps.material();
    const float share = material.plans.enumerates ? 1.0f : 1 / float(material.plans.taps);
    const FloatLanes d;
    WaveFloat weight;
    if (material.sharing == NumberSharing::PerMap && !material.plans.enumerates) {
        std::fill_n(weight.lane, texunit::kWaveLanes, share);
        texunit::WaveColor texel;
        for (int n = 0; n < material.plans.taps; ++n) {
            for (int slot = 0; slot < kMapSlots; ++slot)
                if (plan.holds(slot)) maps[slot] = {};
            taps.for_each_map(plan, n, [&](MapSlot slot, const texunit::SharedTap& tap, int) HWY_ATTR {
                const MapState& map = material.maps[slot];
                texunit::HWY_NAMESPACE::read_drawn_lanes(*map.texture, map.sampler, tap.draw[0], texel);
                add_weighed(texel, tap.weight, 1.0f, tap.lanes, maps[slot]);
            });
            use(weight, taps.lanes());
        }
        return;
    }
    taps.for_each(plan, material.plans.enumerates, [&](const texunit::SharedTap& tap, int) HWY_ATTR {
        read_tap(material, plan, tap, maps);
        for (size_t i = 0; i < texunit::kWaveLanes; i += hn::Lanes(d))
            hn::Store(hn::Mul(hn::Load(d, tap.weight.lane + i), hn::Set(d, share)), d, weight.lane + i);
        use(weight, tap.lanes);
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace rawtexel::shading
HWY_AFTER_NAMESPACE();
#endif
