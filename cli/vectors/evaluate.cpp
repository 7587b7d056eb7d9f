#include "cli/vectors/expectation.h"

#include "texunit/footprint.h"
#include "texunit/shared_draw.h"
#include "texunit/srgb.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace rawtexel::cli {
namespace {

using namespace texunit;

void fill(WaveFloat& wave, float value) { std::fill_n(wave.lane, kWaveLanes, value); }

Kernel kernel_of(uint32_t kind, float b, float c) { return {KernelKind(kind), b, c}; }

PortResult wrap_index(const CaseRecord& record) {
    const int64_t n = record.extent, i = record.index;
    const auto modulo = [](int64_t a, int64_t period) { return (a % period + period) % period; };
    PortResult result;
    switch (Wrap(record.wrap_s)) {
        case Wrap::Repeat: result.x = int32_t(modulo(i, n)); break;
        case Wrap::MirroredRepeat: {
            const int64_t place = modulo(i, 2 * n);
            result.x = int32_t(std::min(place, 2 * n - 1 - place));
            break;
        }
        case Wrap::ClampToEdge: result.x = int32_t(std::clamp<int64_t>(i, 0, n - 1)); break;
        case Wrap::ClampToBorder: result.x = i < 0 || i >= n ? -1 : int32_t(i); break;
        case Wrap::MirrorOnce: result.x = int32_t(std::min(i < 0 ? -1 - i : i, n - 1)); break;
    }
    return result;
}

/// Coordinates of every lane, for the wave functions.
struct CaseWave {
    WaveCoordinates flat;
    WaveCoordinates3 solid;
    WaveFloat layer;
};
void spread(const CaseRecord& record, CaseWave& wave) {
    fill(wave.flat.u, record.at[0]), fill(wave.flat.v, record.at[1]);
    fill(wave.flat.dudx, record.dx[0]), fill(wave.flat.dvdx, record.dx[1]);
    fill(wave.flat.dudy, record.dy[0]), fill(wave.flat.dvdy, record.dy[1]);
    for (size_t axis = 0; axis < 3; ++axis) {
        fill(wave.solid.position[axis], record.at[axis]);
        fill(wave.solid.dx[axis], record.dx[axis]), fill(wave.solid.dy[axis], record.dy[axis]);
    }
    fill(wave.layer, record.layer);
}

bool is_solid(const Shape& shape) { return shape.cube || shape.depth > 1; }

void set_footprint(const Texture& texture, const CaseRecord& record, PortResult& result) {
    SamplerState sampler = sampler_of(record);
    if (is_solid(texture.shape()) || sampler.ellipse > 0) return;
    CaseWave wave;
    spread(record, wave);
    WaveFootprint footprint;
    measure_footprint(texture.levels(), sampler, wave.flat, footprint);
    result.probes = footprint.probes[0];
    result.level = footprint.finer[0];
    result.lod = footprint.lod[0];
}

PortResult sample(const Suite& suite, const CaseRecord& record) {
    const LookupTrace trace = trace_case(suite, record);
    PortResult result;
    set_footprint(suite.textures[record.texture].texture(), record, result);
    result.lod = trace.lod;
    if (record.mip == uint32_t(MipMode::None)) result.level = trace.taps.empty() ? 0 : trace.taps[0].level;
    if (is_solid(suite.textures[record.texture].shape()) && !trace.taps.empty()) result.level = trace.taps[0].level;
    if (trace.taps.size() == 1) {
        const TracedTap& tap = trace.taps[0];
        result.x = tap.border ? -1 : tap.x, result.y = tap.border ? -1 : tap.y, result.slice = tap.slice;
    }
    result.value = trace.result;
    return result;
}

DrawNumbers numbers_of(const CaseRecord& record, bool negative) {
    DrawNumbers numbers;
    fill(numbers.x, negative ? record.negative_x : record.number_x);
    fill(numbers.y, negative ? record.negative_y : record.number_y);
    fill(numbers.z, negative ? record.negative_z : record.number_z);
    fill(numbers.sign, negative ? record.negative_sign : record.number_sign);
    fill(numbers.level, record.number_level);
    fill(numbers.probe, record.number_probe);
    return numbers;
}

/// Draws with these numbers; adds weight times texel to the value.
void draw_with(Texture& texture, const CaseRecord& record, const DrawNumbers& positive, const DrawNumbers& negative, PortResult& result) {
    const SamplerState sampler = sampler_of(record);
    CaseWave wave;
    spread(record, wave);
    LookupSet set;
    set.mask = 1;
    set.count = 1;
    SharedLookup& lookup = set.lookup[0];
    lookup = {.levels = &texture.levels(), .sampler = &sampler, .at = &wave.flat};
    if (is_solid(texture.shape())) lookup.at = nullptr, lookup.solid = &wave.solid, lookup.cube = texture.shape().cube;
    if (texture.shape().cubes() > 1) lookup.layer = &wave.layer, lookup.layers = texture.shape().cubes();
    bool first = true;
    result.value = {};
    draw_shared(set, positive, negative, [&](const SharedTap& tap) {
        if ((tap.lanes & 1) == 0) return;
        const TexelDraw& draw = tap.draw[0];
        const bool border = (draw.border & 1) != 0;
        const std::array<float, 4> texel = border ? sampler.border : texture.texel(draw.level[0], draw.slice[0], draw.x[0], draw.y[0]);
        const float weight = tap.weight[0];
        for (size_t c = 0; c < 4; ++c) result.value[c] += weight * texel[c];
        const int32_t x = border ? -1 : draw.x[0], y = border ? -1 : draw.y[0];
        if (first) {
            result.x = x, result.y = y, result.slice = draw.slice[0], result.level = draw.level[0], result.weight = weight;
        } else {
            result.negative_x = x, result.negative_y = y, result.negative_slice = draw.slice[0], result.negative_weight = -weight;
        }
        first = false;
    });
}

PortResult draw(const Suite& suite, const CaseRecord& record) {
    Texture& texture = suite.textures[record.texture].texture();
    PortResult result, footprint;
    draw_with(texture, record, numbers_of(record, false), numbers_of(record, true), result);
    set_footprint(texture, record, footprint);
    result.lod = footprint.lod, result.probes = footprint.probes;
    return result;
}

RandomAddress address_of(const CaseRecord& record) {
    return {.x = record.pixel_x,
            .y = record.pixel_y,
            .sample = record.sample,
            .surface = record.surface,
            .dimension = Dimension(record.dimension),
            .seed = record.seed};
}

PortResult mean(const Suite& suite, const CaseRecord& record) {
    Texture& texture = suite.textures[record.texture].texture();
    RandomAddress address = address_of(record);
    PortResult result;
    std::array<double, 4> sum{};
    for (uint32_t n = 0; n < record.count; ++n, ++address.sample) {
        DrawNumbers positive, negative;
        positive.z = negative.z = {};
        draw_numbers(address, positive, Noise::White);
        negative_draw_numbers(address, negative, Noise::White);
        PortResult one;
        draw_with(texture, record, positive, negative, one);
        for (size_t c = 0; c < 4; ++c) sum[c] += double(one.value[c]);
    }
    for (size_t c = 0; c < 4; ++c) result.value[c] = float(sum[c] / record.count);
    return result;
}

/// Reflectance at normal incidence of base colour value[0..2] and metalness value[3].
std::array<double, 4> shade(uint32_t shader, const std::array<double, 4>& texel) {
    std::array<double, 4> shaded = texel;
    for (size_t c = 0; c < 4; ++c) {
        if (shader == 1) shaded[c] = texel[c] * texel[c];
        if (shader == 2) shaded[c] = c < 3 ? 0.04 + texel[3] * (texel[c] - 0.04) : texel[3];
    }
    return shaded;
}

PortResult shade_case(const Suite& suite, const CaseRecord& record) {
    const LookupTrace trace = trace_case(suite, record);
    std::array<double, 4> sum{};
    const auto add = [&](double weight, const std::array<double, 4>& what) {
        for (size_t c = 0; c < 4; ++c) sum[c] += weight * what[c];
    };
    for (const TracedTap& tap : trace.taps) {
        const std::array<double, 4> texel = {double(tap.value[0]), double(tap.value[1]), double(tap.value[2]), double(tap.value[3])};
        add(tap.weight, record.order == 1 ? shade(record.shader, texel) : texel);
    }
    if (record.order == 0) sum = shade(record.shader, sum);
    PortResult result;
    for (size_t c = 0; c < 4; ++c) result.value[c] = float(sum[c]);
    return result;
}

PortResult random_number(const CaseRecord& record) {
    PortResult result;
    result.bits = random_bits(address_of(record));
    result.value[0] = unit_float(result.bits);
    return result;
}

PortResult noise_numbers(const CaseRecord& record) {
    WaveFloat a, b;
    noise_pair_wave(Noise(record.noise), address_of(record), Dimension(record.second_dimension), a, b);
    PortResult result;
    result.value[0] = a[0], result.value[1] = b[0];
    return result;
}

PortResult plane(const CaseRecord& record) {
    std::array<float, 3> weight;
    const float largest = std::max({std::abs(record.at[0]), std::abs(record.at[1]), std::abs(record.at[2])});
    for (size_t axis = 0; axis < 3; ++axis) {
        float power = 1, base = std::abs(record.at[axis]) / largest;
        for (uint32_t exponent = record.count; exponent > 0; exponent >>= 1, base *= base) {
            if ((exponent & 1) != 0) power *= base;
        }
        weight[axis] = largest > 0 && std::isfinite(largest) ? power : axis == 2 ? 1.0f : 0.0f;
    }
    const float two = weight[0] + weight[1], sum = two + weight[2], place = record.number_x * sum;
    PortResult result;
    result.x = place < weight[0] ? 0 : place < two ? 1 : 2;
    for (size_t axis = 0; axis < 3; ++axis) result.value[axis] = weight[axis] / sum;
    return result;
}

}  // namespace

