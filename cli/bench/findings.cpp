#include "cli/bench/findings.h"

#include "texunit/kernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace rawtexel::cli {
namespace {

using Group = std::vector<const Series*>;

constexpr double kEqual = 1.01;  ///< errors this near to each other are no difference

std::string short_figure(double value) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), std::abs(value) >= 1000 ? "%.0f" : "%.3g", value);
    return text.data();
}

std::string texels(double count) {
    const std::string figure = short_figure(count);
    return figure + (figure == "1" ? " texel" : " texels");
}

const Measurement& last_of(const Series& series, const SceneResults& results) { return results.measurements[series.points.back()]; }

std::string samples(int count) { return std::to_string(count) + (count == 1 ? " sample" : " samples"); }

/// Of the nearest at the most samples; null for none.
const Series* nearest(const Group& group, const SceneResults& results) {
    const Series* best = nullptr;
    for (const Series* series : group) {
        const double rmse = last_of(*series, results).error.rmse;
        if (std::isfinite(rmse) && (!best || rmse < last_of(*best, results).error.rmse)) best = series;
    }
    return best;
}

/// What becomes of the error, such as "0.526" of a floor, or "0.0972 with 256 samples, N^−0.55".
std::string outlook(const Series& series, const SceneResults& results) {
    const Measurement& last = last_of(series, results);
    const std::string reached = short_figure(last.error.rmse) + " with " + samples(last.spp);
    switch (series.trend) {
        case Trend::Floor: return short_figure(*series.bias);
        case Trend::Flattens: return reached + ", towards " + short_figure(*series.bias);
        case Trend::Falls: return reached + (series.slope ? ", " + print(*series.slope) : "");
        case Trend::Truth:
        case Trend::Unknown: break;
    }
    return reached;
}

/// "mip none · all (0.0952), mip linear · reservoir/jitter (0.825)": estimators that come to the same share their place.
std::string list_of(const Group& group, Trend trend, const SceneResults& results) {
    struct Entry {
        std::string minification, estimators, outlook;
    };
    std::vector<Entry> entries;
    for (const Series* series : group) {
        if (series->trend != trend) continue;
        const std::string text = outlook(*series, results);
        const auto same = std::ranges::find_if(
            entries, [&](const Entry& entry) { return entry.minification == series->minification && entry.outlook == text; });
        if (same == entries.end())
            entries.push_back({series->minification, series->estimator, text});
        else
            same->estimators += "/" + series->estimator;
    }
    std::string list;
    for (const Entry& entry : entries)
        list += (list.empty() ? "" : ", ") + entry.minification + " · " + entry.estimators + " (" + entry.outlook + ")";
    return list;
}

void describe_order(FindingKind kind, const std::string& filter, const Group& group, const SceneResults& results,
                    std::vector<Finding>& findings) {
    if (group.empty()) return;
    constexpr std::pair<Trend, const char*> kTrends[] = {{Trend::Floor, "hits a floor: "},
                                                         {Trend::Flattens, "flattens: "},
                                                         {Trend::Falls, "falls: "},
                                                         {Trend::Truth, "as near as this truth can tell: "},
                                                         {Trend::Unknown, "too few numbers to tell: "}};
    std::string text = filter + (kind == FindingKind::Before ? ", filtered before shading: " : ", filtered after shading: ");
    bool first = true;
    for (const auto& [trend, words] : kTrends) {
        const std::string list = list_of(group, trend, results);
        if (list.empty()) continue;
        text += (first ? "" : "; ") + (words + list);
        first = false;
    }
    findings.push_back({kind, filter, text + "."});
}

/// The nearest of a group with so many samples; null for none.
const Measurement* nearest_with(const Group& group, const SceneResults& results, int spp) {
    const Measurement* best = nullptr;
    for (const Series* series : group)
        for (const size_t i : series->points) {
            const Measurement& one = results.measurements[i];
            if (one.spp == spp && std::isfinite(one.error.rmse) && (!best || one.error.rmse < best->error.rmse)) best = &one;
        }
    return best;
}

