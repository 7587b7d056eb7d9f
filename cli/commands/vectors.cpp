#include "cli/commands/vectors.h"

#include "cli/option_values.h"
#include "cli/vectors/suite_files.h"
#include "scenes/spelling.h"

#include <filesystem>

namespace rawtexel::cli {
namespace {

class VectorsCommand : public Command {
  public:
    std::string_view name() const override { return "vectors"; }
    std::string_view usage() const override { return "vectors --suite NAME -o DIR"; }
    std::string_view summary() const override {
        return "Writes test vectors for ports of samplers: textures, sampler states, coordinates, derivatives and random numbers, and what "
               "a "
               "right port answers, with the interval of legal values where precision leaves freedom.";
    }

    void declare(CommandLine& line) override {
        line.option("--suite", "NAME", "one of `rawtexel list suites`, or `all`, each in a folder of its own",
                    [this](const std::string& text) { suite_ = text; });
        line.option("-o,--output", "DIR", "the folder to write, made where it is missing",
                    [this](const std::string& text) { output_ = text; });
    }

    int run(const Invocation& invocation) override {
        if (suite_.empty()) throw UsageError("--suite NAME is missing (usage: rawtexel " + std::string(usage()) + ")");
        if (output_.empty()) throw UsageError("-o DIR is missing (usage: rawtexel " + std::string(usage()) + ")");
        std::vector<std::string> names;
        for (const SuiteInfo& info : all_suites()) names.emplace_back(info.name);
        if (suite_ == "all") {
            for (const std::string& name : names) write(*make_suite(name), output_ + "/" + name, invocation);
            return kDone;
        }
        const std::optional<Suite> suite = make_suite(suite_);
        names.emplace_back("all");
        if (!suite) throw unknown_value("--suite", suite_, names);
        write(*suite, output_, invocation);
        return kDone;
    }

  private:
    static void write(const Suite& suite, const std::string& folder, const Invocation& invocation) {
        write_suite(suite, folder);
        invocation.out << "Saved: " << folder << "/" << kSuiteFile << " (" << suite.name << ", " << suite.cases.size() << " cases in "
                       << suite.groups.size() << " groups)\n";
    }

    std::string suite_, output_;
};

}  // namespace

std::unique_ptr<Command> make_vectors_command() { return std::make_unique<VectorsCommand>(); }

}  // namespace rawtexel::cli
