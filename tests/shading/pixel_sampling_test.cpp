#include "shading/pixel_sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <algorithm>
#include <numeric>
#include <set>
#include <vector>

namespace rawtexel::shading {
namespace {

constexpr PixelFilter kFilters[] = {PixelFilter::Box, PixelFilter::Tent, PixelFilter::Gaussian};
constexpr PixelJitter kJitters[] = {PixelJitter::Frame, PixelJitter::Pixel};

/// Share of the filter left of t pixels from the centre, from its definition by quadrature.
double filter_cdf(PixelFilter filter, double t) {
    const double radius = double(filter_radius(filter));
    const auto weight = [&](double s) {
        switch (filter) {
            case PixelFilter::Box: return 1.0;
            case PixelFilter::Tent: return 1.0 - std::abs(s);
            case PixelFilter::Gaussian: break;
        }
        return std::exp(-0.5 * (s / 0.5) * (s / 0.5));
    };
    const auto integral = [&](double to) {
        constexpr int kSteps = 4000;
        double sum = 0;
        for (int i = 0; i < kSteps; ++i) sum += weight(-radius + (i + 0.5) / kSteps * (to + radius));
        return sum / kSteps * (to + radius);
    };
    return integral(t) / integral(radius);
}

TEST(PixelSampling, NamesParseBack) {
    for (const PixelFilter filter : kFilters) EXPECT_EQ(parse_pixel_filter(to_string(filter)), filter);
    for (const PixelJitter jitter : kJitters) EXPECT_EQ(parse_pixel_jitter(to_string(jitter)), jitter);
    EXPECT_FALSE(parse_pixel_filter("Box"));
    EXPECT_FALSE(parse_pixel_jitter(""));
}

TEST(PixelSampling, StartsFramesAtTheCentre) {
    for (const PixelFilter filter : kFilters)
        for (const uint32_t seed : {0u, 1u, 77u})
            EXPECT_EQ(sample_offset(filter, PixelJitter::Frame, 0, 5, 9, seed), raster::SampleOffset{});
}

TEST(PixelSampling, LiesOnOddMultiplesWithinTheSupport) {
    for (const PixelFilter filter : kFilters) {
        const int radius = int(filter_radius(filter) * raster::kSampleOne);
        for (const PixelJitter jitter : kJitters) {
            for (uint32_t sample = 1; sample < 5000; ++sample) {
                const raster::SampleOffset at = sample_offset(filter, jitter, sample, sample % 61, sample % 47, 3);
                for (const int32_t offset : {at.x, at.y}) {
                    ASSERT_EQ(offset & 1, 1) << to_string(filter) << " sample " << sample;
                    ASSERT_LT(std::abs(offset - raster::kSampleOne / 2), radius) << to_string(filter) << " sample " << sample;
                }
            }
        }
    }
}

TEST(PixelSampling, IsOneOffsetPerFrameAndOnePerPixel) {
    std::set<std::pair<int, int>> seen;
    for (uint32_t x = 0; x < 64; ++x) {
        EXPECT_EQ(sample_offset(PixelFilter::Tent, PixelJitter::Frame, 9, x, 2 * x, 4),
                  sample_offset(PixelFilter::Tent, PixelJitter::Frame, 9, 0, 0, 4));
        const raster::SampleOffset at = sample_offset(PixelFilter::Tent, PixelJitter::Pixel, 9, x, 2 * x, 4);
        seen.insert({at.x, at.y});
    }
    EXPECT_GT(seen.size(), 60u) << "pixels share their offsets";
}

TEST(PixelSampling, ChangesWithTheSeed) {
    for (const PixelJitter jitter : kJitters) {
        int equal = 0;
        for (uint32_t sample = 1; sample < 100; ++sample)
            equal += sample_offset(PixelFilter::Box, jitter, sample, 1, 2, 0) == sample_offset(PixelFilter::Box, jitter, sample, 1, 2, 1);
        EXPECT_LT(equal, 3) << to_string(jitter);
    }
}

/// Along a sequence of n points R2 deviates from the filter's distribution like log(n)/n, a random set of pixels like 1/sqrt(n).
TEST(PixelSampling, FollowsTheFilter) {
    constexpr uint32_t kCount = 1 << 14;
    for (const PixelFilter filter : kFilters) {
        for (const bool along_samples : {true, false}) {
            std::vector<double> x, y;
            for (uint32_t i = 0; i < kCount; ++i) {
                const raster::SampleOffset at = along_samples ? sample_offset(filter, PixelJitter::Frame, i + 1, 0, 0, 0)
                                                              : sample_offset(filter, PixelJitter::Pixel, 5, i % 128, i / 128, 0);
                x.push_back(double(at.x) / raster::kSampleOne - 0.5);
                y.push_back(double(at.y) / raster::kSampleOne - 0.5);
            }
            for (std::vector<double>* axis : {&x, &y}) {
                std::sort(axis->begin(), axis->end());
                const double mean = std::accumulate(axis->begin(), axis->end(), 0.0) / kCount;
                double worst = 0;
                for (double t = -double(filter_radius(filter)) + 0x1p-8; t < double(filter_radius(filter)); t += 0x1p-4) {
                    // The grid's cells are 1/256 wide and centred on odd multiples of 1/512: t lies between two of them.
                    const auto below = std::lower_bound(axis->begin(), axis->end(), t) - axis->begin();
                    worst = std::max(worst, std::abs(double(below) / kCount - filter_cdf(filter, t)));
                }
                // Kolmogorov-Smirnov at 1e-7 for independent pixels: 2.9/sqrt(n).
                const double allowed = along_samples ? 20.0 / kCount : 2.9 / std::sqrt(double(kCount));
                EXPECT_LT(worst, allowed) << to_string(filter) << (along_samples ? " along samples" : " over pixels");
                EXPECT_LT(std::abs(mean), along_samples ? 10.0 / kCount : 5.5 * 0.5 / std::sqrt(double(kCount))) << to_string(filter);
            }
        }
    }
}

TEST(PixelSampling, CoversEveryCellOfTheBoxAlike) {
    std::vector<int> cells(256);
    for (uint32_t sample = 1; sample <= 256 * 64; ++sample)
        ++cells[size_t(sample_offset(PixelFilter::Box, PixelJitter::Frame, sample, 0, 0, 0).x / 2)];
    for (size_t k = 0; k < cells.size(); ++k) EXPECT_NEAR(cells[k], 64, 3) << "cell " << k;
}

}  // namespace
}  // namespace rawtexel::shading
