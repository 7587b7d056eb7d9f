// `rawtexel render`: a scene to an image.
#pragma once

#include "cli/command.h"

#include <memory>

namespace rawtexel::cli {

std::unique_ptr<Command> make_render_command();

}  // namespace rawtexel::cli
