// The words of one command: options, flags and arguments, read in any order.
#pragma once

#include "cli/usage_error.h"

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rawtexel::cli {

/// Declares what a command takes, then parses. Every error is a UsageError with the nearest valid spelling; the argument library behind it
/// (CLI11) never speaks to the user. `--help` and `-h` are declared by themselves.
class CommandLine {
  public:
    using Reader = std::function<void(const std::string& text)>;

    /// `usage` such as "render SCENE -o FILE".
    CommandLine(std::string usage, std::string summary);
    ~CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    /// A heading over the options declared after it, in the help.
    void group(std::string heading);
    /// `names` such as "-o,--output"; `value` such as "FILE" for the help. Given twice is an error. `read` may throw UsageError.
    void option(const std::string& names, const std::string& value, const std::string& help, Reader read);
    /// May be given again and again, and its values may begin with dashes; one long name.
    void repeated_option(const std::string& name, const std::string& value, const std::string& help, Reader read);
    void flag(const std::string& names, const std::string& help, bool& set);
    /// A flag that may carry a value behind a colon: "--ewa" or "--ewa:0.25". `read` gets the value, empty without one.
    void flag_with_value(const std::string& name, const std::string& value, const std::string& help, Reader read);
    /// Takes the place of the option `name`, such as "--filter", declared before: another value, help and reader, in the same place of the
    /// help.
    void replace_option(const std::string& name, const std::string& value, const std::string& help, Reader read);
    /// The words that are no options, at least `least` and at most `most` of them. `name` is for help and errors.
    void arguments(std::string name, std::string help, size_t least, size_t most, std::vector<std::string>& words);

    /// Reads everything; returns false when help was asked for (nothing is checked then).
    bool parse(const std::vector<std::string>& words);
    std::string help() const;
    /// True for an option that takes a value as its next word.
    bool takes_value(std::string_view option) const;
    /// What parse() read: long names with their values, empty for flags, in the order of the declarations.
    const std::vector<std::pair<std::string, std::string>>& given() const;

  private:
    std::vector<std::string> separate_short_values(const std::vector<std::string>& words) const;

    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// `text` in lines of at most `width` columns, every line but the first indented by `indent` spaces.
std::string wrap_text(std::string_view text, size_t width, size_t indent);

}  // namespace rawtexel::cli
