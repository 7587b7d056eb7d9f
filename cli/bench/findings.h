// What the numbers of a sweep say, in sentences; nothing in them is known beforehand.
#pragma once

#include "cli/bench/series.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rawtexel::cli {

enum class FindingKind { Before, After, Orders, OneTap, OneTapOthers, Truth };
std::string_view to_string(FindingKind kind);  // before after orders one-tap one-tap-others truth

struct Finding {
    FindingKind kind = FindingKind::Before;
    std::string filter, text;
};

/// Of each kernel: what becomes of the errors before and after shading with more samples; which of the two is nearer to the truth with as
/// many samples; and whether one raw texel of a cubic kernel reads the fewest texels at equal error, of all settings of its kernel, and of
/// those of other kernels; and where the truth missed the error that was aimed at, from where on it tells nothing. Series of finer levels
/// (--hybrid-bias) are left out.
std::vector<Finding> findings_of(const SceneResults& results, const std::vector<Series>& series);

/// One texel of a cubic kernel against other settings, at one error that it reaches.
struct OneTapDuel {
    double rmse = 0, fetches = 0;  ///< its own, texel reads a pixel
    int spp = 0;
    const Series* rival = nullptr;  ///< the one of the others that reads the fewest; null where none reaches the error
    double rival_fetches = 0;
    bool wins() const { return rival == nullptr || fetches <= rival_fetches; }
};
/// At every error of `own` that is clear of the truth's, against what reads more texels of its kernel, or against other kernels.
std::vector<OneTapDuel> one_tap_duels(const Series& own, const SceneResults& results, const std::vector<Series>& series,
                                      bool other_kernels);

}  // namespace rawtexel::cli
