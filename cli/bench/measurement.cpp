#include "cli/bench/measurement.h"

#include "cli/bench/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rawtexel::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

double number(const Json& json, const char* key) { return json.at(key).is_null() ? kNan : json.at(key).get<double>(); }

}  // namespace

double Measurement::texels_per_pixel() const { return texture.at("texels_requested").get<double>() / (double(width) * height); }

double Measurement::frame_median() const { return median(frame_s); }

double Measurement::frame_spread() const { return (std::ranges::max(frame_s) - std::ranges::min(frame_s)) / frame_median(); }

bool is_clear(const Measurement& measurement, const Truth& truth) {
    return measurement.error.rmse >= kClearMultiple * truth.standard_error;
}

Json to_json(const Truth& truth) {
    return {{"scene", truth.scene},    {"filter", truth.filter}, {"picture", truth.picture}, {"command", truth.command},
            {"seed", truth.seed},      {"spp", truth.samples},   {"goal", truth.goal},       {"standard_error", truth.standard_error},
            {"seconds", truth.seconds}};
}

Truth truth_from(const Json& json) {
    Truth truth;
    truth.scene = json.at("scene");
    truth.filter = json.at("filter");
    truth.picture = json.at("picture");
    truth.command = json.at("command");
    truth.seed = json.at("seed");
    truth.samples = json.at("spp");
    truth.goal = number(json, "goal");
    truth.standard_error = number(json, "standard_error");
    truth.seconds = number(json, "seconds");
    return truth;
}

Json to_json(const Measurement& one) {
    const ImageError& error = one.error;
    Json json{{"scene", one.scene},
              {"filter", one.filter},
              {"minification", one.minification},
              {"estimator", one.estimator},
              {"order", one.order},
              {"spp", one.spp},
              {"hybrid_bias", one.hybrid_bias ? Json(*one.hybrid_bias) : Json()},
              {"one_tap", one.one_tap},
              {"ewa", one.ellipse},
              {"options", one.options},
              {"command", one.command},
              {"picture", one.picture},
              {"image", {{"width", one.width}, {"height", one.height}, {"spp", one.spp}, {"samples_shaded", one.samples_shaded}}},
              {"mse", error.mse},
              {"rmse", error.rmse},
              {"psnr", error.psnr},
              {"relmse", error.rel_mse},
              {"max", error.max},
              {"mean", error.mean},
              {"flip", one.flip},
              {"flip_kind", one.flip_kind},
              {"times", {{"frame", one.frame_s}, {"geometry", one.geometry_s}, {"raster", one.raster_s}, {"shade", one.shade_s}}},
              {"lines_per_pixel", one.lines_per_pixel},
              {"texture", one.texture}};
    if (one.mean_spp) json["image"]["mean_spp"] = *one.mean_spp;
    return json;
}

Measurement measurement_from(const Json& json) {
    Measurement one;
    one.scene = json.at("scene");
    one.filter = json.at("filter");
    one.minification = json.at("minification");
    one.estimator = json.at("estimator");
    one.order = json.at("order");
    one.spp = json.at("spp");
    if (!json.at("hybrid_bias").is_null()) one.hybrid_bias = json.at("hybrid_bias").get<float>();
    one.one_tap = json.at("one_tap");
    one.ellipse = json.at("ewa");
    one.options = json.at("options");
    one.command = json.at("command");
    one.picture = json.at("picture");
    const Json& image = json.at("image");
    one.width = image.at("width");
    one.height = image.at("height");
    one.samples_shaded = image.at("samples_shaded");
    if (image.contains("mean_spp")) one.mean_spp = image.at("mean_spp").get<double>();
    one.error = {number(json, "mse"),  number(json, "rmse"), number(json, "relmse"),
                 number(json, "psnr"), number(json, "max"),  number(json, "mean")};
    // Of equal images JSON has none.
    if (one.error.mse == 0) one.error.psnr = std::numeric_limits<double>::infinity();
    one.flip = number(json, "flip");
    one.flip_kind = json.at("flip_kind");
    const Json& times = json.at("times");
    one.frame_s = times.at("frame").get<std::vector<double>>();
    one.geometry_s = times.at("geometry").get<std::vector<double>>();
    one.raster_s = times.at("raster").get<std::vector<double>>();
    one.shade_s = times.at("shade").get<std::vector<double>>();
    one.lines_per_pixel = number(json, "lines_per_pixel");
    one.texture = json.at("texture");
    return one;
}

}  // namespace rawtexel::cli
