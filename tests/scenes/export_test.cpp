// Scenes written as .glb and read back.
#include "scenes/export.h"

#include "scenes/builtin.h"
#include "scenes/image_io.h"
#include "scenes/load.h"
#include "tests/scenes/gltf_fixture.h"

#include "texunit/memory_source.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rawtexel::scenes {
namespace {

using nlohmann::json;
using shading::Scene;
using texunit::Format;
using texunit::Texture;

std::vector<std::byte> file_bytes(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    const auto* data = reinterpret_cast<const std::byte*>(text.data());
    return {data, data + text.size()};
}

json json_chunk(const std::string& path) {
    const std::vector<std::byte> bytes = file_bytes(path);
    uint32_t length;
    std::memcpy(&length, bytes.data() + 12, 4);
    const char* text = reinterpret_cast<const char*>(bytes.data()) + 20;
    return json::parse(text, text + length);
}

/// Exports and loads; fails on any warning.
Scene round_trip(const Scene& scene, const std::string& path) {
    export_glb(scene, path);
    LoadOptions options;
    options.warn = [](const std::string& what) { ADD_FAILURE() << "warned: " << what; };
    return load_gltf(path, options);
}

template <class T>
void expect_same_bits(const std::vector<T>& written, const std::vector<T>& read, const std::string& what) {
    ASSERT_EQ(written.size(), read.size()) << what;
    for (size_t i = 0; i < written.size(); ++i) ASSERT_EQ(0, std::memcmp(&written[i], &read[i], sizeof(T))) << what << " element " << i;
}

void expect_same_mesh(const shading::Mesh& written, const shading::Mesh& read) {
    EXPECT_EQ(written.name, read.name);
    expect_same_bits(written.positions, read.positions, written.name + " positions");
    expect_same_bits(written.normals, read.normals, written.name + " normals");
    expect_same_bits(written.tangents, read.tangents, written.name + " tangents");
    expect_same_bits(written.uv[0], read.uv[0], written.name + " uv 0");
    expect_same_bits(written.uv[1], read.uv[1], written.name + " uv 1");
    expect_same_bits(written.colors, read.colors, written.name + " colors");
    expect_same_bits(written.indices, read.indices, written.name + " indices");
}

void expect_same_texels(const Scene& written, int a, const Scene& read, int b) {
    const shading::SceneTexture &from = written.textures[size_t(a)], &to = read.textures[size_t(b)];
    EXPECT_EQ(from.srgb, to.srgb) << from.image_name;
    const int width = from.texture->shape().width, height = from.texture->shape().height;
    ASSERT_EQ(width, to.texture->shape().width) << from.image_name;
    ASSERT_EQ(height, to.texture->shape().height) << from.image_name;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            ASSERT_EQ(from.texture->texel(0, 0, x, y), to.texture->texel(0, 0, x, y)) << from.image_name << " texel " << x << ", " << y;
}

void expect_same_material(const Scene& written, const shading::Material& a, const Scene& read, const shading::Material& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.base_color, b.base_color) << a.name;
    EXPECT_EQ(a.metallic, b.metallic) << a.name;
    EXPECT_EQ(a.roughness, b.roughness) << a.name;
    EXPECT_EQ(a.normal_scale, b.normal_scale) << a.name;
    EXPECT_EQ(a.occlusion_strength, b.occlusion_strength) << a.name;
    EXPECT_EQ(a.emission, b.emission) << a.name;
    EXPECT_EQ(a.alpha_mode, b.alpha_mode) << a.name;
    EXPECT_EQ(a.alpha_cutoff, b.alpha_cutoff) << a.name;
    EXPECT_EQ(a.double_sided, b.double_sided) << a.name;
    EXPECT_EQ(a.unlit, b.unlit) << a.name;
    const auto expect_same_map = [&](const shading::TextureMap& from, const shading::TextureMap& to, const std::string& what) {
        ASSERT_EQ(from.texture < 0, to.texture < 0) << what;
        if (from.texture < 0) return;
        EXPECT_EQ(from.sampler, to.sampler) << what;
        EXPECT_EQ(from.uv_set, to.uv_set) << what;
        EXPECT_EQ(from.uv_from_vertex, to.uv_from_vertex) << what;
        expect_same_texels(written, from.texture, read, to.texture);
    };
    for (size_t slot = 0; slot < shading::kMapSlots; ++slot)
        expect_same_map(a.maps[slot], b.maps[slot], a.name + " slot " + std::to_string(slot));
    ASSERT_EQ(a.triplanar.has_value(), b.triplanar.has_value()) << a.name;
    if (a.triplanar) {
        EXPECT_EQ(a.triplanar->scale, b.triplanar->scale) << a.name;
        EXPECT_EQ(a.triplanar->sharpness, b.triplanar->sharpness) << a.name;
    }
    ASSERT_EQ(a.layers.has_value(), b.layers.has_value()) << a.name;
    if (!a.layers) return;
    EXPECT_EQ(a.layers->materials, b.layers->materials) << a.name;
    expect_same_map(a.layers->mask, b.layers->mask, a.name + " mask");
}

