// `rawtexel verify-shader`: judges a port of a sampler.
#pragma once

#include "cli/command.h"

#include <memory>

namespace rawtexel::cli {

std::unique_ptr<Command> make_verify_shader_command();

}  // namespace rawtexel::cli
