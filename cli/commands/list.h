// `rawtexel list`: what there is to choose from.
#pragma once

#include "cli/command.h"

#include <memory>

namespace rawtexel::cli {

std::unique_ptr<Command> make_list_command();

}  // namespace rawtexel::cli
