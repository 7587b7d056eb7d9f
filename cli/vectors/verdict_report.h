// A verdict on a port, for people and for scripts.
#pragma once

#include "cli/vectors/judge.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace rawtexel::cli {

/// One line where it holds. Otherwise group by group what failed: the first cases with their inputs, what was expected, what is legal, what
/// came, and the likeliest cause. `source`: who answered, such as a device.
std::string verdict_text(const Suite& suite, const SuiteVerdict& verdict, const std::string& source);

/// The same with every failure.
nlohmann::ordered_json verdict_json(const Suite& suite, const SuiteVerdict& verdict, const std::string& source);

/// What a case asks, on one line: its op, texture and every field that is not as in a plain lookup.
std::string case_text(const Suite& suite, const CaseRecord& record);

}  // namespace rawtexel::cli
