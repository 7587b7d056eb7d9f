// `rawtexel texture`: what is inside a texture file, and its texels as images.
#pragma once

#include "cli/command.h"

#include <memory>

namespace rawtexel::cli {

std::unique_ptr<Command> make_texture_command();

}  // namespace rawtexel::cli