void expect_same_camera(const shading::Camera& a, const shading::Camera& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.type, b.type) << a.name;
    EXPECT_EQ(a.world_from_camera, b.world_from_camera) << a.name;
    EXPECT_EQ(glm::vec2(a.znear, a.zfar), glm::vec2(b.znear, b.zfar)) << a.name;
    const auto lens = [](const shading::Camera& camera) {
        const bool perspective = camera.type == shading::Camera::Type::Perspective;
        return perspective ? glm::vec2(camera.vertical_fov) : glm::vec2(camera.xmag, camera.ymag);
    };
    EXPECT_EQ(lens(a), lens(b)) << a.name;
}

void expect_same_light(const shading::Light& a, const shading::Light& b) {
    using Type = shading::Light::Type;
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.type, b.type) << a.name;
    EXPECT_EQ(a.color, b.color) << a.name;
    EXPECT_EQ(a.intensity, b.intensity) << a.name;
    EXPECT_EQ(a.position, b.position) << a.name;
    EXPECT_EQ(a.range, b.range) << a.name;
    // What a kind of light has no use for is not stored.
    const auto direction = [](const shading::Light& light) { return light.type == Type::Point ? glm::vec3(0.0f) : light.direction; };
    const auto cone = [](const shading::Light& light) {
        return light.type == Type::Spot ? glm::vec2(light.inner_cone, light.outer_cone) : glm::vec2(0.0f);
    };
    EXPECT_EQ(direction(a), direction(b)) << a.name;
    EXPECT_EQ(cone(a), cone(b)) << a.name;
}

void expect_same_scene(const Scene& written, const Scene& read) {
    ASSERT_EQ(written.instances.size(), read.instances.size());
    std::vector<bool> compared(written.meshes.size());
    for (size_t i = 0; i < written.instances.size(); ++i) {
        const shading::Instance &a = written.instances[i], &b = read.instances[i];
        EXPECT_EQ(a.world_from_object, b.world_from_object) << "instance " << i;
        EXPECT_EQ(written.meshes[a.mesh].material, read.meshes[b.mesh].material) << "instance " << i;
        if (!compared[a.mesh]) expect_same_mesh(written.meshes[a.mesh], read.meshes[b.mesh]);
        compared[a.mesh] = true;
    }
    ASSERT_EQ(written.materials.size(), read.materials.size());
    for (size_t i = 0; i < written.materials.size(); ++i) expect_same_material(written, written.materials[i], read, read.materials[i]);
    ASSERT_EQ(written.cameras.size(), read.cameras.size());
    for (size_t i = 0; i < written.cameras.size(); ++i) expect_same_camera(written.cameras[i], read.cameras[i]);
    ASSERT_EQ(written.lights.size(), read.lights.size());
    for (size_t i = 0; i < written.lights.size(); ++i) expect_same_light(written.lights[i], read.lights[i]);
    EXPECT_EQ(written.environment, read.environment);
}

std::shared_ptr<Texture> memory_texture(Format format, int width, int height, const std::vector<std::byte>& texels) {
    return std::make_shared<Texture>("generated", texunit::make_memory_source(format, width, height, texels));
}

std::vector<std::byte> random_bytes(size_t count, uint32_t state) {
    std::vector<std::byte> bytes;
    for (size_t i = 0; i < count; ++i) {
        state = state * 1664525u + 1013904223u;
        bytes.push_back(std::byte(state >> 24));
    }
    return bytes;
}

