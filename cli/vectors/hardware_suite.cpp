// A suite for the device's own texture unit: what Vulkan asks of every implementation is legal, and the report tells how much better one is
// (cli/vectors/hardware_report.h).
#include "cli/vectors/hardware_report.h"
#include "cli/vectors/suite_builder.h"
#include "texunit/memory_source.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace rawtexel::cli {
namespace {

using texunit::Format;
using texunit::Kernel;
using texunit::MipMode;
using texunit::SamplerState;
using texunit::Shape;
using texunit::Wrap;

uint32_t add_codes_texture(SuiteBuilder& builder, std::string name, Shape shape) {
    shape.levels = texunit::full_level_count(shape.width, shape.height, shape.depth);
    std::vector<std::byte> codes(4 * texels_of(shape));
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
    if (record.probes == 1 && !compressed) verdict = judge_hardware(suite, record, e.expected, kLeastPrecision);
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

/// Drivers compile a shader for every sampler, so that cases of one follow each other and there are few.
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

void add_arrays(SuiteBuilder& builder) {
    const Shape shape{.width = 32, .height = 24, .layers = 5};
    const uint32_t array = add_codes_texture(builder, "array 32x24 of 5", shape);
    for (const MipMode mip : {MipMode::None, MipMode::Linear}) {
        builder.begin_group(mip == MipMode::None ? "array, layers" : "array, trilinear",
                            "the nearest layer, and where there is none the first or the last; layers are not filtered");
        for (int n = 0; n < 96; ++n) {
            const size_t turn = size_t(n) / 24;
            CaseRecord record = case_of(array, turn == 0 ? Kernel::Nearest : Kernel::Bilinear, mip, kWraps[turn], Wrap::Repeat);
            record.at = {builder.between(-1, 2), builder.between(-1, 2), 0};
            record.layer = builder.between(-2, float(shape.layers) + 1);
            builder.draw_footprint(record, std::exp2(builder.between(-1, mip == MipMode::None ? 0.0f : 5.0f)), 1.5f);
            add(builder, record);
        }
    }
}

/// Derivatives of `size` in texture coordinates at most, or of a direction.
void draw_solid_footprint(SuiteBuilder& builder, CaseRecord& record, float size) {
    for (size_t axis = 0; axis < 3; ++axis) record.dx[axis] = builder.between(-size, size), record.dy[axis] = builder.between(-size, size);
}

void add_volumes(SuiteBuilder& builder) {
    const uint32_t volume = add_codes_texture(builder, "volume 16x12x9", {.width = 16, .height = 12, .depth = 9});
    for (const auto& [name, kernel, mip] : {std::tuple{"volume, nearest", Kernel(Kernel::Nearest), MipMode::None},
                                            {"volume, eight texels", Kernel(Kernel::Bilinear), MipMode::None},
                                            {"volume, two levels", Kernel(Kernel::Bilinear), MipMode::Linear}}) {
        builder.begin_group(name, "slices are weighed and wrapped as columns and rows are");
        for (int n = 0; n < 96; ++n) {
            const size_t turn = size_t(n) / 24;
            CaseRecord record = case_of(volume, kernel, mip, kWraps[turn], kWraps[(turn + 1) % 4]);
            record.wrap_r = uint32_t(kWraps[(turn + 2) % 4]);
            record.at = {builder.between(-1, 2), builder.between(-1, 2), builder.between(-1, 2)};
            draw_solid_footprint(builder, record, std::exp2(builder.between(-6, -1)));
            add(builder, record);
        }
    }
}

/// A direction to a face's inside, or within `edge` texels of a face of `extent` from an edge or a corner of the cube.
std::array<float, 3> draw_direction(SuiteBuilder& builder, int extent, float edge) {
    std::array<float, 3> direction;
    const auto major = size_t(builder.below(3)), beside = (major + 1 + size_t(builder.below(2))) % 3;
    const bool corner = builder.chance(0.3f);
    for (size_t axis = 0; axis < 3; ++axis) {
        const float sign = builder.chance(0.5f) ? 1.0f : -1.0f, within = 1 - 2 * edge * builder.unit() / float(extent);
        const bool at_edge = edge > 0 && (axis == beside || corner);
        direction[axis] = sign * (axis == major ? 1.0f : at_edge ? within : 0.9f * builder.unit());
    }
    const float length = builder.between(0.5f, 2);
    for (float& component : direction) component *= length;
    return direction;
}

void add_cubes(SuiteBuilder& builder) {
    constexpr int kExtent = 16;
    const uint32_t cube = add_codes_texture(builder, "cube 16x16", {.width = kExtent, .height = kExtent, .layers = 6, .cube = true});
    struct Topic {
        const char *name, *about;
        Kernel kernel;
        MipMode mip;
        float edge;  ///< as draw_direction has it
    };
    for (const Topic& topic :
         {Topic{"cube, nearest", "the face of the largest component, and the texel there", Kernel::Nearest, MipMode::None, 0},
          Topic{"cube, bilinear", "inside of faces and at their edges", Kernel::Bilinear, MipMode::None, 0},
          Topic{"cube, seamless edges",
                "texels beyond an edge are the neighbouring face's; at a corner three meet, and their mean stands for "
                "the fourth",
                Kernel::Bilinear, MipMode::None, 1},
          Topic{"cube, two levels", "by the derivatives of coordinates on the face", Kernel::Bilinear, MipMode::Linear, 0}}) {
        builder.begin_group(topic.name, topic.about);
        for (int n = 0; n < 96; ++n) {
            CaseRecord record = case_of(cube, topic.kernel, topic.mip, Wrap::ClampToEdge, Wrap::ClampToEdge);
            record.at = draw_direction(builder, kExtent, topic.edge);
            draw_solid_footprint(builder, record, std::exp2(builder.between(-6, topic.mip == MipMode::None ? -5.0f : -1.0f)));
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
    const uint32_t square = add_codes_texture(builder, "square 64x64", {.width = 64, .height = 64}),
                   odd = add_codes_texture(builder, "odd 45x60", {.width = 45, .height = 60});
    const uint32_t noise = add_filtered_texture(builder, "white noise 256x256", 256);
    add_filters(builder, square, odd);
    add_footprints(builder, noise);
    add_arrays(builder);
    add_volumes(builder);
    add_cubes(builder);
    add_blocks(builder);
    return builder.take();
}

}  // namespace rawtexel::cli
