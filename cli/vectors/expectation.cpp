#include "cli/vectors/expectation.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

namespace rawtexel::cli {
namespace {

using texunit::Estimator;
using texunit::Kernel;
using texunit::KernelKind;
using texunit::MipMode;
using texunit::SamplerState;
using texunit::Shape;

std::array<int32_t, kResultWords> words_of(const PortResult& result) {
    std::array<int32_t, kResultWords> words;
    std::memcpy(words.data(), &result, sizeof(result));
    return words;
}

/// All judged fields that are no floats agree.
bool same_choices(const PortResult& a, const PortResult& b, uint32_t judged) {
    const auto left = words_of(a), right = words_of(b);
    for (const RecordField& field : result_fields()) {
        if (field.type == WordType::Float) continue;
        const auto word = size_t(field.word);
        if ((judged & judges(word)) != 0 && left[word] != right[word]) return false;
    }
    return true;
}

float nudged(float number, float by) { return std::clamp(number + by, 0.0f, 1 - 0x1p-24f); }

using Change = std::function<void(CaseRecord&)>;

/// What precision may do to a case, each change by itself.
std::vector<Change> changes_of(const Suite& suite, const CaseRecord& record, const PortFreedom& freedom) {
    std::vector<Change> changes;
    const bool looks_up =
        record.op == PortOp::Sample || record.op == PortOp::Draw || record.op == PortOp::Mean || record.op == PortOp::Shade;
    if (!looks_up && record.op != PortOp::Plane) return changes;
    for (const float sign : {-1.0f, 1.0f}) {
        if (looks_up && freedom.coordinate > 0) {
            const Shape& shape = suite.textures[record.texture].shape();
            const std::array<int, 3> extent = {shape.width, shape.height, shape.depth};
            const float largest = std::max({std::abs(record.at[0]), std::abs(record.at[1]), std::abs(record.at[2])});
            for (size_t axis = 0; axis < (shape.cube || shape.depth > 1 ? 3 : 2); ++axis) {
                const float unit = shape.cube ? largest / float(shape.width) : 1 / float(extent[axis]);
                changes.emplace_back([=](CaseRecord& c) { c.at[axis] += sign * freedom.coordinate * unit; });
            }
        }
        if (looks_up && freedom.lod > 0 && record.mip != uint32_t(MipMode::None))
            changes.emplace_back([=](CaseRecord& c) { c.lod_bias += sign * freedom.lod; });
        if (looks_up && freedom.derivative > 0 && (record.probes > 1 || record.probe_variance > 0 || record.ellipse > 0)) {
            for (size_t axis = 0; axis < 2; ++axis) {
                changes.emplace_back([=](CaseRecord& c) { c.dx[axis] *= 1 + sign * freedom.derivative; });
                changes.emplace_back([=](CaseRecord& c) { c.dy[axis] *= 1 + sign * freedom.derivative; });
            }
        }
        if ((record.op == PortOp::Draw || record.op == PortOp::Plane) && freedom.number > 0) {
            for (float CaseRecord::*number :
                 {&CaseRecord::number_x, &CaseRecord::number_y, &CaseRecord::number_z, &CaseRecord::number_level, &CaseRecord::number_probe,
                  &CaseRecord::number_sign, &CaseRecord::negative_x, &CaseRecord::negative_y, &CaseRecord::negative_z,
                  &CaseRecord::negative_sign})
                changes.emplace_back([=](CaseRecord& c) { c.*number = nudged(c.*number, sign * freedom.number); });
        }
    }
    return changes;
}

/// Largest magnitude that the sums of a case go through: rounding is a part of it.
double magnitude_of(const Suite& suite, const CaseRecord& record, const PortResult& expected) {
    double most = 0;
    for (const float value : expected.value) most = std::max(most, std::abs(double(value)));
    if (record.op == PortOp::Sample || record.op == PortOp::Shade) {
        for (const texunit::TracedTap& tap : trace_case(suite, record).taps) {
            for (const float value : tap.value) {
                if (std::isfinite(value)) most = std::max(most, std::abs(double(value)));
            }
        }
    }
    if (record.op == PortOp::Draw || record.op == PortOp::Mean)
        most = std::max(most, double(expected.weight) + double(expected.negative_weight));
    return std::max(most, 0x1p-20);
}

/// How far each float may be off by rounding alone.
double rounding(const Suite& suite, const CaseRecord& record, const PortResult& expected, size_t word, const PortFreedom& freedom) {
    if (record.op == PortOp::Random || record.op == PortOp::NoisePair) return 0;
    if (record.op == PortOp::SrgbDecode) return 0x1p-20;
    if (record.op == PortOp::BlockTexel) return std::abs(double(expected.value[word - 12])) * 0x1p-18 + 0x1p-22;
    if (word == 9) return std::max(double(freedom.lod), 0x1p-12);
    if (word == 4 || word == 8) return double(freedom.value) * (1 + double(expected.negative_weight));
    return double(freedom.value) * magnitude_of(suite, record, expected);
}

bool is_one_texel(const SamplerState& sampler) {
    return sampler.magnify == Kernel::Nearest && sampler.minify == Kernel::Nearest && sampler.mip != MipMode::Linear &&
           sampler.is_isotropic();
}

/// Of kernels that grow steeply with the coordinate: a draw's weights follow from it.
constexpr double kSafety = 1.5;

}  // namespace

uint32_t judged_fields(const Suite& suite, const CaseRecord& record, const PortResult& expected) {
    switch (record.op) {
        case PortOp::WrapIndex: return judges(0);
        case PortOp::SrgbDecode: return judges(12);
        case PortOp::SrgbEncode: return kJudgesBits;
        case PortOp::Random: return kJudgesBits | judges(12);
        case PortOp::NoisePair: return judges(12) | judges(13);
        case PortOp::Plane: return judges(0) | judges(12) | judges(13) | judges(14);
        case PortOp::BlockTexel:
        case PortOp::Mean:
        case PortOp::Shade: return kJudgesValue;
        default: break;
    }
    const SamplerState sampler = sampler_of(record);
    const Shape& shape = suite.textures[record.texture].shape();
    const bool solid = shape.cube || shape.depth > 1 || shape.layers > 1;
    uint32_t judged = kJudgesValue;
    if (record.op == PortOp::Sample) {
        if (sampler.mip != MipMode::None && sampler.ellipse <= 0) judged |= kJudgesLod;
        if (sampler.mip == MipMode::Nearest && sampler.ellipse <= 0) judged |= kJudgesLevel;
        if (sampler.probes > 1 && sampler.ellipse <= 0) judged |= kJudgesProbes;
        if (is_one_texel(sampler)) judged |= kJudgesTexel | kJudgesLevel | (solid ? kJudgesSlice : 0);
        return judged;
    }
    judged |= kJudgesTexel | kJudgesLevel | kJudgesWeight | (solid ? kJudgesSlice : 0);
    if (expected.x == -1) judged &= ~kJudgesSlice;
    const bool lobes = !weighs_as_probability(sampler.minify) || !weighs_as_probability(sampler.magnify);
    if (!lobes || sampler.estimator == Estimator::AbsWeight) return judged;
    judged |= kJudgesNegativeWeight;
    // Of next to no negative weight the texel means nothing.
    if (expected.negative_weight > 0x1p-10f)
        judged |= kJudgesNegativeTexel | (solid && expected.negative_x != -1 ? kJudgesNegativeSlice : 0);
    return judged;
}

std::optional<Expectation> expect(const Suite& suite, const CaseRecord& record, const PortFreedom& freedom) {
    Expectation e;
    e.expected = e.least = e.most = evaluate(suite, record);
    e.judged = judged_fields(suite, record, e.expected);
    std::array<double, kResultWords> spread{};
    const auto value_of = [](const PortResult& result, size_t word) {
        float value;
        std::memcpy(&value, reinterpret_cast<const char*>(&result) + 4 * word, 4);
        return value;
    };
    for (const Change& change : changes_of(suite, record, freedom)) {
        CaseRecord changed = record;
        change(changed);
        const PortResult result = evaluate(suite, changed);
        if (!same_choices(e.expected, result, e.judged)) return std::nullopt;
        for (size_t word = 0; word < kResultWords; ++word)
            spread[word] = std::max(spread[word], 0.0) + std::abs(double(value_of(result, word)) - double(value_of(e.expected, word)));
    }
    for (const RecordField& field : result_fields()) {
        if (field.type != WordType::Float) continue;
        for (auto word = size_t(field.word); word < size_t(field.word + field.count); ++word) {
            if ((e.judged & judges(word)) == 0) continue;
            const float expected = value_of(e.expected, word);
            // Infinities are what they are.
            if (!std::isfinite(expected)) continue;
            // Both directions of a change were added up.
            const double by = kSafety / 2 * spread[word] + rounding(suite, record, e.expected, word, freedom);
            const float least = float(double(expected) - by), most = float(double(expected) + by);
            std::memcpy(reinterpret_cast<char*>(&e.least) + 4 * word, &least, 4);
            std::memcpy(reinterpret_cast<char*>(&e.most) + 4 * word, &most, 4);
        }
    }
    return e;
}

}  // namespace rawtexel::cli
