#include "texunit/simd.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace rawtexel::texunit {
namespace {

struct SimdTarget {
    Simd simd;
    std::string_view name;
    int64_t target;  ///< highway's bit; lower bits are better sets
};

constexpr std::array<SimdTarget, 5> kTargets = {{{Simd::Auto, "auto", 0},
                                                 {Simd::Scalar, "scalar", HWY_SCALAR},
                                                 {Simd::Sse4, "sse4", HWY_SSE4},
                                                 {Simd::Avx2, "avx2", HWY_AVX2},
                                                 {Simd::Avx3, "avx3", HWY_AVX3}}};

/// What processor and build have in common. The processor is asked once, before `choose_simd` narrows highway's answer.
int64_t usable_targets() {
    static const int64_t usable = (hwy::SupportedTargets() | HWY_SCALAR) & HWY_TARGETS;
    return usable;
}

const SimdTarget& entry(Simd simd) {
    return *std::find_if(kTargets.begin(), kTargets.end(), [=](const SimdTarget& target) { return target.simd == simd; });
}

}  // namespace

std::string_view to_string(Simd simd) { return entry(simd).name; }

std::optional<Simd> parse_simd(std::string_view text) {
    for (const SimdTarget& target : kTargets) {
        if (target.name == text) return target.simd;
    }
    return std::nullopt;
}

std::vector<Simd> available_simd() {
    std::vector<Simd> available;
    for (const SimdTarget& target : kTargets) {
        if ((target.target & usable_targets()) != 0) available.push_back(target.simd);
    }
    return available;
}

bool choose_simd(Simd simd) {
    const int64_t targets = simd == Simd::Auto ? usable_targets() : entry(simd).target & usable_targets();
    if (targets == 0) return false;
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    return true;
}

Simd chosen_simd() {
    // Highway dispatches to the best of the sets it reports as supported.
    usable_targets();
    Simd best = Simd::Scalar;
    for (const SimdTarget& target : kTargets) {
        if ((target.target & hwy::SupportedTargets() & HWY_TARGETS) != 0) best = target.simd;
    }
    return best;
}

}  // namespace rawtexel::texunit