SamplerState sampler_of(const CaseRecord& record) {
    SamplerState sampler;
    sampler.wrap_s = Wrap(record.wrap_s), sampler.wrap_t = Wrap(record.wrap_t), sampler.wrap_r = Wrap(record.wrap_r);
    sampler.minify = kernel_of(record.minify, record.minify_b, record.minify_c);
    sampler.magnify = kernel_of(record.magnify, record.magnify_b, record.magnify_c);
    sampler.estimator = Estimator(record.estimator);
    sampler.mip = MipMode(record.mip);
    sampler.lod_rule = LodRule(record.lod_rule);
    sampler.probes = record.probes;
    sampler.probe_variance = record.probe_variance, sampler.ellipse = record.ellipse, sampler.hybrid_bias = record.hybrid_bias;
    sampler.lod_bias = record.lod_bias, sampler.min_lod = record.min_lod, sampler.max_lod = record.max_lod;
    sampler.border = record.border;
    return sampler;
}

void set_sampler(const SamplerState& sampler, CaseRecord& record) {
    record.wrap_s = uint32_t(sampler.wrap_s), record.wrap_t = uint32_t(sampler.wrap_t), record.wrap_r = uint32_t(sampler.wrap_r);
    record.minify = uint32_t(sampler.minify.kind), record.minify_b = sampler.minify.b, record.minify_c = sampler.minify.c;
    record.magnify = uint32_t(sampler.magnify.kind), record.magnify_b = sampler.magnify.b, record.magnify_c = sampler.magnify.c;
    record.estimator = uint32_t(sampler.estimator), record.mip = uint32_t(sampler.mip), record.lod_rule = uint32_t(sampler.lod_rule);
    record.probes = sampler.probes, record.probe_variance = sampler.probe_variance;
    record.ellipse = sampler.ellipse, record.hybrid_bias = sampler.hybrid_bias;
    record.lod_bias = sampler.lod_bias, record.min_lod = sampler.min_lod, record.max_lod = sampler.max_lod;
    record.border = sampler.border;
}

