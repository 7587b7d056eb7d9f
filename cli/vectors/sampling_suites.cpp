// Suites about where a lookup reads: addresses, levels, probes, ellipses.
#include "cli/vectors/suite_builder.h"

#include <cmath>
#include <limits>

namespace rawtexel::cli {
namespace {

using texunit::Kernel;
using texunit::MipMode;
using texunit::SamplerState;
using texunit::Wrap;

constexpr std::array kWraps = {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge, Wrap::ClampToBorder, Wrap::MirrorOnce};
constexpr std::array<float, 4> kBorder = {0.9f, 0.1f, 0.6f, 0.4f};
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

SamplerState sampler_with(const Kernel& kernel, MipMode mip, Wrap s = Wrap::Repeat, Wrap t = Wrap::Repeat) {
    SamplerState sampler;
    sampler.magnify = sampler.minify = kernel;
    sampler.mip = mip;
    sampler.wrap_s = s, sampler.wrap_t = t;
    sampler.border = kBorder;
    return sampler;
}

CaseRecord sample_case(uint32_t texture, const SamplerState& sampler) {
    CaseRecord record;
    record.op = PortOp::Sample;
    record.texture = texture;
    set_sampler(sampler, record);
    return record;
}

void add_indices(SuiteBuilder& builder) {
    for (const Wrap wrap : kWraps) {
        builder.begin_group("index " + std::string(to_string(wrap)),
                            "texel indices are wrapped as integers, ((i % n) + n) % n and so on, after taps are selected", true);
        for (const int extent : {1, 2, 3, 5, 8, 17, 64}) {
            CaseRecord record;
            record.op = PortOp::WrapIndex;
            record.wrap_s = uint32_t(wrap);
            record.extent = extent;
            for (int i = -2 * extent - 2; i <= 2 * extent + 2; ++i) record.index = i, builder.add(record);
            for (const int i : {-1000003, -65537, 65537, 1000003}) record.index = i, builder.add(record);
        }
    }
}

void add_lookups(SuiteBuilder& builder, uint32_t odd, uint32_t square, uint32_t thin) {
    for (const Wrap wrap : kWraps) {
        const std::string name(to_string(wrap));
        const SamplerState nearest = sampler_with(Kernel::Nearest, MipMode::None, wrap, wrap);
        builder.begin_group("nearest " + name, "floor(u*n), then the index is wrapped");
        for (const uint32_t texture : {odd, square, thin}) {
            builder.add_some(32, [&] {
                CaseRecord record = sample_case(texture, nearest);
                record.at = {builder.between(-3, 4), builder.between(-3, 4), 0};
                return record;
            });
        }
        builder.begin_group("texel edges " + name, "a coordinate on an edge belongs to the texel after it; -0, 1, and what is next to them",
                            true);
        for (int k = -17; k <= 17; ++k) {
            CaseRecord record = sample_case(square, nearest);
            record.at = {float(k) / 8, float(k + 3) / 8, 0};
            builder.add(record);
        }
        for (const float u : {0.0f, -0.0f, 1.0f, -1.0f, 2.0f, -1e-9f, 1e-9f, -0x1p-120f, std::nextafter(1.0f, 0.0f),
                              std::nextafter(1.0f, 2.0f), std::nextafter(-1.0f, 0.0f), std::nextafter(-1.0f, -2.0f)}) {
            CaseRecord record = sample_case(square, nearest);
            record.at = {u, 0.25f, 0};
            builder.add(record);
            record.at = {0.25f, u, 0};
            builder.add(record);
        }
        builder.begin_group("bilinear " + name, "the centre of texel i is at i + 1/2; each of the four taps wraps by itself");
        for (const uint32_t texture : {odd, square, thin}) {
            builder.add_some(32, [&] {
                CaseRecord record = sample_case(texture, sampler_with(Kernel::Bilinear, MipMode::None, wrap, wrap));
                record.at = {builder.between(-2, 3), builder.between(-2, 3), 0};
                return record;
            });
        }
    }
    builder.begin_group("two wraps", "each axis has its own");
    builder.add_some(64, [&] {
        const auto one = [&] { return kWraps[size_t(builder.below(5))]; };
        CaseRecord record =
            sample_case(odd, sampler_with(builder.chance(0.5f) ? Kernel::Nearest : Kernel::Bilinear, MipMode::None, one(), one()));
        record.at = {builder.between(-2, 3), builder.between(-2, 3), 0};
        return record;
    });
}

}  // namespace

Suite make_addressing_suite() {
    SuiteBuilder builder("addressing", "wraps of texel indices and of coordinates, nearest and bilinear");
    const uint32_t odd = builder.add_noise_texture("odd 7x5", {.width = 7, .height = 5});
    const uint32_t square = builder.add_noise_texture("square 8x8", {.width = 8, .height = 8});
    const uint32_t thin = builder.add_noise_texture("thin 1x9", {.width = 1, .height = 9});
    add_indices(builder);
    add_lookups(builder, odd, square, thin);
    builder.begin_group("far from the origin", "whole repeats are taken away before u is scaled, or 32-bit floats lose the fraction");
    for (const Wrap wrap : {Wrap::Repeat, Wrap::MirroredRepeat}) {
        builder.add_some(32, [&] {
            CaseRecord record = sample_case(odd, sampler_with(Kernel::Bilinear, MipMode::None, wrap, wrap));
            record.at = {4096 + builder.unit(), -4096 + builder.unit(), 0};
            return record;
        });
    }
    builder.begin_group("not finite", "a coordinate that is not finite reads as 0", true);
    for (const float u : {kNan, kInfinity, -kInfinity}) {
        for (const Wrap wrap : kWraps) {
            CaseRecord record = sample_case(square, sampler_with(Kernel::Nearest, MipMode::None, wrap, wrap));
            record.at = {u, 0.4375f, 0};
            builder.add(record);
        }
    }
    return builder.take();
}

Suite make_lod_suite() {
    SuiteBuilder builder("lod", "the level of detail from derivatives, its bias and bounds, and what is read from levels");
    const uint32_t wide = builder.add_noise_texture("wide 64x16", {.width = 64, .height = 16});
    const uint32_t odd = builder.add_noise_texture("odd 45x60", {.width = 45, .height = 60});
    const auto some = [&](const SamplerState& sampler) {
        CaseRecord record = sample_case(builder.chance(0.5f) ? wide : odd, sampler);
        record.at = {builder.unit(), builder.unit(), 0};
        builder.draw_footprint(record, std::exp2(builder.between(-2, 7)), std::exp2(builder.between(0, 3)));
        return record;
    };
    for (const texunit::LodRule rule : {texunit::LodRule::D3d, texunit::LodRule::Exact}) {
        for (const MipMode mip : {MipMode::Linear, MipMode::Nearest}) {
            SamplerState sampler = sampler_with(Kernel::Bilinear, mip);
            sampler.lod_rule = rule;
            const bool longer = rule == texunit::LodRule::D3d;
            builder.begin_group(std::string(to_string(rule)) + " rule, mip " + std::string(to_string(mip)),
                                longer ? "lambda = log2 of the longer derivative in texels of level 0"
                                       : "lambda = log2 of the larger singular value of the derivatives");
            builder.add_some(64, [&] { return some(sampler); });
        }
    }
    builder.begin_group("nearest texel of the nearest level", "sizes of levels are max(1, n >> level)");
    builder.add_some(48, [&] { return some(sampler_with(Kernel::Nearest, MipMode::Nearest)); });
    builder.begin_group("bias", "is added to lambda, it does not replace it");
    builder.add_some(48, [&] {
        SamplerState sampler = sampler_with(Kernel::Bilinear, builder.chance(0.5f) ? MipMode::Linear : MipMode::Nearest);
        sampler.lod_bias = builder.between(-3, 3);
        return some(sampler);
    });
    builder.begin_group("bounds", "lambda is clamped to [min, max]; where they cross min wins");
    builder.add_some(48, [&] {
        SamplerState sampler = sampler_with(Kernel::Bilinear, MipMode::Linear);
        sampler.min_lod = builder.between(0, 4), sampler.max_lod = builder.between(0, 5);
        sampler.lod_bias = builder.between(-1, 1);
        return some(sampler);
    });
    builder.begin_group("two kernels", "magnification is decided after bias and bounds");
    builder.add_some(32, [&] {
        SamplerState sampler = sampler_with(Kernel::Bilinear, MipMode::Linear);
        sampler.magnify = Kernel::BSpline;
        CaseRecord record = some(sampler);
        builder.draw_footprint(record, std::exp2(builder.between(-2, 2)), 1.5f);
        return record;
    });
    builder.begin_group("degenerate", "no derivative: level 0; tiny and huge ones; not finite: the last level");
    for (const float size : {0.0f, 0x1p-120f, 1e-30f, 1e-10f, 1e10f, 1e18f, kInfinity, kNan}) {
        for (const bool along_x : {false, true}) {
            CaseRecord record = sample_case(odd, sampler_with(Kernel::Bilinear, MipMode::Linear));
            record.at = {0.3f, 0.6f, 0};
            (along_x ? record.dx : record.dy) = {size, 0, 0};
            builder.add(record);
        }
    }
    return builder.take();
}

Suite make_anisotropy_suite() {
    SuiteBuilder builder("anisotropy", "number, places and level of anisotropic probes; one of them drawn");
    const uint32_t square = builder.add_noise_texture("square 64x64", {.width = 64, .height = 64});
    const auto some = [&](SamplerState sampler) {
        CaseRecord record = sample_case(square, sampler);
        record.at = {builder.between(-1, 2), builder.between(-1, 2), 0};
        builder.draw_footprint(record, std::exp2(builder.between(0, 5)), std::exp2(builder.between(0, 5)));
        return record;
    };
    for (const int probes : {2, 4, 8, 16, 64}) {
        builder.begin_group(
            "up to " + std::to_string(probes) + " probes",
            "eta = longer/shorter, ceil(eta) probes of equal weight along the longer derivative, at the level of longer/eta");
        builder.add_some(24, [&] {
            SamplerState sampler = sampler_with(Kernel::Bilinear, MipMode::Linear);
            sampler.probes = probes;
            return some(sampler);
        });
    }
    builder.begin_group("beyond 16 probes", "the sampler says how many there may be, not the device that a port was written for");
    builder.add_some(24, [&] {
        SamplerState sampler = sampler_with(Kernel::Bilinear, MipMode::Linear);
        sampler.probes = 64;
        CaseRecord record = some(sampler);
        builder.draw_footprint(record, std::exp2(builder.between(4.3f, 6)), std::exp2(builder.between(4.2f, 6)));
        return record;
    });
    builder.begin_group("axes of the ellipse", "singular values and the major axis instead of the derivatives");
    builder.add_some(32, [&] {
        SamplerState sampler = sampler_with(Kernel::Bilinear, MipMode::Linear);
        sampler.probes = 16, sampler.lod_rule = texunit::LodRule::Exact;
        return some(sampler);
    });
    builder.begin_group("magnified across", "an axis shorter than a texel takes fewer probes, but the level keeps the ratio");
    builder.add_some(32, [&] {
        SamplerState sampler = sampler_with(Kernel::Bilinear, MipMode::Linear);
        sampler.probes = 16;
        CaseRecord record = some(sampler);
        builder.draw_footprint(record, builder.between(0.5f, 6), builder.between(2, 16));
        return record;
    });
    builder.begin_group("bias of the level", "changes the level, not the number of probes");
    builder.add_some(24, [&] {
        SamplerState sampler = sampler_with(Kernel::Bilinear, MipMode::Linear);
        sampler.probes = 8, sampler.lod_bias = builder.between(-2, 2);
        return some(sampler);
    });
    builder.begin_group("normal probes", "covariance S2*J*J^T + I/6 shared out between probes and level");
    builder.add_some(48, [&] {
        SamplerState sampler = sampler_with(Kernel::Bilinear, MipMode::Linear);
        sampler.probes = 2 << builder.below(5), sampler.probe_variance = 1.0f / 6;
        return some(sampler);
    });
    for (const float variance : {0.0f, 1.0f / 6}) {
        builder.begin_group(variance > 0 ? "one normal probe drawn" : "one probe drawn",
                            "any number of probes for one texel: the probe, the level and the texel have numbers of their own");
        builder.add_some(96, [&] {
            SamplerState sampler = sampler_with(Kernel::Bilinear, MipMode::Linear);
            sampler.probes = 16, sampler.probe_variance = variance;
            sampler.estimator = builder.chance(0.5f) ? texunit::Estimator::Reservoir : texunit::Estimator::Jitter;
            CaseRecord record = some(sampler);
            record.op = PortOp::Draw;
            builder.draw_numbers(record);
            return record;
        });
    }
    return builder.take();
}

Suite make_elliptical_suite() {
    SuiteBuilder builder("elliptical", "the exact elliptical Gaussian of covariance S2*J*J^T + I/6 over level 0, weighed and drawn");
    const uint32_t square = builder.add_noise_texture("square 32x32", {.width = 32, .height = 32});
    const uint32_t odd = builder.add_noise_texture("odd 13x21", {.width = 13, .height = 21});
    const uint32_t constant = builder.add_constant_texture("constant 16x16", 16, 16, {0.25f, 0.5f, 0.75f, 1});
    const auto some = [&](uint32_t texture, float longest, float ratio) {
        SamplerState sampler =
            sampler_with(Kernel::Bilinear, MipMode::Linear, kWraps[size_t(builder.below(5))], kWraps[size_t(builder.below(5))]);
        sampler.ellipse = builder.chance(0.5f) ? 1.0f / 6 : 1.0f / 12;
        CaseRecord record = sample_case(texture, sampler);
        record.at = {builder.between(-1, 2), builder.between(-1, 2), 0};
        builder.draw_footprint(record, longest, ratio);
        return record;
    };
    builder.begin_group("weighed", "the sum over all texels that the Gaussian reaches, each integrated over its box");
    builder.add_some(40, [&] {
        return some(builder.chance(0.5f) ? square : odd, std::exp2(builder.between(-2, 3.5f)), std::exp2(builder.between(0, 4)));
    });
    builder.begin_group("magnified", "I/6 remains: no smaller than a pixel's own reconstruction");
    builder.add_some(16, [&] { return some(square, builder.between(0, 0.2f), 2); });
    builder.begin_group("a constant stays", "weights sum to 1 whatever the ellipse");
    builder.add_some(16, [&] { return some(constant, std::exp2(builder.between(-1, 4)), std::exp2(builder.between(0, 4))); });
    builder.begin_group("drawn", "offset = L*normal numbers with L*L^T = S2*J*J^T + I/12, then the texel that holds it");
    const auto drawn = [&](float longest, float ratio) {
        CaseRecord record = some(builder.chance(0.5f) ? square : odd, longest, ratio);
        record.op = PortOp::Draw;
        record.estimator = uint32_t(texunit::Estimator::Jitter);
        builder.draw_numbers(record);
        return record;
    };
    builder.add_some(96, [&] { return drawn(std::exp2(builder.between(-2, 5)), std::exp2(builder.between(0, 5))); });
    builder.begin_group("drawn beyond 16:1", "the missing variance is 1 - r^2 of the axis, no less: any ratio is one draw");
    builder.add_some(48, [&] { return drawn(builder.between(20, 200), builder.chance(0.5f) ? 20.0f : 64.0f); });
    builder.begin_group("huge", "a footprint of more than 2^18 texels draws from the finest level at which it is smaller");
    builder.add_some(32, [&] { return drawn(std::exp2(builder.between(10, 16)), std::exp2(builder.between(0, 3))); });
    builder.begin_group("levels of their own", "with a bias the level is drawn, and what it has filtered is taken off the ellipse");
    builder.add_some(48, [&] {
        CaseRecord record = drawn(std::exp2(builder.between(1, 5)), std::exp2(builder.between(0, 2)));
        record.hybrid_bias = builder.between(0, 2);
        return record;
    });
    return builder.take();
}

}  // namespace rawtexel::cli
