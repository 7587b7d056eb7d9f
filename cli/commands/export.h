// `rawtexel export`: a scene to a .glb file.
#pragma once

#include "cli/command.h"

#include <memory>

namespace rawtexel::cli {

std::unique_ptr<Command> make_export_command();

}  // namespace rawtexel::cli
