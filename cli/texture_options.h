// How texture files are opened: the options of every command that reads any.
#pragma once

#include "cli/command_line.h"
#include "texunit/containers.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace rawtexel::cli {

/// Declares --bc-rounding and --max-texture-bytes.
void declare_texture_options(CommandLine& line, texunit::ContainerOptions& options);

/// A number of bytes, at least 1: digits and optionally K, M or G for 2^10, 2^20 or 2^30 of them.
uint64_t parse_bytes(std::string_view option, std::string_view text);

}  // namespace rawtexel::cli
