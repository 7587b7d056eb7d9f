// Words of a command line that came as one text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rawtexel::cli {

/// Words as a POSIX shell separates them: by blanks, with '…', "…" and \ to keep what they hold; nothing is expanded. Throws UsageError
/// for a quote without its end. The inverse of shell_quoted (cli/run_record.h).
std::vector<std::string> shell_words(std::string_view text);

}  // namespace rawtexel::cli
