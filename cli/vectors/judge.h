// Holds what a port answered against what is legal.
#pragma once

#include "cli/vectors/suite.h"

#include <span>
#include <string>
#include <vector>

namespace rawtexel::cli {

/// A case whose answer is not legal.
struct CaseFailure {
    size_t index = 0;
    PortResult came;
    uint32_t words = 0;  ///< those of the answer that are not legal, one bit each
    std::string cause;   ///< the likeliest; empty where none is known
};

struct SuiteVerdict {
    std::vector<CaseFailure> failures;  ///< in the order of the cases
    bool holds() const { return failures.empty(); }
};

/// Bits of the judged words that lie outside their interval; what is not a number never lies inside.
uint32_t illegal_words(const Expectation& expectation, const PortResult& came);

inline constexpr int kDiagnosedOfGroup = 32;  ///< first failures of a group in which causes are looked for

/// One result a case.
SuiteVerdict judge_results(const Suite& suite, std::span<const PortResult> results);

}  // namespace rawtexel::cli
