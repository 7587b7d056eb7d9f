// Test vectors: what suites hold, that their files say the same, and that a verdict is passed on what lies outside the legal intervals.
#include "cli/vectors/expectation.h"
#include "cli/vectors/judge.h"
#include "cli/vectors/legal_case.h"
#include "cli/vectors/suite_files.h"
#include "tests/cli/program_runner.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace rawtexel::test {
namespace {

using cli::CaseRecord;
using cli::Expectation;
using cli::PortOp;
using cli::PortResult;
using cli::Suite;

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

std::vector<PortResult> right_answers(const Suite& suite) {
    std::vector<PortResult> answers;
    for (const Expectation& expectation : suite.expected) answers.push_back(expectation.expected);
    return answers;
}

std::string bytes_of(const std::vector<PortResult>& answers) {
    return {reinterpret_cast<const char*>(answers.data()), answers.size() * sizeof(PortResult)};
}

TEST(Vectors, HaveTheSuitesThatAreListed) {
    const Outcome listed = run({"list", "suites"});
    ASSERT_EQ(listed.code, 0);
    for (const cli::SuiteInfo& info : cli::all_suites()) {
        EXPECT_NE(listed.out.find(info.name), std::string::npos) << info.name;
        const Suite suite = *cli::make_suite(info.name);
        EXPECT_EQ(suite.name, info.name);
        EXPECT_EQ(suite.expected.size(), suite.cases.size());
        uint32_t next = 0;
        for (const cli::CaseGroup& group : suite.groups) {
            EXPECT_EQ(group.first, next) << info.name << ", " << group.name;
            EXPECT_GE(group.count, 4u) << info.name << ", " << group.name;
            next += group.count;
        }
        EXPECT_EQ(next, suite.cases.size());
    }
    EXPECT_FALSE(cli::make_suite("no such suite"));
}

TEST(Vectors, AreTheSameBitsEveryTime) {
    for (const cli::SuiteInfo& info : cli::all_suites()) {
        const Suite first = *cli::make_suite(info.name), second = *cli::make_suite(info.name);
        EXPECT_TRUE(same_bytes(first.cases, second.cases)) << info.name;
        EXPECT_TRUE(same_bytes(first.expected, second.expected)) << info.name;
    }
}

TEST(Vectors, ReadBackAsTheyWereWritten) {
    for (const char* name : {"addressing", "bc-decode", "noise", "adversarial"}) {
        const TemporaryFolder folder;
        ASSERT_EQ(run({"vectors", "--suite", name, "-o", folder / "suite"}).code, 0);
        const Suite written = *cli::make_suite(name), read = cli::read_suite(folder / "suite");
        EXPECT_EQ(read.name, written.name);
        EXPECT_TRUE(same_bytes(read.cases, written.cases)) << name;
        EXPECT_TRUE(same_bytes(read.expected, written.expected)) << name;
        EXPECT_EQ(read.words, written.words) << name;
        ASSERT_EQ(read.textures.size(), written.textures.size()) << name;
        for (size_t n = 0; n < read.textures.size(); ++n) {
            EXPECT_EQ(read.textures[n].name(), written.textures[n].name());
            EXPECT_EQ(read.textures[n].format(), written.textures[n].format());
            EXPECT_EQ(read.textures[n].shape(), written.textures[n].shape());
            EXPECT_EQ(read.textures[n].bytes(), written.textures[n].bytes());
        }
        ASSERT_EQ(read.groups.size(), written.groups.size());
        for (size_t n = 0; n < read.groups.size(); ++n) EXPECT_EQ(read.groups[n].name, written.groups[n].name);
    }
}

TEST(Vectors, AllGoesIntoAFolderEach) {
    const TemporaryFolder folder;
    ASSERT_EQ(run({"vectors", "--suite", "all", "-o", folder / "all"}).code, 0);
    for (const cli::SuiteInfo& info : cli::all_suites())
        EXPECT_TRUE(cli::is_suite_folder(folder / "all/" + std::string(info.name))) << info.name;
}

/// Names in backquotes in the last column of the tables of docs/pitfalls.md.
std::set<std::string> documented_pitfalls() {
    std::set<std::string> names;
    std::istringstream text(read_file(std::string(RAWTEXEL_SHADERS) + "/../../docs/pitfalls.md"));
    for (std::string line; std::getline(text, line);) {
        if (!line.starts_with("| ") || !line.ends_with("` |")) continue;
        const std::string column = line.substr(line.rfind("| ", line.size() - 3));
        for (size_t at = column.find('`'); at != std::string::npos; at = column.find('`', column.find('`', at + 1) + 1))
            names.insert(column.substr(at + 1, column.find('`', at + 1) - at - 1));
    }
    return names;
}

// What is known to go wrong in stochastic texture filtering, all of it: a group that goes missing takes a pitfall with it.
TEST(Vectors, TryEveryKnownPitfallByName) {
    const Suite suite = *cli::make_suite("adversarial");
    std::set<std::string> tried;
    for (const cli::CaseGroup& group : suite.groups) tried.insert(group.name);
    EXPECT_EQ(tried, documented_pitfalls());
    EXPECT_EQ(tried.size(), 44u);
}

// Of a case with more switched on than it needs the random numbers are the same.
TEST(Vectors, KeepNumbersWhereFeaturesAreSwitchedOn) {
    const Suite suite = *cli::make_suite("adversarial");
    const auto group = std::ranges::find(suite.groups, "a role keeps its numbers", &cli::CaseGroup::name);
    ASSERT_NE(group, suite.groups.end());
    ASSERT_EQ(group->count % 3, 0u);
    for (size_t n = group->first; n < size_t(group->first) + group->count; n += 3) {
        for (const size_t with_more : {n + 1, n + 2})
            EXPECT_EQ(suite.expected[n].expected.value, suite.expected[with_more].expected.value) << with_more;
    }
}

// The independent verifier of texunit finds every sampled value legal, and the ends of its interval no farther off than the freedoms
// explain.
TEST(Vectors, SampledValuesAreLegalToTheVerifier) {
    int judged = 0;
    for (const char* name : {"addressing", "lod", "kernels", "srgb"}) {
        const Suite suite = *cli::make_suite(name);
        for (size_t n = 0; n < suite.cases.size(); n += 7) {
            const CaseRecord& record = suite.cases[n];
            if (record.op != PortOp::Sample) continue;
            const texunit::LegalPrecision precision{
                .coordinate_bits = 22, .subtexel_bits = 16, .lod_bits = 12, .approximate_scale = false, .colour_threshold = 1e-5};
            const std::array<double, 4> colour = cli::judged_colour(suite.expected[n].expected.value);
            const auto verdict = judge_lookup(judged_texture(suite, record), sampler_of(record), judged_lookup(record), colour, precision);
            EXPECT_TRUE(verdict.legal) << name << ", case " << n << ": " << to_string(verdict, colour);
            ++judged;
        }
    }
    EXPECT_GT(judged, 200);
}

TEST(Verdicts, HoldForRightAnswersOfEverySuite) {
    for (const cli::SuiteInfo& info : cli::all_suites()) {
        const Suite suite = *cli::make_suite(info.name);
        EXPECT_TRUE(judge_results(suite, right_answers(suite)).holds()) << info.name;
    }
}

// Every judged word of every case decides: just outside of its interval it is not legal, at its ends it is.
TEST(Verdicts, TurnOnEveryJudgedWord) {
    int words = 0;
    for (const cli::SuiteInfo& info : cli::all_suites()) {
        const Suite suite = *cli::make_suite(info.name);
        for (size_t n = 0; n < suite.cases.size(); n += 13) {
            const Expectation& e = suite.expected[n];
            for (const cli::RecordField& field : cli::result_fields()) {
                for (int word = field.word; word < field.word + field.count; ++word) {
                    if ((e.judged & cli::judges(size_t(word))) == 0) continue;
                    PortResult answer = e.expected;
                    char* const at = reinterpret_cast<char*>(&answer) + 4 * word;
                    const char* const most = reinterpret_cast<const char*>(&e.most) + 4 * word;
                    std::memcpy(at, most, 4);
                    EXPECT_EQ(illegal_words(e, answer), 0u) << info.name << ", case " << n << ", " << field.name;
                    if (field.type == cli::WordType::Float) {
                        float value;
                        std::memcpy(&value, most, 4);
                        if (std::isinf(value)) continue;
                        for (const float wrong :
                             {std::nextafter(value, std::numeric_limits<float>::infinity()), std::numeric_limits<float>::quiet_NaN()}) {
                            std::memcpy(at, &wrong, 4);
                            EXPECT_EQ(illegal_words(e, answer), cli::judges(size_t(word)))
                                << info.name << ", case " << n << ", " << field.name;
                        }
                    } else {
                        int32_t value;
                        std::memcpy(&value, most, 4);
                        ++value;
                        std::memcpy(at, &value, 4);
                        EXPECT_EQ(illegal_words(e, answer), cli::judges(size_t(word))) << info.name << ", case " << n << ", " << field.name;
                    }
                    ++words;
                }
            }
        }
    }
    EXPECT_GT(words, 4000);
}

// Intervals leave room for arithmetic, not for faults: they are narrow beside what a texel more or less makes.
TEST(Verdicts, LeaveLittleRoom) {
    for (const char* name : {"addressing", "lod", "kernels", "anisotropy", "positivization", "elliptical"}) {
        const Suite suite = *cli::make_suite(name);
        std::vector<float> widths;
        for (const Expectation& e : suite.expected) {
            if ((e.judged & cli::kJudgesValue) == 0) continue;
            for (size_t c = 0; c < 4; ++c) widths.push_back(e.most.value[c] - e.least.value[c]);
        }
        std::ranges::sort(widths);
        if (widths.empty()) continue;
        EXPECT_LT(widths[widths.size() / 2], 0.01f) << name << ": the median";
        EXPECT_LT(widths[widths.size() * 99 / 100], 0.06f) << name << ": one in a hundred";
    }
}

TEST(Verdicts, TellCaseIntervalAnswerAndCause) {
    const Suite suite = *cli::make_suite("addressing");
    std::vector<PortResult> answers = right_answers(suite);
    // What a port answers that clamps as GL_CLAMP never did: texel 0 is out of reach.
    size_t changed = 0;
    for (size_t n = 0; n < suite.cases.size(); ++n) {
        if (suite.cases[n].op != PortOp::WrapIndex || suite.cases[n].wrap_s != 2 || suite.cases[n].extent < 2) continue;
        if (answers[n].x == 0) answers[n].x = 1, ++changed;
    }
    const TemporaryFolder folder;
    const std::string file = folder.write("answers.bin", bytes_of(answers));
    const Outcome outcome = run({"verify-shader", "--suite", "addressing", "--outputs", file});
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    const std::vector<std::string> parts = {"addressing (" + file + "): " + std::to_string(changed) + " of ",
                                            "index clamp: ", "wrap-index, wrap_s clamp", "x: expected 0, legal 0 to 0, came 1",
                                            "likeliest cause: texel 0 out of reach"};
    for (const std::string& part : parts) EXPECT_NE(outcome.out.find(part), std::string::npos) << part << "\n" << outcome.out;

    const Outcome json = run({"verify-shader", "--suite", "addressing", "--outputs", file, "--json"});
    EXPECT_EQ(json.code, 1);
    const nlohmann::json verdict = nlohmann::json::parse(json.out);
    EXPECT_EQ(verdict["failed"], changed);
    ASSERT_EQ(verdict["failures"].size(), changed);
    EXPECT_EQ(verdict["failures"][0]["cause"], "texel 0 out of reach");
    EXPECT_EQ(verdict["failures"][0]["fields"][0]["came"], 1);
}

// A sampler that gives a colour and nothing else can be judged by it.
TEST(Verdicts, AreOfTheFieldsThatAreAskedFor) {
    const Suite suite = *cli::make_suite("kernels");
    std::vector<PortResult> answers = right_answers(suite);
    for (PortResult& answer : answers) answer.x = answer.y = answer.level = 77, answer.weight = -1;
    const TemporaryFolder folder;
    const std::string file = folder.write("answers.bin", bytes_of(answers));
    const auto judged = [&](const std::string& fields) {
        return run({"verify-shader", "--suite", "kernels", "--outputs", file, "--fields", fields});
    };
    EXPECT_EQ(run({"verify-shader", "--suite", "kernels", "--outputs", file}).code, 1);
    EXPECT_EQ(judged("value").code, 0);
    const Outcome weights = judged("value,weight");
    EXPECT_EQ(weights.code, 1);
    EXPECT_NE(weights.out.find("      weight: expected "), std::string::npos) << weights.out;
    EXPECT_EQ(weights.out.find("      level: "), std::string::npos) << weights.out;
    answers[3].value[2] += 1;
    write_file(file, bytes_of(answers));
    EXPECT_EQ(judged("value").code, 1);
    EXPECT_EQ(why_not_failed(judged("colour"), 2, "--fields: unknown value 'colour'"), "");
    EXPECT_EQ(why_not_failed(judged(","), 2, "--fields: unknown value ''"), "");
    EXPECT_EQ(why_not_failed(judged("bits"), 2, "no case of kernels decides any of them"), "");
}

// A folder with the answers to every suite: one line each, and the details of that which fails.
TEST(Verdicts, AreOfEverySuiteThatAFolderAnswers) {
    const TemporaryFolder folder;
    for (const cli::SuiteInfo& info : cli::all_suites()) {
        std::vector<PortResult> answers = right_answers(*cli::make_suite(info.name));
        if (info.name == "triplanar") answers[5].x = 9;
        folder.write(std::string(info.name) + ".bin", bytes_of(answers));
    }
    const Outcome outcome = run({"verify-shader", "--suite", "all", "--outputs", folder.path()});
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    for (const cli::SuiteInfo& info : cli::all_suites()) {
        const std::string head = std::string(info.name) + " (" + (folder / (std::string(info.name) + ".bin")) + "): ";
        const size_t line = outcome.out.find(head);
        ASSERT_NE(line, std::string::npos) << info.name << "\n" << outcome.out;
        const std::string verdict = outcome.out.substr(line, outcome.out.find('\n', line) - line);
        EXPECT_TRUE(verdict.ends_with(info.name == "triplanar" ? "cases are not legal" : "all legal")) << verdict;
    }
    std::filesystem::remove(folder / "noise.bin");
    const Outcome missing = run({"verify-shader", "--suite", "all", "--outputs", folder.path()});
    EXPECT_EQ(missing.code, 3);
    EXPECT_NE(missing.err.find("noise.bin: cannot be opened"), std::string::npos) << missing.err;
}

TEST(Verdicts, NeedNoVulkanForOutputs) {
    const Suite suite = *cli::make_suite("srgb");
    const TemporaryFolder folder;
    const std::string file = folder.write("answers.bin", bytes_of(right_answers(suite)));
    const std::string command = "VK_ICD_FILENAMES=/nonexistent VK_DRIVER_FILES=/nonexistent " + std::string(RAWTEXEL_PROGRAM) +
                                " verify-shader --suite srgb --outputs " + file + " > /dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0);
}

/// Nothing where a copy of `path` grown to 64 GiB, which hold no data, is refused with `part`.
std::string why_huge_is_read(const std::string& path, const std::vector<std::string>& command, const std::string& part) {
    const uintmax_t size = std::filesystem::file_size(path);
    std::filesystem::resize_file(path, uintmax_t{64} << 30);
    const std::string why = why_not_failed(run(command), 3, part);
    std::filesystem::resize_file(path, size);
    return why;
}

TEST(VectorFiles, AreRefusedWhereTheyAreDamaged) {
    const TemporaryFolder folder;
    const std::string suite = folder / "suite";
    ASSERT_EQ(run({"vectors", "--suite", "lod", "-o", suite}).code, 0);
    const std::string answers = folder.write("answers.bin", bytes_of(right_answers(*cli::make_suite("lod"))));
    const std::vector<std::string> verify{"verify-shader", "--suite", suite, "--outputs", answers};
    ASSERT_EQ(run(verify).code, 0);
    const auto refused = [&](const char* file, const auto& damage, const std::string& part) {
        const std::string path = suite + "/" + file, whole = read_file(path);
        std::string damaged = whole;
        damage(damaged);
        write_file(path, damaged);
        const std::string why = why_not_failed(run(verify), 3, part);
        write_file(path, whole);
        return why;
    };
    const auto replace = [](const char* from, const char* to) {
        return [=](std::string& text) { text.replace(text.find(from), std::strlen(from), to); };
    };
    const auto set_word = [](size_t at, uint32_t value) {
        return [=](std::string& bytes) { std::memcpy(bytes.data() + 4 * at, &value, 4); };
    };
    EXPECT_EQ(refused("suite.json", replace("\"version\": 1", "\"version\": 7"), "version 7"), "");
    EXPECT_EQ(refused("suite.json", replace("rawtexel vectors", "something else"), "not a suite"), "");
    EXPECT_EQ(refused("suite.json", replace("\"groups\"", "\"gruops\""), "groups"), "");
    EXPECT_EQ(refused(
                  "cases.bin", [](std::string& bytes) { bytes.pop_back(); }, "cases.bin"),
              "");
    EXPECT_EQ(refused(
                  "expected.bin", [](std::string& bytes) { bytes.resize(256); }, "as many expectations as cases"),
              "");
    EXPECT_EQ(refused(
                  "texels.bin", [](std::string& bytes) { bytes.resize(1024); }, "fewer texels"),
              "");
    EXPECT_EQ(refused("cases.bin", set_word(0, 99), "case 0: an op that there is not"), "");
    EXPECT_EQ(refused("cases.bin", set_word(64 + 1, 99), "case 1: a texture that there is not"), "");
    EXPECT_EQ(refused("cases.bin", set_word(2, 9), "case 0: a wrap that there is not"), "");
    EXPECT_EQ(refused("cases.bin", set_word(14, 1000), "case 0: a number of probes"), "");
    EXPECT_EQ(refused("textures.bin", set_word(0, 0), "an extent"), "");
    // A case of another op: an index that no texture has.
    const auto set_index = [](int32_t index, int32_t extent) {
        return [=](std::string& bytes) {
            CaseRecord record;
            record.op = PortOp::WrapIndex;
            record.index = index, record.extent = extent;
            std::memcpy(bytes.data(), &record, sizeof(record));
        };
    };
    EXPECT_EQ(refused("cases.bin", set_index(std::numeric_limits<int32_t>::min(), 8), "case 0: an index beyond 2^30"), "");
    EXPECT_EQ(refused("cases.bin", set_index(3, 0), "case 0: an axis of no texels"), "");
    EXPECT_EQ(refused("cases.bin", set_index(3, std::numeric_limits<int32_t>::max()), "case 0: an axis of no texels or more than 2^24"),
              "");
    // Numbers that would wrap, text that would be a line of its own.
    EXPECT_EQ(refused("suite.json", replace("\"version\": 1", "\"version\": 4294967297"), "\"version\" is out of range"), "");
    EXPECT_EQ(refused("suite.json", replace("\"version\": 1", "\"version\": 1.9"), "\"version\" is out of range"), "");
    EXPECT_EQ(refused("suite.json", replace("\"suite\": \"lod", "\"suite\": \"l\\n"), "\"suite\" is out of range or of another kind"), "");
    EXPECT_EQ(refused("suite.json", replace("\"first\": 0", "\"first\": -1"), "\"first\" is out of range"), "");
    const auto regroup = [](const char* groups) {
        return [=](std::string& text) {
            auto json = nlohmann::json::parse(text);
            json["groups"] = nlohmann::json::parse(groups);
            text = json.dump();
        };
    };
    EXPECT_EQ(refused("suite.json", regroup("{}"), "\"groups\" is no list"), "");
    EXPECT_EQ(refused("suite.json", regroup(R"([{"name": "a", "about": "", "first": 0, "count": 0, "exact": true}])"), "without cases"),
              "");
    EXPECT_EQ(refused("suite.json", regroup(R"([{"name": "a", "about": "", "first": 0, "count": 4294967295, "exact": true},
                                                {"name": "b", "about": "", "first": 4294967295, "count": 2, "exact": true}])"),
                      "do not hold all cases"),
              "");
    // Files far larger than any suite's, of holes alone, are not read.
    EXPECT_EQ(why_huge_is_read(suite + "/texels.bin", verify, "more than a suite's file may have"), "");
    EXPECT_EQ(why_huge_is_read(answers, verify, "bytes of results"), "");
    std::filesystem::remove(suite + "/expected.bin");
    EXPECT_EQ(why_not_failed(run(verify), 3, "expected.bin"), "");
}

