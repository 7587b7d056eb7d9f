#include "tests/cli/program_runner.h"

#include "cli/program.h"
#include "cli/run_record.h"
#include "scenes/image_io.h"

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

namespace rawtexel::test {
namespace {

void append_floats(std::string& bytes, const std::vector<float>& values) {
    const size_t start = bytes.size();
    bytes.resize(start + values.size() * sizeof(float));
    std::memcpy(bytes.data() + start, values.data(), values.size() * sizeof(float));
}

// A gradient with stripes: every level of the pyramid differs from the others.
std::vector<uint8_t> striped_texels(int extent) {
    std::vector<uint8_t> texels;
    for (int y = 0; y < extent; ++y)
        for (int x = 0; x < extent; ++x) {
            texels.push_back(uint8_t(x * 255 / extent));
            texels.push_back(uint8_t((x / 2 + y / 3) % 2 == 0 ? 220 : 30));
            texels.push_back(uint8_t(y * 255 / extent));
        }
    return texels;
}

constexpr const char* kQuadJson = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": 0}]}],
"materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0}}],
"textures": [{"source": 0}], "images": [{"uri": "texture.png"}],
"buffers": [{"uri": "quad.bin", "byteLength": 140}],
"bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 48},
                {"buffer": 0, "byteOffset": 96, "byteLength": 32}, {"buffer": 0, "byteOffset": 128, "byteLength": 12}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]},
              {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"}, {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"},
              {"bufferView": 3, "componentType": 5123, "count": 6, "type": "SCALAR"}]})";

}  // namespace

Outcome run(const std::vector<std::string>& words) {
    std::ostringstream out, err;
    Outcome outcome;
    outcome.code = cli::run_program(words, out, err, false);
    outcome.out = out.str();
    outcome.err = err.str();
    return outcome;
}

Outcome run_built(const std::vector<std::string>& words) {
    const TemporaryFolder folder;
    std::vector<std::string> all{RAWTEXEL_PROGRAM};
    all.insert(all.end(), words.begin(), words.end());
    const std::string command = cli::shell_quoted(all) + " > " + folder / "out" + " 2> " + folder / "err";
    const int status = std::system(command.c_str());
    Outcome outcome;
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    outcome.out = read_file(folder / "out");
    outcome.err = read_file(folder / "err");
    return outcome;
}

std::string read_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream bytes;
    bytes << file.rdbuf();
    return bytes.str();
}

void write_file(const std::string& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

std::string write_quad(const TemporaryFolder& folder) {
    std::string bytes;
    append_floats(bytes, {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0});
    append_floats(bytes, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    append_floats(bytes, {0, 1, 1, 1, 1, 0, 0, 0});
    for (const char index : {'\0', '\1', '\2', '\0', '\2', '\3'}) bytes += {index, '\0'};  // little-endian 16 bits
    write_file(folder / "quad.bin", bytes);
    write_file(folder / "quad.gltf", kQuadJson);
    scenes::write_8bit(folder / "texture.png", 64, 64, 3, striped_texels(64), {});
    return folder / "quad.gltf";
}

std::string why_not_failed(const Outcome& outcome, int code, const std::string& part) {
    std::ostringstream why;
    if (outcome.code != code) why << "exit code " << outcome.code << ", not " << code << "; ";
    if (!outcome.out.empty()) why << "output '" << outcome.out << "'; ";
    if (!outcome.err.starts_with("rawtexel: error: ")) why << "no 'rawtexel: error: '; ";
    if (std::ranges::count(outcome.err, '\n') != 1 || !outcome.err.ends_with('\n')) why << "not one line; ";
    if (outcome.err.find(part) == std::string::npos) why << "'" << part << "' is not named; ";
    return why.str().empty() ? "" : why.str() + "stderr: " + outcome.err;
}

}  // namespace rawtexel::test
