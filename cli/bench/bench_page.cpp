#include "cli/bench/bench_page.h"

#include "cli/comparable_image.h"
#include "cli/profile_page.h"
#include "cli/reports/page.h"

#include <nlohmann/json.hpp>

namespace rawtexel::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMostPixels = 16e6;  ///< of all pictures on a page

struct Picture {
    std::string file;
    Json* place;
};

}  // namespace

std::string bench_page(const std::string& folder, std::span<const SceneResults> scenes, std::span<const SceneAnalysis> analyses,
                       std::span<const std::vector<BenchPlot>> plots, Json bench, const ToneOptions& tone, shading::Executor& executor) {
    double pixels = 0;
    for (const SceneResults& scene : scenes)
        for (const Measurement& one : scene.measurements) pixels += double(one.width) * one.height;
    const bool all = pixels <= kMostPixels;

    std::vector<Picture> pictures;
    Json& configurations = bench["configurations"];
    size_t first = 0;
    for (size_t s = 0; s < scenes.size(); ++s) {
        // Members first, pictures then: an object that grows moves what it holds.
        Json& scene = bench["scenes"][s];
        Json& drawn = scene["plots"] = Json::array();
        for (const BenchPlot& plot : plots[s])
            drawn.push_back({{"kind", plot.kind}, {"filter", plot.filter}, {"svg", plot_svg(plot.plot)}});
        for (Json& truth : scene["truths"]) pictures.push_back({truth.at("picture"), &(truth["source"] = "")});
        std::vector<bool> shown(scenes[s].measurements.size(), all);
        for (const Series& series : analyses[s].series) shown[series.points.back()] = true;
        for (size_t i = 0; i < shown.size(); ++i)
            if (shown[i] || analyses[s].fronts.time[i] || analyses[s].fronts.fetches[i]) {
                Json& one = configurations[first + i];
                pictures.push_back({one.at("picture"), &(one["source"] = "")});
            }
        first += shown.size();
    }
    executor.parallel_for(int64_t(pictures.size()), [&](int64_t index, int) {
        const Picture& picture = pictures[size_t(index)];
        const shading::Image image = with_channels(read_comparable(folder + "/" + picture.file).image, 3);
        *picture.place = picture_address(image.width, image.height, 3, display_codes(image, tone));
    });
    return report_page("bench.html", std::move(bench));
}

}  // namespace rawtexel::cli
