// glTF files made for tests.
#pragma once

#include "scenes/load.h"
#include "tests/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace rawtexel::scenes {

using test::TemporaryFolder;

template <class T>
std::vector<std::byte> bytes_of(const std::vector<T>& values) {
    std::vector<std::byte> bytes(values.size() * sizeof(T));
    if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}
std::vector<std::byte> bytes_of(std::string_view text);

/// glTF component type codes of C++ types.
template <class T>
constexpr int component_type();
template <>
constexpr int component_type<int8_t>() {
    return 5120;
}
template <>
constexpr int component_type<uint8_t>() {
    return 5121;
}
template <>
constexpr int component_type<int16_t>() {
    return 5122;
}
template <>
constexpr int component_type<uint16_t>() {
    return 5123;
}
template <>
constexpr int component_type<uint32_t>() {
    return 5125;
}
template <>
constexpr int component_type<float>() {
    return 5126;
}

/// A document under construction. The JSON is open to any damage a test wants.
struct GltfFixture {
    nlohmann::json json = {{"asset", {{"version", "2.0"}}}};
    std::vector<std::byte> binary;

    /// Appends to an array of the document and returns the new element's index.
    int add(const char* array, nlohmann::json element);
    int add_view(const std::vector<std::byte>& bytes);
    int add_accessor(int view, int component, const char* type, size_t count, bool normalized = false);
    int add_image(const std::vector<std::byte>& bytes, const char* mime_type);

    template <class T>
    int add_values(const char* type, int components, const std::vector<T>& values, bool normalized = false) {
        return add_accessor(add_view(bytes_of(values)), component_type<T>(), type, values.size() / size_t(components), normalized);
    }
    int add_vec2(const std::vector<float>& values) { return add_values("VEC2", 2, values); }
    int add_vec3(const std::vector<float>& values) { return add_values("VEC3", 3, values); }
    int add_vec4(const std::vector<float>& values) { return add_values("VEC4", 4, values); }
    template <class T>
    int add_indices(const std::vector<T>& values) {
        return add_values("SCALAR", 1, values);
    }

    /// A mesh of one primitive on a node of the scene; returns the mesh.
    int show(nlohmann::json primitive);
    int add_node(nlohmann::json node);  ///< a root of the scene

    /// As a binary file. `buffers` is completed by the binary part unless the test has set it.
    std::vector<std::byte> glb() const;
    /// As text, its buffer as a data URI.
    std::string gltf() const;
};

/// A quad of two triangles in the plane z = 0 with normals, both coordinate sets and 16-bit indices.
GltfFixture quad_fixture();
/// Its primitive, to be changed and shown.
nlohmann::json quad_primitive(GltfFixture& fixture);

std::string base64(std::span<const std::byte> bytes);

/// An RGBA image of `width` x `height` distinct pixels as PNG.
std::vector<std::byte> test_png(int width = 4, int height = 4);

/// Loads the fixture from a file in `folder`; warnings go to `warnings` when given.
shading::Scene load_fixture(const TemporaryFolder& folder, const GltfFixture& fixture, std::vector<std::string>* warnings = nullptr);

/// The message of the InputError that loading the fixture throws, which must be one line that begins with the file's name; "" if it loads.
std::string load_error(const TemporaryFolder& folder, const GltfFixture& fixture);
std::string file_error(const std::string& path);

/// That `message` contains `part`; both are shown when it does not.
testing::AssertionResult says(const std::string& message, const std::string& part);

}  // namespace rawtexel::scenes
