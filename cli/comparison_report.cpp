#include "cli/comparison_report.h"

#include "cli/csv_text.h"
#include "cli/version.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <vector>

namespace rawtexel::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 6> kColumns{"mse", "rmse", "psnr", "relmse", "max", "mean"};
constexpr std::array<const char*, 6> kFlipColumns{"flip", "flip_q1", "flip_median", "flip_q3", "flip_min", "flip_max"};

std::array<double, 6> figures(const ImageError& error) { return {error.mse, error.rmse, error.psnr, error.rel_mse, error.max, error.mean}; }

std::array<double, 6> figures(const FlipFigures& flip) {
    return {flip.mean, flip.weighted_q1, flip.weighted_median, flip.weighted_q3, flip.min, flip.max};
}

// Cells of text under a heading: the first column to the left, the others to the right.
std::string aligned(std::span<const std::vector<std::string>> rows) {
    std::vector<size_t> widths(rows.front().size(), 0);
    for (const std::vector<std::string>& row : rows)
        for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    std::string text;
    for (const std::vector<std::string>& row : rows) {
        text += row[0] + std::string(widths[0] - row[0].size(), ' ');
        for (size_t i = 1; i < row.size(); ++i) text += "  " + std::string(widths[i] - row[i].size(), ' ') + row[i];
        text += "\n";
    }
    return text;
}

std::string print_17(double value) {
    std::array<char, 32> number;
    std::snprintf(number.data(), number.size(), "%.17g", value);
    return number.data();
}

std::string print_flip_table(std::span<const Comparison> comparisons) {
    std::vector<std::vector<std::string>> rows{{"image", "kind", "mean", "quartile 1", "median", "quartile 3", "min", "max"}};
    for (const Comparison& comparison : comparisons) {
        std::vector<std::string>& row = rows.emplace_back();
        row = {comparison.path, std::string(to_string(comparison.flip->kind))};
        for (const double figure : figures(comparison.flip->figures)) row.push_back(print_figure(figure));
    }
    std::string text = "FLIP, weighted by error, at " + print_figure(comparisons.front().flip->pixels_per_degree) + " pixels per degree\n";
    text += aligned(rows);
    for (const Comparison& comparison : comparisons)
        if (const auto& exposures = comparison.flip->exposures)
            return text + "exposures of hdr: " + print_figure(exposures->start) + " to " + print_figure(exposures->stop) + ", " +
                   std::to_string(exposures->count) + " of them\n";
    return text;
}

}  // namespace

std::string print_table(std::span<const Comparison> comparisons) {
    std::vector<std::vector<std::string>> rows(1, {"image"});
    rows[0].insert(rows[0].end(), kColumns.begin(), kColumns.end());
    for (const Comparison& comparison : comparisons) {
        std::vector<std::string>& row = rows.emplace_back(1, comparison.path);
        for (const double figure : figures(comparison.error)) row.push_back(print_figure(figure));
    }
    return aligned(rows) + (comparisons.front().flip ? "\n" + print_flip_table(comparisons) : "");
}

Json comparison_json(const std::string& reference, std::span<const Comparison> comparisons) {
    Json json{{"rawtexel", version()}, {"reference", reference}, {"images", Json::array()}};
    for (const Comparison& comparison : comparisons) {
        Json entry{{"image", comparison.path}};
        const std::array<double, 6> values = figures(comparison.error);
        for (size_t i = 0; i < kColumns.size(); ++i) entry[kColumns[i]] = values[i];
        if (const auto& flip = comparison.flip) {
            const std::array<double, 6> looks = figures(flip->figures);
            for (size_t i = 0; i < kFlipColumns.size(); ++i) entry[kFlipColumns[i]] = looks[i];
            entry["flip_kind"] = to_string(flip->kind);
            entry["flip_pixels_per_degree"] = flip->pixels_per_degree;
            if (flip->exposures)
                entry["flip_exposures"] = {
                    {"start", flip->exposures->start}, {"stop", flip->exposures->stop}, {"count", flip->exposures->count}};
        }
        json["images"].push_back(std::move(entry));
    }
    return json;
}

std::string print_json(const std::string& reference, std::span<const Comparison> comparisons) {
    return comparison_json(reference, comparisons).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string print_csv(const std::string& reference, std::span<const Comparison> comparisons) {
    std::string text = "image,reference";
    for (const char* column : kColumns) text += std::string(",") + column;
    for (const char* column : kFlipColumns) text += std::string(",") + column;
    text += ",flip_kind\n";
    for (const Comparison& comparison : comparisons) {
        text += csv_field(comparison.path) + "," + csv_field(reference);
        for (const double figure : figures(comparison.error)) text += "," + print_17(figure);
        if (const auto& flip = comparison.flip) {
            for (const double figure : figures(flip->figures)) text += "," + print_17(figure);
            text += "," + std::string(to_string(flip->kind));
        } else {
            text += std::string(kFlipColumns.size() + 1, ',');
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
