// The error of anisotropic lookups against quadrature over level 0, ours and other samplers', as the tables of docs/anisotropy.md.
//
//   rawtexel_anisotropy_table [FOOTPRINTS.txt [IMAGE]]
//
// Error: root mean square over the lookups of (result - truth)/(standard deviation of the texture). Textures: white noise, where it is the
// distance between the filters' weights, and noise of equal variance per octave, as natural images have; or the red channel of an image of
// 1024x1024 texels. Footprints: per ratio, minor axes
// of 1 to 4 texels at random angles of the ellipse and of the screen; or a file, one `u v dudx dvdx dudy dvdy` a line.
// Other samplers get their derivatives scaled by whatever factor suits each truth best.
#include "texunit/memory_source.h"
#include "texunit/sample.h"

#include "tests/benchmarks/tools/peer_lookup.h"
#include "tests/reference/texunit/footprint_truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>

namespace rawtexel::tools {
namespace {

using texunit::SamplerState;
using texunit::reference::Lookup;
using texunit::reference::PixelFilterShape;
using texunit::reference::Plane;

constexpr int kExtent = 1024;
constexpr int kPerRatio = 96;
constexpr double kRatios[] = {1, 2, 4, 8, 16, 32, 64};
constexpr std::array<double, 4> kVariances = {1.0 / 12, 1.0 / 6, 1.0 / 4, 1.0 / 3};
constexpr const char* kVarianceNames[] = {"1/12", "1/6", "1/4", "1/3"};
constexpr PixelFilterShape kShapes[] = {PixelFilterShape::Box, PixelFilterShape::Tent, PixelFilterShape::Gaussian};

std::vector<double> white_noise(std::mt19937& random) {
    std::vector<double> texels(size_t(kExtent) * kExtent);
    std::uniform_real_distribution<double> unit(0, 1);
    for (double& texel : texels) texel = unit(random);
    return texels;
}

/// Octaves of bilinear noise, each of the same amplitude.
std::vector<double> octave_noise(std::mt19937& random) {
    std::vector<double> sum(size_t(kExtent) * kExtent);
    for (int octave = 0; octave < 8; ++octave) {
        const int extent = kExtent >> octave;
        Plane plane{extent, extent, {}};
        std::normal_distribution<double> normal;
        for (int i = 0; i < extent * extent; ++i) plane.texel.push_back(normal(random));
        for (int i = 0; i < kExtent * kExtent; ++i) {
            sum[size_t(i)] += plane.bilinear((i % kExtent + 0.5) * extent / kExtent, (i / kExtent + 0.5) * extent / kExtent);
        }
    }
    for (double& value : sum) value = std::clamp(0.5 + value / 24, 0.0, 1.0);
    return sum;
}

Pyramid make_pyramid(const std::vector<double>& texels) {
    Pyramid pyramid{kExtent, {{}}};
    for (const double texel : texels) pyramid.level[0].push_back(uint16_t(std::lround(texel * 65535)));
    for (int extent = kExtent / 2; extent >= 1; extent /= 2) {
        const std::vector<uint16_t> parent = pyramid.level.back();
        std::vector<uint16_t> level;
        for (int i = 0; i < extent * extent; ++i) {
            const size_t first = size_t(i / extent) * 4 * size_t(extent) + size_t(i % extent) * 2;
            const int sum = parent[first] + parent[first + 1] + parent[first + 2 * size_t(extent)] + parent[first + 2 * size_t(extent) + 1];
            level.push_back(uint16_t((sum + 2) / 4));
        }
        pyramid.level.push_back(std::move(level));
    }
    return pyramid;
}

std::unique_ptr<texunit::Texture> make_texture(const Pyramid& pyramid) {
    std::vector<std::byte> texels(pyramid.level[0].size() * sizeof(uint16_t));
    std::memcpy(texels.data(), pyramid.level[0].data(), texels.size());
    return std::make_unique<texunit::Texture>("noise",
                                              texunit::make_memory_source(texunit::Format::R16Unorm, kExtent, kExtent, std::move(texels)));
}

Plane make_plane(const Pyramid& pyramid) {
    Plane plane{kExtent, kExtent, {}};
    for (const uint16_t code : pyramid.level[0]) plane.texel.push_back(double(code) / 65535);
    return plane;
}

std::vector<Lookup> make_footprints(double ratio, std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Lookup> lookups;
    for (int i = 0; i < kPerRatio; ++i) {
        const double minor = std::exp2(2 * unit(random)), major = minor * ratio;
        const double turn = unit(random) * 6.2832, screen = unit(random) * 6.2832;
        const double c = std::cos(turn), s = std::sin(turn), cx = std::cos(screen), sx = std::sin(screen);
        lookups.push_back({float(unit(random)), float(unit(random)), float((c * major * cx - s * minor * sx) / kExtent),
                           float((s * major * cx + c * minor * sx) / kExtent), float((-c * major * sx - s * minor * cx) / kExtent),
                           float((-s * major * sx + c * minor * cx) / kExtent)});
    }
    return lookups;
}

std::vector<Lookup> read_footprints(const char* path) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error(std::string("cannot read ") + path);
    std::vector<Lookup> lookups;
    for (std::string line; std::getline(file, line);) {
        std::istringstream numbers(line.substr(0, line.find('#')));
        Lookup at;
        if (numbers >> at.u >> at.v >> at.dudx >> at.dvdx >> at.dudy >> at.dvdy) lookups.push_back(at);
    }
    return lookups;
}

std::vector<double> look_up(texunit::Texture& texture, const SamplerState& sampler, const std::vector<Lookup>& lookups) {
    std::vector<double> values;
    for (size_t first = 0; first < lookups.size(); first += texunit::kWaveLanes) {
        texunit::WaveCoordinates at{};
        const size_t count = std::min(lookups.size() - first, size_t(texunit::kWaveLanes));
        for (size_t i = 0; i < count; ++i) {
            const Lookup& one = lookups[first + i];
            at.u.lane[i] = one.u, at.v.lane[i] = one.v;
            at.dudx.lane[i] = one.dudx, at.dvdx.lane[i] = one.dvdx, at.dudy.lane[i] = one.dudy, at.dvdy.lane[i] = one.dvdy;
        }
        texunit::WaveColor colour;
        sample_wave(texture, sampler, at, count == texunit::kWaveLanes ? texunit::kWaveFull : (1u << count) - 1, colour);
        for (size_t i = 0; i < count; ++i) values.push_back(colour.channel[0].lane[i]);
    }
    return values;
}

double error(const std::vector<double>& found, const std::vector<double>& truth, double deviation) {
    double squares = 0;
    for (size_t i = 0; i < truth.size(); ++i) squares += (found[i] - truth[i]) * (found[i] - truth[i]);
    return std::sqrt(squares / double(truth.size())) / deviation;
}

/// Of each of several settings, its lookups' values.
using Results = std::vector<std::vector<double>>;

/// A row of the table: results that may depend on the variance of the truth; the best setting counts.
struct Row {
    std::string name;
    std::function<Results(double variance)> results;
};

void print_table(const char* title, const Plane& plane, const std::vector<Lookup>& lookups, const std::vector<Row>& rows) {
    std::printf("\n%s\n\n| |", title);
    for (const char* variance : kVarianceNames) std::printf(" S2 %s |", variance);
    std::printf("\n|---|---|---|---|---|\n");
    std::vector<std::vector<double>> truths;
    for (const double variance : kVariances) {
        for (const PixelFilterShape shape : kShapes) {
            std::vector<double> truth;
            for (const Lookup& at : lookups) truth.push_back(footprint_truth(plane, shape, variance, at, 0.3));
            truths.push_back(std::move(truth));
        }
    }
    const double deviation = plane.deviation();
    for (const Row& row : rows) {
        std::printf("| %s |", row.name.c_str());
        for (size_t v = 0; v < kVariances.size(); ++v) {
            const Results results = row.results(kVariances[v]);
            for (size_t shape = 0; shape < std::size(kShapes); ++shape) {
                double best = 1e9;
                for (const std::vector<double>& result : results) best = std::min(best, error(result, truths[v * 3 + shape], deviation));
                std::printf(" %.4f", best);
            }
            std::printf(" |");
        }
        std::printf("\n");
        std::fflush(stdout);
    }
}

std::vector<Row> make_rows(texunit::Texture& texture, PeerSampler* texture_system, PeerSampler* opengl,
                           const std::vector<Lookup>& lookups) {
    const auto ours = [&](SamplerState sampler) {
        return [&texture, &lookups, sampler](double) { return Results(1, look_up(texture, sampler, lookups)); };
    };
    const auto by_variance = [&](int probes) {
        return [&texture, &lookups, probes](double variance) {
            return Results(1, look_up(texture, {.probes = probes, .probe_variance = float(variance)}, lookups));
        };
    };
    const auto exact = [&](double variance) { return Results(1, look_up(texture, {.ellipse = float(variance)}, lookups)); };
    const auto scaled = [&](PeerSampler& peer, double step) {
        Results results;
        for (double scale = 0.5; scale < 2; scale *= step) results.push_back(peer.look_up(lookups, scale));
        return [results](double) { return results; };
    };
    std::vector<Row> rows = {{"trilinear", ours({})},
                             {"`--aniso 16`", ours({.probes = 16})},
                             {"`--aniso 16 --lod-rule exact`", ours({.probes = 16, .lod_rule = texunit::LodRule::Exact})},
                             {"`--aniso 64 --lod-rule exact`", ours({.probes = 64, .lod_rule = texunit::LodRule::Exact})},
                             {"`--aniso 16:S2`", by_variance(16)},
                             {"`--aniso 32:S2`", by_variance(32)},
                             {"`--aniso 64:S2`", by_variance(64)},
                             {"`--ewa:S2`", exact}};
    if (texture_system != nullptr) rows.push_back({texture_system->name() + ", best scale", scaled(*texture_system, 1.05)});
    if (opengl != nullptr) rows.push_back({opengl->name() + ", best scale", scaled(*opengl, 1.15)});
    return rows;
}

int run(int argc, char** argv) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "rawtexel_anisotropy";
    std::filesystem::create_directories(folder);
    std::mt19937 random(1);
    std::vector<std::pair<std::string, std::vector<double>>> textures;
    if (argc > 2) {
        textures.emplace_back(std::filesystem::path(argv[2]).filename().string(), read_red_channel(argv[2], kExtent));
    } else {
        textures.emplace_back("White noise", white_noise(random));
        textures.emplace_back("Equal octaves", octave_noise(random));
    }
    for (const auto& [name, texels] : textures) {
        const Pyramid pyramid = make_pyramid(texels);
        const std::unique_ptr<texunit::Texture> texture = make_texture(pyramid);
        const Plane plane = make_plane(pyramid);
        const std::unique_ptr<PeerSampler> texture_system = make_texture_system_sampler(pyramid, 16, folder.string());
        const std::unique_ptr<PeerSampler> opengl = make_opengl_sampler(pyramid, 16);
        const auto table = [&](const std::string& title, const std::vector<Lookup>& lookups) {
            print_table(title.c_str(), plane, lookups, make_rows(*texture, texture_system.get(), opengl.get(), lookups));
        };
        if (argc > 1) {
            table(name + ", footprints of " + std::filesystem::path(argv[1]).filename().string(), read_footprints(argv[1]));
        } else {
            for (const double ratio : kRatios) table(name + ", ratio " + std::to_string(int(ratio)), make_footprints(ratio, random));
        }
    }
    std::filesystem::remove_all(folder);
    return 0;
}

}  // namespace
}  // namespace rawtexel::tools

int main(int argc, char** argv) {
    try {
        return rawtexel::tools::run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "rawtexel_anisotropy_table: error: %s\n", error.what());
        return 1;
    }
}
