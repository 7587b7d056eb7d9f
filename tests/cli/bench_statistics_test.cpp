// Fits and fronts against their definitions.
#include "cli/bench/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace rawtexel::cli {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();

TEST(Median, IsTheMiddleOrTheMeanOfTheMiddleTwo) {
    EXPECT_EQ(median({3}), 3);
    EXPECT_EQ(median({9, 1, 4}), 4);
    EXPECT_EQ(median({4, 1, 9, 2}), 3);
}

TEST(PowerFit, FindsThePowerThatPointsFollow) {
    for (const double slope : {-1.0, -0.5, 0.0, 0.73}) {
        std::vector<Sample> points;
        for (const double x : {1.0, 3.0, 20.0, 256.0}) points.push_back({x, 2.5 * std::pow(x, slope)});
        const auto fit = fit_power(points);
        ASSERT_TRUE(fit);
        EXPECT_NEAR(fit->slope, slope, 1e-12);
        EXPECT_NEAR(fit->factor, 2.5, 1e-12);
        EXPECT_NEAR(fit->at(7), 2.5 * std::pow(7.0, slope), 1e-12);
    }
}

TEST(PowerFit, LeavesOutWhatHasNoLogarithm) {
    const std::vector<Sample> points{{1, 1}, {2, 0}, {3, -1}, {4, 0.5}, {5, kNan}, {6, kInfinity}, {0, 3}};
    const auto fit = fit_power(points);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->slope, -0.5, 1e-12);
    EXPECT_FALSE(fit_power(std::vector<Sample>{}));
    EXPECT_FALSE(fit_power(std::vector<Sample>{{4, 1}, {4, 2}}));
    EXPECT_FALSE(fit_power(std::vector<Sample>{{4, 1}, {8, 0}}));
}

TEST(PowerFit, HasTheLeastSquaresOfTheLogarithms) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<Sample> points;
        for (int i = 0; i < 6; ++i) points.push_back({std::exp2(2 * i), std::exp(uniform(random) - 0.4 * i)});
        const auto fit = fit_power(points);
        ASSERT_TRUE(fit);
        const auto squares = [&](double slope, double factor) {
            double sum = 0;
            for (const Sample& point : points) sum += std::pow(std::log(point.y / (factor * std::pow(point.x, slope))), 2);
            return sum;
        };
        const double least = squares(fit->slope, fit->factor);
        for (const double step : {-1e-3, 1e-3}) {
            EXPECT_GT(squares(fit->slope + step, fit->factor), least) << trial;
            EXPECT_GT(squares(fit->slope, fit->factor * (1 + step)), least) << trial;
        }
    }
}

double relative_squares(std::span<const Sample> points, double floor, double noise) {
    double sum = 0;
    for (const Sample& point : points) sum += std::pow((floor + noise / point.x) / point.y - 1, 2);
    return sum;
}

TEST(FloorFit, FindsFloorAndNoise) {
    for (const auto& [floor, noise] : {std::pair{0.3, 2.0}, std::pair{0.0, 5.0}, std::pair{1e-6, 0.0}}) {
        std::vector<Sample> points;
        for (const double n : {1.0, 4.0, 16.0, 64.0}) points.push_back({n, floor + noise / n});
        const auto fit = fit_floor(points);
        ASSERT_TRUE(fit);
        EXPECT_NEAR(fit->floor, floor, 1e-9 * (floor + noise));
        EXPECT_NEAR(fit->noise, noise, 1e-9 * (floor + noise));
    }
    EXPECT_FALSE(fit_floor(std::vector<Sample>{{1, 1}}));
}

TEST(FloorFit, HasTheLeastRelativeSquaresOfWhatIsNotBelowNothing) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform(-1, 1);
    int bounded = 0;
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<Sample> points;
        const double slope = 0.8 * uniform(random) - 0.6;
        for (const double n : {1.0, 4.0, 16.0, 64.0}) points.push_back({n, std::pow(n, slope) * std::exp(0.5 * uniform(random))});
        const auto fit = fit_floor(points);
        ASSERT_TRUE(fit);
        ASSERT_GE(fit->floor, 0);
        ASSERT_GE(fit->noise, 0);
        bounded += fit->floor == 0 || fit->noise == 0;
        const double least = relative_squares(points, fit->floor, fit->noise);
        for (int k = 0; k <= 60; ++k)
            for (int l = 0; l <= 60; ++l)
                EXPECT_GE(relative_squares(points, 0.04 * k, 0.1 * l), least * (1 - 1e-9)) << trial << ": " << 0.04 * k << ' ' << 0.1 * l;
    }
    EXPECT_GT(bounded, 20);
    EXPECT_LT(bounded, 180);
}

/// The definition, pair by pair.
std::vector<bool> slow_front(std::span<const Sample> points) {
    std::vector<bool> front;
    for (const Sample& one : points) {
        bool on = std::isfinite(one.x) && std::isfinite(one.y);
        for (const Sample& other : points) {
            if (!std::isfinite(other.x) || !std::isfinite(other.y)) continue;
            if (other.x <= one.x && other.y <= one.y && (other.x < one.x || other.y < one.y)) on = false;
        }
        front.push_back(on);
    }
    return front;
}

TEST(ParetoFront, EqualsItsDefinitionPairByPair) {
    std::mt19937 random(3);
    size_t on = 0, off = 0;
    for (int trial = 0; trial < 500; ++trial) {
        // Few different values: many points are equal in one coordinate or both.
        std::uniform_int_distribution<int> value(0, trial % 20 + 1), count(0, 60);
        std::vector<Sample> points;
        for (int i = count(random); i > 0; --i) {
            points.push_back({double(value(random)), double(value(random))});
            if (value(random) == 0) (value(random) % 2 == 0 ? points.back().x : points.back().y) = trial % 3 == 0 ? kNan : kInfinity;
        }
        const std::vector<bool> front = pareto_front(points), expected = slow_front(points);
        ASSERT_EQ(front, expected) << "trial " << trial;
        on += size_t(std::ranges::count(front, true));
        off += size_t(std::ranges::count(front, false));
    }
    EXPECT_GT(on, 500u);
    EXPECT_GT(off, 5000u);
}

}  // namespace
}  // namespace rawtexel::cli
