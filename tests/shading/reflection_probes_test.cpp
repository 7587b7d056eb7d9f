// The table of probes that stand for reflections: what it promises, and the fit that wrote it.
#include "shading/reflection_probes.h"

#include "tests/reference/shading/probe_table.h"
#include "tests/stress_scale.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

namespace rawtexel::shading {
namespace {

using Table = ReflectionProbeTable;

const uint32_t* words_of(int view, int roughness) {
    return &kReflectionProbes.words[size_t(Table::kNodeWords * (view + Table::kViews * roughness))];
}

reference::FittedProbes probes_of(int view, int roughness) {
    reference::FittedProbes probes;
    const uint32_t* words = words_of(view, roughness);
    const auto fraction = [](uint32_t bits) { return double(bits & 0xFFFFu) / 65535.0; };
    for (size_t k = 0; k < size_t(Table::kProbes); ++k) {
        const uint32_t aim = words[2 * k], shares = words[2 * k + 1];
        probes[k] = {fraction(aim >> 16) * double(Table::kLeanRange) + double(Table::kLeastLean),
                     fraction(aim) * double(Table::kRoughnessRange), fraction(shares >> 16), fraction(shares)};
    }
    return probes;
}

TEST(ReflectionProbes, SharesSumToOne) {
    for (int r = 0; r < Table::kRoughnesses; ++r)
        for (int v = 0; v < Table::kViews; ++v) {
            uint32_t scale = 0, bias = 0;
            for (int k = 0; k < Table::kProbes; ++k) {
                scale += words_of(v, r)[2 * k + 1] >> 16;
                bias += words_of(v, r)[2 * k + 1] & 0xFFFFu;
            }
            EXPECT_EQ(scale, 0xFFFFu) << "view " << v << " roughness " << r;
            EXPECT_EQ(bias, 0xFFFFu) << "view " << v << " roughness " << r;
        }
}

TEST(ReflectionProbes, AreFarCloserToTheReflectionThanOneLobe) {
    for (int r = 3; r < Table::kRoughnesses; r += 4)
        for (int v = 2; v <= 10; v += 4) {
            const reference::ProbeFit fit(reference::node_view(v), reference::node_roughness(r));
            reference::FittedProbes many = probes_of(v, r), one;
            one.fill({0.1, reference::node_roughness(r), 0.2, 0.2});
            const double distance = fit.weigh(many, many), of_one = fit.weigh(one, one);
            EXPECT_LT(distance, 0.2 * of_one) << "view " << v << " roughness " << r;
            EXPECT_LT(distance, 0.05) << "view " << v << " roughness " << r;
        }
}

TEST(ReflectionProbes, SharesAreTheBestForTheirLobes) {
    for (int r = 2; r < Table::kRoughnesses; r += 4)
        for (int v = 1; v < Table::kViews; v += 5) {
            const reference::FittedProbes kept = probes_of(v, r);
            reference::FittedProbes best = kept;
            reference::ProbeFit(reference::node_view(v), reference::node_roughness(r)).weigh(best, kept);
            for (size_t k = 0; k < size_t(Table::kProbes); ++k) {
                EXPECT_NEAR(kept[k].scale_share, best[k].scale_share, 0.05) << "view " << v << " roughness " << r << " probe " << k;
                EXPECT_NEAR(kept[k].bias_share, best[k].bias_share, 0.05) << "view " << v << " roughness " << r << " probe " << k;
            }
        }
}

/// The table in shading/ is the fit's. RAWTEXEL_UPDATE_PROBES=FILE writes a new one there.
TEST(ReflectionProbes, AreWhatTheFitGives) {
    const char* const path = std::getenv("RAWTEXEL_UPDATE_PROBES");
    if (path == nullptr && stress_scale() == 1)
        GTEST_SKIP() << "fitting the table of reflections anew takes minutes: only under ./dev stress";
    const std::vector<reference::FittedProbes> fitted = reference::fit_all_probes();
    if (path != nullptr) {
        std::ofstream(path) << reference::probe_table_source(fitted);
        return;
    }
    for (int r = 0; r < Table::kRoughnesses; ++r)
        for (int v = 0; v < Table::kViews; ++v) {
            const reference::FittedProbes kept = probes_of(v, r);
            const reference::FittedProbes& found = fitted[size_t(v + Table::kViews * r)];
            for (size_t k = 0; k < size_t(Table::kProbes); ++k) {
                // As coarse as 16 bits are.
                constexpr double kStep = 1.0 / 65535;
                EXPECT_NEAR(kept[k].lean, found[k].lean, kStep * double(Table::kLeanRange)) << v << ' ' << r << ' ' << k;
                EXPECT_NEAR(kept[k].roughness, found[k].roughness, kStep * double(Table::kRoughnessRange)) << v << ' ' << r << ' ' << k;
            }
        }
}

}  // namespace
}  // namespace rawtexel::shading
