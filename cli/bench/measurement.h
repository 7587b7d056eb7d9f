// What was measured of one configuration, and of the truth that it is held against.
#pragma once

#include "cli/bench/configuration.h"
#include "cli/metrics/metrics.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rawtexel::cli {

/// The truth of a scene under a kernel.
struct Truth {
    std::string scene, filter;  ///< as given; as print_filter spells it
    std::string picture;        ///< its file, from the sweep's folder
    std::string command;        ///< that renders it
    uint32_t seed = 0;          ///< another than the configurations', so that no sample is shared
    int samples = 0;            ///< per pixel
    double goal = 0, standard_error = 0;
    double seconds = 0;
};

/// Errors are held against the truth of the scene under the same kernel.
struct Measurement {
    std::string scene;
    std::string filter, minification, estimator, order;  ///< as printed
    int spp = 0;
    std::optional<float> hybrid_bias;
    bool one_tap = false;
    bool ellipse = false;
    std::string options;  ///< those of its configuration
    std::string command;  ///< that renders its picture
    std::string picture;  ///< its file, from the sweep's folder
    int width = 0, height = 0;
    uint64_t samples_shaded = 0;
    std::optional<double> mean_spp;  ///< of --adaptive, where `spp` is the most
    ImageError error;
    double flip = 0;  ///< mean; NaN where an image holds what is not finite
    std::string flip_kind;
    std::vector<double> frame_s, geometry_s, raster_s, shade_s;  ///< of each timed frame
    nlohmann::ordered_json texture;                              ///< `texture` of render --stats --count, without what was performed
    double lines_per_pixel = 0;                                  ///< distinct 64-byte lines of a pixel, the mean over pixels

    double texels_per_pixel() const;
    double frame_median() const;
    /// (largest - least) / median of the frames' times.
    double frame_spread() const;
};

/// Errors below this many standard errors of the truth may be the truth's own: the square of an error holds that of the truth, which then
/// is up to a ninth of it.
inline constexpr double kClearMultiple = 3;
bool is_clear(const Measurement& measurement, const Truth& truth);

// Lines of the sweep's file. What is not finite is null; the readers throw nlohmann::json::exception for what is no such line.
nlohmann::ordered_json to_json(const Truth& truth);
nlohmann::ordered_json to_json(const Measurement& measurement);
Truth truth_from(const nlohmann::ordered_json& json);
Measurement measurement_from(const nlohmann::ordered_json& json);

}  // namespace rawtexel::cli
