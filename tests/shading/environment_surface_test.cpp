// What whole surfaces reflect of an environment, in both ways, against brute force.
#include "shading/lighting.h"
#include "tests/reference/shading/environment.h"
#include "tests/shading/environments.h"
#include "tests/shading/surfaces.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rawtexel::shading {
namespace {

using namespace test;

Lighting lit_by(const Environment& environment, EnvironmentReflections reflections) {
    Lighting lighting;
    lighting.environment = std::shared_ptr<const Environment>(&environment, [](const Environment*) {});
    lighting.reflections = reflections;
    return lighting;
}

/// A surface whose mirror direction is `mirrored`, seen at an angle of cosine `n_dot_v`, turned `turn` about that direction.
reference::Surface turned(reference::Surface s, const glm::dvec3& mirrored, double n_dot_v, double turn) {
    const glm::dvec3 across = reference::tangent_of(mirrored), along = glm::cross(mirrored, across);
    const double sine = std::sqrt(1.0 - n_dot_v * n_dot_v);
    s.normal = glm::normalize(mirrored * n_dot_v + (across * std::cos(turn) + along * std::sin(turn)) * sine);
    s.view = 2.0 * n_dot_v * s.normal - mirrored;
    return s;
}

reference::Surface metal(double roughness) {
    reference::Surface s;
    s.metallic = 1.0;
    s.roughness = roughness;
    return s;
}

reference::Surface dielectric(double roughness) {
    reference::Surface s;
    s.base = {0.8, 0.6, 0.4};
    s.roughness = roughness;
    return s;
}

struct ErrorsOfBothWays {
    Errors prefiltered, split_sum;

