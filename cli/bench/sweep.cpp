#include "cli/bench/sweep.h"

#include "cli/filtering_options.h"
#include "cli/footprint_options.h"
#include "cli/limits.h"
#include "cli/option_values.h"
#include "cli/run_record.h"
#include "cli/word_list.h"
#include "shading/reference.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace rawtexel::cli {
namespace {

using shading::FilterOrder;
using texunit::Estimator;
using texunit::Kernel;
using texunit::MipMode;

constexpr std::string_view kUnset = "scene";
constexpr int kLeastTruthSamples = 4 * shading::kReferenceBatch;  ///< after which a truth first looks at its error

/// Parts of a list. A part that begins like a number belongs to the one before: "mitchell:0,0.5".
std::vector<std::string> list_parts(const std::string& text, bool joins_numbers) {
    std::vector<std::string> parts;
    for (const std::string& part : split(text, ',')) {
        const bool number = !part.empty() && (std::isdigit(static_cast<unsigned char>(part[0])) || part[0] == '-' || part[0] == '.');
        if (joins_numbers && number && !parts.empty())
            parts.back() += "," + part;
        else
            parts.push_back(part);
    }
    return parts;
}

template <class Value, class Parse>
void read_list(const char* option, const std::string& text, std::vector<Value>& values, const Parse& parse, bool joins_numbers = false) {
    for (const std::string& part : list_parts(text, joins_numbers)) {
        const Value value = parse(part);
        if (std::ranges::find(values, value) != values.end()) throw UsageError(std::string(option) + ": '" + part + "' is named twice");
        values.push_back(value);
    }
}

SweepAxes::Probes parse_probes(const std::string& text) {
    if (text == kUnset) return {};
    shading::FootprintOptions footprint;
    parse_anisotropy(text, footprint);
    return {footprint.probes, footprint.probe_variance};
}

std::optional<float> parse_bias(const std::string& text) {
    if (text == "none") return std::nullopt;
    return parse_number("--hybrid-bias", text, {0.0f, 16.0f});
}

struct Values {
    std::vector<std::optional<Kernel>> filters;
    std::vector<Minification> minifications;
    std::vector<Estimator> estimators;
    std::vector<FilterOrder> orders;
    std::vector<int> spps;
};

template <class Value>
std::vector<Value> or_default(const std::vector<Value>& chosen, std::vector<Value> otherwise) {
    return chosen.empty() ? std::move(otherwise) : chosen;
}

std::vector<Minification> default_minifications(bool quick) {
    std::vector<Minification> list;
    list.push_back({.mip = MipMode::None});
    list.push_back({.mip = MipMode::Linear});
    if (!quick) list.push_back({.mip = MipMode::Linear, .probes = 16});
    for (const float bias : {1.0f, 2.0f, 4.0f}) list.push_back({.mip = MipMode::Linear, .hybrid_bias = bias});
    return list;
}

std::vector<Minification> minifications_of(const SweepAxes& axes, float ellipse, bool quick) {
    const bool levels_chosen = !axes.mips.empty() || !axes.probes.empty() || (ellipse > 0 && !axes.filters.empty());
    if (!levels_chosen && ellipse <= 0 && axes.hybrid_biases.empty()) return default_minifications(quick);
    std::vector<Minification> list;
    if (levels_chosen || ellipse <= 0) {
        for (const auto& mip : or_default(axes.mips, {MipMode::Linear}))
            for (const SweepAxes::Probes& probes : or_default(axes.probes, {{}}))
                for (const auto& bias : or_default(axes.hybrid_biases, {std::nullopt}))
                    list.push_back({.mip = mip, .probes = probes.count, .probe_variance = probes.variance, .hybrid_bias = bias});
    }
    if (ellipse > 0)
        for (const auto& bias : or_default(axes.hybrid_biases, {std::nullopt})) list.push_back({.ellipse = ellipse, .hybrid_bias = bias});
    return list;
}

Values values_of(const SweepAxes& axes, float ellipse, bool quick) {
    Values values;
    values.filters = or_default(axes.filters, {Kernel::Bilinear, Kernel::BSpline});
    values.minifications = minifications_of(axes, ellipse, quick);
    values.estimators = or_default(axes.estimators, quick ? std::vector{Estimator::All, Estimator::Reservoir}
                                                          : std::vector{Estimator::All, Estimator::Reservoir, Estimator::Jitter});
    values.orders = or_default(axes.orders, {FilterOrder::Before, FilterOrder::After});
    values.spps = or_default(axes.spps, quick ? std::vector{1, 4, 16, 64} : std::vector{1, 4, 16, 64, 256});
    std::ranges::sort(values.spps);
    return values;
}

/// Finer levels by default show what they do to two ends: everything filtered first, and one raw texel.
bool is_default_aside(const Configuration& configuration, const SweepAxes& axes) {
    if (!configuration.minification.hybrid_bias || !axes.hybrid_biases.empty()) return false;
    const bool first = configuration.estimator == Estimator::All && configuration.order == FilterOrder::Before;
    const bool one = configuration.estimator == Estimator::Reservoir && configuration.order == FilterOrder::After;
    return !first && !one;
}

std::string print_count(double count) { return std::to_string(int64_t(std::llround(count))); }

std::string over_budget(const Configuration& configuration, double pixels, const SweepBudget& budget, bool asked) {
    const double texels = shaded_texels(configuration) * pixels * configuration.spp;
    if (texels <= budget.frame) return {};
    const std::string found = print_count(texels) + " shaded texels a frame (allowed: " + print_count(budget.frame);
    if (budget.quick) return "--quick: " + found + ")";
    return asked ? "" : found + " without --spp)";
}

int power_of_two_below(double value) { return 1 << std::clamp(int(std::floor(std::log2(std::max(value, 1.0)))), 0, 20); }

}  // namespace

