// Faults seeded into copies of our GLSL: each is caught by the suite that tries what it breaks, and where a fault is known the report names
// it. What is not caught here would not be caught in anybody's port.
#include "tests/cli/port_device.h"
#include "tests/cli/program_runner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace rawtexel::test {
namespace {

struct Edit {
    std::string file, from, to;
};
struct SeededFault {
    std::string name, suite;
    std::vector<Edit> edits;
    std::string cause;  ///< part of the report; empty where no known fault answers the same
};

const std::vector<SeededFault>& seeded_faults() {
    static const std::vector<SeededFault> faults = {
        {"WrapOffByOneForNegatives",
         "addressing",
         {{"addressing", "n - 1 - (-1 - i) % n", "-i % n"}},
         "wrap off by one for negative indices"},
        {"RemainderOfNegatives",
         "addressing",
         {{"addressing", "i >= 0 ? i % n : n - 1 - (-1 - i) % n", "i - n * int(float(i) / float(n))"}},
         ""},
        {"TexelZeroOutOfReach",
         "addressing",
         {{"addressing", "return clamp(i, 0, n - 1);", "return clamp(i, min(1, n - 1), n - 1);"}},
         "texel 0 out of reach"},
        {"MirrorWithoutItsEdge",
         "addressing",
         {{"addressing", "min(place, 2 * n - 1 - place)", "min(place, min(2 * n - place, n - 1))"}},
         "mirror off by one"},
        {"MirrorOnceOffByOne",
         "addressing",
         {{"addressing", "i < 0 ? -1 - i : i, n - 1", "i < 0 ? -i : i, n - 1"}},
         "wrap off by one for negative indices"},
        {"BorderClamped", "addressing", {{"addressing", "i < 0 || i >= n ? -1 : i", "clamp(i, 0, n - 1)"}}, "wrapped as clamp"},
        {"PeriodsNotTakenAway", "addressing", {{"addressing", "return u - trunc(u);", "return u;"}}, ""},
        {"HalfATexelRight", "kernels", {{"kernels", "float centre = x - 0.5;", "float centre = x;"}}, "half a texel"},
        {"TiesToEven",
         "adversarial",
         {{"lookup", "int(floor(axis_coordinate(l, axis, level, 0.0)))", "int(roundEven(axis_coordinate(l, axis, level, 0.0) - 0.5))"}},
         ""},
        {"ClampedBeforeFloor",
         "adversarial",
         {{"addressing", "return clamp(u, -80.0, 80.0);", "return clamp(u, 1.0 / 16.0, 15.0 / 16.0);"}},
         "clamped to [1/N, 1 - 1/N] before floor"},
        {"BiasIgnored", "lod", {{"lod", "min(lambda + bias, max_lod)", "min(lambda, max_lod)"}}, "bias of the level left out"},
        {"BiasWithoutDerivatives",
         "adversarial",
         {{"lookup", "return d;", "if (l.lod_bias != 0.0) d.levels = choose_levels(l.mip, l.lod_bias, l.shape.levels);\n    return d;"}},
         "derivatives left out where there is a bias"},
        {"UpperBoundWins",
         "lod",
         {{"lod", "max(min(lambda + bias, max_lod), min_lod)", "min(max(lambda + bias, min_lod), max_lod)"}},
         "the upper bound of the level wins"},
        {"LevelBeforeClamp",
         "mip-choice",
         {{"lod", "l.finer = int(floor(l.lod));", "l.finer = clamp(int(floor(lambda)), 0, levels - 1);"},
          {"lod", "l.fraction = l.lod - float(l.finer);", "l.fraction = fract(lambda);"}},
         ""},
        {"SizesOfThinLevels", "lod", {{"addressing", "return max(1, n >> level);", "return max(n >> level, level > 5 ? 2 : 1);"}}, ""},
        {"LogarithmOfTheSquare",
         "lod",
         {{"lod", "0.5 * log2(max(squared, 1.0e-37)) + log2(f.scale)", "log2(max(squared, 1.0e-37)) + 2.0 * log2(f.scale)"}},
         "log2 of the squared length"},
        {"ShorterAxis",
         "lod",
         {{"lod", "Axes(max(x2, y2), min(x2, y2), x2 < y2", "Axes(min(x2, y2), min(x2, y2), x2 < y2"}},
         "the longer axis and the shorter one swapped"},
        {"SixteenProbesAtMost",
         "anisotropy",
         {{"lookup", "ratio_line(f, axes, l.most_probes, extent)", "ratio_line(f, axes, min(l.most_probes, 16), extent)"}},
         "at most 16 probes"},
        {"ProbesAtTheLongLevel",
         "anisotropy",
         {{"anisotropic_probe", "line.lambda = log2_length(f, minor2);", "line.lambda = log2_length(f, a.major2);"}},
         ""},
        {"TentByTheWrongRoot", "kernels", {{"fis", "sqrt(2.0 * number) - 1.0", "2.0 * number - 1.0"}}, ""},
        {"NormalOfHalfTheVariance", "kernels", {{"fis", "* 1.41421356;\n}\n\nfloat jitter_offset", ";\n}\n\nfloat jitter_offset"}}, ""},
        {"JitterRoundedTwice",
         "kernels",
         {{"fis", "floor(x + jitter_offset(k, number))", "floor(x + jitter_offset(k, number) + 0.5)"}},
         "half a texel right"},
        {"TapOfWeightZero", "adversarial", {{"frs", "weight > 0.0 && at >= before", "at >= before"}}, ""},
        {"DrawnByMagnitude",
         "positivization",
         {{"draw", "!lobes || l.estimator == ESTIMATOR_ABS_WEIGHT", "true"},
          {"draw", "int by = l.estimator == ESTIMATOR_ABS_WEIGHT ?", "int by = lobes ?"}},
         "drawn by the magnitude of the weights, |w|"},
        {"PositiveWeightOfOne", "positivization", {{"draw", "r.weight = 1.0 + r.negative_weight;", "r.weight = 1.0;"}}, ""},
        {"NegativeWithThePositivesNumbers",
         "positivization",
         {{"draw", "negative ? n.negative_tap[axis] : n.tap[axis]", "n.tap[axis]"},
          {"draw", "negative ? n.negative_sign : n.sign_", "n.sign_"}},
         "the negative texel is drawn with the positive one's numbers"},
        {"CorrelatedAxes",
         "kernels",
         {{"draw", "moved[axis] : 0.0), n.tap[axis]);", "moved[axis] : 0.0), n.tap.x);"},
          {"draw", "reservoir_tap(taps[axis], by, n.tap[axis])", "reservoir_tap(taps[axis], by, n.tap.x)"}},
         "y is drawn with the number of x"},
        {"WrongBranchOfTheBSpline",
         "kernels",
         {{"kernels", "2.0 / 3.0 - 0.5 * g * g * (2.0 - g)", "2.0 / 3.0 - 0.5 * f * f * (2.0 - f)"}},
         ""},
        {"RawSincWeights", "kernels", {{"kernels", "for (int i = 0; i < 2 * lobes; ++i) taps.weight[i] /= sum;", ""}}, ""},
        {"LevelsSwapped", "mip-choice", {{"stochastic_mip", "number < l.fraction", "number < 1.0 - l.fraction"}}, ""},
        {"LevelWithTheTexelsNumber",
         "mip-choice",
         {{"draw", "draw_level(d.levels, n.level)", "draw_level(d.levels, n.tap.x)"}},
         "the level is drawn with the number of x"},
        {"OneIsReached",
         "adversarial",
         {{"random", "float(bits >> 8) * (1.0 / 16777216.0)", "float(bits) * (1.0 / 4294967296.0)"}},
         "all 32 bits as a float"},
        {"HashWithAWrongShift", "random-numbers", {{"random", "bits ^ bits >> 15", "bits ^ bits >> 14"}}, ""},
        {"SlicesOfNoiseConfused",
         "noise",
         {{"noise", "a.sample_index / STBN_DEPTH, a.sample_index % STBN_DEPTH",
           "a.sample_index % STBN_DEPTH, a.sample_index / STBN_DEPTH"}},
         ""},
        {"EllipseWithoutReconstruction",
         "elliptical",
         {{"elliptical", "min((2.0 * boxes - 3.0) / 12.0, least - boxes / 12.0)", "min(0.0, least - boxes / 12.0)"}},
         ""},
        {"EllipseNotSlanted", "elliptical", {{"elliptical", "vec2(e.slope * y + e.sigma", "vec2(e.sigma"}}, ""},
        {"PlanesNotAccumulated", "triplanar", {{"triplanar", "number < weights.x + weights.y ||", "number < weights.y ||"}}, ""},
        {"PowerInPlaceOfSrgb",
         "srgb",
         {{"srgb", "encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4)", "pow(encoded, 2.2)"}},
         "a power of 2.2 in place of sRGB"},
        {"OrderHonouredByBc3", "bc-decode", {{"blocks", "always_four || a > b", "a > b"}}, ""},
        {"Bc7WithoutRounding", "bc-decode", {{"blocks", "w * second + 32) >> 6", "w * second) >> 6"}}, ""},
        {"CubeFacesClamped",
         "adversarial",
         {{"cube", "    fold_onto_faces(face, texel, n);\n}\n\nbool", "    texel = clamp(texel, 0, n - 1);\n}\n\nbool"}},
         "edges of faces clamped"},
        {"SliceWithTheNumberOfX",
         "adversarial",
         {{"draw", "n.tap = case_vec3(index, CASE_NUMBER_X);", "n.tap = case_vec3(index, CASE_NUMBER_X).xyx;"}},
         "z is drawn with the number of x"},
        {"SizeOfAnotherLanesLevel",
         "adversarial",
         {{"lookup", "int n = extent_at(l.shape, level)[axis];",
           "int n = extent_at(l.shape, decide(load_lookup(gl_GlobalInvocationID.x / 8u * 8u)).levels.finer)[axis];"},
          {"lookup", "ivec3 n = extent_at(l.shape, level), i = ivec3(0);",
           "ivec3 n = extent_at(l.shape, decide(load_lookup(gl_GlobalInvocationID.x / 8u * 8u)).levels.finer), i = ivec3(0);"}},
         "sized by another lane's level"},
        {"FilteredBeforeShading",
         "adversarial",
         {{"lookup", "r.value = filter_lookup(l, d, after ? shader : 0u);\n    if (!after)",
           "r.value = filter_lookup(l, d, 0u);\n    if (true)"}},
         "filtered before shading"},
        {"InfinityTimesZero", "adversarial", {{"lookup", "if (weight == 0.0) continue;", ""}}, "not a number"},
    };
    return faults;
}

/// A copy of our GLSL with the fault in it.
void seed(const SeededFault& fault, const TemporaryFolder& folder) {
    std::filesystem::copy(std::string(RAWTEXEL_SHADERS) + "/glsl", folder.path(), std::filesystem::copy_options::recursive);
    for (const Edit& edit : fault.edits) {
        std::string text = folder.read(edit.file + ".glsl");
        const size_t at = text.find(edit.from);
        ASSERT_NE(at, std::string::npos) << edit.file << ".glsl has no: " << edit.from;
        ASSERT_EQ(text.find(edit.from, at + 1), std::string::npos) << edit.file << ".glsl has it twice: " << edit.from;
        text.replace(at, edit.from.size(), edit.to);
        folder.write(edit.file + ".glsl", text);
    }
}

/// By suite, so that the program starts once for all faults of one.
class PortFaults : public testing::TestWithParam<std::string> {};

TEST_P(PortFaults, AreCaughtByTheirSuite) {
    RAWTEXEL_NEED_PORTS();
    compile_for_narrow_vectors();
    for (const SeededFault& fault : seeded_faults()) {
        if (fault.suite != GetParam()) continue;
        SCOPED_TRACE(fault.name);
        const TemporaryFolder folder;
        seed(fault, folder);
        const Outcome outcome = run({"verify-shader", "--suite", fault.suite, "--glsl", folder / (fault.suite + ".comp")});
        EXPECT_EQ(outcome.code, 1) << outcome.out << outcome.err;
        EXPECT_TRUE(outcome.out.starts_with(fault.suite + " (")) << outcome.out;
        EXPECT_NE(outcome.out.find("are not legal"), std::string::npos) << outcome.out;
        EXPECT_NE(outcome.out.find(fault.cause.empty() ? "likeliest cause: " : fault.cause), std::string::npos) << outcome.out;
    }
}

std::vector<std::string> suites_with_faults() {
    std::set<std::string> names;
    for (const SeededFault& fault : seeded_faults()) names.insert(fault.suite);
    return {names.begin(), names.end()};
}
INSTANTIATE_TEST_SUITE_P(Seeded, PortFaults, testing::ValuesIn(suites_with_faults()), [](const auto& tested) {
    std::string name = tested.param;
    std::ranges::replace(name, '-', '_');
    return name;
});

// The report names the suite that tries what a fault breaks, and clears those that do not.
TEST(PortFault, FailsTheSuiteThatTriesItAlone) {
    RAWTEXEL_NEED_PORTS();
    compile_for_narrow_vectors();
    const auto fault = std::ranges::find(seeded_faults(), "LevelsSwapped", &SeededFault::name);
    ASSERT_NE(fault, seeded_faults().end());
    const TemporaryFolder folder;
    seed(*fault, folder);
    for (const auto& [suite, fails] : {std::pair{std::string("mip-choice"), true}, {"lod", false}, {"srgb", false}}) {
        const Outcome outcome = run({"verify-shader", "--suite", suite, "--glsl", folder / (suite + ".comp")});
        EXPECT_EQ(outcome.code, fails ? 1 : 0) << suite << "\n" << outcome.out << outcome.err;
    }
}

}  // namespace
}  // namespace rawtexel::test
