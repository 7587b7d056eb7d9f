// A suite for the device's own texture unit: what Vulkan asks of every implementation is legal, and the report tells how much better one is
// (cli/vectors/hardware_report.h).
#include "cli/vectors/hardware_report.h"
#include "cli/vectors/suite_builder.h"
#include "texunit/memory_source.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rawtexel::cli {
namespace {

using texunit::Format;
using texunit::Kernel;
using texunit::MipMode;
using texunit::SamplerState;
using texunit::Shape;
using texunit::Wrap;

/// Subtexel and level bits that every implementation has (Vulkan "Required Limits": subTexelPrecisionBits, mipmapPrecisionBits).
constexpr int kLeastBits = 4;

uint32_t add_codes_texture(SuiteBuilder& builder, std::string name, int width, int height) {
    Shape shape{.width = width, .height = height, .levels = texunit::full_level_count(width, height)};
    size_t texels = 0;
    for (int level = 0; level < shape.levels; ++level) texels += texels_of_level(shape, level);
    std::vector<std::byte> codes(4 * texels);
    for (std::byte& code : codes) code = std::byte(builder.bits() >> 24);
    return builder.add_texture({std::move(name), Format::RGBA8Unorm, shape, std::move(codes)});
}

/// White noise whose levels are filtered from each other, as footprints of many texels need them.
uint32_t add_filtered_texture(SuiteBuilder& builder, std::string name, int extent) {
    std::vector<std::byte> codes(4 * size_t(extent) * size_t(extent));
    for (std::byte& code : codes) code = std::byte(builder.bits() >> 24);
    texunit::Texture pyramid(name, texunit::make_memory_source(Format::RGBA8Unorm, extent, extent, codes));
    std::vector<std::byte> all;
    for (int level = 0; level < pyramid.shape().levels; ++level) {
        for (int y = 0; y < texunit::level_extent(extent, level); ++y) {
            for (int x = 0; x < texunit::level_extent(extent, level); ++x) {
                for (const float value : pyramid.texel(level, 0, x, y)) all.push_back(std::byte(std::lround(255 * value)));
            }
        }
    }
    return builder.add_texture({std::move(name), Format::RGBA8Unorm, pyramid.shape(), std::move(all)});
}

/// Takes the case with the interval that the least precision leaves. Footprints of several probes are measured, not judged.
void add(SuiteBuilder& builder, const CaseRecord& record) {
    Suite& suite = builder.suite();
    Expectation e;
    e.expected = e.least = e.most = evaluate(suite, record);
    const double threshold = hardware_threshold(suite, record);
    const bool compressed = texunit::info(suite.textures[record.texture].format()).block_compressed;
    texunit::LegalVerdict verdict;
    for (size_t c = 0; c < 4; ++c) verdict.least[c] = verdict.most[c] = double(e.expected.value[c]);
    if (record.probes == 1 && !compressed) verdict = judge_hardware(suite, record, e.expected, {kLeastBits, kLeastBits, false});
    for (size_t c = 0; c < 4 && record.probes == 1; ++c) {
        e.judged |= judges(12 + c);
        e.least.value[c] = std::min(float(verdict.least[c] - threshold), e.expected.value[c]);
        e.most.value[c] = std::max(float(verdict.most[c] + threshold), e.expected.value[c]);
    }
    suite.cases.push_back(record);
    suite.expected.push_back(e);
    ++suite.groups.back().count;
}

CaseRecord case_of(uint32_t texture, const Kernel& kernel, MipMode mip, Wrap s, Wrap t) {
    SamplerState sampler;
    sampler.magnify = sampler.minify = kernel;
    sampler.mip = mip;
    sampler.wrap_s = s, sampler.wrap_t = t;
    CaseRecord record;
    record.op = PortOp::Sample;
    record.texture = texture;
    set_sampler(sampler, record);
    return record;
}

constexpr std::array kWraps = {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge, Wrap::ClampToBorder};

void add_filters(SuiteBuilder& builder, uint32_t square, uint32_t odd) {
    const auto some = [&](const Kernel& kernel, MipMode mip, Wrap wrap, uint32_t texture, float largest) {
        for (int n = 0; n < 16; ++n) {
            CaseRecord record = case_of(texture, kernel, mip, wrap, wrap);
            record.at = {builder.between(-1, 2), builder.between(-1, 2), 0};
            builder.draw_footprint(record, std::exp2(builder.between(-1, largest)), 1.5f);
            add(builder, record);
        }
    };
    builder.begin_group("nearest", "the texel that holds the coordinate");
    for (const Wrap wrap : kWraps)
        some(Kernel::Nearest, MipMode::None, wrap, square, 0), some(Kernel::Nearest, MipMode::None, wrap, odd, 0);
    builder.begin_group("bilinear", "weights in steps of the subtexel precision");
    for (const Wrap wrap : kWraps)
        some(Kernel::Bilinear, MipMode::None, wrap, square, 0), some(Kernel::Bilinear, MipMode::None, wrap, odd, 0);
    builder.begin_group("nearest level", "one level, the nearest to lambda");
    for (const uint32_t texture : {square, odd})
        some(Kernel::Bilinear, MipMode::Nearest, Wrap::Repeat, texture, 6),
            some(Kernel::Nearest, MipMode::Nearest, Wrap::Repeat, texture, 6);
    builder.begin_group("trilinear", "two levels in steps of the level precision");
    for (const Wrap wrap : kWraps)
        some(Kernel::Bilinear, MipMode::Linear, wrap, square, 6), some(Kernel::Bilinear, MipMode::Linear, wrap, odd, 6);
    builder.begin_group("trilinear, bias and bounds", "of the sampler");
    for (int n = 0; n < 16; ++n) {
        CaseRecord record = case_of(odd, Kernel::Bilinear, MipMode::Linear, Wrap::Repeat, Wrap::Repeat);
        record.lod_bias = float(builder.below(17) - 8) / 4;
        record.min_lod = float(builder.below(8)) / 4, record.max_lod = record.min_lod + float(builder.below(12)) / 4;
        for (int of_sampler = 0; of_sampler < 4; ++of_sampler) {
            record.at = {builder.between(-1, 2), builder.between(-1, 2), 0};
            builder.draw_footprint(record, std::exp2(builder.between(-1, 6)), 1.5f);
            add(builder, record);
        }
    }
}

void add_footprints(SuiteBuilder& builder, uint32_t noise) {
    for (const int ratio : {2, 4, 8, 16}) {
        builder.begin_group(std::string(kAnisotropicGroup) + std::to_string(ratio),
                            "a footprint of this ratio, by 16 probes at most: measured against the ellipse");
        for (int n = 0; n < 96; ++n) {
            CaseRecord record = case_of(noise, Kernel::Bilinear, MipMode::Linear, Wrap::Repeat, Wrap::Repeat);
            record.probes = 16;
            record.at = {builder.unit(), builder.unit(), 0};
            builder.draw_footprint(record, float(ratio) * std::exp2(builder.between(0, 1.5f)), float(ratio));
            add(builder, record);
        }
    }
}

void add_blocks(SuiteBuilder& builder) {
    for (const Format format :
         {Format::BC1RgbUnorm, Format::BC1RgbaUnorm, Format::BC2Unorm, Format::BC3Unorm, Format::BC4Unorm, Format::BC4Snorm,
          Format::BC5Unorm, Format::BC5Snorm, Format::BC6HUfloat, Format::BC6HSfloat, Format::BC7Unorm}) {
        builder.begin_group(std::string(texunit::info(format).name), std::string(texunit::info(format).description));
        const uint32_t texture = add_block_texture(builder, format);
        const Shape& shape = builder.suite().textures[texture].shape();
        for (int block = 0; block < shape.width / 4 * (shape.height / 4); ++block) {
            CaseRecord record = case_of(texture, Kernel::Nearest, MipMode::None, Wrap::Repeat, Wrap::Repeat);
            const int x = 4 * (block % (shape.width / 4)) + builder.below(4), y = 4 * (block / (shape.width / 4)) + builder.below(4);
            record.at = {(float(x) + 0.5f) / float(shape.width), (float(y) + 0.5f) / float(shape.height), 0};
            add(builder, record);
        }
    }
}

}  // namespace

Suite make_hardware_suite() {
    SuiteBuilder builder(kHardwareSuite, "the device's own texture unit, asked by textureGrad: legal is what Vulkan allows everywhere");
    const uint32_t square = add_codes_texture(builder, "square 64x64", 64, 64), odd = add_codes_texture(builder, "odd 45x60", 45, 60);
    const uint32_t noise = add_filtered_texture(builder, "white noise 256x256", 256);
    add_filters(builder, square, odd);
    add_footprints(builder, noise);
    add_blocks(builder);
    return builder.take();
}

}  // namespace rawtexel::cli
