// Writes the files that fuzzing starts from: one argument, the folder to put them in.
#include "tests/texunit/container_damage.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: rawtexel_fuzz_seeds FOLDER\n", stderr);
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    int number = 0;
    for (const auto& bytes : rawtexel::texunit::test_files::seed_files()) {
        std::ofstream file(folder / ("seed" + std::to_string(number++)), std::ios::binary);
        file.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
        if (!file.flush()) {
            std::fprintf(stderr, "%s: cannot be written\n", folder.c_str());
            return 4;
        }
    }
    return 0;
}
