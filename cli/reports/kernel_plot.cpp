#include "cli/reports/kernel_plot.h"

#include "texunit/lookup_trace.h"
#include "texunit/memory_source.h"

#include <memory>

namespace rawtexel::cli {
namespace {

constexpr int kExtent = 32, kTexel = kExtent / 2;
constexpr int kSteps = 32;  ///< a texel
constexpr int kReach = 4;   ///< texels

double weight_at(texunit::Texture& texture, const texunit::SamplerState& sampler, double distance) {
    const double place = (kTexel + 0.5 - distance) / kExtent;
    double weight = 0;
    for (const texunit::TracedTap& tap : trace_lookup(texture, sampler, {float(place), 0.5f}).taps)
        if (tap.x == kTexel) weight += tap.weight;
    return weight;
}

}  // namespace

Plot kernel_plot(std::span<const texunit::Kernel> kernels) {
    // One row that repeats: the other axis weighs 1 in all.
    texunit::Texture row("row", texunit::make_memory_source(texunit::Format::R8Unorm, kExtent, 1, std::vector<std::byte>(kExtent)));
    Plot plot{.title = "Weights of texels", .x = {"distance of the texel's centre (texels)"}, .y = {"weight along an axis"}, .series = {}};
    for (const texunit::Kernel& kernel : kernels) {
        texunit::SamplerState sampler;
        sampler.magnify = sampler.minify = kernel;
        sampler.mip = texunit::MipMode::None;
        PlotSeries& series = plot.series.emplace_back(PlotSeries{.name = to_string(kernel), .points = {}});
        for (int k = -kReach * kSteps; k <= kReach * kSteps; ++k) {
            const double distance = double(k) / kSteps;
            series.points.push_back({distance, weight_at(row, sampler, distance)});
        }
    }
    return plot;
}

}  // namespace rawtexel::cli
