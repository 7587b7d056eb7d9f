#include "cli/texture_info.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace rawtexel::cli {
namespace {

using texunit::Shape;
using Json = nlohmann::ordered_json;

int full_levels(const Shape& shape) { return texunit::full_level_count(shape.width, shape.height, shape.depth); }

bool holds_floats(texunit::Format format) {
    const texunit::StorageClass storage = texunit::layout(format).storage;
    return storage == texunit::StorageClass::Half4 || storage == texunit::StorageClass::Float4;
}

std::string describe_shape(const Shape& shape) {
    const int layers = shape.cubes();
    std::string text = print_extents(shape, 0);
    if (shape.depth > 1) text += ", a volume";
    if (shape.cube) text += ", a cube map of 6 faces";
    if (layers > 1) text += ", " + std::to_string(layers) + " layers";
    return text;
}

std::string padded(std::string text, size_t width) {
    text.resize(std::max(text.size(), width), ' ');
    return text;
}

std::string property(const std::string& name, const std::string& value) { return "  " + padded(name, 13) + value + "\n"; }

std::string level_rows(const texunit::TexelSource& source) {
    const Shape shape = source.shape();
    std::string text = "  level  " + padded("extents", 18) + "bytes\n";
    for (int level = 0; level < shape.levels; ++level)
        text += "  " + padded(std::to_string(level), 7) + padded(print_extents(shape, level), 18) +
                std::to_string(source.level_bytes(level)) + "\n";
    return text;
}

}  // namespace

std::string color_space_of(const TextureInfo& info) {
    const texunit::Format format = info.file.source->format();
    if (texunit::info(format).srgb) return "srgb";
    const bool silent = info.file.container == "image" && !holds_floats(format) && !info.color_space_chosen;
    return silent ? "" : "linear";
}

std::string print_extents(const Shape& shape, int level) {
    const auto extent = [&](int whole) { return std::to_string(texunit::level_extent(whole, level)); };
    const std::string flat = extent(shape.width) + "x" + extent(shape.height);
    return shape.depth > 1 ? flat + "x" + extent(shape.depth) : flat;
}

std::string texture_info_text(const TextureInfo& info) {
    const texunit::TexelSource& source = *info.file.source;
    const texunit::FormatInfo& format = texunit::info(source.format());
    const Shape shape = source.shape();
    const std::string color_space = color_space_of(info);
    return info.path + ": " + info.file.container + ", " + std::to_string(info.file_bytes) + " bytes\n" +
           property("format", std::string(format.name) + ": " + std::string(format.description)) +
           property("color space", color_space.empty() ? "not declared, linear unless --color-space says otherwise" : color_space) +
           property("extents", describe_shape(shape)) +
           property("levels", std::to_string(shape.levels) + " in the file, " + std::to_string(full_levels(shape)) + " in a full pyramid") +
           property("texels", std::to_string(source.stored_bytes()) + " bytes") + "\n" + level_rows(source);
}

std::string texture_info_json(const TextureInfo& info) {
    const texunit::TexelSource& source = *info.file.source;
    const Shape shape = source.shape();
    const std::string color_space = color_space_of(info);
    Json levels = Json::array();
    for (int level = 0; level < shape.levels; ++level)
        levels.push_back({{"level", level},
                          {"width", texunit::level_extent(shape.width, level)},
                          {"height", texunit::level_extent(shape.height, level)},
                          {"depth", texunit::level_extent(shape.depth, level)},
                          {"bytes", source.level_bytes(level)}});
    const Json json{{"file", info.path},
                    {"container", info.file.container},
                    {"format", texunit::info(source.format()).name},
                    {"color_space", color_space.empty() ? Json(nullptr) : Json(color_space)},
                    {"width", shape.width},
                    {"height", shape.height},
                    {"depth", shape.depth},
                    {"layers", shape.cubes()},
                    {"faces", shape.faces()},
                    {"levels", shape.levels},
                    {"levels_full", full_levels(shape)},
                    {"file_bytes", info.file_bytes},
                    {"stored_bytes", source.stored_bytes()},
                    {"per_level", std::move(levels)}};
    // Paths may hold bytes that are no UTF-8: they are replaced, not refused.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rawtexel::cli
