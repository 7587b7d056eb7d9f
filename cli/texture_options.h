// How texture files are opened: the options of every command that reads any.
#pragma once

#include "cli/command_line.h"
#include "texunit/containers.h"

namespace rawtexel::cli {

/// Declares --bc-rounding and --max-texture-bytes.
void declare_texture_options(CommandLine& line, texunit::ContainerOptions& options);

}  // namespace rawtexel::cli
