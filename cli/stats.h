// The numbers of a run as JSON.
#pragma once

#include "cli/run_record.h"

#include <span>
#include <string>
#include <string_view>

namespace rawtexel::cli {

/// Keys that were not counted are left out, never 0.
std::string stats_json(const RunRecord& record, const shading::Scene& scene);

/// A counter of that file, for `rawtexel list counters`.
struct CounterInfo {
    std::string_view name;  ///< path of the key, such as "texture.taps"
    std::string_view description;
};
std::span<const CounterInfo> all_counters();

}  // namespace rawtexel::cli
