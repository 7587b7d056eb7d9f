// What is told of a device's own texture unit, on answers whose precision, footprints and rounding are known.
#include "cli/vectors/hardware_report.h"
#include "cli/vectors/legal_case.h"
#include "cli/vectors/verdict_report.h"
#include "tests/cli/program_runner.h"
#include "texunit/block_codec.h"
#include "texunit/legal_judge.h"
#include "texunit/texel_value.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace rawtexel::test {
namespace {

using cli::CaseRecord;
using cli::HardwareAgreement;
using cli::PortResult;
using cli::Suite;

const Suite& hardware_suite() {
    static const Suite suite = *cli::make_suite(cli::kHardwareSuite);
    return suite;
}

std::vector<PortResult> answers_of(const std::function<void(CaseRecord&)>& change) {
    std::vector<PortResult> answers;
    for (CaseRecord record : hardware_suite().cases) {
        change(record);
        answers.push_back(evaluate(hardware_suite(), record));
    }
    return answers;
}

const HardwareAgreement& find(const std::vector<HardwareAgreement>& agreements, const std::string& group) {
    return *std::ranges::find(agreements, group, &HardwareAgreement::group);
}

/// Coordinates to steps of 1/2^bits of a texel of level 0.
std::function<void(CaseRecord&)> snap_coordinates(int bits) {
    return [=](CaseRecord& record) {
        const texunit::Shape& shape = hardware_suite().textures[record.texture].shape();
        const float steps = std::exp2(float(bits));
        record.at[0] = std::floor(record.at[0] * float(shape.width) * steps + 0.5f) / (float(shape.width) * steps);
        record.at[1] = std::floor(record.at[1] * float(shape.height) * steps + 0.5f) / (float(shape.height) * steps);
    };
}

TEST(HardwareReport, FindsTheBitsOfAnExactTextureUnit) {
    const auto agreements = measure_hardware(hardware_suite(), answers_of([](CaseRecord&) {}), {});
    for (const char* group : {"nearest", "bilinear", "nearest level", "trilinear", "trilinear, bias and bounds", "array, layers",
                              "array, trilinear", "volume, nearest", "volume, eight texels", "volume, two levels", "cube, nearest",
                              "cube, bilinear", "cube, seamless edges", "cube, two levels"}) {
        EXPECT_EQ(find(agreements, group).subtexel_bits, 8) << group;
        EXPECT_TRUE(find(agreements, group).holds()) << group;
    }
    EXPECT_EQ(find(agreements, "trilinear").lod_bits, 8);
    EXPECT_TRUE(find(agreements, "trilinear").exact_scale);
    EXPECT_FALSE(find(agreements, "bilinear").lod_bits);
    EXPECT_EQ(find(agreements, "volume, two levels").lod_bits, 8);
    EXPECT_EQ(find(agreements, "cube, two levels").lod_bits, 8);
}

// The faults of arrays, volumes and cube maps that texture units had, each in its groups alone and with its name in the report.
TEST(HardwareReport, RefusesWhatIsNoRightArrayVolumeOrCubeMap) {
    const Suite& suite = hardware_suite();
    const auto failing = [&](const std::vector<PortResult>& answers, const std::string& cause) {
        const cli::SuiteVerdict verdict = judge_results(suite, answers);
        const auto agreements = measure_hardware(suite, answers, {});
        std::set<std::string> groups;
        bool named = false;
        for (const cli::CaseFailure& failure : verdict.failures) {
            groups.insert(suite.group_of(failure.index).name);
            named = named || failure.cause == cause;
        }
        for (const std::string& group : groups) EXPECT_FALSE(find(agreements, group).holds()) << group;
        EXPECT_TRUE(named) << cause << "\n" << verdict_text(suite, verdict, "");
        return groups;
    };
    const auto shape_of = [&](const CaseRecord& record) -> const texunit::Shape& { return suite.textures[record.texture].shape(); };
    using Groups = std::set<std::string>;
    EXPECT_EQ(failing(answers_of([](CaseRecord& record) { record.layer = std::floor(record.layer); }), "layer off by one"),
              (Groups{"array, layers", "array, trilinear"}));
    EXPECT_EQ(failing(answers_of([&](CaseRecord& record) {
                          if (shape_of(record).depth > 1) record.at[2] += 0.5f / float(shape_of(record).depth);
                      }),
                      "half a slice behind"),
              (Groups{"volume, nearest", "volume, eight texels", "volume, two levels"}));
    EXPECT_EQ(failing(answers_of([&](CaseRecord& record) {
                          if (shape_of(record).cube) record.at[1] = -record.at[1];
                      }),
                      "direction mirrored in y"),
              (Groups{"cube, nearest", "cube, bilinear", "cube, seamless edges", "cube, two levels"}));
    // Edges that are clamped: of all colours that such a texture unit gives the one that is nearest to what is right.
    std::vector<PortResult> clamped = answers_of([](CaseRecord&) {});
    for (size_t n = 0; n < clamped.size(); ++n) {
        const CaseRecord& record = suite.cases[n];
        if (!shape_of(record).cube) continue;
        const texunit::LegalVerdict verdict =
            judge_suspected(judged_texture(suite, record), sampler_of(record), judged_lookup(record), cli::judged_colour(clamped[n].value),
                            {.subtexel_bits = 20, .lod_bits = 20, .approximate_scale = false, .colour_threshold = 1e-6},
                            {.footprint = {}, .address = {.shift = {}, .seamless = false}});
        for (size_t c = 0; c < 4; ++c) clamped[n].value[c] = float(verdict.closest[c]);
    }
    const Groups edges = failing(clamped, "edges of faces clamped");
    EXPECT_TRUE(edges.contains("cube, seamless edges"));
    EXPECT_FALSE(edges.contains("cube, bilinear"));
}

TEST(HardwareReport, FindsFewerBitsWhereThereAreFewer) {
    for (const int bits : {4, 5}) {
        const auto agreements = measure_hardware(hardware_suite(), answers_of(snap_coordinates(bits)), {});
        const std::optional<int> found = find(agreements, "bilinear").subtexel_bits;
        ASSERT_TRUE(found) << bits;
        // Rounded to the nearest step a coordinate is off by half of one, and some of that hides in the rounding of colours.
        EXPECT_GE(*found, bits);
        EXPECT_LE(*found, bits + 1);
    }
    const auto coarse = measure_hardware(hardware_suite(), answers_of(snap_coordinates(2)), {});
    EXPECT_FALSE(find(coarse, "bilinear").holds());
    EXPECT_NE(hardware_text(coarse).find("bilinear: not even at 4 bits"), std::string::npos);
    const auto levels = measure_hardware(hardware_suite(), answers_of([](CaseRecord& record) { record.lod_bias += 0x1p-5f; }), {});
    EXPECT_EQ(find(levels, "bilinear").subtexel_bits, 8);
    const std::optional<int> found = find(levels, "trilinear").lod_bits;
    ASSERT_TRUE(found);
    EXPECT_GE(*found, 4);
    EXPECT_LE(*found, 5);
    EXPECT_TRUE(find(levels, "trilinear").exact_scale);
    // A third of a level is what the freedom of the scale factor allows.
    const auto scaled = measure_hardware(hardware_suite(), answers_of([](CaseRecord& record) { record.lod_bias += 0.3f; }), {});
    EXPECT_TRUE(find(scaled, "trilinear").holds());
    EXPECT_FALSE(find(scaled, "trilinear").exact_scale);
}

TEST(HardwareReport, MeasuresFootprintsAgainstTheEllipse) {
    const auto footprint = [](const std::function<void(CaseRecord&)>& change, const std::string& group) {
        return *find(measure_hardware(hardware_suite(), answers_of(change), {}), group).footprint;
    };
    const auto truth = footprint([](CaseRecord& record) { record.ellipse = 1.0f / 6; }, "anisotropic 1:8");
    EXPECT_LT(truth.error, 1e-6);
    EXPECT_DOUBLE_EQ(truth.s2, 1.0 / 6);
    const auto probes = footprint([](CaseRecord&) {}, "anisotropic 1:8");
    EXPECT_DOUBLE_EQ(probes.error, probes.ours);
    EXPECT_LT(probes.error, 0.6 * probes.isotropic);
    const auto isotropic = footprint([](CaseRecord& record) { record.probes = 1; }, "anisotropic 1:8");
    EXPECT_DOUBLE_EQ(isotropic.error, isotropic.isotropic);
    // A texture unit that answers the mean of the texture knows nothing.
    std::vector<PortResult> grey(hardware_suite().cases.size());
    for (PortResult& answer : grey) answer.value = {0.5f, 0.5f, 0.5f, 0.5f};
    EXPECT_NEAR(find(measure_hardware(hardware_suite(), grey, {}), "anisotropic 1:8").footprint->error, 1, 0.05);
}

TEST(HardwareReport, NamesTheRuleOfCompressedTexels) {
    for (const texunit::BcRounding rounding : texunit::kBcRoundings) {
        std::vector<PortResult> answers = answers_of([](CaseRecord&) {});
        for (size_t n = 0; n < answers.size(); ++n) {
            const cli::SuiteTexture& texture = hardware_suite().textures[hardware_suite().cases[n].texture];
            if (!has_bc_rounding(texture.format())) continue;
            const auto unit = size_t(texunit::info(texture.format()).bytes_per_block);
            const int block = answers[n].x / 4 + texture.shape().width / 4 * (answers[n].y / 4);
            alignas(16) std::byte texels[256];
            decode_block(texture.format(), texture.bytes().data() + unit * size_t(block), texels, rounding);
            const texunit::TexelLayout& layout = texunit::layout(texture.format(), rounding);
            answers[n].value =
                load_texel(layout, texels + size_t(answers[n].x % 4 + 4 * (answers[n].y % 4)) * size_t(bytes_per_texel(layout.storage)));
        }
        EXPECT_TRUE(judge_results(hardware_suite(), answers).holds()) << to_string(rounding);
        const auto agreements = measure_hardware(hardware_suite(), answers, {});
        for (const char* group : {"bc1-rgb-unorm", "bc2-unorm", "bc3-unorm"}) {
            EXPECT_EQ(find(agreements, group).blocks->rounding, to_string(rounding)) << group;
            EXPECT_EQ(find(agreements, group).blocks->from_rounding, 0) << group;
        }
        EXPECT_EQ(find(agreements, "bc7-unorm").blocks->largest, 0);
    }
}

TEST(HardwareReport, IsPartOfTheVerdict) {
    const TemporaryFolder folder;
    const auto judged = [&](const std::vector<PortResult>& answers) {
        const std::string bytes(reinterpret_cast<const char*>(answers.data()), answers.size() * sizeof(PortResult));
        return run({"verify-shader", "--suite", "hardware", "--outputs", folder.write("answers.bin", bytes)});
    };
    const Outcome right = judged(answers_of([](CaseRecord&) {}));
    EXPECT_EQ(right.code, 0) << right.out << right.err;
    EXPECT_NE(right.out.find("  trilinear: agrees at 8 subtexel bits and 8 level bits of the exact scale factor\n"), std::string::npos)
        << right.out;
    const Outcome shifted = judged(answers_of([](CaseRecord& record) { record.at[0] += 0.5f / 64; }));
    EXPECT_EQ(shifted.code, 1);
    EXPECT_NE(shifted.out.find("likeliest cause: half a texel right"), std::string::npos) << shifted.out;
    // One bit of a BC7 texel is one too many.
    std::vector<PortResult> answers = answers_of([](CaseRecord&) {});
    const cli::CaseGroup& last = hardware_suite().groups.back();
    ASSERT_EQ(last.name, "bc7-unorm");
    answers[last.first].value[1] += 1.0f / 255;
    const Outcome inexact = judged(answers);
    EXPECT_EQ(inexact.code, 1);
    EXPECT_NE(inexact.out.find("bc7-unorm: 1 of 256 cases are not legal"), std::string::npos) << inexact.out;
}

}  // namespace
}  // namespace rawtexel::test