TEST(VectorFiles, OfHardwareExpectNoTexelThatABlockLacks) {
    const TemporaryFolder folder;
    const std::string suite = folder / "suite";
    ASSERT_EQ(run({"vectors", "--suite", "hardware", "-o", suite}).code, 0);
    const Suite whole = *cli::make_suite("hardware");
    const std::string answers = folder.write("answers.bin", bytes_of(right_answers(whole)));
    const std::vector<std::string> verify{"verify-shader", "--suite", suite, "--outputs", answers};
    ASSERT_EQ(run(verify).code, 0);
    const auto group = std::ranges::find_if(whole.groups, [](const cli::CaseGroup& g) { return g.name.starts_with("bc1"); });
    ASSERT_NE(group, whole.groups.end());
    std::vector<cli::Expectation> expected = whole.expected;
    expected[group->first].expected.x = 1 << 30;
    write_file(suite + "/expected.bin", {reinterpret_cast<const char*>(expected.data()), expected.size() * sizeof(expected[0])});
    EXPECT_EQ(why_not_failed(run(verify), 3, "expects a texel that there is not"), "");
}

TEST(VectorUsage, IsRefusedWithTheNearestSpelling) {
    const TemporaryFolder folder;
    EXPECT_EQ(why_not_failed(run({"vectors", "-o", folder / "out"}), 2, "--suite NAME"), "");
    EXPECT_EQ(why_not_failed(run({"vectors", "--suite", "lod"}), 2, "-o DIR is missing"), "");
    EXPECT_EQ(why_not_failed(run({"vectors", "--suite", "kernel", "-o", folder / "out"}), 2, "nearest is 'kernels'"), "");
    EXPECT_EQ(why_not_failed(run({"verify-shader", "--suite", "lod"}), 2, "one of --spirv, --glsl and --outputs is missing"), "");
    EXPECT_EQ(why_not_failed(run({"verify-shader", "--spirv", "a.spv"}), 2, "--suite NAME is missing"), "");
    EXPECT_EQ(why_not_failed(run({"verify-shader", "--suite", "lod", "--spirv", "a.spv", "--glsl", "b.comp"}), 2, "not two"), "");
    EXPECT_EQ(why_not_failed(run({"verify-shader", "--suite", "lodd", "--spirv", "a.spv"}), 2, "nearest is 'lod'"), "");
    EXPECT_EQ(why_not_failed(run({"verify-shader", "--suite", "lod", "--outputs", "a", "--device", "x"}), 2, "--device"), "");
    EXPECT_EQ(why_not_failed(run({"verify-shader", "--suite", "lod", "--outputs", "a", "-o", "x"}), 2, "-o"), "");
    EXPECT_EQ(
        why_not_failed(run({"verify-shader", "--suite", "lod", "--outputs", folder.write("short.bin", "abc")}), 3, "3 bytes of results"),
        "");
    EXPECT_EQ(why_not_failed(run({"verify-shader", "--suite", folder.path(), "--outputs", folder / "short.bin"}), 3,
                             "no folder that `rawtexel vectors` wrote"),
              "");
}

