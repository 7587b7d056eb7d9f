// `rawtexel vectors`: test vectors for ports of samplers.
#pragma once

#include "cli/command.h"

#include <memory>

namespace rawtexel::cli {

std::unique_ptr<Command> make_vectors_command();

}  // namespace rawtexel::cli