/// A corner of the texture, so that large images need not be encoded to see whether the rest of a scene survives.
shading::SceneTexture corner_of(const shading::SceneTexture& source) {
    const int width = std::min(16, source.texture->shape().width), height = std::min(16, source.texture->shape().height);
    std::vector<std::byte> codes;
    for (int i = 0; i < width * height; ++i)
        for (const float value : source.texture->texel(0, 0, i % width, i / width)) codes.push_back(std::byte(std::lround(value * 255.0f)));
    shading::SceneTexture corner = source;
    corner.texture = memory_texture(source.srgb ? Format::RGBA8Srgb : Format::RGBA8Unorm, width, height, codes);
    return corner;
}

/// One triangle with one map in `slot`.
Scene textured_triangle(shading::SceneTexture texture, shading::MapSlot slot) {
    Scene scene;
    shading::Mesh mesh;
    mesh.name = "triangle";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.uv[0] = {{0, 1}, {1, 1}, {0, 0}};
    mesh.indices = {0, 1, 2};
    scene.meshes.push_back(std::move(mesh));
    scene.instances.emplace_back();
    shading::Material material;
    material.name = "material";
    material.maps[slot].texture = 0;
    scene.materials.push_back(std::move(material));
    scene.textures.push_back(std::move(texture));
    return scene;
}

std::string refusal(const Scene& scene, const std::string& path) {
    try {
        export_glb(scene, path);
    } catch (const OutputError& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        EXPECT_EQ(std::string(error.what()).rfind(path, 0), 0u) << error.what();
        return error.what();
    }
    ADD_FAILURE() << "was written";
    return {};
}

class BuiltinRoundTrip : public testing::TestWithParam<size_t> {};

TEST_P(BuiltinRoundTrip, KeepsEveryBitButTheTextures) {
    const TemporaryFolder folder;
    Scene scene = builtin_scenes()[GetParam()].make({});
    for (shading::SceneTexture& texture : scene.textures) texture = corner_of(texture);
    expect_same_scene(scene, round_trip(scene, folder / "scene.glb"));
}

INSTANTIATE_TEST_SUITE_P(Scenes, BuiltinRoundTrip, testing::Range(size_t{0}, builtin_scenes().size()), [](const auto& tested) {
    std::string name(builtin_scenes()[tested.param].name);
    std::erase(name, '-');
    return name;
});

TEST(Export, KeepsEveryTexelOfGeneratedTextures) {
    const TemporaryFolder folder;
    for (const BuiltinScene& builtin : builtin_scenes()) {
        if (builtin.name != "magnify" && builtin.name != "metal-edge") continue;
        const Scene scene = builtin.make({});
        expect_same_scene(scene, round_trip(scene, folder / "scene.glb"));
    }
}

TEST(Export, KeepsEveryLightCameraAndFactor) {
    const TemporaryFolder folder;
    Scene scene = textured_triangle({memory_texture(Format::RGBA8Srgb, 1, 1, random_bytes(4, 1)), "texel", "image/png", true, nullptr},
                                    shading::kEmissive);
    shading::Material& material = scene.materials[0];
    material.base_color = {0.1f, 0.7f, 1.0f / 3.0f, 0.9f};
    material.metallic = 0.3f;
    material.roughness = 0.7f;
    material.emission = {11.7f, 0.03f, 1.0f / 7.0f};
    material.alpha_mode = shading::AlphaMode::Mask;
    material.alpha_cutoff = 0.37f;
    material.double_sided = true;
    material.maps[shading::kEmissive].uv_from_vertex = {0.3f, 0.0f, 0.0f, -1.7f, 0.1f, 12.3f};
    scene.materials.push_back(material);
    scene.materials[1].name = "blend";
    scene.materials[1].alpha_mode = shading::AlphaMode::Blend;
    scene.materials[1].alpha_cutoff = 0.5f;
    scene.materials[1].emission = glm::vec3(0.9f);
    scene.materials[1].unlit = true;
    scene.instances[0].world_from_object = {1.1f, 0, 0, 0, 0, -0.7f, 0.2f, 0, 0, 0.1f, 0.3f, 0, 1.0f / 3.0f, -9, 4, 1};

    shading::Light light;
    light.name = "spot";
    light.type = shading::Light::Type::Spot;
    light.color = {0.9f, 0.2f, 0.1f};
    light.intensity = 1234.5f;
    light.position = {0.1f, 0.2f, 0.3f};
    light.direction = {0.0f, -1.0f, 0.0f};
    light.range = 7.7f;
    light.inner_cone = 0.11f;
    light.outer_cone = 0.77f;
    scene.lights.push_back(light);
    light.type = shading::Light::Type::Point;
    light.inner_cone = 0.0f;
    light.outer_cone = shading::Light{}.outer_cone;
    scene.lights.push_back(light);

    shading::Camera camera;
    camera.name = "orthographic";
    camera.type = shading::Camera::Type::Orthographic;
    camera.xmag = 1.7f;
    camera.ymag = 0.3f;
    camera.zfar = 99.0f;
    camera.world_from_camera[3] = {1, 2, 3, 1};
    scene.cameras.push_back(camera);
    camera.type = shading::Camera::Type::Perspective;
    camera.name = "perspective";
    camera.vertical_fov = 0.123f;
    scene.cameras.push_back(camera);
    camera.zfar = 0.0f;
    scene.cameras.push_back(camera);
    scene.environment = shading::EnvironmentRequest::None;
    expect_same_scene(scene, round_trip(scene, folder / "scene.glb"));
    scene.environment = shading::EnvironmentRequest::Unspecified;
    expect_same_scene(scene, round_trip(scene, folder / "scene.glb"));
}

