// `rawtexel sample`: one lookup, explained.
#pragma once

#include "cli/command.h"

#include <memory>

namespace rawtexel::cli {

std::unique_ptr<Command> make_sample_command();

}  // namespace rawtexel::cli
