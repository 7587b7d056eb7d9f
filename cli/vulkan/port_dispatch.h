// A port on a Vulkan device, in this process: what cli/vulkan/port_runner.h puts into one of its own.
#pragma once

#include "cli/vulkan/port_runner.h"

namespace rawtexel::cli {

/// As run_port; a driver that crashes takes this process with it.
PortRun dispatch_port(const Suite& suite, const SpirvModule& module, const std::string& path, const std::string& device);

}  // namespace rawtexel::cli
