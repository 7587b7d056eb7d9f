// The program without its main: words in, exit code out.
#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace rawtexel::cli {

/// `words` without the program's name. Every failure is one line on `err` and one of the exit codes 1 to 4; nothing is thrown.
int run_program(const std::vector<std::string>& words, std::ostream& out, std::ostream& err, bool err_is_terminal);

}  // namespace rawtexel::cli
