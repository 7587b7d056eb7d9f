// `rawtexel compare`: how far images are from a reference.
#pragma once

#include "cli/command.h"

#include <memory>

namespace rawtexel::cli {

std::unique_ptr<Command> make_compare_command();

}  // namespace rawtexel::cli
