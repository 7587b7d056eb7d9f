// Instructions of small fixed workloads under valgrind, which other work on the machine cannot change, beside a baseline of another build.
//
// The program starts itself under callgrind (--run), once for each workload, so that none sees what another one left of the heap. There it
// is prepared, run once so that whatever is made on first use is there, and then run twice while callgrind counts.
#include "tests/benchmarks/instructions/callgrind.h"
#include "tests/benchmarks/instructions/workloads.h"
#include "tests/benchmarks/peer/machine.h"
#include "texunit/simd.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace rawtexel::instructions {
namespace {

using nlohmann::json;

constexpr int kCountedRuns = 2;
constexpr int kGrown = 1;

/// Those whose names hold one of the words; all without words.
std::vector<Workload> chosen(const std::vector<std::string>& words) {
    std::vector<Workload> all = all_workloads();
    std::erase_if(all, [&](const Workload& one) {
        return !words.empty() &&
               std::ranges::none_of(words, [&](const std::string& word) { return one.name.find(word) != std::string::npos; });
    });
    if (all.empty()) throw std::runtime_error("no workload has such a name");
    return all;
}

/// Under valgrind.
void run(const std::string& name) {
    const std::vector<Workload> all = all_workloads();
    const auto found = std::ranges::find(all, name, &Workload::name);
    if (found == all.end()) throw std::runtime_error("no workload has such a name");
    const std::function<void()> work = found->prepare();
    work();
    for (int n = 0; n < kCountedRuns; ++n) counted(work);
}

struct Count {
    const Workload* workload;
    uint64_t instructions;
    uint64_t difference;  ///< between the counted runs
};

Count count(const Workload& workload, const std::string& simd) {
    const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
    const std::vector<uint64_t> found = count_instructions({self, "--simd", simd, "--run", workload.name});
    if (found.size() < kCountedRuns) throw std::runtime_error("callgrind counted fewer runs than there were");
    const auto [least, most] = std::minmax(found[0], found[1]);
    return {&workload, least, most - least};
}

json read_baseline(const std::string& file) {
    std::ifstream stream(file);
    if (!stream) throw std::runtime_error(file + " cannot be read");
    const json baseline = json::parse(stream, nullptr, false);
    if (!baseline.is_object() || !baseline.contains("workloads") || !baseline["workloads"].is_object())
        throw std::runtime_error(file + " holds no counts of instructions");
    for (const json& one : baseline["workloads"])
        if (!one.is_object() || !one.contains("instructions") || !one["instructions"].is_number_unsigned())
            throw std::runtime_error(file + " holds a workload without a count of instructions");
    return baseline;
}

std::optional<uint64_t> before_of(const json& baseline, const std::string& name) {
    const auto found = baseline["workloads"].find(name);
    if (found == baseline["workloads"].end()) return std::nullopt;
    return found->at("instructions").get<uint64_t>();
}

/// Prints counts as they come, and keeps what is to be said of all of them.
class Table {
  public:
    Table(const json& baseline, double allowed) : baseline_(baseline), allowed_(allowed) {
        std::printf("%-40s %14s %12s  %-12s %s\n", "workload", "instructions", "a unit", "unit",
                    baseline.is_null() ? "" : "against baseline");
    }

    void add(const Count& one) {
        std::printf("%-40s %14llu %12.2f  %-12s", one.workload->name.c_str(), (unsigned long long)(one.instructions),
                    double(one.instructions) / double(one.workload->units), std::string(one.workload->unit).c_str());
        if (!baseline_.is_null()) compare(one);
        if (one.difference > 0) std::printf("  (%llu more at the other run)", (unsigned long long)(one.difference));
        std::printf("\n");
        std::fflush(stdout);
        ++workloads_;
        unlike_ += one.difference > 0;
        farthest_ = std::max(farthest_, 100 * double(one.difference) / double(one.instructions));
    }

