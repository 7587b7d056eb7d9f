// Containers, JSON, URIs, extensions: everything before the first vertex.
#include "scenes/utf8.h"
#include "tests/scenes/gltf_fixture.h"

#include "scenes/gltf_uri.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sys/stat.h>

namespace rawtexel::scenes {
namespace {

class GltfDocumentTest : public testing::Test {
  protected:
    std::string text_error(std::string_view text) { return file_error(folder_.write("scene.gltf", text)); }
    std::string glb_error(std::span<const std::byte> bytes) { return file_error(folder_.write("scene.glb", bytes)); }
    std::string error() { return load_error(folder_, fixture_); }

    TemporaryFolder folder_;
    GltfFixture fixture_ = quad_fixture();
};

TEST_F(GltfDocumentTest, TextAndBinaryFilesHoldTheSameScene) {
    const shading::Scene text = load_gltf(folder_.write("quad.gltf", fixture_.gltf()));
    const shading::Scene binary = load_gltf(folder_.write("quad.glb", fixture_.glb()));
    EXPECT_EQ(text.name, "quad");
    ASSERT_EQ(text.meshes.size(), 1u);
    EXPECT_EQ(text.meshes[0].positions, binary.meshes.at(0).positions);
    EXPECT_EQ(text.meshes[0].uv, binary.meshes[0].uv);
    EXPECT_EQ(text.meshes[0].indices, binary.meshes[0].indices);
}

TEST_F(GltfDocumentTest, TheContentDecidesNotTheExtension) {
    EXPECT_EQ(load_gltf(folder_.write("odd.gltf", fixture_.glb())).meshes.size(), 1u);
    EXPECT_EQ(load_gltf(folder_.write("odd.glb", fixture_.gltf())).meshes.size(), 1u);
}

TEST_F(GltfDocumentTest, MissingEmptyAndSpecialFilesAreNamed) {
    EXPECT_TRUE(says(file_error(folder_ / "none.glb"), folder_ / "none.glb"));
    EXPECT_TRUE(says(text_error(""), "empty (0 bytes"));
    EXPECT_TRUE(says(file_error(folder_.path()), folder_.path()));
    ASSERT_EQ(::mkfifo((folder_ / "pipe.glb").c_str(), 0600), 0);
    EXPECT_NE(file_error(folder_ / "pipe.glb"), "");
}

TEST_F(GltfDocumentTest, GlbHeadersAreChecked) {
    std::vector<std::byte> file = fixture_.glb();
    const auto with = [&](size_t offset, uint8_t value) {
        std::vector<std::byte> changed = file;
        changed[offset] = std::byte(value);
        return glb_error(changed);
    };
    EXPECT_EQ(glb_error(file), "");
    EXPECT_TRUE(says(with(4, 1), "GLB version 1 (allowed: 2)"));
    EXPECT_TRUE(says(with(11, 1), "truncated GLB (it declares"));
    EXPECT_TRUE(says(with(15, 0x7f), "truncated GLB (a chunk of"));
    EXPECT_TRUE(says(with(16, 'X'), "GLB without JSON"));
    EXPECT_TRUE(says(glb_error(std::span(file).first(10)), "truncated GLB (10 bytes"));
    file.resize(file.size() + 16);  // what follows the declared length is no part of it
    EXPECT_EQ(glb_error(file), "");
}

TEST_F(GltfDocumentTest, JsonThatIsNotGltfIsRefused) {
    EXPECT_TRUE(says(text_error("not json"), "not valid JSON"));
    EXPECT_TRUE(says(text_error("{\"asset\": {\"version\": \"2.0\"}"), "not valid JSON"));
    EXPECT_TRUE(says(text_error("[]"), "the document is an array of 0 (allowed: an object)"));
    EXPECT_TRUE(says(text_error("{}"), "has no \"asset\""));
    EXPECT_TRUE(says(text_error("{\"asset\": {}}"), "asset has no \"version\""));
    EXPECT_TRUE(says(text_error("{\"asset\": {\"version\": \"1.0\"}, \"scene\": \"name\"}"), "glTF version \"1.0\" (allowed: 2.x)"));
    EXPECT_TRUE(says(text_error("{\"asset\": {\"version\": \"2.0\"}, \"meshes\": {}}"), "meshes is an object (allowed: an array)"));
    EXPECT_TRUE(says(text_error("{\"asset\": {\"version\": \"2.0\"}, \"nodes\": [7]}"), "nodes[0] is 7 (allowed: an object)"));
    EXPECT_EQ(text_error("{\"asset\": {\"version\": \"2.0\"}}"), "");
    EXPECT_EQ(text_error("\xef\xbb\xbf{\"asset\": {\"version\": \"2.1\"}}"), "");  // a byte order mark
}

TEST_F(GltfDocumentTest, MinimalVersionsAbove2Point0AreRefused) {
    const auto with = [&](const char* version, const char* least) {
        return text_error(nlohmann::json{{"asset", {{"version", version}, {"minVersion", least}}}}.dump());
    };
    EXPECT_EQ(with("2.0", "2.0"), "");
    EXPECT_EQ(with("2.7", "2.0"), "");
    EXPECT_TRUE(says(with("2.1", "2.1"), "asset.minVersion is \"2.1\" (allowed: at most \"2.0\")"));
    EXPECT_TRUE(says(with("2.0", "2.10"), "asset.minVersion is \"2.10\" (allowed: at most"));
    EXPECT_TRUE(says(with("2.0", "3.0"), "asset.minVersion is \"3.0\" (allowed: at most"));
    for (const char* odd : {"2", "2.", ".0", "2.0.1", "2.x", "", "-2.0"}) {
        EXPECT_TRUE(says(with("2.0", odd), "asset.minVersion is \"" + std::string(odd) + "\" (allowed: two numbers")) << odd;
        EXPECT_NE(with(odd, "2.0"), "") << odd;
    }
}

TEST_F(GltfDocumentTest, JsonErrorsNameTheByteInWordsOfOurOwn) {
    EXPECT_TRUE(says(text_error("{\"a\": nul}"), "not valid JSON (byte 10: '}' is out of place)"));
    EXPECT_TRUE(says(text_error("{\"a\": 1"), "the text ends too early)"));
    EXPECT_TRUE(says(text_error("{\"a\n\": 1}"), "not valid JSON (byte 4: a control character is out of place)"));
    EXPECT_TRUE(says(text_error("{\"a\xff\": 1}"), "not valid JSON (byte 4: not UTF-8)"));
    EXPECT_TRUE(says(text_error("\xff\xfe{"), "not valid JSON (byte 1: not UTF-8)"));
    EXPECT_TRUE(says(text_error("{\"a\": \u00e9}"), "not valid JSON (byte 7: '\u00e9' is out of place)"));
    EXPECT_TRUE(says(text_error("{\"a\": 1e999}"), "not valid JSON (a number is too large)"));
    // Whatever stands in a file, the message is UTF-8 and no library speaks.
    for (int byte = 1; byte < 256; ++byte) {
        const std::string error = text_error("{\"asset\": " + std::string(1, char(byte)) + "}");
        EXPECT_EQ(find_invalid_utf8(error), error.npos) << byte << ": " << error;
        EXPECT_EQ(error.find("json.exception"), error.npos) << error;
    }
}

TEST_F(GltfDocumentTest, NumbersInMessagesAreWords) {
    fixture_.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 4}, {"znear", 0.1}}}}};
    EXPECT_TRUE(says(error(), "cameras[0].perspective.yfov is 4 (allowed: an angle in radians above 0 and below pi, 180\u00b0)"));
    fixture_.json["cameras"][0]["perspective"] = {{"yfov", 1}, {"znear", 0}};
    EXPECT_TRUE(says(error(), "cameras[0].perspective.znear is 0 (allowed: a number above 0)"));
    fixture_.json.erase("cameras");
    fixture_.json["samplers"] = {{{"wrapS", 33069}}};
    EXPECT_TRUE(says(error(), "samplers[0].wrapS is 33069 (allowed: 33071 CLAMP_TO_EDGE, 33648 MIRRORED_REPEAT, 10497 REPEAT)"));
    fixture_.json.erase("samplers");
    fixture_.json["accessors"][0].erase("bufferView");
    fixture_.json["accessors"][0]["count"] = 100000000;
    EXPECT_TRUE(says(error(),
                     "accessors[0] has 100000000 elements without a buffer view, all zero (allowed: 65536 and one for each of the file's"));
    fixture_.json["accessors"][0]["count"] = 1e300;
    EXPECT_TRUE(says(error(), "(allowed: an integer from 1 to 2^53)"));
}

