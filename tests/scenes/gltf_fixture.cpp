#include "tests/scenes/gltf_fixture.h"

#include "scenes/image_io.h"

#include <algorithm>

namespace rawtexel::scenes {
namespace {

void append_32(std::vector<std::byte>& bytes, size_t value) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(std::byte(value >> shift & 0xff));
}

void append_chunk(std::vector<std::byte>& file, size_t type, std::vector<std::byte> bytes, std::byte padding) {
    while (bytes.size() % 4 != 0) bytes.push_back(padding);
    append_32(file, bytes.size());
    append_32(file, type);
    file.insert(file.end(), bytes.begin(), bytes.end());
}

}  // namespace

std::vector<std::byte> bytes_of(std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

int GltfFixture::add(const char* array, nlohmann::json element) {
    json[array].push_back(std::move(element));
    return int(json[array].size()) - 1;
}

int GltfFixture::add_view(const std::vector<std::byte>& bytes) {
    while (binary.size() % 4 != 0) binary.push_back(std::byte{0});
    const size_t offset = binary.size();
    binary.insert(binary.end(), bytes.begin(), bytes.end());
    return add("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}});
}

int GltfFixture::add_accessor(int view, int component, const char* type, size_t count, bool normalized) {
    nlohmann::json accessor = {{"bufferView", view}, {"componentType", component}, {"type", type}, {"count", count}};
    if (normalized) accessor["normalized"] = true;
    return add("accessors", accessor);
}

int GltfFixture::add_image(const std::vector<std::byte>& bytes, const char* mime_type) {
    return add("images", {{"bufferView", add_view(bytes)}, {"mimeType", mime_type}});
}

int GltfFixture::show(nlohmann::json primitive) {
    const int mesh = add("meshes", {{"primitives", nlohmann::json::array({std::move(primitive)})}});
    add_node({{"mesh", mesh}});
    return mesh;
}

int GltfFixture::add_node(nlohmann::json node) {
    const int index = add("nodes", std::move(node));
    if (!json.contains("scenes")) json["scenes"] = nlohmann::json::array({nlohmann::json::object()});
    json["scenes"][0]["nodes"].push_back(index);
    return index;
}

std::vector<std::byte> GltfFixture::glb() const {
    nlohmann::json complete = json;
    if (!complete.contains("buffers") && !binary.empty()) complete["buffers"] = {{{"byteLength", binary.size()}}};
    std::vector<std::byte> chunks, file;
    append_chunk(chunks, 0x4e4f534a, bytes_of(complete.dump()), std::byte{' '});
    if (!binary.empty()) append_chunk(chunks, 0x004e4942, binary, std::byte{0});
    append_32(file, 0x46546c67);
    append_32(file, 2);
    append_32(file, chunks.size() + 12);
    file.insert(file.end(), chunks.begin(), chunks.end());
    return file;
}

std::string GltfFixture::gltf() const {
    nlohmann::json complete = json;
    if (!complete.contains("buffers") && !binary.empty())
        complete["buffers"] = {{{"byteLength", binary.size()}, {"uri", "data:application/octet-stream;base64," + base64(binary)}}};
    return complete.dump();
}

nlohmann::json quad_primitive(GltfFixture& fixture) {
    const int positions = fixture.add_vec3({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    const int normals = fixture.add_vec3({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    const int uv0 = fixture.add_vec2({0, 1, 1, 1, 1, 0, 0, 0});
    const int uv1 = fixture.add_vec2({0, 0.5f, 0.5f, 0.5f, 0.5f, 0, 0, 0});
    const int indices = fixture.add_indices<uint16_t>({0, 1, 2, 0, 2, 3});
    return {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uv0}, {"TEXCOORD_1", uv1}}}, {"indices", indices}};
}

GltfFixture quad_fixture() {
    GltfFixture fixture;
    fixture.show(quad_primitive(fixture));
    return fixture;
}

std::string base64(std::span<const std::byte> bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t bits = 0;
        const size_t held = std::min<size_t>(3, bytes.size() - i);
        for (size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < held ? uint32_t(bytes[i + k]) : 0);
        for (size_t k = 0; k < 4; ++k) text += k <= held ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::vector<std::byte> test_png(int width, int height) {
    std::vector<std::byte> pixels;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (const int value : {x * 16 + 1, y * 16 + 2, x * y + 3, 255 - x}) pixels.push_back(std::byte(value & 0xff));
    return encode_png(width, height, 4, 8, pixels);
}

shading::Scene load_fixture(const TemporaryFolder& folder, const GltfFixture& fixture, std::vector<std::string>* warnings) {
    LoadOptions options;
    if (warnings) options.warn = [warnings](const std::string& text) { warnings->push_back(text); };
    return load_gltf(folder.write("scene.glb", fixture.glb()), options);
}

std::string file_error(const std::string& path) {
    try {
        load_gltf(path);
        return "";
    } catch (const InputError& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.find('\n'), message.npos) << message;
        return message;
    }
}

testing::AssertionResult says(const std::string& message, const std::string& part) {
    if (message.find(part) != message.npos) return testing::AssertionSuccess();
    return testing::AssertionFailure() << '"' << message << "\" does not say \"" << part << '"';
}

std::string load_error(const TemporaryFolder& folder, const GltfFixture& fixture) {
    const std::string path = folder.write("scene.glb", fixture.glb());
    const std::string message = file_error(path);
    if (!message.empty()) {
        EXPECT_EQ(message.find(path), 0u) << message;
    }
    return message;
}

}  // namespace rawtexel::scenes
