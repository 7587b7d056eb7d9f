#include "cli/vectors/judge.h"

#include "cli/vectors/diagnosis.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <map>

namespace rawtexel::cli {
namespace {

template <class T>
T word_of(const PortResult& result, size_t word) {
    T value;
    std::memcpy(&value, reinterpret_cast<const char*>(&result) + 4 * word, 4);
    return value;
}

template <class T>
bool is_within(const Expectation& e, const PortResult& came, size_t word) {
    const T value = word_of<T>(came, word);
    return value >= word_of<T>(e.least, word) && value <= word_of<T>(e.most, word);
}

}  // namespace

uint32_t illegal_words(const Expectation& expectation, const PortResult& came) {
    uint32_t illegal = 0;
    for (const RecordField& field : result_fields()) {
        for (auto word = size_t(field.word); word < size_t(field.word + field.count); ++word) {
            if ((expectation.judged & judges(word)) == 0) continue;
            const bool legal = field.type == WordType::Float ? is_within<float>(expectation, came, word)
                               : field.type == WordType::Int ? is_within<int32_t>(expectation, came, word)
                                                             : is_within<uint32_t>(expectation, came, word);
            if (!legal) illegal |= judges(word);
        }
    }
    return illegal;
}

SuiteVerdict judge_results(const Suite& suite, std::span<const PortResult> results) {
    assert(results.size() == suite.cases.size());
    SuiteVerdict verdict;
    std::vector<std::vector<std::string>> causes;
    std::map<std::string, int> explained;
    for (const CaseGroup& group : suite.groups) {
        int diagnosed = 0;
        for (size_t index = group.first; index < size_t(group.first) + group.count; ++index) {
            const uint32_t words = illegal_words(suite.expected[index], results[index]);
            if (words == 0) continue;
            verdict.failures.push_back({index, results[index], words, {}});
            causes.emplace_back();
            if (diagnosed++ < kDiagnosedOfGroup) causes.back() = possible_causes(suite, index, results);
            for (const std::string& cause : causes.back()) ++explained[cause];
        }
    }
    // One fault fails many cases: of all that explain a case the one that explains most others is the likeliest.
    for (size_t n = 0; n < causes.size(); ++n) {
        const auto likeliest = std::ranges::max_element(causes[n], {}, [&](const std::string& cause) { return explained[cause]; });
        if (likeliest != causes[n].end()) verdict.failures[n].cause = *likeliest;
    }
    return verdict;
}

}  // namespace rawtexel::cli
