#include "cli/bench/findings.h"

#include "texunit/kernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace rawtexel::cli {
namespace {

using Group = std::vector<const Series*>;

std::string short_figure(double value) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.3g", value);
    return text.data();
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

std::string outlook(const Series& series) {
    switch (series.trend) {
        case Trend::Floor: return ", and more samples do not bring it below " + short_figure(*series.bias);
        case Trend::Flattens: return ", and flattens towards " + short_figure(*series.bias);
        case Trend::Falls: return series.slope ? ", and falls as samples^" + short_figure(series.slope->slope) : std::string();
        case Trend::Truth: return ", no further off than the truth can tell";
        case Trend::Unknown: break;
    }
    return "";
}

std::string count_of(size_t count, size_t all) {
    if (count == all) return all == 1 ? "the one setting" : "all " + std::to_string(all) + " settings";
    if (count == 0) return "none of " + std::to_string(all) + " settings";
    return std::to_string(count) + " of " + std::to_string(all) + " settings";
}

void describe_order(FindingKind kind, const std::string& filter, const Group& group, const SceneResults& results,
                    std::vector<Finding>& findings) {
    const Series* best = nearest(group, results);
    if (!best) return;
    const auto floors = size_t(std::ranges::count(group, Trend::Floor, &Series::trend));
    const Measurement& last = last_of(*best, results);
    const bool plural = floors != 1;
    std::string text = filter + (kind == FindingKind::Before ? ", filtered before shading: " : ", filtered after shading: ");
    text += count_of(floors, group.size()) + (plural ? " hit a floor. " : " hits a floor. ");
    text += "The nearest to the truth, " + best->name(false) + ", is at RMSE " + short_figure(last.error.rmse) + " with " +
            samples(last.spp) + outlook(*best) + ".";
    findings.push_back({kind, filter, text});
}

void compare_orders(const std::string& filter, const Group& before, const Group& after, const SceneResults& results,
                    std::vector<Finding>& findings) {
    const Series *first = nearest(before, results), *second = nearest(after, results);
    if (!first || !second) return;
    const double before_rmse = last_of(*first, results).error.rmse, after_rmse = last_of(*second, results).error.rmse;
    std::string text = filter + ": ";
    if (before_rmse == after_rmse) {
        text += "before and after shading are equally near to the truth.";
    } else {
        const bool after_wins = after_rmse < before_rmse;
        const double nearer = std::min(before_rmse, after_rmse), farther = std::max(before_rmse, after_rmse);
        text +=
            after_wins ? "filtered after shading it gets nearer to the truth, " : "filtered before shading it gets nearer to the truth, ";
        text += short_figure(nearer) + " against " + short_figure(farther);
        if (nearer > 0) text += ", " + short_figure(farther / nearer) + " times";
        text += ".";
    }
    findings.push_back({FindingKind::Orders, filter, text});
}

bool is_cubic(const std::string& filter) {
    const std::optional<texunit::Kernel> kernel = texunit::parse_kernel(filter);
    using enum texunit::KernelKind;
    return kernel && (kernel->kind == BSpline || kernel->kind == Mitchell || kernel->kind == CatmullRom);
}

void describe_one_tap(const Series& own, const SceneResults& results, const std::vector<Series>& series, std::vector<Finding>& findings) {
    const std::vector<OneTapDuel> duels = one_tap_duels(own, results, series);
    if (duels.empty()) return;
    const auto won = size_t(std::ranges::count_if(duels, &OneTapDuel::wins));
    const std::string name = "one-tap " + own.name();
    std::string text = won == duels.size() ? name + " has the fewest fetches at equal error, at "
                       : won == 0          ? name + " has the fewest fetches at none of "
                                           : name + " has the fewest fetches at ";
    text += won == duels.size() ? (duels.size() == 1 ? std::string("the one error") : "all " + std::to_string(won) + " errors")
            : won == 0          ? std::to_string(duels.size()) + " errors"
                                : std::to_string(won) + " of " + std::to_string(duels.size()) + " errors";
    text += " that it reaches";
    const auto at = [](const OneTapDuel& duel) { return "at RMSE " + short_figure(duel.rmse) + " (" + samples(duel.spp) + ")"; };
    // Won at the least error; lost where the rival reads the smallest share.
    const auto last_won = std::find_if(duels.rbegin(), duels.rend(), [](const OneTapDuel& duel) { return duel.wins(); });
    if (last_won != duels.rend()) {
        text += ": " + at(*last_won) + " it reads " + short_figure(last_won->fetches) + " texels a pixel, ";
        text += last_won->rival ? "the next, " + last_won->rival->name() + ", " + short_figure(last_won->rival_fetches)
                                : std::string("and nothing else gets there");
    }
    text += ".";
    const auto lost = std::ranges::min_element(
        duels, {}, [](const OneTapDuel& duel) { return duel.wins() ? INFINITY : duel.rival_fetches / duel.fetches; });
    if (!lost->wins())
        text += " It has not " + at(*lost) + ": there " + lost->rival->name() + " reads " + short_figure(lost->rival_fetches) + ", it " +
                short_figure(lost->fetches) + ".";
    if (const auto& all = duels.back().all_taps)
        text += " All taps of the kernel read " + short_figure(*all / duels.back().fetches) + " times as many " + at(duels.back()) + ".";
    findings.push_back({FindingKind::OneTap, own.filter, text});
}

}  // namespace

std::string_view to_string(FindingKind kind) {
    switch (kind) {
        case FindingKind::Before: return "before";
        case FindingKind::After: return "after";
        case FindingKind::Orders: return "orders";
        case FindingKind::OneTap: break;
    }
    return "one-tap";
}

std::vector<OneTapDuel> one_tap_duels(const Series& own, const SceneResults& results, const std::vector<Series>& series) {
    std::vector<OneTapDuel> duels;
    for (const size_t i : own.points) {
        const Measurement& one = results.measurements[i];
        if (!is_clear(one, results.truth_of(one))) continue;
        OneTapDuel duel{.rmse = one.error.rmse, .fetches = one.texels_per_pixel(), .spp = one.spp, .all_taps = {}};
        for (const Series& other : series) {
            const bool same_kernel = other.filter == own.filter && !other.ellipse;
            if ((same_kernel && other.one_tap) || other.hybrid_bias) continue;
            const std::optional<double> fetches = fetches_at(other, results, duel.rmse);
            if (!fetches) continue;
            if (!duel.rival || *fetches < duel.rival_fetches) duel.rival = &other, duel.rival_fetches = *fetches;
            const bool all_taps = same_kernel && other.estimator == "all";
            if (all_taps && (!duel.all_taps || *fetches < *duel.all_taps)) duel.all_taps = fetches;
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
        const Series* own = is_cubic(filter) ? nearest(one_tap, results) : nullptr;
        if (own) describe_one_tap(*own, results, series, findings);
    }
    return findings;
}

}  // namespace rawtexel::cli
