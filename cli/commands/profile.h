// rawtexel profile: everything that a frame fetches, as numbers, pictures and a page.
#pragma once

#include "cli/command.h"

#include <memory>

namespace rawtexel::cli {

std::unique_ptr<Command> make_profile_command();

}  // namespace rawtexel::cli
