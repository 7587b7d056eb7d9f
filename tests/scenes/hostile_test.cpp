// Damaged files: cut off anywhere, changed anywhere. They load or they are one clear error; nothing else may happen.
#include "tests/scenes/gltf_fixture.h"
#include "tests/stress/worst_case.h"
#include "tests/stress_scale.h"

#include "texunit/texel_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

namespace rawtexel::scenes {
namespace {

/// A small file with a bit of everything: two primitives, sparse and normalised accessors, a skin, targets, a light, a camera, an image.
GltfFixture rich_fixture() {
    GltfFixture fixture;
    fixture.add("textures", {{"source", fixture.add_image(test_png(), "image/png")}, {"sampler", 0}});
    fixture.add("samplers", {{"wrapS", 33071}, {"minFilter", 9987}});
    fixture.add("materials", {{"normalTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {2, 2}}}}}}}},
                              {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}}}});
    nlohmann::json primitive = quad_primitive(fixture);
    primitive["material"] = 0;
    primitive["attributes"]["COLOR_0"] = fixture.add_values<uint8_t>("VEC4", 4, std::vector<uint8_t>(16, 200), true);
    primitive["attributes"]["JOINTS_0"] = fixture.add_values<uint8_t>("VEC4", 4, std::vector<uint8_t>(16, 0));
    primitive["attributes"]["WEIGHTS_0"] = fixture.add_vec4(std::vector<float>(16, 0.25f));
    const int sparse = fixture.add("accessors", {{"componentType", 5126}, {"type", "VEC3"}, {"count", 4}});
    const int sparse_indices = fixture.add_view(bytes_of(std::vector<uint16_t>{0, 2})),
              sparse_values = fixture.add_view(bytes_of(std::vector<float>(6, 1.0f)));
    fixture.json["accessors"][sparse]["sparse"] = {
        {"count", 2}, {"indices", {{"bufferView", sparse_indices}, {"componentType", 5123}}}, {"values", {{"bufferView", sparse_values}}}};
    primitive["targets"] = {{{"POSITION", sparse}}};
    fixture.show(primitive);
    fixture.json["meshes"][0]["weights"] = {0.5};
    fixture.add_node({{"translation", {0, 1, 0}}, {"children", {2}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    fixture.add("nodes", {{"camera", 0}, {"rotation", {0, 0, 0, 1}}, {"scale", {1, 1, 1}}});
    fixture.add("skins", {{"joints", {1, 2}}});
    fixture.json["nodes"][0]["skin"] = 0;
    fixture.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"spot", {{"outerConeAngle", 0.5}}}}};
    fixture.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
    primitive.erase("targets");
    primitive["mode"] = 5;
    fixture.show(primitive);
    return fixture;
}

/// Loads a file and samples its textures. True when it loaded; an error must be one line that names the file.
bool survives(const std::string& path) {
    try {
        const shading::Scene scene = load_gltf(path);
        for (const shading::Mesh& mesh : scene.meshes) {
            for (const uint32_t index : mesh.indices) EXPECT_LT(index, mesh.positions.size());
            for (const size_t length :
                 {mesh.normals.size(), mesh.tangents.size(), mesh.uv[0].size(), mesh.uv[1].size(), mesh.colors.size()})
                EXPECT_TRUE(length == 0 || length == mesh.positions.size());
            EXPECT_LT(mesh.material, scene.materials.size());
        }
        for (const shading::SceneTexture& texture : scene.textures) {
            try {
                texture.texture->texel(0, 0, 0, 0);
            } catch (const texunit::TextureError& error) {
                EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << error.what();
            }
        }
        return true;
    } catch (const InputError& error) {
        EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << error.what();
        return false;
    }
}

/// Damage of one kind or another, a few bytes of it.
std::vector<std::byte> mutated(std::vector<std::byte> file, std::mt19937& random) {
    const auto below = [&](size_t n) { return size_t(random() % n); };
    static constexpr std::string_view kTokens[] = {
        "0", "-1", "1e999", "4294967296", "9007199254740993", "null", "\"\"", "[]", "{}", "true", "[[", "1e38", ",", "}"};
    for (size_t edits = 1 + below(4); edits > 0 && file.size() > 1; --edits) {
        const size_t at = below(file.size());
        switch (below(6)) {
            case 0: file[at] = std::byte(random() & 0xff); break;
            case 1: file[at] ^= std::byte(1u << below(8)); break;
            case 2: file[at] = file[below(file.size())]; break;
            case 3:
                file.erase(file.begin() + std::ptrdiff_t(at), file.begin() + std::ptrdiff_t(std::min(file.size(), at + 1 + below(8))));
                break;
            case 4: file.insert(file.begin() + std::ptrdiff_t(at), 1 + below(8), std::byte(random() & 0xff)); break;
            default: {
                const auto token = bytes_of(kTokens[below(std::size(kTokens))]);
                std::copy_n(token.begin(), std::min(token.size(), file.size() - at), file.begin() + std::ptrdiff_t(at));
            }
        }
    }
    return file;
}

/// Replaces a number somewhere in the JSON of a fixture by another, keeping the file well formed so that the deeper checks are reached.
nlohmann::json with_other_number(nlohmann::json document, std::mt19937& random) {
    std::vector<nlohmann::json*> numbers, open = {&document};
    while (!open.empty()) {
        nlohmann::json* value = open.back();
        open.pop_back();
        if (value->is_number()) numbers.push_back(value);
        if (value->is_structured())
            for (nlohmann::json& element : *value) open.push_back(&element);
    }
    static const nlohmann::json kNumbers[] = {
        0,    1,    2,          3,   5,    7,   16,    -1,   255, 256, 65535,       5121,       5123,
        5125, 5126, 2147483647, 1e9, 1e38, 0.5, -1e30, 1e12, 6,   100, 4294967295u, 4294967296, 9007199254740991};
    *numbers[random() % numbers.size()] = kNumbers[random() % std::size(kNumbers)];
    return document;
}

TEST(Hostile, TheUndamagedFileLoads) {
    TemporaryFolder folder;
    EXPECT_EQ(load_error(folder, rich_fixture()), "");
}

TEST(Hostile, FilesCutOffAnywhereAreRefused) {
    TemporaryFolder folder;
    const std::vector<std::byte> file = rich_fixture().glb();
    for (size_t length = 0; length < file.size(); length += 7)
        EXPECT_FALSE(survives(folder.write("cut.glb", std::span(file).first(length)))) << length << " of " << file.size();
}

TEST(Hostile, TextCutOffAnywhereIsRefused) {
    TemporaryFolder folder;
    const std::string text = rich_fixture().gltf();
    for (size_t length = 0; length < text.size(); length += 23)
        EXPECT_FALSE(survives(folder.write("cut.gltf", std::string_view(text).substr(0, length)))) << length << " of " << text.size();
}

TEST(Hostile, FilesWithChangedBytesLoadOrAreRefused) {
    TemporaryFolder folder;
    const std::vector<std::byte> file = rich_fixture().glb();
    std::mt19937 random(1);
    int loaded = 0;
    const int files = 2500 * stress_scale();
    for (int i = 0; i < files; ++i) loaded += survives(folder.write("changed.glb", mutated(file, random)));
    tell_tested(uint64_t(files), "files");
    EXPECT_GT(loaded, files / 100);
    EXPECT_LT(loaded, files);
}

TEST(Hostile, FilesWithChangedNumbersLoadOrAreRefused) {
    TemporaryFolder folder;
    GltfFixture fixture = rich_fixture();
    const nlohmann::json good = fixture.json;
    std::mt19937 random(2);
    int loaded = 0;
    const int files = 2500 * stress_scale();
    for (int i = 0; i < files; ++i) {
        fixture.json = good;
        for (int edits = 1 + int(random() % 2); edits > 0; --edits) fixture.json = with_other_number(fixture.json, random);
        loaded += survives(folder.write("changed.glb", fixture.glb()));
    }
    tell_tested(uint64_t(files), "files");
    EXPECT_GT(loaded, files / 20);
    EXPECT_LT(loaded, files);
}

std::vector<std::byte> whole_file(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(stream)), {});
    return bytes_of(text);
}

