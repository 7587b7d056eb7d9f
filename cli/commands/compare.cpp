#include "cli/commands/compare.h"

#include "cli/comparable_image.h"
#include "cli/comparison_report.h"
#include "cli/image_output.h"
#include "cli/metrics/metrics.h"
#include "cli/option_values.h"
#include "cli/output_files.h"
#include "cli/render_options.h"
#include "cli/version.h"
#include "scenes/image_io.h"
#include "scenes/output_file.h"
#include "shading/display.h"

#include <algorithm>
#include <optional>
#include <span>

namespace rawtexel::cli {
namespace {

using shading::Image;

constexpr NumberRange kAtLeastZero{.lowest = 0.0f};

std::string print_extents(const Image& image) { return print(ImageSize{image.width, image.height}); }

void write_difference(const std::string& path, const Image& difference, const std::string& command) {
    const scenes::Metadata metadata{{"Software", "rawtexel " + std::string(version())}, {"rawtexel:command", command}};
    if (scenes::is_float_format(path)) return scenes::write_float(path, difference, {}, metadata);
    const std::vector<uint8_t> codes = shading::encode_8bit(difference, shading::Transfer::Linear);
    scenes::write_8bit(path, difference.width, difference.height, difference.channels, codes, metadata);
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
        line.option("--max-rmse", "X", "exit with 1 when the RMSE of any image is above X, " + print(kAtLeastZero),
                    [this](const std::string& text) { max_rmse_ = parse_number("--max-rmse", text, kAtLeastZero); });
        line.option("--min-psnr", "X", "exit with 1 when the PSNR of any image is below X dB, any number",
                    [this](const std::string& text) { min_psnr_ = parse_number("--min-psnr", text); });
    }

    int run(const Invocation& invocation) override {
        check_before_reading();
        const std::string& reference_path = words_[1];
        const Image reference = read_comparable(reference_path);
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
    void check_before_reading() const {
        std::vector<OutputFile> outputs;
        if (!output_.empty()) {
            check_image_format("-o", output_);
            outputs.push_back({"-o", output_});
        }
        if (!csv_.empty()) outputs.push_back({"--csv", csv_});
        check_outputs(outputs, words_);
    }

    void write_csv(const std::string& reference, const std::vector<Comparison>& comparisons) const {
        const std::string text = print_csv(reference, comparisons);
        scenes::write_file(csv_, std::as_bytes(std::span(text)));
    }

    Comparison compare(const std::string& path, const Image& reference, bool is_first, const std::string& command) const {
        const Image image = read_comparable(path);
        if (image.width != reference.width || image.height != reference.height)
            throw scenes::InputError(path + ": the extents differ from the reference's (found " + print_extents(image) + ", allowed " +
                                     print_extents(reference) + ")");
        const int channels = std::max(image.channels, reference.channels);
        const Image test_values = with_channels(image, channels), reference_values = with_channels(reference, channels);
        if (is_first && !output_.empty()) write_difference(output_, absolute_difference(test_values, reference_values), command);
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
