#include "cli/skip_options.h"

#include "cli/option_values.h"
#include "cli/word_list.h"

#include <algorithm>
#include <string>
#include <vector>

namespace rawtexel::cli {

namespace {

constexpr std::string_view kAll = "all";

std::vector<std::string> skip_names() {
    std::vector<std::string> names;
    for (const shading::SkipInfo& skip : shading::kSkips) names.emplace_back(skip.name);
    return names;
}

}  // namespace

shading::Skips parse_skips(std::string_view option, std::string_view text, bool on) {
    shading::Skips skips;
    for (const shading::SkipInfo& skip : shading::kSkips) skips.*skip.on = !on;
    std::vector<std::string> seen;
    for (const std::string& word : split(text, ',')) {
        const auto named = std::ranges::find(shading::kSkips, word, &shading::SkipInfo::name);
        if (named == shading::kSkips.end() && word != kAll) {
            std::vector<std::string> names = skip_names();
            names.emplace_back(kAll);
            throw unknown_value(option, word, names);
        }
        if (std::ranges::find(seen, word) != seen.end()) throw UsageError(std::string(option) + ": '" + word + "' is named twice");
        seen.push_back(word);
        if (named != shading::kSkips.end()) skips.*named->on = on;
    }
    if (std::ranges::find(seen, kAll) == seen.end()) return skips;
    if (seen.size() > 1) throw UsageError(std::string(option) + ": all leaves nothing else to name");
    for (const shading::SkipInfo& skip : shading::kSkips) skips.*skip.on = on;
    return skips;
}

void declare_skip_options(CommandLine& line, SkipRequest& request) {
    const auto declare = [&](const char* option, bool on, const std::string& what) {
        line.option(option, "LIST", what, [&request, option, on](const std::string& text) {
            if (!request.option.empty() && request.option != option) throw UsageError("--skip and --no-skip exclude each other");
            request.option = option;
            request.skips = parse_skips(option, text, on);
        });
    };
    declare("--skip", true,
            "work that is left out where it changes nothing, and no other: all, or of " + join(skip_names(), ",") + " (default all)");
    declare("--no-skip", false, "the same by what is done all the same");
}

}  // namespace rawtexel::cli
