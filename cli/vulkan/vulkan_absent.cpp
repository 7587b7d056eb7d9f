// Stands in for the runner where the build found no Vulkan headers.
#ifndef RAWTEXEL_HAS_VULKAN
#include "cli/vulkan/port_runner.h"

namespace rawtexel::cli {
namespace {
constexpr const char* kRemedy =
    "this build has no Vulkan: install libvulkan-dev and build again, or judge results made elsewhere with --outputs FILE";
}

PortRun run_port(const Suite&, const SpirvModule&, const std::string&, const std::string&) { throw NoVulkan(kRemedy); }
std::vector<std::string> vulkan_devices() { throw NoVulkan(kRemedy); }

}  // namespace rawtexel::cli
#endif
