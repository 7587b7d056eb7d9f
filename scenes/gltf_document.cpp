#include "scenes/gltf_document.h"

#include "scenes/gltf_container.h"
#include "scenes/gltf_schema.h"
#include "scenes/gltf_uri.h"
#include "scenes/image_io.h"
#include "scenes/spelling.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>

namespace rawtexel::scenes {
namespace {

using nlohmann::json;
using SharedBytes = std::shared_ptr<const std::vector<std::byte>>;

constexpr std::array<std::string_view, 7> kKnownExtensions = {
    "KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_materials_unlit", "KHR_mesh_quantization",
    "KHR_texture_basisu",  "KHR_texture_transform",           "MSFT_texture_dds",
};
bool is_known(const std::string& extension) { return std::ranges::find(kKnownExtensions, extension) != kKnownExtensions.end(); }

/// Nesting that no glTF needs; the parsers and everything after them recurse this deep at most.
constexpr int kMaxNesting = 128;

/// The deepest nesting of brackets outside strings; of valid JSON that is the nesting of its values.
int nesting(std::string_view text) {
    int depth = 0, deepest = 0;
    bool in_string = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string && c == '\\') ++i;  // the next character is escaped
        if (c == '"') in_string = !in_string;
        if (in_string) continue;
        if (c == '[' || c == '{') deepest = std::max(deepest, ++depth);
        if (c == ']' || c == '}') --depth;
    }
    return deepest;
}

json parse_json(const std::string& path, std::string_view text) {
    if (nesting(text) > kMaxNesting) throw InputError(path + ": JSON nested deeper than " + std::to_string(kMaxNesting) + " levels");
    try {
        return json::parse(text.begin(), text.end());
    } catch (const json::exception& error) {
        throw InputError(path + ": not valid JSON (" + one_line(error.what()) + ")");
    }
}

/// Required ones must be known; the others are told of and left out.
void check_extensions(const GltfDocument& document, const json& checked, const LoadOptions& options) {
    const auto names = [&](const char* list) { return checked.value(list, std::set<std::string>{}); };
    const auto required = names("extensionsRequired");
    for (const std::string& name : required)
        if (!is_known(name)) document.fail("needs the extension " + one_line(name) + " (which is not supported)");
    for (const std::string& name : names("extensionsUsed"))
        if (!is_known(name)) options.warn(document.path + ": the extension " + one_line(name) + " is left out");
}

/// What the document holds and the scene will not.
void tell_of_animations(const GltfDocument& document, const json& original, const LoadOptions& options) {
    const auto animations = original.find("animations");
    if (animations != original.end() && !animations->empty()) options.warn(document.path + ": animations are left out");
}

/// Reads what URIs name, each file once.
class Resources {
  public:
    explicit Resources(GltfDocument& document) : document_(document) {}

    /// `what` is the owner in messages, such as "buffers[0]". Sets `mime_type` where the URI tells it.
    SharedBytes read(const std::string& uri, const std::string& what, std::string& mime_type) {
        if (is_data_uri(uri)) {
            auto data = decode_data_uri(uri);
            if (!data) document_.fail(what + " is a malformed data URI");
            if (mime_type.empty()) mime_type = data->mime_type;
            return std::make_shared<const std::vector<std::byte>>(std::move(data->bytes));
        }
        if (uri.empty() || uri.find('\0') != uri.npos || percent_decoded(uri).find('\0') != std::string::npos)
            document_.fail(what + " has an unusable URI");
        if (leaves_the_folder_tree(uri)) document_.fail(what + " refers to " + one_line(uri) + " (allowed: relative paths and data URIs)");
        return read_relative(uri);
    }

  private:
    SharedBytes read_relative(const std::string& uri) {
        auto [entry, is_new] = files_.try_emplace(uri);
        if (!is_new) return entry->second;
        const std::filesystem::path folder = std::filesystem::path(document_.path).parent_path();
        std::filesystem::path file = folder / percent_decoded(uri);
        // Exporters that do not escape write the file's name as it is.
        std::error_code ignored;
        if (!std::filesystem::exists(file, ignored) && std::filesystem::exists(folder / uri, ignored)) file = folder / uri;
        entry->second = std::make_shared<const std::vector<std::byte>>(read_file(file.string()));
        document_.memory->grant(entry->second->size());
        return entry->second;
    }

    GltfDocument& document_;
    std::map<std::string, SharedBytes> files_;
};

void read_buffers(GltfDocument& document, const json& checked, Resources& resources, const SharedBytes& file,
                  const std::optional<std::span<const std::byte>>& binary) {
    const json none = json::array();
    const json& buffers = checked.contains("buffers") ? checked["buffers"] : none;
    for (size_t i = 0; i < buffers.size(); ++i) {
        std::string what = "buffers[" + std::to_string(i) + "]";
        GltfBuffer buffer;
        buffer.declared_bytes = buffers[i]["byteLength"].get<uint64_t>();
        if (buffers[i].contains("uri")) {
            const std::string uri = buffers[i]["uri"].get<std::string>();
            std::string mime_type;
            const SharedBytes bytes = resources.read(uri, what, mime_type);
            if (uri.rfind("data:", 0) != 0) what += " '" + uri + "'";
            buffer.owner = bytes;
            buffer.bytes = *bytes;
        } else if (i == 0 && binary) {
            buffer.owner = file;
            buffer.bytes = *binary;
        } else {
            document.buffers.push_back(buffer);
            continue;
        }
        if (buffer.bytes.size() < buffer.declared_bytes)
            document.fail(what + " is truncated (" + std::to_string(buffer.bytes.size()) + " bytes, it declares " +
                          std::to_string(buffer.declared_bytes) + ")");
        document.buffers.push_back(buffer);
    }
}

