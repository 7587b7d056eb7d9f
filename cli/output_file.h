// Files the program writes: whole or not at all.
#pragma once

#include <string>
#include <string_view>

namespace rawtexel::cli {

/// Throws scenes::OutputError when a file at `path` could not be created, naming the reason; called before long work. Leaves nothing behind.
void check_output(const std::string& path);

/// Writes under a temporary name beside `path`, then renames. Throws scenes::OutputError.
void write_text(const std::string& path, std::string_view text);

}  // namespace rawtexel::cli
