// The files that a command writes, looked at before long work.
#pragma once

#include <span>
#include <string>

namespace rawtexel::cli {

/// A file and the option that named it.
struct OutputFile {
    std::string option, path;
};

/// Throws UsageError when two outputs are one file or an output is one of the `inputs`, whatever their names; devices may be both.
void check_apart(std::span<const OutputFile> outputs, std::span<const std::string> inputs);

/// check_apart, and scenes::OutputError where an output cannot be written.
void check_outputs(std::span<const OutputFile> outputs, std::span<const std::string> inputs);

}  // namespace rawtexel::cli
