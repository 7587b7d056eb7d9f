// Why a port's answer is not legal: known faults are tried on the case until one answers what came.
#pragma once

#include "cli/vectors/suite.h"

#include <span>
#include <string>
#include <vector>

namespace rawtexel::cli {

/// Every known fault under which the answer to case `index` would be what came, such as "half a texel left"; the likelier ones first, none
/// twice. `results`: all that came, for the neighbours of a case may be at fault.
std::vector<std::string> possible_causes(const Suite& suite, size_t index, std::span<const PortResult> results);

}  // namespace rawtexel::cli
