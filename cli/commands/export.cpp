#include "cli/commands/export.h"

#include "cli/output_files.h"
#include "scenes/export.h"
#include "scenes/load.h"

namespace rawtexel::cli {
namespace {

class ExportCommand : public Command {
  public:
    std::string_view name() const override { return "export"; }
    std::string_view usage() const override { return "export SCENE -o FILE.glb"; }
    std::string_view summary() const override { return "Writes a scene as one binary glTF file that renders the same."; }

    void declare(CommandLine& line) override {
        line.arguments("SCENE", "a .gltf or .glb file, or a built-in scene (rawtexel list scenes)", 1, 1, words_);
        line.option("-o,--output", "FILE.glb", "the file to write", [this](const std::string& text) { output_ = text; });
    }

    int run(const Invocation& invocation) override {
        if (output_.empty()) throw UsageError("-o FILE.glb is missing (usage: rawtexel " + std::string(usage()) + ")");
        if (!output_.ends_with(".glb")) throw UsageError("-o: '" + output_ + "' is not a .glb file, the only format of export");
        const std::vector<OutputFile> outputs{{"-o", output_}};
        check_outputs(outputs, words_);
        std::vector<std::string> opened;
        scenes::LoadOptions options;
        options.warn = [&](const std::string& what) { warn(invocation, what); };
        options.opened = [&](const std::string& path) { opened.push_back(path); };
        const shading::Scene scene = scenes::load(words_[0], options);
        check_apart(outputs, opened);
        scenes::export_glb(scene, output_);
        invocation.out << "Saved: " << output_ << '\n';
        return kDone;
    }

  private:
    std::vector<std::string> words_;
    std::string output_;
};

}  // namespace

std::unique_ptr<Command> make_export_command() { return std::make_unique<ExportCommand>(); }

}  // namespace rawtexel::cli