TEST(SceneVectors, AreTheLookupsOfAFrame) {
    const TemporaryFolder folder;
    const auto write = [&](const char* to, std::vector<std::string> options) {
        options.insert(options.begin(), {"vectors", "--from", "metal-edge", "--size", "64x36", "--cases", "200", "-o", folder / to});
        const Outcome outcome = run(options);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
    };
    write("all", {});
    write("again", {});
    write("drawn", {"--estimator", "reservoir", "--filter", "lanczos3", "--mip", "linear"});
    for (const char* file : {"suite.json", "cases.bin", "expected.bin", "texels.bin"})
        EXPECT_EQ(folder.read(std::string("all/") + file), folder.read(std::string("again/") + file)) << file;
    const Suite all = cli::read_suite(folder / "all"), drawn = cli::read_suite(folder / "drawn");
    EXPECT_GT(all.cases.size() + all.left_out, 150u);
    EXPECT_LE(all.cases.size() + all.left_out, 200u);
    for (const CaseRecord& record : all.cases) EXPECT_EQ(record.op, PortOp::Sample);
    for (const CaseRecord& record : drawn.cases) {
        EXPECT_EQ(record.op, PortOp::Draw);
        EXPECT_EQ(texunit::KernelKind(record.minify), texunit::KernelKind::Lanczos3);
    }
    // What was expected is what the texture unit answers to the case that was written.
    for (size_t n = 0; n < drawn.cases.size(); ++n) EXPECT_EQ(illegal_words(drawn.expected[n], evaluate(drawn, drawn.cases[n])), 0u) << n;
    EXPECT_TRUE(judge_results(all, right_answers(all)).holds());
}

