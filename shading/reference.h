// The truth: what a scene looks like when every texel is shaded and only then filtered. Every error of this project is measured against it.
#pragma once

#include "shading/render.h"

namespace rawtexel::shading {

struct ReferenceGoal {
    double error = 0;            ///< > 0, of linear radiance
    int most_samples = 1 << 20;  ///< per pixel, where the goal is out of reach
};

struct Reference {
    RenderResult result;        ///< radiance of all samples; everything else of the first batch
    double standard_error = 0;  ///< reached: root mean square over pixels and channels of the mean's standard error
    int samples = 0;            ///< per pixel
};

/// Options that make `options` the truth: level 0, all taps shaded and then filtered, unquantised, an offset per sample and pixel. The
/// kernel, the pixel filter and everything that is no matter of texture filtering stay.
RenderOptions reference_options(RenderOptions options);

/// Renders batches of kReferenceBatch samples until the image's standard error, estimated from the spread of the batches, is below the
/// goal; it is looked at after 4, 8, 16 … of them. Samples of a batch are more even than chance, so the estimate is on the safe side.
inline constexpr int kReferenceBatch = 16;
Reference render_reference(const Scene& scene, const Lighting& lighting, const RenderOptions& options, const ReferenceGoal& goal,
                           Executor& executor, const Progress& progress = {});

}  // namespace rawtexel::shading
