#include "cli/commands/verify_shader.h"

#include "cli/option_values.h"
#include "cli/vectors/hardware_report.h"
#include "cli/vectors/suite_files.h"
#include "cli/vectors/verdict_report.h"
#include "cli/vulkan/glsl_compiler.h"
#include "cli/vulkan/port_runner.h"
#include "scenes/image_io.h"
#include "scenes/output_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <sstream>

namespace rawtexel::cli {
namespace {

/// Where answers come from.
enum class Source { Spirv, Glsl, Outputs };

/// What answers one suite.
struct Port {
    Source source;
    std::string path;
};

std::vector<PortResult> read_outputs(const std::string& path, const Suite& suite) {
    const size_t needed = suite.cases.size() * sizeof(PortResult);
    // Nobody reads a file that is too large to be right.
    std::error_code unreadable;
    uint64_t size = std::filesystem::file_size(path, unreadable);
    std::vector<std::byte> bytes;
    if (unreadable || size == needed) size = (bytes = scenes::read_file(path)).size();
    if (size != needed)
        throw scenes::InputError(path + ": " + std::to_string(size) + " bytes of results (" + std::to_string(needed) + " for the " +
                                 std::to_string(suite.cases.size()) + " cases of " + suite.name + ", " +
                                 std::to_string(sizeof(PortResult)) + " each)");
    std::vector<PortResult> results(suite.cases.size());
    std::memcpy(results.data(), bytes.data(), bytes.size());
    return results;
}

/// Bits of the words of fields with these names, separated by commas.
uint32_t parse_fields(const std::string& text) {
    uint32_t words = 0;
    std::vector<std::string> names;
    for (const RecordField& field : result_fields()) names.emplace_back(field.name);
    std::istringstream list(text);
    for (std::string name; std::getline(list, name, ',');) {
        const auto field = std::ranges::find(result_fields(), name, &RecordField::name);
        if (field == result_fields().end()) throw unknown_value("--fields", name, names);
        for (int word = field->word; word < field->word + field->count; ++word) words |= judges(size_t(word));
    }
    if (words == 0) throw UsageError("--fields: no field is named");
    return words;
}

/// Leaves the words to be judged that are among these.
void judge_only(uint32_t words, Suite& suite) {
    uint32_t judged = 0;
    for (Expectation& expectation : suite.expected) judged |= expectation.judged &= words;
    if (judged == 0) throw UsageError("--fields: no case of " + suite.name + " decides any of them");
}

class VerifyShaderCommand : public Command {
  public:
    std::string_view name() const override { return "verify-shader"; }
    std::string_view usage() const override { return "verify-shader --suite NAME (--spirv FILE | --glsl FILE | --outputs FILE)"; }
    std::string_view summary() const override {
        return "Judges a port of a sampler: runs a compute shader over the cases of a suite on any Vulkan device, without a window, or "
               "takes "
               "answers made elsewhere, and tells which are not legal and why. Exit code 1 when a case fails.";
    }

    void declare(CommandLine& line) override {
        line.option("--suite", "NAME",
                    "one of `rawtexel list suites`, a folder that `rawtexel vectors` wrote, or `all`: FILE is a folder then, with "
                    "NAME.spv, NAME.comp or NAME.bin of every suite",
                    [this](const std::string& text) { suite_ = text; });
        const auto from = [this](Source source) {
            return [this, source](const std::string& text) {
                if (port_) throw UsageError("one of --spirv, --glsl and --outputs, not two");
                port_ = Port{source, text};
            };
        };
        line.option("--spirv", "FILE", "a SPIR-V compute shader with the bindings of docs/porting.md", from(Source::Spirv));
        line.option("--glsl", "FILE", "the same in GLSL, compiled by glslangValidator", from(Source::Glsl));
        line.option("--outputs", "FILE", "answers made elsewhere, 64 bytes a case; asks for no Vulkan", from(Source::Outputs));
        line.option("--fields", "LIST",
                    "judges these fields of the answers alone, such as value or x,y,level (default: all that a case decides)",
                    [this](const std::string& text) { fields_ = parse_fields(text); });
        line.option("--device", "NAME", "a part of the device's name (default: the first that is no CPU, else the first)",
                    [this](const std::string& text) { device_ = text; });
        line.option("-o,--output", "FILE", "writes the answers, as --outputs takes them",
                    [this](const std::string& text) { output_ = text; });
        line.flag("--json", "one JSON object a suite, with every failure", json_);
    }