TEST(Export, KeepsEverySampler) {
    using namespace texunit;
    const TemporaryFolder folder;
    const shading::SceneTexture texture{memory_texture(Format::RGBA8Srgb, 2, 2, random_bytes(16, 2)), "texels", "image/png", true, nullptr};
    Scene scene = textured_triangle(texture, shading::kBaseColor);
    const shading::Material first = scene.materials[0];
    scene.materials.clear();
    for (const Wrap wrap : {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge})
        for (const Kernel magnify : {Kernel::Nearest, Kernel::Bilinear})
            for (const Kernel minify : {Kernel::Nearest, Kernel::Bilinear})
                for (const MipMode mip : {MipMode::None, MipMode::Nearest, MipMode::Linear}) {
                    scene.materials.push_back(first);
                    scene.materials.back().maps[shading::kBaseColor].sampler = {wrap, Wrap::Repeat, magnify, minify, mip};
                }
    const std::string path = folder / "scene.glb";
    expect_same_scene(scene, round_trip(scene, path));
    EXPECT_EQ(json_chunk(path)["images"].size(), 1u) << "one image serves all samplers";
}

TEST(Export, TurnsTextureTransformsIntoOffsetRotationScale) {
    const TemporaryFolder folder;
    const shading::SceneTexture texture{memory_texture(Format::RGBA8Srgb, 2, 2, random_bytes(16, 3)), "texels", "image/png", true, nullptr};
    Scene scene = textured_triangle(texture, shading::kBaseColor);
    glm::mat3x2& transform = scene.materials[0].maps[shading::kBaseColor].uv_from_vertex;
    for (int turn = 0; turn < 12; ++turn) {
        const float c = std::cos(0.55f * float(turn)), s = std::sin(0.55f * float(turn)), sx = 0.7f, sy = turn % 2 ? 2.5f : -1.5f;
        transform = {c * sx, -s * sx, s * sy, c * sy, 0.25f, -3.0f};
        const Scene read = round_trip(scene, folder / "scene.glb");
        const glm::mat3x2& back = read.materials[0].maps[shading::kBaseColor].uv_from_vertex;
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 2; ++row)
                EXPECT_NEAR(transform[column][row], back[column][row], 1e-6f) << "turn " << turn << " column " << column << " row " << row;
    }
    transform = {1.0f, 0.0f, 0.5f, 1.0f, 0.0f, 0.0f};
    EXPECT_NE(refusal(scene, folder / "skewed.glb").find("skewed texture transform"), std::string::npos);
}

TEST(Export, KeepsSixteenBitData) {
    const TemporaryFolder folder;
    const auto texels = random_bytes(5 * 3 * 8, 4);
    const Scene scene = textured_triangle({memory_texture(Format::RGBA16Unorm, 5, 3, texels), "heights", "image/png", false, nullptr},
                                          shading::kMetallicRoughness);
    expect_same_scene(scene, round_trip(scene, folder / "scene.glb"));
}

