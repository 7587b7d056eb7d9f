// `rawtexel explain`: everything behind one pixel.
#pragma once

#include "cli/command.h"

#include <memory>

namespace rawtexel::cli {

std::unique_ptr<Command> make_explain_command();

}  // namespace rawtexel::cli