LaneCoordinates flat_coordinates(const CaseRecord& record) {
    return {record.at[0], record.at[1], record.dx[0], record.dx[1], record.dy[0], record.dy[1]};
}
LaneCoordinates3 solid_coordinates(const CaseRecord& record) { return {record.at, record.dx, record.dy}; }

LookupTrace trace_case(const Suite& suite, const CaseRecord& record) {
    Texture& texture = suite.textures[record.texture].texture();
    const SamplerState sampler = sampler_of(record);
    if (texture.shape().cube) return trace_cube_lookup(texture, sampler, solid_coordinates(record), record.layer);
    if (texture.shape().depth > 1) return trace_volume_lookup(texture, sampler, solid_coordinates(record));
    return trace_lookup(texture, sampler, flat_coordinates(record), record.layer);
}

PortResult evaluate(const Suite& suite, const CaseRecord& record) {
    PortResult result;
    switch (record.op) {
        case PortOp::WrapIndex: return wrap_index(record);
        case PortOp::Sample: return sample(suite, record);
        case PortOp::Draw: return draw(suite, record);
        case PortOp::Mean: return mean(suite, record);
        case PortOp::Shade: return shade_case(suite, record);
        case PortOp::SrgbDecode: result.value[0] = srgb8_table()[record.index]; return result;
        case PortOp::SrgbEncode: result.bits = encode_srgb8(record.at[0]); return result;
        case PortOp::BlockTexel:
            result.value = suite.textures[record.texture].texture().texel(0, 0, record.index, record.extent);
            return result;
        case PortOp::Random: return random_number(record);
        case PortOp::NoisePair: return noise_numbers(record);
        case PortOp::Plane: return plane(record);
    }
    return result;
}

}  // namespace rawtexel::cli