    int run(const Invocation& invocation) override {
        if (suite_.empty()) throw UsageError("--suite NAME is missing (usage: rawtexel " + std::string(usage()) + ")");
        if (!port_) throw UsageError("one of --spirv, --glsl and --outputs is missing (usage: rawtexel " + std::string(usage()) + ")");
        if (port_->source == Source::Outputs && !device_.empty()) throw UsageError("--device: --outputs asks for no device");
        if (port_->source == Source::Outputs && !output_.empty()) throw UsageError("-o: --outputs has the answers already");
        try {
            return suite_ == "all" ? verify_all(invocation) : verify(load(), *port_, invocation) ? kDone : kCheckFailed;
        } catch (const NoVulkan& missing) {
            throw scenes::InputError(missing.what());
        }
    }

  private:
    Suite load() const {
        if (std::optional<Suite> suite = make_suite(suite_)) return std::move(*suite);
        if (is_suite_folder(suite_)) return read_suite(suite_);
        std::error_code ignored;
        if (std::filesystem::exists(suite_, ignored))
            throw scenes::InputError(suite_ + ": no folder that `rawtexel vectors` wrote (it has no " + std::string(kSuiteFile) + ")");
        std::vector<std::string> names{"all"};
        for (const SuiteInfo& info : all_suites()) names.emplace_back(info.name);
        throw unknown_value("--suite", suite_, names);
    }

    int verify_all(const Invocation& invocation) const {
        if (!output_.empty()) throw UsageError("-o: with --suite all there is no one file of answers");
        static constexpr const char* kExtensions[] = {".spv", ".comp", ".bin"};
        bool holds = true;
        for (const SuiteInfo& info : all_suites()) {
            const std::string file =
                (std::filesystem::path(port_->path) / (std::string(info.name) + kExtensions[size_t(port_->source)])).string();
            holds = verify(*make_suite(info.name), {port_->source, file}, invocation) && holds;
        }
        return holds ? kDone : kCheckFailed;
    }

    bool verify(Suite suite, const Port& port, const Invocation& invocation) const {
        if (fields_ != 0) judge_only(fields_, suite);
        PortRun run;
        if (port.source == Source::Outputs) {
            run = {port.path, read_outputs(port.path, suite), {}};
        } else {
            const std::vector<std::byte> spirv = port.source == Source::Glsl ? compile_glsl(port.path) : scenes::read_file(port.path);
            run = run_port(suite, parse_spirv(port.path, spirv), port.path, device_);
        }
        if (!output_.empty()) scenes::write_file(output_, std::as_bytes(std::span(run.results)));
        const bool hardware = suite.name == kHardwareSuite;
        if (!hardware && !run.unsupported.empty())
            throw scenes::InputError(port.path + ": it samples images (bindings 5 to 8), and the device has none such as texture '" +
                                     suite.textures[run.unsupported[0]].name() + "'");
        SuiteVerdict verdict = judge_results(suite, run.results);
        std::erase_if(verdict.failures, [&](const CaseFailure& failure) {
            return std::ranges::find(run.unsupported, suite.cases[failure.index].texture) != run.unsupported.end();
        });
        std::vector<HardwareAgreement> agreements;
        if (hardware) agreements = measure_hardware(suite, run.results, run.unsupported);
        if (json_) {
            nlohmann::ordered_json json = verdict_json(suite, verdict, run.device);
            if (hardware) json["agreement"] = hardware_json(agreements);
            invocation.out << json.dump() << '\n';
        } else {
            invocation.out << verdict_text(suite, verdict, run.device) << hardware_text(agreements);
        }
        return verdict.holds() && std::ranges::all_of(agreements, &HardwareAgreement::holds);
    }

    std::string suite_, device_, output_;
    std::optional<Port> port_;
    uint32_t fields_ = 0;  ///< bits of the words that are judged; 0: all
    bool json_ = false;
};

}  // namespace

std::unique_ptr<Command> make_verify_shader_command() { return std::make_unique<VerifyShaderCommand>(); }

}  // namespace rawtexel::cli
