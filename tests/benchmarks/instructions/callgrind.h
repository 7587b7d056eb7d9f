// Instructions that calls of one function take, as valgrind's callgrind counts them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace rawtexel::instructions {

/// Runs `work`. Callgrind counts while this function runs and at no other time.
void counted(const std::function<void()>& work);

/// Starts `command` (program, arguments) under callgrind; instructions of each of its calls of counted(), in their order.
/// Throws std::runtime_error where valgrind is missing or the command fails.
std::vector<uint64_t> count_instructions(const std::vector<std::string>& command);

}  // namespace rawtexel::instructions
