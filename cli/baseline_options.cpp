#include "cli/baseline_options.h"

#include "cli/option_values.h"
#include "cli/usage_error.h"

namespace rawtexel::cli {
namespace {

using shading::Baseline;
using shading::FilterOrder;
using texunit::Estimator;
using texunit::Kernel;
using texunit::MipMode;

std::string title(Baseline baseline) { return "--baseline " + std::string(to_string(baseline)); }

/// Whether the baseline reads one level at one place, with the bilinear kernel or the nearest texel.
bool picks_texels(Baseline baseline) { return is_dither(baseline) || baseline == Baseline::Moonray; }

void check_draws(const shading::FilteringOptions& filtering) {
    const std::string name = title(filtering.baseline);
    if (filtering.estimator != Estimator::All)
        throw UsageError(name + " and --estimator " + std::string(to_string(filtering.estimator)) +
                         " exclude each other: a baseline is a way of its own");
    if (filtering.taps != 1) throw UsageError(name + " and --taps exclude each other: a baseline is a way of its own");
    if (filtering.sharing == shading::NumberSharing::PerMap) throw UsageError(name + " and --random per-map exclude each other");
    if (filtering.common_numbers) throw UsageError(name + " and --signed-numbers common exclude each other");
    if (!filtering.order) return;
    const FilterOrder own = is_dither(filtering.baseline) ? FilterOrder::After : FilterOrder::Before;
    if (filtering.order != own)
        throw UsageError(name + ": --order " + std::string(to_string(*filtering.order)) +
                         " is not its own (allowed: " + std::string(to_string(own)) + ")");
}

void check_lookups(const LookupOptions& lookup) {
    const Baseline baseline = lookup.filtering.baseline;
    const std::string name = title(baseline);
    if (corrects_gloss(baseline)) return;
    if (picks_texels(baseline)) {
        if (lookup.filter && *lookup.filter != Kernel(Kernel::Bilinear))
            throw UsageError(name + ": --filter " + print_filter(lookup.filter) + " is not its own (allowed: bilinear)");
        if (lookup.mip == MipMode::Linear) throw UsageError(name + ": --mip linear is not its own (allowed: nearest, none)");
    } else if (lookup.mip && lookup.mip != MipMode::Linear) {
        throw UsageError(name + ": --mip " + print_mip(lookup.mip) + " leaves it no level to draw (allowed: linear)");
    }
    if (lookup.footprint.ellipse > 0) throw UsageError(name + " and --ewa exclude each other");
    if (lookup.footprint.probes.value_or(1) > 1 || lookup.footprint.probe_variance > 0)
        throw UsageError(name + " and --aniso exclude each other: its footprints are isotropic");
}

}  // namespace

void declare_baseline_option(CommandLine& line, shading::FilteringOptions& filtering) {
    line.option("--baseline", "NAME",
                "renders as others do, to compare with: one of `rawtexel list baselines`, such as toksvig or ue-dither (default none). "
                "Negative biases are --lod-bias",
                [&](const std::string& text) {
                    using enum Baseline;
                    filtering.baseline =
                        parse_choice("--baseline", text, {None, Toksvig, Lean, Clean, UeDither, StartrekDither, OiioStochastic, Moonray});
                });
}

void check_baseline(const LookupOptions& lookup) {
    if (lookup.filtering.baseline == Baseline::None) return;
    check_draws(lookup.filtering);
    check_lookups(lookup);
}

}  // namespace rawtexel::cli