TEST_F(GltfDocumentTest, ErrorsOfNamedFilesNameTheSceneToo) {
    const auto buffer_error = [&](const std::string& uri) {
        fixture_.json["buffers"] = {{{"byteLength", 4}, {"uri", uri}}};
        return text_error(fixture_.json.dump());
    };
    const std::string scene = folder_ / "scene.gltf";
    EXPECT_EQ(buffer_error("."), scene + ": buffers[0] '.': is not a regular file");
    EXPECT_EQ(buffer_error("none.bin"), scene + ": buffers[0] 'none.bin': cannot be opened: No such file or directory");
    EXPECT_EQ(buffer_error(""), scene + ": buffers[0] has an empty URI");
    EXPECT_EQ(buffer_error("a%00b"), scene + ": buffers[0] 'a%00b' holds a zero byte");
    EXPECT_EQ(buffer_error("data:;base64," + std::string(1000, '!')),
              scene + ": buffers[0] 'data:;base64,!!!!!!!!!!!!!!!!!!!!!!!!!!!...' is a malformed data URI");
    fixture_.json["images"] = {{{"uri", "none.png"}}};
    fixture_.json.erase("buffers");
    EXPECT_TRUE(says(error(), ": images[0] 'none.png': cannot be opened"));
}

TEST_F(GltfDocumentTest, EveryFileReadIsTold) {
    folder_.write("scene.bin", fixture_.binary);
    folder_.write("image.png", test_png());
    fixture_.json["buffers"] = {{{"byteLength", fixture_.binary.size()}, {"uri", "scene.bin"}}};
    fixture_.json["images"] = {{{"uri", "image.png"}}, {{"uri", "image.png"}}, {{"uri", "data:;base64," + base64(test_png())}}};
    std::vector<std::string> opened;
    LoadOptions options;
    options.opened = [&](const std::string& path) { opened.push_back(path); };
    const std::string scene = folder_.write("scene.gltf", fixture_.json.dump());
    load_gltf(scene, options);
    EXPECT_EQ(opened, (std::vector<std::string>{scene, folder_ / "scene.bin", folder_ / "image.png"}));
}

