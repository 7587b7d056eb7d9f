// rawtexel bench: error against time, samples and fetches.
#pragma once

#include "cli/command.h"

#include <memory>

namespace rawtexel::cli {

std::unique_ptr<Command> make_bench_command();

}  // namespace rawtexel::cli
