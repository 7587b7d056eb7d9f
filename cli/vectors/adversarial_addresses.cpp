// Pitfalls of addresses: texels out of reach, seams, centres, coordinates that lose their fraction.
#include "cli/vectors/adversary.h"

namespace rawtexel::cli {

using texunit::Estimator;
using texunit::Kernel;
using texunit::MipMode;
using texunit::Wrap;

void add_address_pitfalls(Adversary& a) {
    a.group("clamp reaches every texel", "clamping to [1/N, 1 - 1/N] before floor never reads texel 0, and of 2x2 only texel (1, 1)");
    for (const Wrap wrap : {Wrap::ClampToEdge, Wrap::ClampToBorder, Wrap::MirrorOnce}) {
        for (const uint32_t texture : {a.tiny, a.square}) {
            a.builder.add_some(16, [&] {
                CaseRecord record = a.drawn(a.lookup(texture, Kernel::Nearest, MipMode::None, wrap, wrap), Estimator::Reservoir);
                record.at = {a.builder.between(-0.2f, 0.3f), a.builder.between(0.7f, 1.2f), 0};
                return record;
            });
        }
    }
    a.group("the border has its colour", "the verdict that a texel is beyond the edge must reach the load of a drawn texel too");
    a.builder.add_some(24, [&] {
        CaseRecord record =
            a.drawn(a.lookup(a.square, Kernel::Bilinear, MipMode::None, Wrap::ClampToBorder, Wrap::ClampToBorder), a.either());
        record.at = {a.builder.between(-0.1f, 0.1f), a.builder.between(0.9f, 1.1f), 0};
        return record;
    });
    a.group("across the seam", "a footprint that crosses u = 0 wraps tap by tap; an address helper that is told a size of 1 reads texel 0");
    a.builder.add_some(32, [&] {
        CaseRecord record = a.lookup(a.square, Kernel::BSpline, MipMode::None, a.any_wrap(), a.any_wrap());
        record.at = {a.builder.between(-0.08f, 0.08f), a.builder.between(0.92f, 1.08f), 0};
        return a.builder.chance(0.5f) ? a.drawn(record, a.either()) : record;
    });
    a.group("wraps come after selection", "a drawn texel wraps as an integer: each kernel's mean under a wrap is that of the filter");
    for (const Wrap wrap : kEveryWrap) {
        a.builder.add_some(12, [&] {
            CaseRecord record =
                a.drawn(a.lookup(a.square, a.builder.chance(0.5f) ? Kernel::gaussian(1) : Kernel::Quadratic, MipMode::None, wrap, wrap),
                        a.either());
            record.at = {a.builder.between(-2, 3), a.builder.between(-2, 3), 0};
            return record;
        });
    }
    a.group("just below 0", "frac(-1e-9) is 1 in 32-bit floats: the index is wrapped again, as an integer", true);
    for (const float u : {-1e-9f, -1e-20f, -0.0f, -0x1p-120f, -0x1p-25f}) {
        for (const Wrap wrap : kEveryWrap)
            a.builder.add([&] {
                CaseRecord record = a.lookup(a.square, Kernel::Nearest, MipMode::None, wrap, wrap);
                record.at = {u, 0.25f, 0};
                return record;
            }());
    }
    a.group("ties and texel centres",
            "texel i has its centre at i + 1/2, and floor decides: rounding half to even is off at every other edge", true);
    for (int k = -16; k <= 32; ++k) {
        CaseRecord record = a.lookup(a.square, Kernel::Nearest);
        record.at = {float(k) / 16, float(k) / 32, 0};
        a.builder.add(record);
    }
    a.group("centres of 4095 texels", "an index that goes through a float coordinate and back comes back");
    for (int i = 0; i < 4095; i += 63) {
        CaseRecord record = a.lookup(a.wide, Kernel::Nearest);
        record.at = {(float(i) + 0.5f) / 4095, 0.5f, 0};
        a.builder.add(record);
    }
    a.group("far from the origin",
            "at u = 4096 a 32-bit float has 2048 steps: whole repeats are taken away before the coordinate is scaled");
    a.builder.add_some(32, [&] {
        CaseRecord record =
            a.lookup(a.odd, Kernel::Bilinear, MipMode::None, a.builder.chance(0.5f) ? Wrap::Repeat : Wrap::MirroredRepeat, Wrap::Repeat);
        record.at = {a.builder.between(4000, 4200), a.builder.between(-4200, -4000), 0};
        return a.builder.chance(0.5f) ? a.drawn(record, a.either()) : record;
    });
}

}  // namespace rawtexel::cli
