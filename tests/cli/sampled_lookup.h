// Lookups told by `rawtexel sample --json`, and what holds for all of them.
#pragma once

#include "tests/cli/program_runner.h"

#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace rawtexel::test {

using Json = nlohmann::json;

/// The words of `rawtexel sample TEXTURE MORE…`.
std::vector<std::string> sample_words(const std::string& texture, const std::vector<std::string>& more);

/// The lookup that it prints.
Json sample(const std::string& texture, const std::vector<std::string>& more);

std::set<std::string> keys_of(const Json& json);

/// The taps must explain the result: their weighted sum is within rounding of it, none has weight 0, and their weights add up to 1.
void expect_adds_up(const Json& lookup, const std::string& what);

}  // namespace rawtexel::test