TEST_F(GltfDocumentTest, DeepJsonIsRefusedWithoutRecursion) {
    for (const char* bracket : {"[", "{\"a\":"}) {
        std::string text = "{\"asset\": {\"version\": \"2.0\"}, \"extras\": ";
        for (int i = 0; i < 300000; ++i) text += bracket;
        EXPECT_TRUE(says(text_error(text), "nested deeper than"));
    }
    // Brackets in strings are no nesting.
    EXPECT_EQ(
        text_error("{\"asset\": {\"version\": \"2.0\"}, \"extras\": \"" + std::string(1000, '[') + "\\\"" + std::string(1000, '{') + "\"}"),
        "");
}

TEST_F(GltfDocumentTest, UnknownPropertiesAndExtrasOfAnyTypePlayNoPart) {
    fixture_.json["extras"] = {1, "two", {{"three", nullptr}}};
    fixture_.json["nodes"][0]["extras"] = 5;
    fixture_.json["nodes"][0]["colour"] = {{"of", "no meaning"}};
    fixture_.json["extensions"]["VENDOR_unknown"] = 3;
    EXPECT_EQ(error(), "");
}

TEST_F(GltfDocumentTest, UnknownExtensionsAreToldOnceAndRequiredOnesAreErrors) {
    fixture_.json["extensionsUsed"] = {"KHR_materials_unlit", "VENDOR_a", "VENDOR_b", "VENDOR_a"};
    std::vector<std::string> warnings;
    load_fixture(folder_, fixture_, &warnings);
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_TRUE(says(warnings[0], "the extension VENDOR_a is left out"));
    EXPECT_TRUE(says(warnings[1], "the extension VENDOR_b is left out"));
    fixture_.json["extensionsRequired"] = {"KHR_texture_transform", "VENDOR_b"};
    EXPECT_TRUE(says(error(), "needs the extension VENDOR_b"));
    fixture_.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    EXPECT_EQ(error(), "");
}

TEST_F(GltfDocumentTest, AnimationsAreToldAndNotRead) {
    fixture_.json["animations"] = {{{"nonsense", 1}}, {{"channels", "none"}}};
    std::vector<std::string> warnings;
    load_fixture(folder_, fixture_, &warnings);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_TRUE(says(warnings[0], "animations are left out"));
}

