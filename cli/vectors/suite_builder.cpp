#include "cli/vectors/suite_builder.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

namespace rawtexel::cli {
namespace {

std::vector<std::byte> bytes_of(const std::vector<float>& values) {
    std::vector<std::byte> bytes(values.size() * 4);
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

texunit::Shape with_all_levels(texunit::Shape shape) {
    shape.levels = texunit::full_level_count(shape.width, shape.height, shape.depth);
    return shape;
}

}  // namespace

SuiteBuilder::SuiteBuilder(std::string_view name, std::string_view about) : seed_(0) {
    suite_.name = name;
    suite_.about = about;
    for (const char letter : name) seed_ = texunit::mix_bits(seed_ ^ uint32_t(letter));
}

uint32_t SuiteBuilder::add_texture(SuiteTexture texture) {
    suite_.textures.push_back(std::move(texture));
    return uint32_t(suite_.textures.size() - 1);
}

uint32_t SuiteBuilder::add_noise_texture(std::string name, const texunit::Shape& extents) {
    const texunit::Shape shape = with_all_levels(extents);
    std::vector<float> values(4 * texels_of(shape));
    for (float& value : values) value = float(bits() >> 24) / 255;
    return add_texture({std::move(name), texunit::Format::RGBA32Float, shape, bytes_of(values)});
}

uint32_t SuiteBuilder::add_constant_texture(std::string name, int width, int height, const std::array<float, 4>& value) {
    const texunit::Shape shape = with_all_levels({.width = width, .height = height});
    std::vector<float> values;
    for (size_t n = texels_of(shape); n > 0; --n) values.insert(values.end(), value.begin(), value.end());
    return add_texture({std::move(name), texunit::Format::RGBA32Float, shape, bytes_of(values)});
}

void SuiteBuilder::begin_group(std::string name, std::string about, bool exact) {
    suite_.groups.push_back({std::move(name), std::move(about), uint32_t(suite_.cases.size()), 0, exact});
}

bool SuiteBuilder::add(const CaseRecord& record) {
    CaseGroup& group = suite_.groups.back();
    const std::optional<Expectation> expected = expect(suite_, record, group.exact ? kExactFreedom : PortFreedom{});
    if (!expected) return false;
    suite_.cases.push_back(record);
    suite_.expected.push_back(*expected);
    ++group.count;
    return true;
}

void SuiteBuilder::draw_numbers(CaseRecord& record) {
    for (float CaseRecord::*number :
         {&CaseRecord::number_x, &CaseRecord::number_y, &CaseRecord::number_z, &CaseRecord::number_level, &CaseRecord::number_probe,
          &CaseRecord::number_sign, &CaseRecord::negative_x, &CaseRecord::negative_y, &CaseRecord::negative_z, &CaseRecord::negative_sign})
        record.*number = unit();
}

void SuiteBuilder::draw_footprint(CaseRecord& record, float longer, float ratio) {
    const texunit::Shape& shape = suite_.textures[record.texture].shape();
    const float shorter = longer / ratio, turn = between(0, 2 * std::numbers::pi_v<float>), skew = between(-0.3f, 0.3f);
    const float c = std::cos(turn), s = std::sin(turn);
    const auto width = float(shape.width), height = float(shape.height);
    // The axes are a little askew, as those of a surface seen from aside are.
    record.dx = {longer * c / width, longer * s / height, 0};
    record.dy = {shorter * (-s + skew * c) / width, shorter * (c + skew * s) / height, 0};
    if (chance(0.5f)) std::swap(record.dx, record.dy);
}

Suite SuiteBuilder::take() { return std::move(suite_); }

}  // namespace rawtexel::cli
