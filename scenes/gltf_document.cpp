#include "scenes/gltf_document.h"

#include "scenes/gltf_container.h"
#include "scenes/gltf_schema.h"
#include "scenes/gltf_uri.h"
#include "scenes/message_text.h"
#include "scenes/utf8.h"

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

[[noreturn]] void fail_json(const std::string& path, const std::string& what) {
    throw InputError(path + ": not valid JSON (" + what + ")");
}

/// What stands at byte `number` of a text, counted from 1, where it may not.
std::string misplaced(std::string_view text, size_t number) {
    const std::string byte = "byte " + std::to_string(number) + ": ";
    if (number == 0 || number > text.size()) return byte + "the text ends too early";
    const std::string character = one_line(text.substr(number - 1, utf8_character(text, number - 1)));
    return byte + (character.empty() ? "a control character" : "'" + character + "'") + " is out of place";
}

json parse_json(const std::string& path, std::string_view text) {
    if (nesting(text) > kMaxNesting) throw InputError(path + ": JSON nested deeper than " + std::to_string(kMaxNesting) + " levels");
    if (const size_t invalid = find_invalid_utf8(text); invalid != text.npos)
        fail_json(path, "byte " + std::to_string(invalid + 1) + ": not UTF-8");
    try {
        return json::parse(text.begin(), text.end());
    } catch (const json::parse_error& error) {
        fail_json(path, misplaced(text, error.byte));
    } catch (const json::exception&) {
        fail_json(path, "a number is too large");
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
    if (animations == original.end() || animations->empty()) return;
    options.warn(document.path + (options.camera_animations ? ": animations move nothing but the camera" : ": animations are left out"));
}

SharedBytes read_all(const texunit::ByteSource& source) { return std::make_shared<const std::vector<std::byte>>(all_bytes(source)); }

/// What messages call the owner of a URI, such as "buffers[0] 'scene.bin'".
std::string owner_of(const std::string& what, const std::string& uri) { return what + " '" + shortened(uri) + "'"; }

/// Opens what URIs name, and reads it where it is asked for, each file once.
class Resources {
  public:
    Resources(GltfDocument& document, const LoadOptions& options) : document_(document), options_(options) {}

    /// `what` holds the URI, such as "buffers[0]". Sets `mime_type` where the URI tells it.
    EncodedBytes open(const std::string& uri, const std::string& what, std::string& mime_type) {
        const std::string owner = owner_of(what, uri);
        if (is_data_uri(uri)) {
            auto data = decode_data_uri(uri);
            if (!data) document_.fail(owner + " is a malformed data URI");
            if (mime_type.empty()) mime_type = data->mime_type;
            return texunit::open_memory(document_.path + ": " + owner, std::move(data->bytes));
        }
        if (uri.empty()) document_.fail(what + " has an empty URI");
        if (percent_decoded(uri).find('\0') != std::string::npos) document_.fail(owner + " holds a zero byte");
        if (leaves_the_folder_tree(uri)) document_.fail(what + " refers to " + shortened(uri) + " (allowed: relative paths and data URIs)");
        return open_relative(uri, owner);
    }

    SharedBytes contents(const EncodedBytes& source) {
        auto [entry, is_new] = contents_.try_emplace(source);
        if (is_new) entry->second = read_all(*source);
        return entry->second;
    }

  private:
    EncodedBytes open_relative(const std::string& uri, const std::string& owner) {
        auto [entry, is_new] = files_.try_emplace(uri);
        if (!is_new) return entry->second;
        const std::filesystem::path folder = std::filesystem::path(document_.path).parent_path();
        std::filesystem::path file = folder / percent_decoded(uri);
        // Exporters that do not escape write the file's name as it is.
        std::error_code ignored;
        if (!std::filesystem::exists(file, ignored) && std::filesystem::exists(folder / uri, ignored)) file = folder / uri;
        entry->second = bytes_of_file(document_.path + ": " + owner, file.string());
        document_.memory->grant(entry->second->size());
        options_.opened(file.string());
        return entry->second;
    }

    GltfDocument& document_;
    const LoadOptions& options_;
    std::map<std::string, EncodedBytes> files_;
    std::map<EncodedBytes, SharedBytes> contents_;
};

/// A glTF or GLB file itself.
struct MainFile {
    EncodedBytes source;
    SharedBytes bytes;
};

void read_buffers(GltfDocument& document, const json& checked, Resources& resources, const MainFile& file,
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
            buffer.source = resources.open(uri, what, mime_type);
            const SharedBytes bytes = resources.contents(buffer.source);
            if (!is_data_uri(uri)) what = owner_of(what, uri);
            buffer.owner = bytes;
            buffer.bytes = *bytes;
        } else if (i == 0 && binary) {
            buffer.owner = file.bytes;
            buffer.bytes = *binary;
            buffer.source = file.source;
            buffer.source_offset = uint64_t(binary->data() - file.bytes->data());
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

/// The bytes of a buffer view, where the buffer has them from.
EncodedBytes view_of(const GltfDocument& document, int index, std::string name) {
    const std::span<const std::byte> bytes = document.view(index);
    const tinygltf::BufferView& view = document.model.bufferViews[size_t(index)];
    const GltfBuffer& buffer = document.buffers[size_t(view.buffer)];
    return part_of(std::move(name), buffer.source, buffer.source_offset + view.byteOffset, bytes.size());
}

void open_images(GltfDocument& document, const json& checked, Resources& resources) {
    std::map<int, EncodedBytes> from_views;
    const json none = json::array();
    const json& images = checked.contains("images") ? checked["images"] : none;
    for (size_t i = 0; i < images.size(); ++i) {
        const json& image = images[i];
        const std::string what = "images[" + std::to_string(i) + "]";
        GltfImage result{image_name(image, i), image.value("mimeType", std::string()), {}, nullptr};
        if (image.contains("uri") == image.contains("bufferView")) document.fail(what + " needs either a uri or a bufferView");
        if (image.contains("uri")) {
            const std::string uri = image["uri"].get<std::string>();
            result.encoded = resources.open(uri, what, result.mime_type);
            if (!is_data_uri(uri)) result.file_name = percent_decoded(uri);
        } else {
            const int view = image["bufferView"].get<int>();
            EncodedBytes& bytes = from_views[view];
            if (!bytes) bytes = view_of(document, view, document.path + ": " + what);
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
    const EncodedBytes source = bytes_of_file(path, path);
    const MainFile file{source, read_all(*source)};
    document.memory->grant(file.bytes->size());
    options.opened(path);
    const GltfContainer container = split_gltf(path, *file.bytes);
    if (container.json.size() > kMaxJsonBytes)
        document.fail("JSON of " + std::to_string(container.json.size()) + " bytes (allowed: 2 GiB)");

    const json original = parse_json(path, container.json);
    json checked;
    try {
        checked = checked_gltf(original, {.animations = options.camera_animations});
    } catch (const SchemaError& error) {
        document.fail(one_line(error.what()));
    }
    check_extensions(document, checked, options);
    tell_of_animations(document, original, options);
    document.model = parse_model(document, checked);
    Resources resources(document, options);
    read_buffers(document, checked, resources, file, container.binary);
    check_buffer_views(document);
    open_images(document, checked, resources);
    return document;
}

}  // namespace rawtexel::scenes