TEST_F(GltfDocumentTest, BuffersComeFromFilesBesideTheScene) {
    folder_.write("data/my buffer.bin", fixture_.binary);
    for (const char* uri : {"data/my%20buffer.bin", "data/my buffer.bin", "./data/../data/my%20buffer.bin"}) {
        fixture_.json["buffers"] = {{{"byteLength", fixture_.binary.size()}, {"uri", uri}}};
        EXPECT_EQ(load_gltf(folder_.write("scene.gltf", fixture_.json.dump())).meshes.size(), 1u) << uri;
    }
    // A name that holds the escape itself.
    folder_.write("a%20b.bin", fixture_.binary);
    fixture_.json["buffers"][0]["uri"] = "a%20b.bin";
    EXPECT_EQ(text_error(fixture_.json.dump()), "");
    // From a folder below, upwards.
    fixture_.json["buffers"][0]["uri"] = "../data/my%20buffer.bin";
    EXPECT_EQ(file_error(folder_.write("below/scene.gltf", fixture_.json.dump())), "");
}

TEST_F(GltfDocumentTest, UrisThatLeaveTheTreeAreRefused) {
    for (const char* uri : {"http://example.com/a.bin", "file:///etc/passwd", "/etc/passwd", "ftp:x"}) {
        fixture_.json["buffers"] = {{{"byteLength", 4}, {"uri", uri}}};
        EXPECT_TRUE(says(text_error(fixture_.json.dump()), std::string("buffers[0] refers to ") + uri)) << uri;
    }
    for (const char* uri : {"", "a%00b", "data:nothing", "data:;base64,!!!!", "data:;base64,AAAAA"}) {
        fixture_.json["buffers"] = {{{"byteLength", 4}, {"uri", uri}}};
        EXPECT_TRUE(says(text_error(fixture_.json.dump()), "buffers[0]")) << uri;
    }
    fixture_.json["buffers"] = {{{"byteLength", 4}, {"uri", "."}}};
    EXPECT_NE(text_error(fixture_.json.dump()), "");
}

TEST_F(GltfDocumentTest, BuffersShorterThanTheyDeclareAreRefusedAndLongerOnesAreNot) {
    fixture_.json["buffers"] = {{{"byteLength", fixture_.binary.size() + 4}}};
    EXPECT_TRUE(says(error(), "buffers[0] is truncated"));
    folder_.write("long.bin", std::vector<std::byte>(fixture_.binary.size() + 100));
    fixture_.json["buffers"] = {{{"byteLength", fixture_.binary.size()}, {"uri", "long.bin"}}};
    EXPECT_EQ(text_error(fixture_.json.dump()), "");
    fixture_.json["buffers"][0].erase("uri");
    EXPECT_TRUE(says(text_error(fixture_.json.dump()), "which has no data"));
}

TEST_F(GltfDocumentTest, ImagesComeFromDataUrisOfAnyMediaType) {
    fixture_.add("materials", {{"normalTexture", {{"index", 0}}}});
    fixture_.add("textures", {{"source", 0}});
    for (const char* head : {"data:image/png;base64,", "data:;base64,", "DATA:application/x-odd;charset=x;base64,"}) {
        fixture_.json["images"] = {{{"uri", head + base64(test_png())}}};
        EXPECT_EQ(load_fixture(folder_, fixture_).textures.at(0).texture->shape().width, 4) << head;
    }
    fixture_.json["images"] = {nlohmann::json::object()};
    EXPECT_TRUE(says(error(), "images[0] needs either a uri or a bufferView"));
}

TEST(GltfUri, Base64OfEveryLengthComesBack) {
    std::vector<std::byte> bytes;
    for (int length = 0; length < 70; ++length) {
        const auto decoded = decode_data_uri("data:a/b;base64," + base64(bytes));
        ASSERT_TRUE(decoded) << length;
        EXPECT_EQ(decoded->bytes, bytes) << length;
        EXPECT_EQ(decoded->mime_type, "a/b");
        bytes.push_back(std::byte(length * 37 & 0xff));
    }
}

TEST(GltfUri, PlainDataUrisArePercentDecoded) {
    const auto decoded = decode_data_uri("data:text/plain,a%20b%2");
    ASSERT_TRUE(decoded);
    EXPECT_EQ(decoded->bytes, bytes_of("a b%2"));
}

TEST(GltfUri, PercentEscapesThatAreNoneStandForThemselves) {
    EXPECT_EQ(percent_decoded("100%"), "100%");
    EXPECT_EQ(percent_decoded("%zz%4"), "%zz%4");
    EXPECT_EQ(percent_decoded("%41%62%2f+"), "Ab/+");
}

}  // namespace
}  // namespace rawtexel::scenes