    void add(const Environment& environment, const reference::Surface& s, const glm::dvec3& expected) {
        prefiltered.add(shaded(lit_by(environment, EnvironmentReflections::Prefiltered), s), expected);
        split_sum.add(shaded(lit_by(environment, EnvironmentReflections::SplitSum), s), expected);
    }
    void print() const { std::printf(" %5.2f (%5.2f)", 100.0 * prefiltered.rms(), 100.0 * split_sum.rms()); }
};

/// Under the sky, from `views` sides, against 65 536 directions of specular and as many of diffuse light.
ErrorsOfBothWays errors_under_the_sky(const reference::Surface& material, double n_dot_v, int views) {
    ErrorsOfBothWays errors;
    for (int k = 0; k < views; ++k) {
        const reference::Surface s = turned(material, reference::spiral_direction(k, views), n_dot_v, 1.7 * k);
        errors.add(sky_environment(), s, reference::reflected_light(sky(), s, 65536));
    }
    return errors;
}

void print_header(const char* what, std::initializer_list<double> angles) {
    std::printf("  %s: rms error in %% prefiltered (split-sum)\n  n.v          ", what);
    for (const double n_dot_v : angles) std::printf("    %.2f      ", n_dot_v);
    std::printf("\n");
}

TEST(EnvironmentSurface, MetalsUnderTheSkyAreWithinOnePercentOfSampling65536Directions) {
    const auto angles = {1.0, 0.9, 0.75, 0.5, 0.3, 0.15};
    // One lobe per reflection is neither stretched at an angle nor cut off at the horizon.
    const double split_sum_bounds[] = {0.025, 0.03, 0.045, 0.065, 0.1, 0.15};
    print_header("metals, sky", angles);
    for (const double roughness : {0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0}) {
        std::printf("  roughness %.1f", roughness);
        for (size_t i = 0; i < angles.size(); ++i) {
            const double n_dot_v = angles.begin()[i];
            const ErrorsOfBothWays errors = errors_under_the_sky(metal(roughness), n_dot_v, 12);
            errors.print();
            EXPECT_LT(errors.prefiltered.rms(), 0.01) << "roughness " << roughness << " n.v " << n_dot_v;
            EXPECT_LT(errors.split_sum.rms(), split_sum_bounds[i]) << "roughness " << roughness << " n.v " << n_dot_v;
        }
        std::printf("\n");
    }
}

TEST(EnvironmentSurface, DielectricsUnderTheSkyAreWithinOnePercentOfSampling65536Directions) {
    const auto angles = {1.0, 0.7, 0.4, 0.2};
    print_header("dielectrics, sky", angles);
    for (const double roughness : {0.1, 0.3, 0.5, 0.7, 1.0}) {
        std::printf("  roughness %.1f", roughness);
        for (const double n_dot_v : angles) {
            const ErrorsOfBothWays errors = errors_under_the_sky(dielectric(roughness), n_dot_v, 6);
            errors.print();
            EXPECT_LT(errors.prefiltered.rms(), 0.01) << "roughness " << roughness << " n.v " << n_dot_v;
            EXPECT_LT(errors.split_sum.rms(), n_dot_v > 0.5 ? 0.01 : 0.05) << "roughness " << roughness << " n.v " << n_dot_v;
        }
        std::printf("\n");
    }
}

TEST(EnvironmentSurface, UnderASmallBrightSunKeepsTheTabulatedError) {
    // Samples would scatter, so the reference visits the whole image; a third of the views look at the sun's reflection.
    SerialExecutor executor;
    const Image image = sharp_sun(512);
    const Environment environment(image, executor);
    const reference::ImageIntegral integral(image, 2);
    const auto angles = {0.9, 0.5, 0.2};
    constexpr int kViews = 12;
    print_header("metals, small sun", angles);
    for (const double roughness : {0.2, 0.4, 0.7, 1.0}) {
        std::printf("  roughness %.1f", roughness);
        for (const double n_dot_v : angles) {
            ErrorsOfBothWays errors;
            for (int k = 0; k < kViews; ++k) {
                glm::dvec3 mirrored = reference::spiral_direction(k, kViews);
                if (k % 3 == 0) mirrored = glm::normalize(to_sharp_sun() + mirrored * (roughness * roughness * 0.15 * k));
                const reference::Surface s = turned(metal(roughness), mirrored, n_dot_v, 1.7 * k);
                errors.add(environment, s, integral.reflected(s));
            }
            errors.print();
            EXPECT_LT(errors.prefiltered.rms(), 0.15) << "roughness " << roughness << " n.v " << n_dot_v;
            EXPECT_LT(errors.prefiltered.rms(), 0.4 * errors.split_sum.rms()) << "roughness " << roughness << " n.v " << n_dot_v;
        }
        std::printf("\n");
    }
}

/// Greatest second difference of what a metal reflects while `surface_at(i)` moves in small steps, relative to the light.
template <class SurfaceAt>
double greatest_bend(const SurfaceAt& surface_at, int steps) {
    const Lighting lighting = lit_by(sky_environment(), EnvironmentReflections::Prefiltered);
    double worst = 0.0;
    glm::dvec3 before = shaded(lighting, surface_at(0)), here = shaded(lighting, surface_at(1));
    for (int i = 2; i <= steps; ++i) {
        const glm::dvec3 after = shaded(lighting, surface_at(i));
        worst = std::max(worst, glm::length(after - 2.0 * here + before) / glm::length(here));
        before = here;
        here = after;
    }
    return worst;
}

TEST(EnvironmentSurface, ChangesSteadilyWithViewAndRoughness) {
    // The mirror direction stands still: what changes is the reflection's shape. A jump would be a second difference of its own size.
    constexpr int kSteps = 500;
    for (int k = 0; k < 6; ++k) {
        const glm::dvec3 mirrored = reference::spiral_direction(k, 6);
        for (const double fixed : {0.12, 0.3, 0.55, 0.8, 1.0}) {
            const auto by_view = [&](int i) { return turned(metal(fixed), mirrored, std::cos(1.55 * i / kSteps), k); };
            const auto by_roughness = [&](int i) { return turned(metal(double(i) / kSteps), mirrored, fixed, k); };
            EXPECT_LT(greatest_bend(by_view, kSteps), 8e-3) << "direction " << k << " roughness " << fixed;
            EXPECT_LT(greatest_bend(by_roughness, kSteps), 8e-3) << "direction " << k << " n.v " << fixed;
        }
    }
}

}  // namespace
}  // namespace rawtexel::shading
