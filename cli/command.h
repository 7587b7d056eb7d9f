// What every command of the program is.
#pragma once

#include "cli/command_line.h"

#include <ostream>
#include <string>
#include <string_view>

namespace rawtexel::cli {

/// How the program was called and where its words go.
struct Invocation {
    std::string command_line;  ///< everything, quoted for a shell: kept in metadata
    std::ostream& out;         ///< results
    std::ostream& err;         ///< warnings and progress
    bool err_is_terminal = false;
};

/// Exit codes, a contract (docs: `rawtexel --help`).
enum ExitCode : int { kDone = 0, kCheckFailed = 1, kWrongUsage = 2, kBadInput = 3, kCannotWrite = 4 };

/// One command with its options as members. Errors are exceptions; the program turns them into exit codes.
class Command {
  public:
    virtual ~Command() = default;
    virtual std::string_view name() const = 0;
    virtual std::string_view usage() const = 0;         ///< such as "render SCENE -o FILE [options]"
    virtual std::string_view summary() const = 0;       ///< one sentence
    virtual void declare(CommandLine& line) = 0;        ///< the options it takes, bound to its members
    virtual int run(const Invocation& invocation) = 0;  ///< an ExitCode
};

/// "rawtexel: warning: WHAT" on one line.
void warn(const Invocation& invocation, const std::string& what);

}  // namespace rawtexel::cli
