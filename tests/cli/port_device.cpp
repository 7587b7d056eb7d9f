#include "tests/cli/port_device.h"

#include "cli/vulkan/glsl_compiler.h"
#include "cli/vulkan/port_runner.h"

#include <cstdlib>
#include <exception>

namespace rawtexel::test {

std::string why_no_ports() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    return "sanitizers know nothing of the memory and threads of drivers";
#endif
    setenv("GALLIVM_PERF", "nopt", 0);
    try {
        if (cli::vulkan_devices().empty()) return "no Vulkan device (Debian: mesa-vulkan-drivers)";
        cli::compile_glsl(port_of("triplanar"));
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

void compile_for_narrow_vectors() { setenv("LP_NATIVE_VECTOR_WIDTH", "128", 0); }

}  // namespace rawtexel::test
