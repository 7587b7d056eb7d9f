// What the numbers of a sweep say, in sentences; nothing in them is known beforehand.
#pragma once

#include "cli/bench/series.h"

#include <optional>
#include <string>
#include <vector>

namespace rawtexel::cli {

enum class FindingKind { Before, After, Orders, OneTap };
std::string_view to_string(FindingKind kind);  // before after orders one-tap

struct Finding {
    FindingKind kind = FindingKind::Before;
    std::string filter;
    std::string text;
};

/// Of each kernel: what becomes of the errors before and after shading with more samples, which of the two is nearer to the truth, and
/// whether one raw texel of a cubic kernel reads the fewest texels at equal error. Series of finer levels (--hybrid-bias) are left out.
std::vector<Finding> findings_of(const SceneResults& results, const std::vector<Series>& series);

/// One texel of a cubic kernel against everything else, at one error that it reaches.
struct OneTapDuel {
    double rmse = 0, fetches = 0;  ///< its own, texel reads a pixel
    int spp = 0;
    const Series* rival = nullptr;  ///< the one that reads the fewest of all others; null where none reaches the error
    double rival_fetches = 0;
    std::optional<double> all_taps;  ///< of the kernel itself, every tap read and filtered after shading too
    bool wins() const { return rival == nullptr || fetches <= rival_fetches; }
};
/// At every error of `one_tap` that is clear of the truth's own.
std::vector<OneTapDuel> one_tap_duels(const Series& one_tap, const SceneResults& results, const std::vector<Series>& series);

}  // namespace rawtexel::cli