    /// How many workloads take more than is allowed beyond the baseline.
    int end() const {
        std::printf("%d of %d workloads took the same instructions at both runs; the others were at most %.3f %% apart.\n",
                    workloads_ - unlike_, workloads_, farthest_);
        if (grown_ > 0) std::printf("%d grew by more than %g %%.\n", grown_, allowed_);
        return grown_;
    }

  private:
    void compare(const Count& one) {
        const std::optional<uint64_t> before = before_of(baseline_, one.workload->name);
        if (!before || *before == 0) {
            std::printf(" not in it");
            return;
        }
        const double percent = 100 * (double(one.instructions) / double(*before) - 1);
        std::printf(" %+.3f %%%s", percent, percent > allowed_ ? "  GREW" : "");
        grown_ += percent > allowed_;
    }

    const json& baseline_;
    double allowed_, farthest_ = 0;
    int workloads_ = 0, grown_ = 0, unlike_ = 0;
};

json as_json(const std::vector<Count>& counts, const std::string& simd) {
    json all{{"machine", peer::machine_description()}, {"workloads", json::object()}};
    all["machine"]["simd"] = simd;
    for (const Count& one : counts)
        all["workloads"][one.workload->name] = {{"instructions", one.instructions},
                                                {"unit", one.workload->unit},
                                                {"units", one.workload->units},
                                                {"difference_between_runs", one.difference}};
    return all;
}

int main_of(int argc, char** argv) {
    CLI::App app("Instructions of small fixed workloads under valgrind's callgrind.");
    std::vector<std::string> words;
    std::string file, baseline_file, simd = "avx2", under_valgrind;
    double allowed = 1;
    app.add_option("WORD", words, "only workloads with one of these words in their names");
    app.add_option("--simd", simd, "instruction set; valgrind knows none beyond avx2")->check(CLI::IsMember({"scalar", "sse4", "avx2"}));
    app.add_option("--json", file, "the counts with the machine's description: a baseline for later");
    app.add_option("--baseline", baseline_file, "counts to compare with: ends with 1 where any has grown")->check(CLI::ExistingFile);
    app.add_option("--allow", allowed, "percent that a count may grow by")
        ->check(CLI::Range(0.0, 1000.0))
        ->check([](const std::string& text) {
            return std::isnan(std::strtod(text.c_str(), nullptr)) ? std::string("not a number") : std::string();
        });
    app.add_option("--run", under_valgrind, "run one workload: what is started under valgrind")->group("");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    if (!texunit::choose_simd(*texunit::parse_simd(simd))) throw std::runtime_error("no " + simd + " here");
    if (!under_valgrind.empty()) {
        run(under_valgrind);
        return 0;
    }
    const std::vector<Workload> workloads = chosen(words);
    const json baseline = baseline_file.empty() ? json() : read_baseline(baseline_file);
    const json compiler = peer::machine_description()["compiler"];
    const json::json_pointer their_compiler("/machine/compiler");
    if (baseline.contains("machine") && baseline["machine"].is_object() && baseline.value(their_compiler, compiler) != compiler)
        std::printf("The baseline was made by another compiler, whose code differs by itself.\n");
    // Minutes of counting are not to end in a file that cannot be written.
    if (!file.empty() && !std::ofstream(file, std::ios::app)) throw std::runtime_error(file + " cannot be written");
    Table table(baseline, allowed);
    std::vector<Count> counts;
    for (const Workload& workload : workloads) {
        counts.push_back(count(workload, simd));
        table.add(counts.back());
    }
    if (!file.empty() && !(std::ofstream(file) << as_json(counts, simd).dump(2) << '\n'))
        throw std::runtime_error(file + " cannot be written");
    return table.end() > 0 ? kGrown : 0;
}

}  // namespace
}  // namespace rawtexel::instructions

int main(int argc, char** argv) {
    try {
        return rawtexel::instructions::main_of(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "rawtexel_instruction_bench: %s\n", error.what());
        return 3;
    }
}