// Of the same pixel and map a case has the coordinates and the result that `explain` tells.
TEST(SceneVectors, AgreeWithExplain) {
    const TemporaryFolder folder;
    ASSERT_EQ(run({"vectors", "--from", "plane", "--size", "48x27", "--cases", "2000", "-o", folder / "suite"}).code, 0);
    const Suite suite = cli::read_suite(folder / "suite");
    const Outcome explained = run({"explain", "plane", "--size", "48x27", "--pixel", "20,20", "--json"});
    ASSERT_EQ(explained.code, 0) << explained.err;
    const nlohmann::json pixel = nlohmann::json::parse(explained.out);
    const nlohmann::json map = pixel["samples"][0]["surface"]["maps"][0];
    const auto u = map["uv"][0].get<float>(), v = map["uv"][1].get<float>();
    size_t found = 0;
    for (size_t n = 0; n < suite.cases.size(); ++n) {
        if (suite.cases[n].at[0] != u || suite.cases[n].at[1] != v) continue;
        ++found;
        for (size_t c = 0; c < 4; ++c) EXPECT_EQ(suite.expected[n].expected.value[c], map["result"][c].get<float>()) << c;
    }
    EXPECT_EQ(found, 1u);
}

TEST(SceneVectors, RefuseWhatTheyDoNotHave) {
    const TemporaryFolder folder;
    const auto refused = [&](std::vector<std::string> options, int code, const char* part) {
        options.insert(options.begin(), {"vectors", "-o", folder / "out"});
        return why_not_failed(run(options), code, part);
    };
    EXPECT_EQ(refused({"--from", "plane", "--suite", "lod"}, 2, "not both"), "");
    EXPECT_EQ(refused({"--suite", "lod", "--aniso", "4"}, 2, "go with --from"), "");
    EXPECT_EQ(refused({"--suite", "lod", "--cases", "4"}, 2, "go with --from"), "");
    EXPECT_EQ(refused({"--from", "plane", "--precision", "gpu"}, 2, "--precision gpu"), "");
    EXPECT_EQ(refused({"--from", "plane", "--footprint", "sample"}, 2, "--footprint sample"), "");
    EXPECT_EQ(refused({"--from", "plane", "--cases", "0"}, 2, "--cases"), "");
    EXPECT_EQ(refused({"--from", "no-such-scene.glb"}, 3, "no-such-scene.glb"), "");
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    // A scene whose buffer has the name of one of the suite's files keeps it.
    write_quad(folder);
    std::string gltf = folder.read("quad.gltf");
    gltf.replace(gltf.find("quad.bin"), 8, "cases.bin");
    folder.write("quad.gltf", gltf);
    std::filesystem::rename(folder / "quad.bin", folder / "cases.bin");
    const std::string before = folder.read("cases.bin");
    EXPECT_EQ(why_not_failed(run({"vectors", "--from", folder / "quad.gltf", "-o", folder.path()}), 2, "cases.bin"), "");
    EXPECT_EQ(folder.read("cases.bin"), before);
}

}  // namespace
}  // namespace rawtexel::test
