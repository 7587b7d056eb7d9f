#include "cli/commands/compare.h"

#include "cli/comparable_image.h"
#include "cli/comparison_page.h"
#include "cli/comparison_report.h"
#include "cli/image_output.h"
#include "cli/metrics/metrics.h"
#include "cli/option_values.h"
#include "cli/output_files.h"
#include "cli/render_options.h"
#include "cli/reports/colour_map.h"
#include "cli/version.h"
#include "scenes/image_io.h"
#include "scenes/output_file.h"
#include "shading/display.h"
#include "shading/executor.h"

#include <algorithm>
#include <optional>
#include <span>

namespace rawtexel::cli {
namespace {

using shading::Image;

constexpr NumberRange kAtLeastZero{.lowest = 0.0f};

constexpr NumberRange kPixelsPerDegree{.lowest = float(kMinPixelsPerDegree), .highest = float(kMaxPixelsPerDegree)};

std::string print_extents(const Image& image) { return print(ImageSize{image.width, image.height}); }

scenes::Metadata map_metadata(const std::string& command) {
    return {{"Software", "rawtexel " + std::string(version())}, {"rawtexel:command", command}};
}

void write_difference(const std::string& path, const Image& difference, const std::string& command) {
    if (scenes::is_float_format(path)) return scenes::write_float(path, difference, {}, map_metadata(command));
    const std::vector<uint8_t> codes = shading::encode_8bit(difference, shading::Transfer::Linear);
    scenes::write_8bit(path, difference.width, difference.height, difference.channels, codes, map_metadata(command));
}

void write_flip_map(const std::string& path, const Image& map, const std::string& command) {
    if (scenes::is_float_format(path)) return scenes::write_float(path, map, {}, map_metadata(command));
    scenes::write_8bit(path, map.width, map.height, 3, magma_codes(map.values, 0.0, 1.0), map_metadata(command));
}

class CompareCommand : public Command {
  public:
    std::string_view name() const override { return "compare"; }
    std::string_view usage() const override { return "compare IMAGE REFERENCE [MORE...] [options]"; }
    std::string_view summary() const override {
        return "Measures how far images are from a reference: MSE, RMSE, PSNR (peak 1), relMSE, largest and mean difference of the colour "
               "channels, and FLIP, how different they look. Float images are compared as linear values, 8-bit images as display values "
               "from 0 to 1, shown over black where they are transparent.";
    }

    void declare(CommandLine& line) override {
        line.arguments("IMAGE REFERENCE [MORE...]",
                       "two or more images of the same extents; all but the second are held against the second", 2, size_t(-1), words_);
        line.option("-o,--output", "DIFF", "an image of the absolute differences of IMAGE",
                    [this](const std::string& text) { output_ = text; });
        line.option("--flip-map", "FILE", "the FLIP error of every pixel of IMAGE: from black to yellow in 8 bits, as it is in floats",
                    [this](const std::string& text) { flip_map_ = text; });
        line.flag("--json", "the figures as JSON instead of a table; infinite ones are null", json_);
        line.option("--csv", "FILE", "the figures as a comma-separated file", [this](const std::string& text) { csv_ = text; });
        line.option("--html", "FILE", "a page of the images under a slider, maps of their errors and the figures, all in one file",
                    [this](const std::string& text) { html_ = text; });
        line.option("--flip", "KIND",
                    "auto: hdr where both images hold linear light, else ldr; ldr: as they show on a screen; hdr: the worst of a range of "
                    "exposures; none (default auto)",
                    [this](const std::string& text) {
                        flip_.kind = parse_choice("--flip", text, {FlipKind::Auto, FlipKind::Ldr, FlipKind::Hdr, FlipKind::None});
                    });
        line.option(
            "--pixels-per-degree", "X",
            "how near FLIP's observer is, " + print(kPixelsPerDegree) + " (default 67.02: 0.7 m before a 3840-pixel screen of 0.7 m)",
            [this](const std::string& text) { pixels_per_degree_ = parse_number("--pixels-per-degree", text, kPixelsPerDegree); });
        line.option("--max-rmse", "X", "exit with 1 when the RMSE of any image is above X, " + print(kAtLeastZero),
                    [this](const std::string& text) { max_rmse_ = parse_number("--max-rmse", text, kAtLeastZero); });
        line.option("--min-psnr", "X", "exit with 1 when the PSNR of any image is below X dB, any number",
                    [this](const std::string& text) { min_psnr_ = parse_number("--min-psnr", text); });
        line.option("--max-flip", "X", "exit with 1 when the mean FLIP of any image is above X, " + print(kAtLeastZero),
                    [this](const std::string& text) { max_flip_ = parse_number("--max-flip", text, kAtLeastZero); });
    }

