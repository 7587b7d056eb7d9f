#include "tests/benchmarks/peer/machine.h"

#include "texunit/simd.h"

#include <fstream>
#include <string>
#include <thread>

namespace rawtexel::peer {

nlohmann::json machine_description() {
    std::string processor = "unknown";
    std::ifstream cpuinfo("/proc/cpuinfo");
    for (std::string line; std::getline(cpuinfo, line);) {
        if (!line.starts_with("model name")) continue;
        processor = line.substr(line.find(':') + 2);
        break;
    }
    return {{"processor", processor},
            {"threads", std::thread::hardware_concurrency()},
            {"simd", to_string(texunit::chosen_simd())},
            {"compiler", __VERSION__}};
}

}  // namespace rawtexel::peer
