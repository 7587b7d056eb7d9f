// GLSL to SPIR-V by glslang's own program, found when it is asked for.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace rawtexel::cli {

/// The SPIR-V of the compute shader in `path`, for Vulkan 1.0; #include "…" finds files beside it. Throws scenes::InputError: no such file,
/// the first thing that glslang has against it, or no glslangValidator on the PATH (Debian: glslang-tools).
std::vector<std::byte> compile_glsl(const std::string& path);

}  // namespace rawtexel::cli
