// Pitfalls of random numbers: 0 and 1, bytes in their place, numbers used twice, numbers that depend on what was asked before.
#include "cli/vectors/adversary.h"

#include <cmath>
#include <utility>

namespace rawtexel::cli {

using texunit::Estimator;
using texunit::Kernel;
using texunit::MipMode;

namespace {

CaseRecord number_at(uint32_t x, uint32_t y, uint32_t sample) {
    CaseRecord record;
    record.op = PortOp::Random;
    record.pixel_x = x, record.pixel_y = y, record.sample = sample;
    record.dimension = uint32_t(texunit::Dimension::TapX);
    return record;
}

}  // namespace

void add_number_pitfalls(Adversary& a) {
    a.group("a number is never 1", "32 random bits as a float round up to 1: only the upper 24 are used", true);
    // Addresses whose bits are 0xFFFFFF80 and more, or next to 0.
    for (const auto& [x, y, sample] :
         {std::array{2083u, 3596u, 1u}, {762u, 3712u, 1u}, {1950u, 3786u, 1u}, {3688u, 1418u, 0u}, {1970u, 327u, 1u}})
        a.builder.add(number_at(x, y, sample));
    a.group("a number of 0", "is as good as any other: no logarithm of 0, no offset that is not finite");
    for (const Kernel& kernel : {Kernel::gaussian(0.5f), Kernel::gaussian(0.02f), Kernel::BSpline, Kernel::Bilinear}) {
        for (const float number : {0.0f, kLargestNumber}) {
            a.builder.add_some(4, [&] {
                CaseRecord record = a.drawn(a.lookup(a.square, kernel), Estimator::Jitter);
                record.number_x = record.number_y = number;
                return record;
            });
        }
    }
    a.group("the largest number",
            "weights that round to less than 1 in sum leave room for no other tap than the last that weighs anything");
    for (const Kernel& kernel : {Kernel::gaussian(0.3f), Kernel::gaussian(0.5f), Kernel::gaussian_point(0.4f), Kernel::Lanczos3}) {
        a.builder.add_some(12, [&] {
            CaseRecord record = a.drawn(a.lookup(a.square, kernel), Estimator::Reservoir);
            record.number_x = record.number_y = kLargestNumber;
            return record;
        });
    }
    a.group("numbers have 24 bits", "a byte in a number's place moves what is drawn by half of 1/256, and never draws what weighs less");
    a.builder.add_some(24, [&] {
        // Numbers that as bytes would draw another texel.
        for (;;) {
            const CaseRecord record =
                a.drawn(a.lookup(a.square, a.builder.chance(0.5f) ? Kernel::BSpline : Kernel::gaussian(1)), a.either());
            CaseRecord coarse = record;
            coarse.number_x = std::floor(record.number_x * 256) / 256;
            if (evaluate(a.builder.suite(), record).x != evaluate(a.builder.suite(), coarse).x) return record;
        }
    });
    a.group("one number, one choice", "level, probe, sign and both axes have numbers of their own; none is used again");
    a.builder.add_some(48, [&] {
        CaseRecord record =
            a.drawn(a.lookup(a.odd, a.builder.chance(0.5f) ? Kernel::CatmullRom : Kernel::BSpline, MipMode::Linear), Estimator::Reservoir);
        record.probes = 8;
        a.footprint(record, 1, 5, 6);
        return record;
    });
    a.group("maps share their numbers", "maps of other resolutions draw with the same numbers: the same offset of either's own texels");
    for (int n = 0; n < 16; ++n) {
        a.builder.add_some(1, [&] {
            CaseRecord record = a.drawn(a.lookup(a.square, Kernel::Bilinear), Estimator::Jitter);
            return record;
        });
        CaseRecord record = a.builder.suite().cases.back();
        record.texture = a.odd;
        a.builder.add(record);
    }
    a.group("the same case again", "shadow and colour passes draw the same texel: an answer depends on the case, not on its place");
    const std::vector<CaseRecord> before(a.builder.suite().cases.end() - 24, a.builder.suite().cases.end());
    for (auto record = before.rbegin(); record != before.rend(); ++record) a.builder.add(*record);
    a.group("every draw has its numbers",
            "numbers that are handed on by value are used again by the next draw, for some kernels or levels");
    for (const Kernel& kernel : {Kernel(Kernel::Bilinear), Kernel(Kernel::BSpline), Kernel::gaussian(0.7f)}) {
        a.builder.add_some(4, [&] {
            CaseRecord record = a.mean(a.lookup(a.odd, kernel, MipMode::Linear), a.either(), 16);
            record.probes = 4;
            a.footprint(record, 1, 4, 4);
            return record;
        });
    }
    a.group("a role keeps its numbers", "levels and probes that are switched on, but not needed, leave the others' numbers what they are");
    for (int n = 0; n < 8; ++n) {
        CaseRecord record = a.mean(a.lookup(a.square, Kernel::BSpline), Estimator::Reservoir, 4);
        a.footprint(record, -3, -1);
        for (const auto& [mip, probes] : {std::pair{MipMode::None, 1}, {MipMode::Linear, 1}, {MipMode::Linear, 8}}) {
            record.mip = uint32_t(mip), record.probes = probes;
            a.builder.add(record);
        }
    }
    a.group("an address is a number", "whatever is asked before it, in whatever order", true);
    for (uint32_t n = 0; n < 32; ++n) a.builder.add(number_at(n * 7 % 32, 3, n % 4));
    for (uint32_t n = 32; n-- > 0;) a.builder.add(number_at(n * 7 % 32, 3, n % 4));
}

}  // namespace rawtexel::cli
