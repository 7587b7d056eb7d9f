// Pitfalls of drawn texels: offsets of volumes and cube maps, weights of 0 and below, what is drawn of codes, facets and infinities.
#include "cli/vectors/adversary.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace rawtexel::cli {

using texunit::Estimator;
using texunit::Kernel;
using texunit::MipMode;

namespace {

uint32_t add_srgb_texture(SuiteBuilder& builder) {
    std::vector<std::byte> codes(4 * (64 + 16 + 4 + 1));
    for (std::byte& code : codes) code = std::byte(builder.bits() >> 24);
    return builder.add_texture({"codes 8x8", texunit::Format::RGBA8Srgb, {.width = 8, .height = 8, .levels = 4}, std::move(codes)});
}

/// Every other texel of level 0 is infinite in red.
uint32_t add_infinite_texture(SuiteBuilder& builder) {
    std::vector<float> values(4 * (16 + 4 + 1), 0.5f);
    for (size_t n = 0; n < 16; n += 2) values[4 * n] = std::numeric_limits<float>::infinity();
    std::vector<std::byte> bytes(values.size() * 4);
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return builder.add_texture({"infinities 4x4", texunit::Format::RGBA32Float, {.width = 4, .height = 4, .levels = 3}, std::move(bytes)});
}

}  // namespace

void add_draw_pitfalls(Adversary& a) {
    a.group("normal offsets of volumes",
            "each axis has a number of its own; one number for radius and angle has neither mean 0 nor variance 1");
    a.builder.add_some(32, [&] {
        CaseRecord record = a.drawn(a.lookup(a.volume, Kernel::gaussian(0.7f), MipMode::None, a.any_wrap()), a.either());
        return record;
    });
    a.group("volumes have three axes", "the slice is weighed, wrapped and drawn like x and y");
    a.builder.add_some(32, [&] {
        CaseRecord record = a.lookup(a.volume, a.builder.chance(0.5f) ? Kernel::Bilinear : Kernel::BSpline, MipMode::Linear, a.any_wrap());
        a.solid_footprint(record);
        return a.builder.chance(0.5f) ? a.drawn(record, a.either()) : record;
    });
    a.group("cube maps", "offsets are texels of a face, and go on over its edges; at a corner three texels meet");
    for (const Kernel& kernel : {Kernel(Kernel::Nearest), Kernel(Kernel::Bilinear), Kernel(Kernel::BSpline), Kernel::gaussian(0.7f)}) {
        a.builder.add_some(32, [&] {
            CaseRecord record = a.lookup(a.cube, kernel, MipMode::Linear);
            if (a.builder.chance(0.5f)) {  // Near an edge or a corner.
                for (float& component : record.at) component = std::copysign(a.builder.between(0.8f, 1), component);
                if (a.builder.chance(0.5f)) record.at[size_t(a.builder.below(3))] = a.builder.between(-1, 1);
            }
            a.solid_footprint(record);
            return a.builder.chance(0.5f) ? a.drawn(record, a.either()) : record;
        });
    }
    a.group("a tap of weight 0", "on a texel's centre the first and the last number draw no tap that weighs nothing", true);
    for (const Kernel& kernel : {Kernel::BSpline, Kernel::Bilinear, Kernel::CatmullRom, Kernel::Lanczos3}) {
        for (const float number : {0.0f, 0x1p-24f, kLargestNumber}) {
            CaseRecord record = a.drawn(a.lookup(a.square, kernel), Estimator::Reservoir);
            record.at = {5.5f / 16, 9.5f / 16, 0};
            record.number_x = record.number_y = record.number_sign = number;
            a.builder.add(record);
        }
    }
    a.group("Gaussians are integrated over texels",
            "offsets drawn from a normal and rounded to texels have the integral over the texel as weight, not the density");
    a.builder.add_some(24, [&] { return a.drawn(a.lookup(a.square, Kernel::gaussian(a.builder.between(0.3f, 1))), Estimator::Reservoir); });
    a.builder.add_some(8, [&] { return a.lookup(a.square, Kernel::gaussian(a.builder.between(0.1f, 0.4f))); });
    a.group("weights of either sign are normalised",
            "raw sinc weights do not sum to 1; subtract after shading, and let the result be negative");
    a.builder.add_some(
        32, [&] { return a.drawn(a.lookup(a.tiny, Kernel::Lanczos3, MipMode::None, a.any_wrap(), a.any_wrap()), Estimator::Reservoir); });
    a.builder.add_some(16, [&] { return a.lookup(a.tiny, a.builder.chance(0.5f) ? Kernel::Lanczos3 : Kernel::Lanczos2); });
    a.group("a drawn texel is raw", "a jittered coordinate that goes to a linear sampler is filtered twice");
    a.builder.add_some(32, [&] { return a.drawn(a.lookup(a.square, Kernel::BSpline), Estimator::Jitter); });
    a.group("no blend between two normals", "a drawn texel of a normal map is one facet, not a curve; its length is the texel's");
    a.builder.add_some(16, [&] { return a.drawn(a.lookup(a.tiny, Kernel::Bilinear), Estimator::Reservoir); });
    a.group("what others lack", "quadratic and negative lobes, one probe of many, the ellipse: each is drawn, too");
    for (const Kernel& kernel : {Kernel::Quadratic, Kernel::mitchell(), Kernel::Lanczos3}) {
        a.builder.add_some(8, [&] { return a.drawn(a.lookup(a.odd, kernel), Estimator::Reservoir); });
    }
    a.builder.add_some(8, [&] {
        CaseRecord record = a.drawn(a.lookup(a.square, Kernel::Bilinear), Estimator::Jitter);
        record.ellipse = 1.0f / 6;
        a.footprint(record, 0, 4, 4);
        return record;
    });
    a.group("sRGB texels", "the drawn code is decoded; nothing is ever filtered in codes");
    const uint32_t encoded = add_srgb_texture(a.builder);
    a.builder.add_some(24, [&] { return a.drawn(a.lookup(encoded, Kernel::BSpline), a.either()); });
    a.builder.add_some(8, [&] { return a.lookup(encoded, Kernel::BSpline); });
    a.group("an infinite texel beside", "a tap of weight 0 is not read: 0 times infinity is not a number", true);
    const uint32_t infinite = add_infinite_texture(a.builder);
    for (const int x : {1, 3}) {
        for (const Kernel& kernel : {Kernel::Bilinear, Kernel::CatmullRom}) {
            CaseRecord record = a.lookup(infinite, kernel);
            record.at = {(float(x) + 0.5f) / 4, 0.375f, 0};
            a.builder.add(record);
        }
    }
}

}  // namespace rawtexel::cli
