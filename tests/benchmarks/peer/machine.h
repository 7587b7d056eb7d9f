// What figures were taken on.
#pragma once

#include <nlohmann/json.hpp>

namespace rawtexel::peer {

/// Processor, cores, instruction set in use and the compiler.
nlohmann::json machine_description();

}  // namespace rawtexel::peer