TEST(Export, KeepsTheBytesOfImagesThatCameFromFiles) {
    const TemporaryFolder folder;
    std::vector<std::byte> bytes = encode_png(3, 2, 3, 8, random_bytes(18, 5));
    bytes.push_back(std::byte{42});  // what a decoder ignores must stay too
    const EncodedBytes png = texunit::open_memory("photo", bytes);
    Scene scene = textured_triangle({nullptr, "photo", "image/png", true, png}, shading::kBaseColor);
    scene.textures[0].texture = std::make_shared<Texture>("photo", open_image(png, true));
    const Scene read = round_trip(scene, folder / "scene.glb");
    ASSERT_EQ(read.textures.size(), 1u);
    EXPECT_EQ(all_bytes(*read.textures[0].encoded), bytes);
    EXPECT_EQ(read.textures[0].mime_type, "image/png");
    expect_same_scene(scene, read);
}

TEST(Export, StoresAnImageOnceForColourAndData) {
    const TemporaryFolder folder;
    const EncodedBytes png = texunit::open_memory("both", encode_png(3, 2, 3, 8, random_bytes(18, 6)));
    Scene scene = textured_triangle({nullptr, "both", "image/png", true, png}, shading::kBaseColor);
    scene.textures[0].texture = std::make_shared<Texture>("both", open_image(png, true));
    scene.textures.push_back({std::make_shared<Texture>("both", open_image(png, false)), "both", "image/png", false, png});
    scene.materials[0].maps[shading::kMetallicRoughness].texture = 1;
    const std::string path = folder / "scene.glb";
    expect_same_scene(scene, round_trip(scene, path));
    EXPECT_EQ(json_chunk(path)["images"].size(), 1u);
}

/// A DDS file of one BC1 block.
std::vector<std::byte> dds_bc1() {
    std::vector<uint32_t> words(32 + 2);
    words[0] = 0x20534444;                          // "DDS "
    words[1] = 124;                                 // header size
    words[2] = 0x1 | 0x2 | 0x4 | 0x1000 | 0x80000;  // caps, height, width, pixel format, linear size
    words[3] = words[4] = 4;
    words[5] = 8;
    words[19] = 32;          // pixel format size
    words[20] = 0x4;         // four-character code
    words[21] = 0x31545844;  // "DXT1"
    words[27] = 0x1000;      // texture
    words[32] = 0x07E0F800;
    words[33] = 0x1B1B1B1B;
    std::vector<std::byte> bytes(words.size() * 4);
    std::memcpy(bytes.data(), words.data(), bytes.size());
    return bytes;
}

TEST(Export, EmbedsBlockCompressedFilesAsTheyCame) {
    const TemporaryFolder folder;
    const EncodedBytes dds = texunit::open_memory("blocks", dds_bc1());
    Scene scene = textured_triangle({nullptr, "blocks", "image/vnd-ms.dds", true, dds}, shading::kBaseColor);
    scene.textures[0].texture = memory_texture(Format::RGBA8Srgb, 4, 4, random_bytes(64, 7));
    const std::string path = folder / "scene.glb";
    const Scene read = round_trip(scene, path);
    ASSERT_EQ(read.textures.size(), 1u);
    EXPECT_EQ(all_bytes(*read.textures[0].encoded), dds_bc1());
    EXPECT_EQ(texunit::info(read.textures[0].texture->format()).block_compressed, true);
    EXPECT_EQ(json_chunk(path)["extensionsRequired"], json::array({"MSFT_texture_dds"}));
    // And once more, from what was read.
    const Scene again = round_trip(read, folder / "again.glb");
    expect_same_scene(read, again);
    EXPECT_EQ(all_bytes(*again.textures[0].encoded), dds_bc1());
}

