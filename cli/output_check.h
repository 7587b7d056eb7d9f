// Whether a file can be written, asked before long work.
#pragma once

#include <string>

namespace rawtexel::cli {

/// Throws scenes::OutputError, naming the reason, when no file can be created at `path`. Leaves nothing behind and changes no file.
void check_output(const std::string& path);

}  // namespace rawtexel::cli
