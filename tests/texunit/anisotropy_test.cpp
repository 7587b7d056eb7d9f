// How far filtered lookups are from quadrature over level 0 (docs/anisotropy.md): root mean square over lookups of the difference, over the
// standard deviation of the texture, which is white noise: the measure is then the distance between the filters' weights.
#include "texunit/memory_source.h"
#include "texunit/sample.h"

#include "tests/reference/texunit/footprint_truth.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <random>
#include <sstream>

namespace rawtexel::texunit {
namespace {

using reference::Lookup;
using reference::PixelFilterShape;

constexpr double kVariances[] = {1.0 / 12, 1.0 / 6, 1.0 / 4, 1.0 / 3};

struct Noise {
    explicit Noise(int extent) : plane{extent, extent, {}} {
        std::mt19937 random(21);
        std::vector<uint16_t> codes;
        for (int i = 0; i < extent * extent; ++i) codes.push_back(uint16_t(random()));
        for (const uint16_t code : codes) plane.texel.push_back(double(code) / 65535);
        std::vector<std::byte> bytes(codes.size() * sizeof(uint16_t));
        std::memcpy(bytes.data(), codes.data(), bytes.size());
        texture = std::make_unique<Texture>("noise", make_memory_source(Format::R16Unorm, extent, extent, std::move(bytes)));
    }
    reference::Plane plane;
    std::unique_ptr<Texture> texture;
};

/// Footprints of one ratio at angles all around, of the ellipse and of the screen; minor axes from 1 to 2 texels.
std::vector<Lookup> footprints_of_ratio(int extent, double ratio, int count) {
    std::vector<Lookup> lookups;
    for (int i = 0; i < count; ++i) {
        const double minor = std::exp2(double(i % 7) / 6), major = minor * ratio;
        const double turn = 6.2832 * i / count, screen = 2.4 * i;
        const double c = std::cos(turn), s = std::sin(turn), cx = std::cos(screen), sx = std::sin(screen);
        lookups.push_back({float(std::fmod(0.137 + 0.381 * i, 1)), float(std::fmod(0.291 + 0.618 * i, 1)),
                           float((c * major * cx - s * minor * sx) / extent), float((s * major * cx + c * minor * sx) / extent),
                           float((-c * major * sx - s * minor * cx) / extent), float((-s * major * sx + c * minor * cx) / extent)});
    }
    return lookups;
}

std::vector<float> look_up(Texture& texture, const SamplerState& sampler, const std::vector<Lookup>& lookups) {
    std::vector<float> values;
    for (size_t first = 0; first < lookups.size(); first += kWaveLanes) {
        WaveCoordinates at{};
        const size_t count = std::min(lookups.size() - first, size_t(kWaveLanes));
        for (size_t i = 0; i < count; ++i) {
            const Lookup& one = lookups[first + i];
            at.u.lane[i] = one.u, at.v.lane[i] = one.v;
            at.dudx.lane[i] = one.dudx, at.dvdx.lane[i] = one.dvdx, at.dudy.lane[i] = one.dudy, at.dvdy.lane[i] = one.dvdy;
        }
        WaveColor colour;
        sample_wave(texture, sampler, at, count == kWaveLanes ? kWaveFull : (1u << count) - 1, colour);
        values.insert(values.end(), colour.channel[0].lane, colour.channel[0].lane + count);
    }
    return values;
}

double error(const Noise& noise, const std::vector<float>& found, const std::vector<Lookup>& lookups, PixelFilterShape shape,
             double variance) {
    double squares = 0;
    for (size_t i = 0; i < lookups.size(); ++i) {
        const double difference = double(found[i]) - reference::footprint_truth(noise.plane, shape, variance, lookups[i], 0.34);
        squares += difference * difference;
    }
    return std::sqrt(squares / double(lookups.size())) / noise.plane.deviation();
}

TEST(Anisotropy, TheEllipticalFilterIsWithinOnePercentOfTheGaussianTruth) {
    const Noise noise(256);
    for (const double ratio : {1.0, 3.0, 8.0, 20.0, 64.0}) {
        const std::vector<Lookup> lookups = footprints_of_ratio(256, ratio, ratio > 10 ? 14 : 28);
        for (const double variance : kVariances) {
            const double found =
                error(noise, look_up(*noise.texture, {.ellipse = float(variance)}, lookups), lookups, PixelFilterShape::Gaussian, variance);
            EXPECT_LT(found, 0.01) << "ratio " << ratio << " S2 " << variance;
        }
    }
}

TEST(Anisotropy, ProbesByVarianceAreNearerTheTruthThanTheSpecifiedLine) {
    const Noise noise(256);
    for (const double ratio : {4.0, 16.0}) {
        const std::vector<Lookup> lookups = footprints_of_ratio(256, ratio, 64);
        for (const double variance : kVariances) {
            // The uniform line is a box along the major axis itself, so against a box only its wrong width shows.
            for (const PixelFilterShape shape : {PixelFilterShape::Tent, PixelFilterShape::Gaussian}) {
                const auto error_of = [&](const SamplerState& sampler) {
                    return error(noise, look_up(*noise.texture, sampler, lookups), lookups, shape, variance);
                };
                const double line = error_of({.probes = 16, .lod_rule = LodRule::Exact});
                const double by_variance = error_of({.probes = 16, .probe_variance = float(variance)});
                const double more = error_of({.probes = 64, .probe_variance = float(variance)});
                EXPECT_LT(by_variance, line) << "ratio " << ratio << " S2 " << variance << " filter " << int(shape);
                EXPECT_LT(more, by_variance * 1.1) << "ratio " << ratio << " S2 " << variance << " filter " << int(shape);
                EXPECT_LT(more, ratio > 10 ? 0.05 : 0.09) << "ratio " << ratio << " S2 " << variance << " filter " << int(shape);
            }
        }
    }
}

TEST(Anisotropy, AtRatio16TheErrorsAreTheDocumentedOnes) {
    // Of docs/anisotropy.md, which has other texture systems beside, a smaller sample: against box, tent and Gaussian for each S2.
    struct Case {
        int probes;
        double bound[4][3];
    };
    const Case cases[] = {
        {16, {{0.058, 0.053, 0.055}, {0.051, 0.046, 0.048}, {0.048, 0.042, 0.044}, {0.045, 0.039, 0.042}}},
        {32, {{0.044, 0.030, 0.029}, {0.047, 0.034, 0.033}, {0.046, 0.035, 0.034}, {0.044, 0.029, 0.028}}},
    };
    const Noise noise(512);
    const std::vector<Lookup> lookups = footprints_of_ratio(512, 16, 64);
    for (const Case& one : cases) {
        for (size_t v = 0; v < std::size(kVariances); ++v) {
            const std::vector<float> found =
                look_up(*noise.texture, {.probes = one.probes, .probe_variance = float(kVariances[v])}, lookups);
            for (const PixelFilterShape shape : {PixelFilterShape::Box, PixelFilterShape::Tent, PixelFilterShape::Gaussian}) {
                EXPECT_LT(error(noise, found, lookups, shape, kVariances[v]), one.bound[v][size_t(shape)])
                    << one.probes << " probes, S2 " << kVariances[v] << ", filter " << int(shape);
            }
        }
    }
}

TEST(Anisotropy, TheListedFootprintsAreFilteredWithinOnePercent) {
    const char* const path = std::getenv("RAWTEXEL_FOOTPRINTS");
    if (path == nullptr) GTEST_SKIP() << "RAWTEXEL_FOOTPRINTS names no list of footprints of a 1024x1024 texture";
    std::ifstream file(path);
    ASSERT_TRUE(file) << path;
    std::vector<Lookup> lookups;
    for (std::string line; std::getline(file, line);) {
        std::istringstream numbers(line.substr(0, line.find('#')));
        Lookup at;
        if (numbers >> at.u >> at.v >> at.dudx >> at.dvdx >> at.dudy >> at.dvdy) lookups.push_back(at);
    }
    ASSERT_FALSE(lookups.empty());
    const Noise noise(1024);
    const double found =
        error(noise, look_up(*noise.texture, {.ellipse = 1.0f / 6}, lookups), lookups, PixelFilterShape::Gaussian, 1.0 / 6);
    EXPECT_LT(found, 0.01) << lookups.size() << " footprints";
}

}  // namespace
}  // namespace rawtexel::texunit
