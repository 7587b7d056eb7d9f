// Pitfalls of what is averaged: shaders of means for means of shaders, and means that are clamped or resampled on the way.
#include "cli/vectors/adversary.h"

namespace rawtexel::cli {

using texunit::Estimator;
using texunit::Kernel;
using texunit::MipMode;

namespace {

/// Every tap shaded and averaged (order 1), or the mean of the taps shaded (0).
CaseRecord shaded(CaseRecord record, uint32_t order, uint32_t shader) {
    record.op = PortOp::Shade;
    record.order = order, record.shader = shader;
    return record;
}

}  // namespace

void add_order_pitfalls(Adversary& a) {
    a.group("the mean of draws", "is that of the filter when nothing is clamped to neighbours on the way");
    a.builder.add_some(8, [&] {
        return a.mean(a.lookup(a.square, a.builder.chance(0.5f) ? Kernel::CatmullRom : Kernel::BSpline), Estimator::Reservoir, 64);
    });
    a.group("a camera at rest", "a history that is not resampled adds no blur: 32 samples of one pixel");
    a.builder.add_some(8, [&] {
        CaseRecord record = a.mean(a.lookup(a.odd, Kernel::Bilinear, MipMode::Linear), Estimator::Jitter, 32);
        a.footprint(record, 0, 2);
        return record;
    });
    a.group("magnified and squared", "filtering after shading has the square's own frequencies, which no later filter takes away");
    a.builder.add_some(16, [&] { return shaded(a.lookup(a.square, Kernel::Lanczos3), 1, 1); });
    a.group("minified and squared", "filtering before shading stays wrong at any number of samples");
    a.builder.add_some(16, [&] {
        CaseRecord record = a.lookup(a.odd, Kernel::Bilinear, MipMode::Linear);
        record.probes = 8;
        a.footprint(record, 2, 5, 6);
        return shaded(record, 1, 1);
    });
    a.group("which order is which", "before: the shader of the mean; after: the mean of the shader. The same lookups in both");
    for (int n = 0; n < 12; ++n) {
        const CaseRecord record = a.lookup(a.square, Kernel::Bilinear);
        for (const uint32_t order : {0u, 1u}) a.builder.add(shaded(record, order, 2));
    }
}

}  // namespace rawtexel::cli