std::string setting(const Measurement& one) { return one.minification + " · " + one.estimator; }

/// Whether the orders differ by themselves with so many samples: the nearest setting was measured in the other order, too, if it was with
/// any number of samples. Where shading every texel was left out for its cost, draws in its place are no match for all taps.
bool is_fair(const Group& before, const Group& after, const SceneResults& results, int spp) {
    const Measurement *first = nearest_with(before, results, spp), *second = nearest_with(after, results, spp);
    if (!first || !second) return false;
    const bool after_wins = second->error.rmse < first->error.rmse;
    const Measurement& near = after_wins ? *second : *first;
    const Group& others = after_wins ? before : after;
    const auto same = std::ranges::find_if(
        others, [&](const Series* series) { return series->minification == near.minification && series->estimator == near.estimator; });
    return same == others.end() || std::ranges::any_of((*same)->points, [&](size_t i) { return results.measurements[i].spp == spp; });
}

void compare_orders(const std::string& filter, const Group& before, const Group& after, const SceneResults& results,
                    std::vector<Finding>& findings) {
    int spp = 0;
    for (const Measurement& one : results.measurements)
        if (one.spp > spp && is_fair(before, after, results, one.spp)) spp = one.spp;
    if (spp == 0) return;
    const Measurement &first = *nearest_with(before, results, spp), &second = *nearest_with(after, results, spp);
    const bool after_wins = second.error.rmse < first.error.rmse;
    const Measurement &near = after_wins ? second : first, &far = after_wins ? first : second;
    std::string text = filter + ", with " + samples(spp) + ": ";
    const Truth& truth = results.truth_of(near);
    if (!is_clear(far, truth)) {
        text += "before and after shading are both as near as this truth can tell (" + short_figure(far.error.rmse) + ").";
    } else if (far.error.rmse <= kEqual * near.error.rmse) {
        text += "before and after shading are equally near to the truth (" + short_figure(near.error.rmse) + ").";
    } else {
        text += std::string("filtering ") + (after_wins ? "after" : "before") + " shading is ";
        if (is_clear(near, truth)) text += short_figure(far.error.rmse / near.error.rmse) + " times ";
        text += "nearer to the truth: " + short_figure(near.error.rmse) + " (" + setting(near) + ") against " +
                short_figure(far.error.rmse) + " (" + setting(far) + ").";
    }
    findings.push_back({FindingKind::Orders, filter, text});
}

void describe_truth(const std::string& filter, const SceneResults& results, std::vector<Finding>& findings) {
    const auto truth = std::ranges::find(results.truths, filter, &Truth::filter);
    if (truth == results.truths.end() || truth->standard_error <= truth->goal) return;
    findings.push_back({FindingKind::Truth, filter,
                        filter + ": its truth is known to " + short_figure(truth->standard_error) + " and not to the " +
                            short_figure(truth->goal) + " aimed at; errors below " + short_figure(kClearMultiple * truth->standard_error) +
                            " are its own."});
}

bool is_cubic(const std::string& filter) {
    const std::optional<texunit::Kernel> kernel = texunit::parse_kernel(filter);
    using enum texunit::KernelKind;
    return kernel && (kernel->kind == BSpline || kernel->kind == Mitchell || kernel->kind == CatmullRom);
}

