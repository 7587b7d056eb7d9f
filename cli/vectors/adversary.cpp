#include "cli/vectors/adversary.h"

#include <cmath>

namespace rawtexel::cli {

using texunit::Estimator;
using texunit::Kernel;
using texunit::MipMode;
using texunit::SamplerState;
using texunit::Wrap;

CaseRecord Adversary::lookup(uint32_t texture, const Kernel& kernel, MipMode mip, Wrap s, Wrap t) {
    SamplerState sampler;
    sampler.magnify = sampler.minify = kernel;
    sampler.mip = mip;
    sampler.wrap_s = s, sampler.wrap_t = t, sampler.wrap_r = s;
    sampler.border = {0.9f, 0.1f, 0.6f, 0.4f};
    CaseRecord record;
    record.op = PortOp::Sample;
    record.texture = texture;
    set_sampler(sampler, record);
    record.at = {builder.unit(), builder.unit(), builder.unit()};
    record.layer = float(builder.below(4));
    if (texture == cube) record.at = {builder.between(-1, 1), builder.between(-1, 1), builder.between(-1, 1)};
    return record;
}

CaseRecord Adversary::drawn(CaseRecord record, Estimator estimator) {
    record.op = PortOp::Draw;
    record.estimator = uint32_t(estimator);
    builder.draw_numbers(record);
    return record;
}

CaseRecord Adversary::mean(CaseRecord record, Estimator estimator, uint32_t count) {
    record.op = PortOp::Mean;
    record.estimator = uint32_t(estimator);
    record.count = count;
    record.pixel_x = uint32_t(builder.below(1000)), record.pixel_y = uint32_t(builder.below(1000));
    return record;
}

void Adversary::footprint(CaseRecord& record, float least_log2, float most_log2, float ratio) {
    builder.draw_footprint(record, std::exp2(builder.between(least_log2, most_log2)), ratio);
}

void Adversary::solid_footprint(CaseRecord& record) {
    const float size = std::exp2(builder.between(-6, -1));
    for (size_t axis = 0; axis < 3; ++axis) record.dx[axis] = builder.between(-size, size), record.dy[axis] = builder.between(-size, size);
}

Suite make_adversarial_suite() {
    Adversary adversary;
    add_address_pitfalls(adversary);
    add_level_pitfalls(adversary);
    add_draw_pitfalls(adversary);
    add_number_pitfalls(adversary);
    add_order_pitfalls(adversary);
    return adversary.builder.take();
}

}  // namespace rawtexel::cli
