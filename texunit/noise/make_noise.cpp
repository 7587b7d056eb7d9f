// Writes the masks of blue noise into the file named: rawtexel_make_noise texunit/noise/masks.bin
#include "texunit/noise/mask_file.h"

#include <cstdio>
#include <fstream>

int main(int count, char** arguments) {
    if (count != 2) {
        std::fprintf(stderr, "usage: rawtexel_make_noise FILE\n");
        return 2;
    }
    const std::vector<std::byte> bytes = rawtexel::texunit::noise::make_mask_file();
    std::ofstream file(arguments[1], std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    if (file.flush()) return 0;
    std::fprintf(stderr, "rawtexel_make_noise: cannot write %s\n", arguments[1]);
    return 1;
}