void describe_one_tap(const Series& own, const SceneResults& results, const std::vector<Series>& series, bool other_kernels,
                      std::vector<Finding>& findings) {
    const std::vector<OneTapDuel> duels = one_tap_duels(own, results, series, other_kernels);
    if (duels.empty()) return;
    const auto won = size_t(std::ranges::count_if(duels, &OneTapDuel::wins));
    const std::string all = std::to_string(duels.size()), errors = duels.size() == 1 ? " error" : " errors";
    std::string text = "One-tap " + own.filter + " (" + own.minification + " · " + own.estimator + ") has ";
    text += won == 0 ? "not the fewest fetches at any of the " + all + errors
                     : "the fewest fetches at " + std::to_string(won) + " of " + all + errors;
    text += std::string(" that it reaches, against ") +
            (other_kernels ? "other kernels, each beside its own truth" : "more taps of its kernel");
    const auto at = [](const OneTapDuel& duel) { return "at RMSE " + short_figure(duel.rmse) + " (" + samples(duel.spp) + ")"; };
    // Won at the least error; lost where the rival reads the smallest share.
    const auto last_won = std::find_if(duels.rbegin(), duels.rend(), [](const OneTapDuel& duel) { return duel.wins(); });
    if (last_won != duels.rend()) {
        text += ": " + at(*last_won) + " it reads " + texels(last_won->fetches) + " a pixel, ";
        if (last_won->rival == nullptr)
            text += "and none of them gets there";
        else if (last_won->fetches == last_won->rival_fetches)
            text += "as many as " + last_won->rival->name();
        else
            text += last_won->rival->name() + " " + short_figure(last_won->rival_fetches);
    }
    text += ".";
    const auto lost = std::ranges::min_element(
        duels, {}, [](const OneTapDuel& duel) { return duel.wins() ? INFINITY : duel.rival_fetches / duel.fetches; });
    if (!lost->wins())
        text += " It has not " + at(*lost) + ": there " + lost->rival->name() + " reads " + short_figure(lost->rival_fetches) + ", it " +
                short_figure(lost->fetches) + ".";
    findings.push_back({other_kernels ? FindingKind::OneTapOthers : FindingKind::OneTap, own.filter, text});
}

}  // namespace

std::string_view to_string(FindingKind kind) {
    switch (kind) {
        case FindingKind::Before: return "before";
        case FindingKind::After: return "after";
        case FindingKind::Orders: return "orders";
        case FindingKind::OneTap: return "one-tap";
        case FindingKind::OneTapOthers: return "one-tap-others";
        case FindingKind::Truth: break;
    }
    return "truth";
}

std::vector<OneTapDuel> one_tap_duels(const Series& own, const SceneResults& results, const std::vector<Series>& series,
                                      bool other_kernels) {
    std::vector<OneTapDuel> duels;
    for (const size_t i : own.points) {
        const Measurement& one = results.measurements[i];
        if (!is_clear(one, results.truth_of(one))) continue;
        OneTapDuel duel{.rmse = one.error.rmse, .fetches = one.texels_per_pixel(), .spp = one.spp};
        for (const Series& other : series) {
            const bool same_kernel = other.filter == own.filter && !other.ellipse;
            if (same_kernel == other_kernels || other.hybrid_bias || (same_kernel && other.one_tap)) continue;
            const std::optional<double> fetches = fetches_at(other, results, duel.rmse);
            if (fetches && (!duel.rival || *fetches < duel.rival_fetches)) duel.rival = &other, duel.rival_fetches = *fetches;
        }
        duels.push_back(duel);
    }
    return duels;
}

std::vector<Finding> findings_of(const SceneResults& results, const std::vector<Series>& series) {
    std::vector<std::string> filters;
    for (const Series& one : series)
        if (std::ranges::find(filters, one.filter) == filters.end()) filters.push_back(one.filter);
    std::vector<Finding> findings;
    for (const std::string& filter : filters) {
        Group before, after, one_tap;
        for (const Series& one : series) {
            if (one.filter != filter || one.hybrid_bias) continue;
            (one.order == "before" ? before : after).push_back(&one);
            if (one.one_tap && one.order == "after" && !one.ellipse) one_tap.push_back(&one);
        }
        describe_order(FindingKind::Before, filter, before, results, findings);
        describe_order(FindingKind::After, filter, after, results, findings);
        compare_orders(filter, before, after, results, findings);
        describe_truth(filter, results, findings);
        const Series* own = is_cubic(filter) ? nearest(one_tap, results) : nullptr;
        if (!own) continue;
        describe_one_tap(*own, results, series, false, findings);
        if (filters.size() > 1) describe_one_tap(*own, results, series, true, findings);
    }
    return findings;
}

}  // namespace rawtexel::cli
