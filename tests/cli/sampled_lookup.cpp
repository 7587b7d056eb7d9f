#include "tests/cli/sampled_lookup.h"

#include "cli/command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rawtexel::test {

std::vector<std::string> sample_words(const std::string& texture, const std::vector<std::string>& more) {
    std::vector<std::string> words{"sample", texture};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

Json sample(const std::string& texture, const std::vector<std::string>& more) {
    std::vector<std::string> words = sample_words(texture, more);
    words.emplace_back("--json");
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, cli::kDone) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.out, '\n'), 1) << outcome.out;
    return Json::parse(outcome.out);
}

std::set<std::string> keys_of(const Json& json) {
    std::set<std::string> keys;
    for (const auto& [key, value] : json.items()) keys.insert(key);
    return keys;
}

void expect_adds_up(const Json& lookup, const std::string& what) {
    double weights = 0, magnitude = 0;
    std::array<double, 4> sum{};
    for (const Json& tap : lookup["taps"]) {
        const double weight = tap["weight"];
        EXPECT_NE(weight, 0) << what;
        weights += weight;
        magnitude += std::abs(weight);
        for (size_t c = 0; c < 4; ++c) sum[c] += weight * double(tap["value"][c]);
    }
    const double bound = (double(lookup["taps"].size()) + 8) * 0x1p-23 * std::max(1.0, magnitude);
    EXPECT_NEAR(weights, 1, bound) << what;
    for (size_t c = 0; c < 4; ++c) EXPECT_NEAR(double(lookup["result"][c]), sum[c], bound) << what << ", channel " << c;
}

}  // namespace rawtexel::test