/// Every glTF below `folder` as it is, and damaged copies of the smaller binary ones.
void survive_folder(const std::filesystem::path& folder, int mutations) {
    TemporaryFolder scratch;
    std::mt19937 random(3);
    int files = 0, loaded = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".gltf" && extension != ".glb") continue;
        ++files;
        loaded += survives(entry.path().string());
        if (extension != ".glb" || entry.file_size() > 200000) continue;
        const std::vector<std::byte> file = whole_file(entry.path());
        for (int i = 0; i < mutations; ++i) survives(scratch.write("changed.glb", mutated(file, random)));
        for (int i = 0; i < mutations; ++i) survives(scratch.write("cut.glb", std::span(file).first(random() % file.size())));
    }
    EXPECT_GT(files, 0) << folder;
    EXPECT_GT(loaded, 0) << folder;
}

TEST(Hostile, RealFilesAndDamagedCopiesLoadOrAreRefused) {
    const char* corpus = std::getenv("RAWTEXEL_CORPUS");
    if (!corpus) GTEST_SKIP() << "RAWTEXEL_CORPUS is not set: damaged copies of real glTF files are not loaded";
    survive_folder(std::filesystem::path(corpus) / "gltf", 50);
}

TEST(Hostile, AssimpsTestModelsLoadOrAreRefused) {
    const std::filesystem::path models = "/usr/share/assimp/models/glTF2";
    if (!std::filesystem::is_directory(models)) GTEST_SKIP() << "assimp-testmodels is not installed";
    survive_folder(models, 20);
    for (const char* negative :
         {"MissingBin/BoxTextured.gltf", "RecursiveNodes/RecursiveNodes.gltf", "IndexOutOfRange/IndexOutOfRange.gltf",
          "IndexOutOfRange/AllIndicesOutOfRange.gltf", "IncorrectVertexArrays/Cube.gltf", "SchemaFailures/sceneWrongType.gltf",
          "wrongTypes/badArray.gltf", "wrongTypes/badExtension.gltf", "wrongTypes/badNumber.gltf", "wrongTypes/badObject.gltf",
          "wrongTypes/badString.gltf", "wrongTypes/badUint.gltf"})
        EXPECT_NE(file_error((models / negative).string()), "") << negative;
}

}  // namespace
}  // namespace rawtexel::scenes
