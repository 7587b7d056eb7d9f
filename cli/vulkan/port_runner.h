// Runs a port over the cases of a suite on a Vulkan device, without a window. Vulkan is loaded when it is asked for; a build without its
// headers, and a machine without its loader or a device, say what to install.
#pragma once

#include "cli/vectors/suite.h"
#include "cli/vulkan/spirv_module.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace rawtexel::cli {

/// There is no Vulkan, or no device as asked for. what() is one line with the remedy.
class NoVulkan : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

struct PortRun {
    std::string device;  ///< name, version of the API and driver
    std::vector<PortResult> results;
    std::vector<uint32_t> unsupported;  ///< those that the device has no images of, or the shader no binding; their results are 0
};

/// One result a case. `device`: part of a device's name, empty for the first that is no CPU, or else the first. Throws NoVulkan;
/// scenes::InputError, naming `path`, where the device cannot run the module or its driver crashes: it runs in a process of its own.
PortRun run_port(const Suite& suite, const SpirvModule& module, const std::string& path, const std::string& device);

/// Names of the devices there are; throws NoVulkan where there is no loader.
std::vector<std::string> vulkan_devices();

}  // namespace rawtexel::cli
