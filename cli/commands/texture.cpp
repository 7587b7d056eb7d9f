#include "cli/commands/texture.h"

#include "cli/image_output.h"
#include "cli/limits.h"
#include "cli/lookup_options.h"
#include "cli/option_values.h"
#include "cli/output_files.h"
#include "cli/texel_image.h"
#include "cli/texture_file.h"
#include "cli/texture_info.h"
#include "cli/texture_options.h"
#include "cli/version.h"
#include "scenes/output_file.h"
#include "texunit/dds_writer.h"

#include <filesystem>

namespace rawtexel::cli {
namespace {

using texunit::Shape;
using texunit::Texture;

/// Which part of a texture, as far as the user says.
struct SliceChoice {
    std::optional<int> level, layer, face, depth_slice;
};

/// `value`, or 0 where none is given; throws UsageError when there are not so many.
int checked(const std::string& option, std::optional<int> value, int count, const std::string& of) {
    if (value.value_or(0) < count) return value.value_or(0);
    throw UsageError(option + ": there is no " + std::to_string(*value) + " (" + of + ": 0 to " + std::to_string(count - 1) + ")");
}

/// The slice of `level` that the choice means. A depth slice counts in level 0: coarser levels have the one that covers it.
int chosen_slice(const Shape& shape, const SliceChoice& choice, int level) {
    if (choice.face && !shape.cube) throw UsageError("--face: the texture is no cube map");
    if (choice.depth_slice && shape.depth == 1) throw UsageError("--slice: the texture is no volume");
    const int layer = checked("--layer", choice.layer, shape.cubes(), shape.cube ? "cubes of the array" : "layers of the array");
    const int face = checked("--face", choice.face, shape.faces(), "+x -x +y -y +z -z");
    const int depth_slice = checked("--slice", choice.depth_slice, shape.depth, "depth slices of level 0");
    const int last = texunit::level_extent(shape.depth, level) - 1;
    return shape.depth > 1 ? std::min(depth_slice >> level, last) : layer * shape.faces() + face;
}

/// FOLDER/NAME.levelN.EXT for FOLDER/NAME.EXT.
std::string level_path(const std::string& path, int level) {
    std::filesystem::path name(path);
    const std::string extension = name.extension().string();
    return name.replace_extension().string() + ".level" + std::to_string(level) + extension;
}

bool is_dds(const std::string& path) { return scenes::extension_of(path) == "dds"; }

class TextureCommand : public Command {
  public:
    std::string_view name() const override { return "texture"; }
    std::string_view usage() const override { return "texture info|decode|mips FILE [-o IMAGE] [options]"; }
    std::string_view summary() const override {
        return "Tells what is inside a texture file (info), or writes its texels as images: of one level (decode), or of every level of "
               "its pyramid (mips), those that the file lacks included. Formats of floats get linear values, formats of 8 bits the "
               "texture's own codes.";
    }

    void declare(CommandLine& line) override {
        line.arguments("info|decode|mips FILE", "what to do, and a .dds or .ktx2 file, or any image", 2, 2, words_);
        line.flag("--json", "info: as JSON", json_);
        line.option("-o,--output", "IMAGE",
                    "decode, mips: the image to write; for NAME.EXT mips writes one image a level, NAME.level0.EXT and so on, but all "
                    "layers, faces and levels into a NAME.dds",
                    [this](const std::string& text) { output_ = text; });
        line.group("Which texels (each 0 by default); mips writes every level of that layer, face or slice");
        declare_index(line, "--level", "L", "decode: the level, finest first", choice_.level);
        declare_index(line, "--layer", "N", "the layer of an array, or the cube of an array of cubes", choice_.layer);
        declare_index(line, "--face", "F", "the face of a cube map: +x -x +y -y +z -z are 0 to 5", choice_.face);
        declare_index(line, "--slice", "Z", "the depth slice of a volume, counted in level 0", choice_.depth_slice);
        line.group("How the file is read");
        declare_color_space(line, color_space_);
        line.option("--mip-storage", "source|float", "generated levels rounded to the file's own format (the default), or kept in float",
                    [this](const std::string& text) { mip_storage_ = parse_mip_storage(text); });
        declare_texture_options(line, files_);
    }

    int run(const Invocation& invocation) override {
        const size_t action = parse_word("texture", words_[0], {"info", "decode", "mips"});
        check_options(action);
        if (action == 0) return tell(invocation);
        return is_dds(output_) ? write_dds(invocation) : write_images(invocation, action == 2);
    }

