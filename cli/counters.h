// Everything that a run can count, by the key under which its JSON has it.
#pragma once

#include <span>
#include <string_view>

namespace rawtexel::cli {

/// A number of `render --stats`; those that were not counted are left out there.
struct CounterInfo {
    std::string_view name;  ///< path of the key, such as "texture.taps"
    std::string_view description;
};
std::span<const CounterInfo> all_counters();

}  // namespace rawtexel::cli
