// Running the program in tests: in this process for speed, or the built one.
#pragma once

#include "tests/temporary_folder.h"

#include <string>
#include <vector>

namespace rawtexel::test {

struct Outcome {
    int code = -1;
    std::string out, err;
};

/// The program's library, in this process.
Outcome run(const std::vector<std::string>& words);
/// The built program, as a shell starts it.
Outcome run_built(const std::vector<std::string>& words);

std::string read_file(const std::string& path);
void write_file(const std::string& path, const std::string& bytes);

/// A textured quad as glTF: FOLDER/quad.gltf, quad.bin and the 64x64 texture.png. Returns the path of the .gltf.
std::string write_quad(const TemporaryFolder& folder);

/// "" or why `outcome` is no failure with `code`, one line on stderr that begins "rawtexel: error: " and holds `part`, and nothing on
/// stdout.
std::string why_not_failed(const Outcome& outcome, int code, const std::string& part);

}  // namespace rawtexel::test
