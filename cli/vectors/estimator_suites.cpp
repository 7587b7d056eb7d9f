// Suites about what becomes of the weights: kernels, estimators, levels drawn, planes drawn.
#include "cli/vectors/suite_builder.h"

#include <cmath>

namespace rawtexel::cli {
namespace {

using texunit::Estimator;
using texunit::Kernel;
using texunit::MipMode;
using texunit::SamplerState;
using texunit::Wrap;

constexpr std::array kWraps = {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge, Wrap::ClampToBorder, Wrap::MirrorOnce};

std::vector<Kernel> tried_kernels() {
    return {Kernel::Nearest,
            Kernel::Bilinear,
            Kernel::Quadratic,
            Kernel::BSpline,
            Kernel::mitchell(),
            Kernel::mitchell(0, 0),
            Kernel::mitchell(1.5f, -0.25f),
            Kernel::CatmullRom,
            Kernel::Lanczos2,
            Kernel::Lanczos3,
            Kernel::gaussian(0.3f),
            Kernel::gaussian(),
            Kernel::gaussian(1.25f),
            Kernel::gaussian_point(0.3f),
            Kernel::gaussian_point(),
            Kernel::gaussian_point(1)};
}

CaseRecord case_of(SuiteBuilder& builder, uint32_t texture, const Kernel& kernel, Estimator estimator) {
    SamplerState sampler;
    sampler.magnify = sampler.minify = kernel;
    sampler.mip = MipMode::None;
    sampler.estimator = estimator;
    sampler.wrap_s = kWraps[size_t(builder.below(5))], sampler.wrap_t = kWraps[size_t(builder.below(5))];
    sampler.border = {0.3f, 0.7f, 0.2f, 0.8f};
    CaseRecord record;
    record.op = estimator == Estimator::All ? PortOp::Sample : PortOp::Draw;
    record.texture = texture;
    set_sampler(sampler, record);
    record.at = {builder.between(-1, 2), builder.between(-1, 2), 0};
    builder.draw_numbers(record);
    return record;
}

}  // namespace

Suite make_kernels_suite() {
    SuiteBuilder builder("kernels", "the weights of every kernel, and the texel that every estimator draws from them");
    const uint32_t odd = builder.add_noise_texture("odd 23x19", {.width = 23, .height = 19});
    for (const Kernel& kernel : tried_kernels()) {
        for (const texunit::EstimatorInfo& estimator : texunit::all_estimators()) {
            if (!refusal(estimator.estimator, kernel).empty()) continue;
            builder.begin_group(to_string(kernel) + " " + std::string(estimator.name), std::string(estimator.description));
            builder.add_some(24, [&] { return case_of(builder, odd, kernel, estimator.estimator); });
        }
    }
    return builder.take();
}

Suite make_positivization_suite() {
    SuiteBuilder builder("positivization", "kernels with negative lobes: one texel of either sign, (1 + W)*S(positive) - W*S(negative)");
    const uint32_t odd = builder.add_noise_texture("odd 23x19", {.width = 23, .height = 19});
    const uint32_t square = builder.add_noise_texture("square 16x16", {.width = 16, .height = 16});
    const uint32_t constant = builder.add_constant_texture("constant 8x8", 8, 8, {0.125f, 0.5f, 0.875f, 1});
    const std::array kernels = {Kernel::mitchell(), Kernel::CatmullRom, Kernel::Lanczos2, Kernel::Lanczos3};
    for (const Kernel& kernel : kernels) {
        const std::string name = to_string(kernel);
        builder.begin_group("both signs " + name, "signs of the axes first, each axis then from the weights of its sign");
        builder.add_some(64, [&] { return case_of(builder, odd, kernel, Estimator::Reservoir); });
        builder.begin_group("a constant stays " + name, "W+ - W- = 1: a constant has no variance, which drawing by |w| gives it");
        builder.add_some(24, [&] { return case_of(builder, constant, kernel, Estimator::Reservoir); });
        builder.begin_group("on a texel's centre " + name, "no weight is negative there: one texel, of weight 1", true);
        for (int n = 0; n < 8; ++n) {
            CaseRecord record = case_of(builder, square, kernel, Estimator::Reservoir);
            record.at = {(float(builder.below(16)) + 0.5f) / 16, (float(builder.below(16)) + 0.5f) / 16, 0};
            builder.add(record);
        }
        builder.begin_group("between levels " + name, "both texels come from the level that is drawn");
        builder.add_some(24, [&] {
            CaseRecord record = case_of(builder, odd, kernel, Estimator::Reservoir);
            record.mip = uint32_t(MipMode::Linear);
            builder.draw_footprint(record, std::exp2(builder.between(0, 4)), 1.5f);
            return record;
        });
    }
    return builder.take();
}

Suite make_mip_choice_suite() {
    SuiteBuilder builder("mip-choice", "one of two levels drawn: the coarser where the number is below its weight");
    const uint32_t wide = builder.add_noise_texture("wide 64x32", {.width = 64, .height = 32});
    const uint32_t odd = builder.add_noise_texture("odd 45x60", {.width = 45, .height = 60});
    const auto some = [&](const Kernel& kernel, float least, float most) {
        CaseRecord record =
            case_of(builder, builder.chance(0.5f) ? wide : odd, kernel,
                    builder.chance(0.5f) || !refusal(Estimator::Jitter, kernel).empty() ? Estimator::Reservoir : Estimator::Jitter);
        record.mip = uint32_t(MipMode::Linear);
        builder.draw_footprint(record, std::exp2(builder.between(least, most)), 1.5f);
        return record;
    };
    for (const Kernel& kernel : {Kernel::Nearest, Kernel::Bilinear, Kernel::BSpline}) {
        builder.begin_group("between levels " + to_string(kernel), "level = floor(lambda) + (number < fraction)");
        builder.add_some(64, [&] { return some(kernel, 0, 5); });
    }
    builder.begin_group("beyond the levels", "lambda is clamped before it is split: no number moves the last level or level 0");
    builder.add_some(48, [&] { return builder.chance(0.5f) ? some(Kernel::Bilinear, 7, 12) : some(Kernel::Bilinear, -6, -0.1f); });
    builder.begin_group("bounds", "between the levels that bounds and bias leave");
    builder.add_some(48, [&] {
        CaseRecord record = some(Kernel::Bilinear, 0, 6);
        record.min_lod = builder.between(0, 3), record.max_lod = builder.between(0, 4), record.lod_bias = builder.between(-1, 1);
        return record;
    });
    builder.begin_group("nearest level", "where one level is read no number decides");
    builder.add_some(32, [&] {
        CaseRecord record = some(Kernel::Bilinear, 0, 5);
        record.mip = uint32_t(MipMode::Nearest);
        return record;
    });
    return builder.take();
}

Suite make_triplanar_suite() {
    SuiteBuilder builder("triplanar", "weights |n|^sharpness of the three planes, and one of them drawn");
    builder.begin_group("planes", "x, y, z in this order, by one number");
    builder.add_some(128, [&] {
        CaseRecord record;
        record.op = PortOp::Plane;
        record.at = {builder.between(-1, 1), builder.between(-1, 1), builder.between(-1, 1)};
        record.count = uint32_t(1 + builder.below(16));
        record.number_x = builder.unit();
        return record;
    });
    builder.begin_group("one plane alone", "a normal along an axis draws it with any number", true);
    for (size_t axis = 0; axis < 3; ++axis) {
        for (const float length : {-1.0f, 1.0f, 1e-6f, -2.5f}) {
            for (const float number : {0.0f, 0.5f, 1 - 0x1p-24f}) {
                CaseRecord record;
                record.op = PortOp::Plane;
                record.at[axis] = length;
                record.count = 4;
                record.number_x = number;
                builder.add(record);
            }
        }
    }
    return builder.take();
}

}  // namespace rawtexel::cli