TEST(Export, RefusesWhatAPngCannotHold) {
    const TemporaryFolder folder;
    const std::string path = folder / "scene.glb";
    const auto refused = [&](Format format, bool srgb, shading::MapSlot slot) {
        const auto texels = random_bytes(texunit::stored_bytes(format, 4, 4), 8);
        return refusal(textured_triangle({memory_texture(format, 4, 4, texels), "odd one", "", srgb, nullptr}, slot), path);
    };
    for (const Format format : {Format::RGBA32Float, Format::RGBA16Half, Format::RGBA8Snorm})
        EXPECT_NE(refused(format, false, shading::kNormal).find("\"odd one\" cannot be stored"), std::string::npos);
    EXPECT_NE(refused(Format::RGBA16Unorm, true, shading::kBaseColor).find("\"odd one\" cannot be stored"), std::string::npos);
    EXPECT_NE(refused(Format::RGBA8Unorm, false, shading::kBaseColor).find("linear but used as colour"), std::string::npos);
    EXPECT_NE(refused(Format::RGBA8Srgb, true, shading::kNormal).find("sRGB-encoded but used as data"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(Export, StoresEqualMeshesOnce) {
    const TemporaryFolder folder;
    Scene scene = textured_triangle({memory_texture(Format::RGBA8Srgb, 1, 1, random_bytes(4, 9)), "texel", "image/png", true, nullptr},
                                    shading::kBaseColor);
    scene.meshes.push_back(scene.meshes[0]);
    scene.materials.push_back(scene.materials[0]);
    scene.meshes[1].material = 1;
    scene.instances.push_back({1, glm::mat4(1.0f)});
    const std::string path = folder / "scene.glb";
    expect_same_scene(scene, round_trip(scene, path));
    EXPECT_EQ(json_chunk(path)["accessors"].size(), 4u);  // positions, normals, uv, indices
}

TEST(Export, WritesAWellFormedFile) {
    const TemporaryFolder folder;
    const std::string path = folder / "scene.glb";
    export_glb(textured_triangle({memory_texture(Format::RGBA8Srgb, 1, 1, random_bytes(4, 10)), "texel", "image/png", true, nullptr},
                                 shading::kBaseColor),
               path);
    const std::vector<std::byte> bytes = file_bytes(path);
    uint32_t header[5];
    std::memcpy(header, bytes.data(), sizeof header);
    EXPECT_EQ(header[0], 0x46546C67u);
    EXPECT_EQ(header[1], 2u);
    EXPECT_EQ(header[2], bytes.size());
    EXPECT_EQ(header[3] % 4, 0u);
    uint32_t binary[2];
    std::memcpy(binary, bytes.data() + 20 + header[3], sizeof binary);
    EXPECT_EQ(binary[1], 0x004E4942u);
    EXPECT_EQ(20 + header[3] + 8 + binary[0], bytes.size());
    const json document = json_chunk(path);
    EXPECT_LE(document["buffers"][0]["byteLength"].get<size_t>(), binary[0]);
    for (const json& view : document["bufferViews"]) {
        EXPECT_EQ(view["byteOffset"].get<size_t>() % 4, 0u);
        EXPECT_LE(view["byteOffset"].get<size_t>() + view["byteLength"].get<size_t>(), document["buffers"][0]["byteLength"].get<size_t>());
    }
    const json positions = document["accessors"][document["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<size_t>()];
    EXPECT_EQ(positions["min"], json::array({0.0, 0.0, 0.0}));
    EXPECT_EQ(positions["max"], json::array({1.0, 1.0, 0.0}));
}

TEST(Export, LeavesOutMeshesWithoutTriangles) {
    const TemporaryFolder folder;
    Scene scene = textured_triangle({memory_texture(Format::RGBA8Srgb, 1, 1, random_bytes(4, 11)), "texel", "image/png", true, nullptr},
                                    shading::kBaseColor);
    scene.meshes.emplace(scene.meshes.begin())->name = "empty";
    scene.instances = {{0, glm::mat4(1.0f)}, {1, glm::mat4(1.0f)}};
    const Scene read = round_trip(scene, folder / "scene.glb");
    ASSERT_EQ(read.instances.size(), 1u);
    EXPECT_EQ(read.meshes[read.instances[0].mesh].name, "triangle");
    export_glb(Scene{}, folder / "nothing.glb");
    EXPECT_EQ(load_gltf(folder / "nothing.glb").instances.size(), 0u);
}

TEST(Export, RefusesFoldersThatCannotBeWritten) {
    const TemporaryFolder folder;
    refusal(Scene{}, folder / "missing/scene.glb");
    refusal(Scene{}, folder / "");
    refusal(Scene{}, "/proc/rawtexel.glb");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "something was left behind";
}

}  // namespace
}  // namespace rawtexel::scenes
