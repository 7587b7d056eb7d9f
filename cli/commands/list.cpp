#include "cli/commands/list.h"

#include "cli/counters.h"
#include "cli/option_values.h"
#include "cli/reports/kernel_plot.h"
#include "cli/vectors/suite.h"
#include "scenes/builtin.h"
#include "scenes/output_file.h"
#include "shading/baseline.h"
#include "texunit/estimator.h"
#include "texunit/format.h"
#include "texunit/kernel.h"
#include "texunit/noise.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace rawtexel::cli {
namespace {

struct Entry {
    std::string name, description;
};
using Entries = std::vector<Entry>;

template <class Range>
Entries entries_of(const Range& range) {
    Entries entries;
    for (const auto& item : range) entries.push_back({std::string(item.name), std::string(item.description)});
    return entries;
}

Entries filter_entries() {
    Entries entries{{"scene", "what the file's sampler says, bilinear where it is silent"}};
    for (const texunit::KernelInfo& kernel : texunit::all_kernels()) {
        entries.push_back({std::string(kernel.name), std::string(kernel.description)});
        if (!kernel.parameters.empty())
            entries.back().description += " (spelled " + std::string(kernel.name) + ":" + std::string(kernel.parameters) + ")";
    }
    return entries;
}

Entries entries_for(const std::string& subject) {
    switch (parse_word("list", subject, {"scenes", "filters", "estimators", "noises", "baselines", "formats", "counters", "suites"})) {
        case 0: return entries_of(scenes::builtin_scenes());
        case 1: return filter_entries();
        case 2: return entries_of(texunit::all_estimators());
        case 3: return entries_of(texunit::all_noises());
        case 4: return entries_of(shading::all_baselines());
        case 5: return entries_of(texunit::all_formats());
        case 6: return entries_of(all_counters());
        default: return entries_of(all_suites());
    }
}

std::vector<texunit::Kernel> default_kernels() {
    std::vector<texunit::Kernel> kernels;
    for (const texunit::KernelInfo& kernel : texunit::all_kernels()) kernels.push_back(*texunit::parse_kernel(kernel.name));
    return kernels;
}

std::string print_json(const Entries& entries) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Entry& entry : entries) list.push_back({{"name", entry.name}, {"description", entry.description}});
    return list.dump(2) + "\n";
}

std::string print_lines(const Entries& entries) {
    size_t column = 0;
    for (const Entry& entry : entries) column = std::max(column, entry.name.size() + 2);
    std::string text;
    for (Entry entry : entries) {
        entry.name.resize(column, ' ');
        text += entry.name + entry.description + "\n";
    }
    return text;
}

class ListCommand : public Command {
  public:
    std::string_view name() const override { return "list"; }
    std::string_view usage() const override {
        return "list scenes|filters|estimators|noises|baselines|formats|counters|suites [--json] [--plot FILE.svg]";
    }
    std::string_view summary() const override {
        return "Lists built-in scenes, texture filters, estimators, noises, baselines, texel formats, counters or suites of test vectors, "
               "one a line.";
    }

    void declare(CommandLine& line) override {
        line.arguments("SUBJECT", "scenes, filters, estimators, noises, baselines, formats, counters or suites", 1, 1, words_);
        line.flag("--json", "an array of objects with \"name\" and \"description\"", json_);
        line.option("--plot", "FILE.svg", "of filters: draws what every kernel weighs along an axis",
                    [&](const std::string& text) { plot_ = text; });
    }

    int run(const Invocation& invocation) override {
        const Entries entries = entries_for(words_[0]);
        if (!plot_.empty()) write_plot();
        invocation.out << (json_ ? print_json(entries) : print_lines(entries));
        return kDone;
    }

  private:
    void write_plot() const {
        if (words_[0] != "filters") throw UsageError("--plot: " + words_[0] + " have no plot (allowed: list filters)");
        if (!plot_.ends_with(".svg")) throw UsageError("--plot: '" + plot_ + "' does not end with .svg");
        const std::string svg = plot_svg(kernel_plot(default_kernels()));
        scenes::write_file(plot_, std::as_bytes(std::span(svg)));
    }

    std::vector<std::string> words_;
    std::string plot_;
    bool json_ = false;
};

}  // namespace

std::unique_ptr<Command> make_list_command() { return std::make_unique<ListCommand>(); }

}  // namespace rawtexel::cli
