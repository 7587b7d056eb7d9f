#include "cli/comparison_page.h"

#include "cli/reports/colour_map.h"
#include "cli/reports/page.h"
#include "shading/display.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace rawtexel::cli {
namespace {

using shading::Image;

std::vector<uint8_t> shown_codes(const ComparableImage& image) {
    const Image colour = with_channels(image.image, 3);
    if (image.linear) return shading::encode_8bit(shading::tone_mapped(colour, {}), shading::Transfer::Srgb);
    return shading::encode_8bit(colour, shading::Transfer::Linear);
}

struct Differences {
    std::vector<float> largest;  ///< of a pixel's channels; what is not a number stays so
    double most = 0;             ///< of those that are finite
};

Differences differences_of(const Image& a, const Image& b) {
    Differences differences;
    for (size_t i = 0; i < a.values.size(); i += size_t(a.channels)) {
        double largest = 0;
        for (size_t c = 0; c < size_t(a.channels); ++c) {
            const double difference = std::abs(double(a.values[i + c]) - double(b.values[i + c]));
            if (!(difference <= largest)) largest = difference;
        }
        if (std::isfinite(largest)) differences.most = std::max(differences.most, largest);
        differences.largest.push_back(float(largest));
    }
    return differences;
}

}  // namespace

std::string comparison_page(const std::vector<ComparedPicture>& pictures, std::span<const Comparison> comparisons,
                            const std::string& command) {
    const auto reference = std::ranges::find(pictures, true, &ComparedPicture::reference);
    const int width = reference->image.image.width, height = reference->image.image.height;
    std::vector<Differences> differences(pictures.size());
    double range = 0;
    for (size_t i = 0; i < pictures.size(); ++i) {
        if (pictures[i].reference) continue;
        const int channels = std::max(pictures[i].image.image.channels, reference->image.image.channels);
        differences[i] = differences_of(with_channels(pictures[i].image.image, channels), with_channels(reference->image.image, channels));
        range = std::max(range, differences[i].most);
    }

    nlohmann::ordered_json data = comparison_json(reference->path, comparisons);
    data["command"] = command;
    data["width"] = width;
    data["height"] = height;
    data["absolute_range"] = range;
    data["tone_mapped"] = std::ranges::any_of(pictures, [](const ComparedPicture& picture) { return picture.image.linear; });
    data["pictures"] = nlohmann::ordered_json::array();
    for (size_t i = 0; i < pictures.size(); ++i) {
        const ComparedPicture& picture = pictures[i];
        nlohmann::ordered_json entry{{"name", picture.path}, {"reference", picture.reference}};
        entry["picture"] = picture_address(width, height, 3, shown_codes(picture.image));
        if (!picture.reference) entry["absolute"] = picture_address(width, height, 3, magma_codes(differences[i].largest, 0.0, range));
        if (!picture.flip.values.empty()) entry["flip"] = picture_address(width, height, 3, magma_codes(picture.flip.values, 0.0, 1.0));
        data["pictures"].push_back(std::move(entry));
    }
    return report_page("compare.html", std::move(data));
}

}  // namespace rawtexel::cli
