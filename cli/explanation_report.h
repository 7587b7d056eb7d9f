// An explained pixel, told: as JSON for scripts, as text for people.
#pragma once

#include "cli/pixel_explanation.h"

#include <memory>
#include <ostream>

namespace rawtexel::cli {

/// Told of the pixel, then of its samples one after the other, then of what they lead to. Looks up every lookup again for its taps:
/// throws texunit::TextureError.
class ExplanationReport {
  public:
    virtual ~ExplanationReport() = default;
    virtual void begin(const ExplainedPixel& pixel) = 0;
    virtual void sample(const ExplainedSample& sample) = 0;
    /// `mean` is null where not all samples were told.
    virtual void end(const ExplainedMean* mean) = 0;
};

/// Numbers are the shortest that read back as the same bits, but for the taps' tables.
std::unique_ptr<ExplanationReport> make_explanation_text(std::ostream& out);

/// One object, a line for every sample; numbers read back as the same bits:
/// {"scene", "camera", "size", "pixel", "spp", "pixel_filter", "pixel_jitter", "seed",
///  "samples": [{"sample", "weight", "offset", "sequence_shift", "let_through": [SURFACE …], "surface": SURFACE or null, "radiance"} …],
///  "mean", "rendered", "display"}; the last three where all samples are told.
std::unique_ptr<ExplanationReport> make_explanation_json(std::ostream& out);

}  // namespace rawtexel::cli