    int run(const Invocation& invocation) override {
        settle_flip();
        check_before_reading();
        const auto executor = shading::make_executor(shading::default_executor_kind(), 0);
        const std::string& reference_path = words_[1];
        const ComparableImage reference = read_comparable(reference_path);
        std::vector<Comparison> comparisons;
        std::vector<ComparedPicture> pictures;  // for the page alone
        for (size_t i = 0; i < words_.size(); ++i) {
            if (i == 1) {
                if (!html_.empty()) pictures.push_back({reference_path, reference, {}, true});
                continue;
            }
            ComparableImage test = read_comparable(words_[i]);
            comparisons.push_back(compare(words_[i], test, reference, *executor, invocation));
            if (i == 0) write_maps(test, reference, comparisons[0], invocation.command_line);
            auto& flip = comparisons.back().flip;
            if (!html_.empty()) pictures.push_back({words_[i], std::move(test), flip ? flip->map : Image{}, false});
            if (flip) flip->map = {};
        }
        if (!html_.empty()) write_text(html_, comparison_page(pictures, comparisons, invocation.command_line));
        invocation.out << (json_ ? print_json(reference_path, comparisons) : print_table(comparisons));
        if (!csv_.empty()) write_text(csv_, print_csv(reference_path, comparisons));
        return check(comparisons, invocation) ? kDone : kCheckFailed;
    }

  private:
    void settle_flip() {
        const std::pair<bool, const char*> asked[] = {{!flip_map_.empty(), "--flip-map"},
                                                      {pixels_per_degree_.has_value(), "--pixels-per-degree"},
                                                      {max_flip_.has_value(), "--max-flip"}};
        for (const auto& [given, option] : asked)
            if (given && flip_.kind == FlipKind::None) throw UsageError(std::string(option) + ": --flip none leaves FLIP out");
        if (pixels_per_degree_) flip_.pixels_per_degree = double(*pixels_per_degree_);
    }

    void check_before_reading() const {
        std::vector<OutputFile> outputs;
        for (const auto& [option, path] : {std::pair{"-o", output_}, std::pair{"--flip-map", flip_map_}}) {
            if (path.empty()) continue;
            check_image_format(option, path);
            outputs.push_back({option, path});
        }
        if (!csv_.empty()) outputs.push_back({"--csv", csv_});
        if (!html_.empty()) outputs.push_back({"--html", html_});
        check_outputs(outputs, words_);
    }

    static void write_text(const std::string& path, const std::string& text) { scenes::write_file(path, std::as_bytes(std::span(text))); }

    Comparison compare(const std::string& path, const ComparableImage& test, const ComparableImage& reference, shading::Executor& executor,
                       const Invocation& invocation) const {
        const Image& image = test.image;
        if (image.width != reference.image.width || image.height != reference.image.height)
            throw scenes::InputError(path + ": the extents differ from the reference's (found " + print_extents(image) + ", allowed " +
                                     print_extents(reference.image) + ")");
        if (test.linear != reference.linear)
            warn(invocation, path + " and " + words_[1] + ": one holds linear light and the other display values");
        const int channels = std::max(image.channels, reference.image.channels);
        Comparison comparison{
            path, image_error(with_channels(image, channels).values, with_channels(reference.image, channels).values), {}};
        if (flip_.kind != FlipKind::None) comparison.flip = flip_comparison(test, reference, flip_, executor);
        return comparison;
    }

    // Of the first image.
    void write_maps(const ComparableImage& test, const ComparableImage& reference, const Comparison& comparison,
                    const std::string& command) const {
        const int channels = std::max(test.image.channels, reference.image.channels);
        if (!output_.empty())
            write_difference(output_, absolute_difference(with_channels(test.image, channels), with_channels(reference.image, channels)),
                             command);
        if (flip_map_.empty()) return;
        if (comparison.flip->map.values.empty())
            throw scenes::InputError(words_[0] + " or " + words_[1] + ": FLIP has no map of images with values that are not finite");
        write_flip_map(flip_map_, comparison.flip->map, command);
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
            if (max_flip_ && !(comparison.flip->figures.mean <= double(*max_flip_)))
                report(comparison.path + ": FLIP " + print_figure(comparison.flip->figures.mean) + " (at most " + print_number(*max_flip_) +
                       ")");
        }
        return holds;
    }

    std::vector<std::string> words_;
    std::string output_, flip_map_, csv_, html_;
    bool json_ = false;
    FlipRequest flip_;
    std::optional<float> pixels_per_degree_;
    std::optional<float> max_rmse_, min_psnr_, max_flip_;
};

}  // namespace

std::unique_ptr<Command> make_compare_command() { return std::make_unique<CompareCommand>(); }

}  // namespace rawtexel::cli
