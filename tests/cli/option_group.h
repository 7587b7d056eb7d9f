// A group of options by itself, as tests parse it.
#pragma once

#include "cli/command_line.h"
#include "cli/usage_error.h"

#include <string>
#include <vector>

namespace rawtexel::test {

/// What `words` make of default options, declared by declare(line, options). Throws UsageError.
template <class Options, class Declare>
Options parsed_options(const Declare& declare, const std::vector<std::string>& words) {
    Options options;
    cli::CommandLine line("test", "test");
    declare(line, options);
    line.parse(words);
    return options;
}

/// The UsageError that parse(words) ends in, or nothing.
template <class Parse>
std::string complaint_of(const Parse& parse, const std::vector<std::string>& words) {
    try {
        parse(words);
    } catch (const cli::UsageError& error) {
        return error.what();
    }
    return "";
}

}  // namespace rawtexel::test