void declare_axes(CommandLine& line, SweepAxes& axes) {
    const auto replace = [&](const char* name, const char* value, const std::string& help, CommandLine::Reader read) {
        line.replace_option(name, value, help, std::move(read));
    };
    replace("--filter", "LIST", "kernels, of `rawtexel list filters`, each against a truth of its own (default bilinear,bspline)",
            [&](const std::string& text) { read_list("--filter", text, axes.filters, parse_filter, /*joins_numbers=*/true); });
    replace("--mip", "LIST",
            "of scene, linear, nearest and none (default: none, linear, and linear with each of --hybrid-bias 1,2,4; "
            "without --quick linear with --aniso 16, too)",
            [&](const std::string& text) { read_list("--mip", text, axes.mips, parse_mip); });
    replace("--aniso", "LIST", "of scene and N[:S2] as in render (default scene)",
            [&](const std::string& text) { read_list("--aniso", text, axes.probes, parse_probes); });
    replace("--hybrid-bias", "LIST", "of none and biases as in render (default none)",
            [&](const std::string& text) { read_list("--hybrid-bias", text, axes.hybrid_biases, parse_bias); });
    replace("--estimator", "LIST", "of all, reservoir, jitter and abs-weight (default all,reservoir; without --quick jitter, too)",
            [&](const std::string& text) { read_list("--estimator", text, axes.estimators, read_estimator); });
    replace("--order", "LIST", "of before and after (default both)", [&](const std::string& text) {
        read_list("--order", text, axes.orders, [](const std::string& part) {
            return parse_choice("--order", part, {FilterOrder::Before, FilterOrder::After});
        });
    });
    replace("--spp", "LIST",
            "samples per pixel, 1 to " + std::to_string(kMaxSamples) +
                " each (default 1,4,16,64, without --quick 256, too, as far as a "
                "frame stays affordable)",
            [&](const std::string& text) {
                read_list("--spp", text, axes.spps,
                          [](const std::string& part) { return int(parse_integer("--spp", part, 1, kMaxSamples)); });
            });
}

SweepBudget full_budget() { return {.frame = 1e7, .repeats = 1e7, .least_repeats = 3, .most_repeats = 9, .truth = 1.6e8}; }

SweepBudget quick_budget(size_t scenes) {
    const double share = 4.0 / double(std::max<size_t>(scenes, 4));
    return {.frame = 6e5 * share, .repeats = 3e5 * share, .least_repeats = 2, .most_repeats = 5, .truth = 1e7 * share, .quick = true};
}

double quick_pixels(const SweepBudget& budget) { return budget.truth / (kLeastTruthSamples * 16); }

void Sweep::leave_out(const Configuration& configuration, const std::string& reason, bool late) {
    Configuration series = configuration;
    series.spp = 0;
    const std::string options = shell_quoted(options_of(series));
    const auto found = std::ranges::find_if(left_out, [&](const LeftOut& one) { return one.options == options && one.reason == reason; });
    if (found == left_out.end())
        left_out.push_back({options, {configuration.spp}, reason, late});
    else
        found->spps.push_back(configuration.spp);
}

Sweep plan_sweep(const SweepAxes& axes, const RenderRequest& base, const SweepBudget& budget,
                 const std::function<std::string(const RenderRequest&)>& refusal) {
    RenderRequest shared = base;
    const float ellipse = std::exchange(shared.lookup.footprint.ellipse, 0.0f);
    const Values values = values_of(axes, ellipse, budget.quick);
    const shading::Crop& crop = base.crop;
    const double pixels = crop.width > 0 ? double(crop.width) * crop.height : double(base.image_size().width) * base.image_size().height;

    Sweep sweep;
    std::vector<Configuration> seen;
    const auto consider = [&](const Configuration& configuration) {
        if (std::ranges::find(seen, configuration) != seen.end() || is_default_aside(configuration, axes)) return;
        seen.push_back(configuration);
        RenderRequest request = with_configuration(shared, configuration);
        std::string reason;
        try {
            settle(request);
            reason = refusal(request);
        } catch (const UsageError& error) {
            reason = error.what();
        }
        if (reason.empty()) reason = over_budget(configuration, pixels, budget, !axes.spps.empty());
        if (reason.empty())
            sweep.configurations.push_back(configuration);
        else
            sweep.leave_out(configuration, reason);
    };
    // An ellipse is a kernel of its own: it comes once, under the scene's.
    for (const bool ellipses : {false, true}) {
        const std::vector<std::optional<Kernel>> own{std::nullopt};
        for (const auto& filter : ellipses ? own : values.filters)
            for (const Minification& minification : values.minifications) {
                if ((minification.ellipse > 0) != ellipses) continue;
                for (const Estimator estimator : values.estimators)
                    for (const FilterOrder order : values.orders)
                        for (const int spp : values.spps) consider({filter, minification, estimator, order, spp});
            }
    }
    return sweep;
}

int repeats_of(const Configuration& configuration, double pixels, const SweepBudget& budget) {
    const double texels = shaded_texels(configuration) * pixels * configuration.spp;
    return int(std::clamp(budget.repeats / texels, double(budget.least_repeats), double(budget.most_repeats)));
}

int truth_samples(const std::optional<Kernel>& filter, double pixels, const SweepBudget& budget) {
    const double axis = filter ? texunit::axis_taps(*filter) : 2;
    return std::max(power_of_two_below(budget.truth / (pixels * axis * axis)), kLeastTruthSamples);
}

}  // namespace rawtexel::cli