  private:
    static void declare_index(CommandLine& line, const std::string& option, const std::string& value, const std::string& help,
                              std::optional<int>& index) {
        line.option(option, value, help,
                    [&index, option](const std::string& text) { index = int(parse_integer(option, text, 0, kMaxLayer)); });
    }

    void check_options(size_t action) const;
    int tell(const Invocation& invocation) const;
    int write_dds(const Invocation& invocation) const;
    int write_images(const Invocation& invocation, bool every_level) const;

    std::vector<std::string> words_;
    std::string output_;
    SliceChoice choice_;
    std::optional<ColorSpace> color_space_;
    std::optional<texunit::MipStorage> mip_storage_;  ///< unset: Source
    texunit::ContainerOptions files_;
    bool json_ = false;
};

/// Options that the action does not look at are refused.
void TextureCommand::check_options(size_t action) const {
    const bool is_info = action == 0;
    const auto refuse = [&](const char* option) { throw UsageError("texture " + words_[0] + " takes no " + option); };
    if (is_info && !output_.empty()) refuse("-o");
    if (!is_info && json_) refuse("--json");
    if (action != 1 && choice_.level) refuse("--level");
    if (is_info && (choice_.layer || choice_.face || choice_.depth_slice)) refuse("--layer, --face or --slice");
    if (is_info && (mip_storage_ || files_.bc_rounding != texunit::BcRounding::Exact)) refuse("--mip-storage or --bc-rounding");
    if (is_info) return;
    if (output_.empty()) throw UsageError("-o IMAGE is missing (usage: rawtexel texture " + words_[0] + " FILE -o IMAGE)");
    if (action != 2 || !is_dds(output_)) return check_image_format("-o", output_);
    if (choice_.layer || choice_.face || choice_.depth_slice) throw UsageError("-o: a .dds file holds every layer, face and slice");
}

int TextureCommand::tell(const Invocation& invocation) const {
    const std::string& path = words_[1];
    const TextureFile file = open_texture_file(path, color_space_, files_);
    const TextureInfo info{path, file, texunit::open_file(path)->size(), color_space_.has_value()};
    invocation.out << (json_ ? texture_info_json(info) : texture_info_text(info));
    return kDone;
}

/// The whole texture as one file.
int TextureCommand::write_dds(const Invocation& invocation) const {
    const std::string& path = words_[1];
    check_outputs(std::vector<OutputFile>{{"-o", output_}}, {&path, 1});
    Texture texture(path, open_texture_file(path, color_space_, files_).source,
                    {.mip_storage = mip_storage_.value_or(texunit::MipStorage::Source)});
    scenes::write_file(output_, texunit::encode_dds(texture));
    invocation.out << "Saved: " << output_ << '\n';
    return kDone;
}

int TextureCommand::write_images(const Invocation& invocation, bool every_level) const {
    const std::string& path = words_[1];
    TextureFile file = open_texture_file(path, color_space_, files_);
    check_holds_texels("-o", output_, file.source->format());
    Texture texture(path, std::move(file.source), {.mip_storage = mip_storage_.value_or(texunit::MipStorage::Source)});

    const int levels = texture.shape().levels;
    const int first = checked("--level", choice_.level, levels, "levels of the pyramid"), end = every_level ? levels : first + 1;
    std::vector<OutputFile> outputs;
    for (int level = first; level < end; ++level) outputs.push_back({"-o", every_level ? level_path(output_, level) : output_});
    check_outputs(outputs, {&path, 1});

    const scenes::Metadata metadata{{"Software", "rawtexel " + std::string(version())}, {"rawtexel:command", invocation.command_line}};
    bool lost_alpha = false;
    for (int level = first; level < end; ++level) {
        const std::string& output = outputs[size_t(level - first)].path;
        const int slice = chosen_slice(texture.shape(), choice_, level);
        write_slice(output, texture, level, slice, metadata);
        lost_alpha = lost_alpha || loses_alpha(output, texture, level, slice);
        invocation.out << "Saved: " << output << '\n';
    }
    if (lost_alpha) warn(invocation, output_ + ": the format has no alpha, which the texels have; one that does is '.png'");
    return kDone;
}

}  // namespace

std::unique_ptr<Command> make_texture_command() { return std::make_unique<TextureCommand>(); }

}  // namespace rawtexel::cli
