#include "cli/comparison_report.h"

#include "cli/version.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdio>

namespace rawtexel::cli {
namespace {

constexpr std::array<const char*, 6> kColumns{"mse", "rmse", "psnr", "relmse", "max", "mean"};

std::array<double, 6> figures(const ImageError& error) { return {error.mse, error.rmse, error.psnr, error.rel_mse, error.max, error.mean}; }

// RFC 4180: quotes around what holds a comma, a quote or a line end; quotes doubled.
std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

}  // namespace

std::string print_table(std::span<const Comparison> comparisons) {
    size_t path_width = 5;
    for (const Comparison& comparison : comparisons) path_width = std::max(path_width, comparison.path.size());
    const auto padded = [](const std::string& text, size_t width) { return std::string(width - std::min(width, text.size()), ' ') + text; };
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

std::string print_json(const std::string& reference, std::span<const Comparison> comparisons) {
    nlohmann::ordered_json json{{"rawtexel", version()}, {"reference", reference}, {"images", nlohmann::ordered_json::array()}};
    for (const Comparison& comparison : comparisons) {
        nlohmann::ordered_json entry{{"image", comparison.path}};
        const std::array<double, 6> values = figures(comparison.error);
        for (size_t i = 0; i < kColumns.size(); ++i) entry[kColumns[i]] = values[i];
        json["images"].push_back(std::move(entry));
    }
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string print_csv(const std::string& reference, std::span<const Comparison> comparisons) {
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

std::string print_figure(double value) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.6g", value);
    return text.data();
}

}  // namespace rawtexel::cli