void check_buffer_views(const GltfDocument& document) {
    for (size_t i = 0; i < document.model.bufferViews.size(); ++i) {
        const tinygltf::BufferView& view = document.model.bufferViews[i];
        const uint64_t available = document.buffers[size_t(view.buffer)].declared_bytes;
        if (view.byteOffset > available || view.byteLength > available - view.byteOffset)
            document.fail("bufferViews[" + std::to_string(i) + "] ends at byte " + std::to_string(view.byteOffset + view.byteLength) +
                          " of buffer " + std::to_string(view.buffer) + " (which has " + std::to_string(available) + ")");
    }
}

std::string image_name(const json& image, size_t number) {
    if (const std::string name = image.value("name", std::string()); !name.empty()) return one_line(name);
    const std::string uri = image.value("uri", std::string());
    if (!uri.empty() && !is_data_uri(uri)) return one_line(std::filesystem::path(percent_decoded(uri)).filename().string());
    return "image " + std::to_string(number);
}

void read_images(GltfDocument& document, const json& checked, Resources& resources) {
    std::map<int, SharedBytes> from_views;
    const json none = json::array();
    const json& images = checked.contains("images") ? checked["images"] : none;
    for (size_t i = 0; i < images.size(); ++i) {
        const json& image = images[i];
        const std::string what = "images[" + std::to_string(i) + "]";
        GltfImage result{image_name(image, i), image.value("mimeType", std::string()), nullptr};
        if (image.contains("uri") == image.contains("bufferView")) document.fail(what + " needs either a uri or a bufferView");
        if (image.contains("uri")) {
            result.encoded = resources.read(image["uri"].get<std::string>(), what, result.mime_type);
        } else {
            SharedBytes& bytes = from_views[image["bufferView"].get<int>()];
            if (!bytes) {
                const auto view = document.view(image["bufferView"].get<int>());
                document.memory->spend(view.size());
                bytes = std::make_shared<const std::vector<std::byte>>(view.begin(), view.end());
            }
            result.encoded = bytes;
        }
        document.images.push_back(std::move(result));
    }
}

/// tinygltf gets the checked JSON and nothing else: no bytes, no file system.
tinygltf::Model parse_model(const GltfDocument& document, json checked) {
    checked.erase("buffers");
    checked.erase("images");
    const std::string text = checked.dump();
    tinygltf::TinyGLTF parser;
    tinygltf::Model model;
    std::string error, warning;
    if (!parser.LoadASCIIFromString(&model, &error, &warning, text.data(), static_cast<unsigned>(text.size()), ""))
        document.fail("not a valid glTF (" + one_line(error) + ")");
    return model;
}

}  // namespace

void MemoryAllowance::spend(uint64_t bytes) {
    if (bytes > left_) throw InputError(path_ + ": asks for more memory than its size allows (64 bytes per byte of the file and 256 MiB)");
    left_ -= bytes;
}

void GltfDocument::fail(const std::string& what) const { throw InputError(path + ": " + what); }

std::span<const std::byte> GltfDocument::view(int buffer_view) const {
    const tinygltf::BufferView& view = model.bufferViews[size_t(buffer_view)];
    const GltfBuffer& buffer = buffers[size_t(view.buffer)];
    if (buffer.bytes.empty())
        fail("bufferViews[" + std::to_string(buffer_view) + "] reads buffer " + std::to_string(view.buffer) + " (which has no data)");
    return buffer.bytes.subspan(view.byteOffset, view.byteLength);
}

GltfDocument read_gltf_document(const std::string& path, const LoadOptions& options) {
    constexpr uint64_t kMaxJsonBytes = uint64_t{1} << 31;
    GltfDocument document;
    document.path = path;
    document.memory = std::make_shared<MemoryAllowance>(path);
    const auto file = std::make_shared<const std::vector<std::byte>>(read_file(path));
    document.memory->grant(file->size());
    const GltfContainer container = split_gltf(path, *file);
    if (container.json.size() > kMaxJsonBytes)
        document.fail("JSON of " + std::to_string(container.json.size()) + " bytes (allowed: 2 GiB)");

    const json original = parse_json(path, container.json);
    json checked;
    try {
        checked = checked_gltf(original);
    } catch (const SchemaError& error) {
        document.fail(one_line(error.what()));
    }
    check_extensions(document, checked, options);
    tell_of_animations(document, original, options);
    document.model = parse_model(document, checked);
    Resources resources(document);
    read_buffers(document, checked, resources, file, container.binary);
    check_buffer_views(document);
    read_images(document, checked, resources);
    return document;
}

}  // namespace rawtexel::scenes
