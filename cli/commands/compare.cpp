#include "cli/commands/compare.h"

#include "cli/image_output.h"
#include "cli/metrics/metrics.h"
#include "cli/option_values.h"
#include "cli/output_check.h"
#include "cli/version.h"
#include "scenes/image_io.h"
#include "scenes/output_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <span>

namespace rawtexel::cli {
namespace {

using shading::Image;

struct Comparison {
    std::string path;
    ImageError error;
};

// The colour channels as they show over black; further layers are left out. Float formats hold colour times alpha
// already, the others do not.
Image read_colour(const std::string& path) {
    const Image whole = scenes::read_image(path, /*srgb_integers=*/false);
    const int channels = whole.channels >= 3 ? 3 : 1;
    const bool has_alpha = whole.channels == channels + 1 && !scenes::is_float_format(path);
    Image colour(whole.width, whole.height, channels);
    for (int y = 0; y < whole.height; ++y)
        for (int x = 0; x < whole.width; ++x) {
            const float* from = whole.pixel(x, y);
            const float alpha = has_alpha ? from[channels] : 1.0f;
            std::transform(from, from + channels, colour.pixel(x, y), [&](float value) { return value * alpha; });
        }
    return colour;
}

// Grey as r = g = b, so that it compares with colour.
Image with_channels(Image image, int channels) {
    if (image.channels == channels) return image;
    Image wide(image.width, image.height, channels);
    for (size_t i = 0; i < wide.values.size(); ++i) wide.values[i] = image.values[i / size_t(channels)];
    return wide;
}

std::string print_extents(const Image& image) { return std::to_string(image.width) + "x" + std::to_string(image.height); }

std::string print_figure(double value) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.6g", value);
    return text.data();
}

constexpr std::array<const char*, 6> kColumns{"mse", "rmse", "psnr", "relmse", "max", "mean"};

std::array<double, 6> figures(const ImageError& error) { return {error.mse, error.rmse, error.psnr, error.rel_mse, error.max, error.mean}; }

std::string print_table(const std::vector<Comparison>& comparisons) {
    size_t path_width = 5;
    for (const Comparison& comparison : comparisons) path_width = std::max(path_width, comparison.path.size());
    const auto padded = [](std::string text, size_t width) { return std::string(width - std::min(width, text.size()), ' ') + text; };
    std::string text = "image" + std::string(path_width - 5, ' ');
    for (const char* column : kColumns) text += padded(column, 14);
    text += "\n";
    for (const Comparison& comparison : comparisons) {
        text += comparison.path + std::string(path_width - comparison.path.size(), ' ');
        for (const double figure : figures(comparison.error)) text += padded(print_figure(figure), 14);
        text += "\n";
    }
    return text;
}

// JSON knows no infinity: the PSNR of equal images is null, and so is every figure of images that hold what is not a number.
std::string print_json(const std::string& reference, const std::vector<Comparison>& comparisons) {
    nlohmann::ordered_json json{{"rawtexel", version()}, {"reference", reference}, {"images", nlohmann::ordered_json::array()}};
    for (const Comparison& comparison : comparisons) {
        nlohmann::ordered_json entry{{"image", comparison.path}};
        const std::array<double, 6> values = figures(comparison.error);
        for (size_t i = 0; i < kColumns.size(); ++i) entry[kColumns[i]] = values[i];
        json["images"].push_back(std::move(entry));
    }
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

// RFC 4180: quotes around what holds a comma, a quote or a line end; quotes doubled.
std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

std::string print_csv(const std::string& reference, const std::vector<Comparison>& comparisons) {
    std::string text = "image,reference";
    for (const char* column : kColumns) text += std::string(",") + column;
    text += "\n";
    for (const Comparison& comparison : comparisons) {
        text += csv_field(comparison.path) + "," + csv_field(reference);
        for (const double figure : figures(comparison.error)) {
            std::array<char, 32> number;
            std::snprintf(number.data(), number.size(), ",%.17g", figure);
            text += number.data();
        }
        text += "\n";
    }
    return text;
}

void write_difference(const std::string& path, const Image& image, const Image& reference, const std::string& command) {
    Image difference(image.width, image.height, image.channels);
    for (size_t i = 0; i < image.values.size(); ++i) difference.values[i] = std::abs(image.values[i] - reference.values[i]);
    const scenes::Metadata metadata{{"Software", "rawtexel " + std::string(version())}, {"rawtexel:command", command}};
    if (scenes::is_float_format(path)) return scenes::write_float(path, difference, {}, metadata);
    const std::vector<uint8_t> codes = shading::encode_8bit(difference, shading::Transfer::Linear);
    scenes::write_8bit(path, difference.width, difference.height, difference.channels, codes, metadata);
}

// Formats that hold nothing but floats, against those that never do: linear light against display values.
bool mixes_linear_and_display(const std::string& a, const std::string& b) {
    const auto is_tiff = [](const std::string& path) { return path.ends_with(".tif") || path.ends_with(".tiff"); };
    return !is_tiff(a) && !is_tiff(b) && scenes::is_float_format(a) != scenes::is_float_format(b);
}

class CompareCommand : public Command {
  public:
    std::string_view name() const override { return "compare"; }
    std::string_view usage() const override { return "compare IMAGE REFERENCE [MORE...] [options]"; }
    std::string_view summary() const override {
        return "Measures how far images are from a reference: MSE, RMSE, PSNR (peak 1), relMSE, largest and mean difference of the colour "
               "channels. Float images are compared as linear values, 8-bit images as display values from 0 to 1, shown over black "
               "where they are transparent.";
    }

    void declare(CommandLine& line) override {
        line.arguments("IMAGE REFERENCE [MORE...]",
                       "two or more images of the same extents; all but the second are held against the second", 2, size_t(-1), words_);
        line.option("-o,--output", "DIFF", "an image of the absolute differences of IMAGE",
                    [this](const std::string& text) { output_ = text; });
        line.flag("--json", "the figures as JSON instead of a table; infinite ones are null", json_);
        line.option("--csv", "FILE", "the figures as a comma-separated file", [this](const std::string& text) { csv_ = text; });
        line.option("--max-rmse", "X", "exit with 1 when the RMSE of any image is above X",
                    [this](const std::string& text) { max_rmse_ = parse_number("--max-rmse", text, 0.0f); });
        line.option("--min-psnr", "X", "exit with 1 when the PSNR of any image is below X dB",
                    [this](const std::string& text) { min_psnr_ = parse_number("--min-psnr", text); });
    }

    int run(const Invocation& invocation) override {
        check_outputs();
        const std::string& reference_path = words_[1];
        const Image reference = read_colour(reference_path);
        std::vector<Comparison> comparisons;
        for (size_t i = 0; i < words_.size(); ++i) {
            if (i == 1) continue;
            if (mixes_linear_and_display(words_[i], reference_path))
                warn(invocation, words_[i] + " and " + reference_path + ": one holds linear light and the other display values");
            comparisons.push_back(compare(words_[i], reference, i == 0, invocation.command_line));
        }
        invocation.out << (json_ ? print_json(reference_path, comparisons) : print_table(comparisons));
        if (!csv_.empty()) write_csv(reference_path, comparisons);
        return check(comparisons, invocation) ? kDone : kCheckFailed;
    }

  private:
    void check_outputs() const {
        if (!output_.empty()) {
            check_image_format("-o", output_);
            check_output(output_);
        }
        if (!csv_.empty()) check_output(csv_);
    }

    void write_csv(const std::string& reference, const std::vector<Comparison>& comparisons) const {
        const std::string text = print_csv(reference, comparisons);
        scenes::write_file(csv_, std::as_bytes(std::span(text)));
    }

    Comparison compare(const std::string& path, const Image& reference, bool is_first, const std::string& command) const {
        const Image image = read_colour(path);
        if (image.width != reference.width || image.height != reference.height)
            throw scenes::InputError(path + ": the extents differ from the reference's (found " + print_extents(image) + ", allowed " +
                                     print_extents(reference) + ")");
        const int channels = std::max(image.channels, reference.channels);
        const Image test_values = with_channels(image, channels), reference_values = with_channels(reference, channels);
        if (is_first && !output_.empty()) write_difference(output_, test_values, reference_values, command);
        return {path, image_error(test_values.values, reference_values.values)};
    }

    // Written so that a figure that is not a number fails.
    bool check(const std::vector<Comparison>& comparisons, const Invocation& invocation) const {
        bool holds = true;
        const auto report = [&](const std::string& what) {
            invocation.err << "rawtexel: check failed: " << what << '\n';
            holds = false;
        };
        for (const Comparison& comparison : comparisons) {
            const ImageError& error = comparison.error;
            if (max_rmse_ && !(error.rmse <= double(*max_rmse_)))
                report(comparison.path + ": RMSE " + print_figure(error.rmse) + " (at most " + print_number(*max_rmse_) + ")");
            if (min_psnr_ && !(error.psnr >= double(*min_psnr_)))
                report(comparison.path + ": PSNR " + print_figure(error.psnr) + " dB (at least " + print_number(*min_psnr_) + ")");
        }
        return holds;
    }

    std::vector<std::string> words_;
    std::string output_, csv_;
    bool json_ = false;
    std::optional<float> max_rmse_, min_psnr_;
};

}  // namespace

std::unique_ptr<Command> make_compare_command() { return std::make_unique<CompareCommand>(); }

}  // namespace rawtexel::cli
