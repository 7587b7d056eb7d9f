#include "cli/command_line.h"

#include "cli/word_list.h"
#include "scenes/spelling.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <optional>

namespace rawtexel::cli {
namespace {

constexpr size_t kHelpColumn = 34, kHelpWidth = 110;  // characters

bool looks_like_option(std::string_view word) { return word.size() > 1 && word[0] == '-'; }

// "--filtr=nearest" is about "--filtr".
std::string option_name(std::string_view word) { return std::string(word.substr(0, word.find('='))); }

}  // namespace

struct CommandLine::Impl {
    struct HelpEntry {
        std::string heading;  ///< not empty: starts a group
        std::string left, right;
    };
    struct Arguments {
        std::string name;
        size_t least, most;
        std::vector<std::string>* words;
    };

    std::string usage, summary;
    CLI::App app;
    std::vector<HelpEntry> entries;
    struct ValuedFlag {
        std::string name;
        Reader read;
        std::optional<std::string> given;  ///< the word
    };
    struct RepeatedOption {
        std::string name, value;
        Reader read;
    };
    std::optional<Arguments> arguments;
    std::vector<ValuedFlag> valued_flags;
    std::vector<RepeatedOption> repeated_options;
    std::vector<std::pair<std::string, std::string>> given;
    bool help = false;

    void add_option(const std::string& names, const std::string& value, Reader read);
    std::vector<std::string> option_names() const;
    void check_for_repeats() const;
    std::vector<std::string> take_valued_flags(const std::vector<std::string>& words);
    std::vector<std::string> take_repeated_options(const std::vector<std::string>& words);
    void take_remaining(const std::vector<std::string>& remaining);
    [[noreturn]] void throw_unknown_option(const std::string& word) const;
};

std::vector<std::string> CommandLine::Impl::option_names() const {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
        for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    }
    return names;
}

void CommandLine::Impl::check_for_repeats() const {
    for (const CLI::Option* option : app.get_options())
        if (option->get_items_expected_max() > 0 && option->results().size() > 1)
            throw UsageError(option->get_name() + ": given more than once ('" + option->results()[0] + "' and '" + option->results()[1] +
                             "')");
}

// Reads the words that are valued flags and returns the others.
std::vector<std::string> CommandLine::Impl::take_valued_flags(const std::vector<std::string>& words) {
    std::vector<std::string> others;
    const auto end = std::ranges::find(words, "--");
    for (auto word = words.begin(); word != end; ++word) {
        const auto flag = std::ranges::find_if(
            valued_flags, [&](const ValuedFlag& each) { return *word == each.name || word->starts_with(each.name + ":"); });
        if (flag == valued_flags.end()) {
            others.push_back(*word);
            continue;
        }
        if (flag->given) throw UsageError(flag->name + ": given more than once ('" + *flag->given + "' and '" + *word + "')");
        flag->given = *word;
        given.emplace_back(*word, "");
        flag->read(word->size() > flag->name.size() ? word->substr(flag->name.size() + 1) : "");
    }
    others.insert(others.end(), end, words.end());
    return others;
}

// Reads the words that are repeated options and their values, and returns the others.
std::vector<std::string> CommandLine::Impl::take_repeated_options(const std::vector<std::string>& words) {
    std::vector<std::string> others;
    const auto end = std::ranges::find(words, "--");
    for (auto word = words.begin(); word != end; ++word) {
        const auto option = std::ranges::find(repeated_options, option_name(*word), &RepeatedOption::name);
        if (option == repeated_options.end()) {
            others.push_back(*word);
            continue;
        }
        std::string value;
        if (word->size() > option->name.size())
            value = word->substr(option->name.size() + 1);
        else if (word + 1 != end)
            value = *++word;
        if (value.empty()) throw UsageError(option->name + ": a value is missing (" + option->value + ")");
        option->read(value);
        given.emplace_back(option->name, value);
    }
    others.insert(others.end(), end, words.end());
    return others;
}

void CommandLine::Impl::throw_unknown_option(const std::string& word) const {
    const std::string name = option_name(word);
    throw UsageError("unknown option '" + name + "', the nearest is '" + scenes::nearest_spelling(name, option_names()) + "'");
}

// What the argument library did not recognise: unknown options, and the words that are no options.
void CommandLine::Impl::take_remaining(const std::vector<std::string>& remaining) {
    std::vector<std::string> words;
    bool only_words = false;
    for (const std::string& word : remaining) {
        if (!only_words && word == "--")
            only_words = true;
        else if (!only_words && looks_like_option(word))
            throw_unknown_option(word);
        else
            words.push_back(word);
    }
    if (std::ranges::find(words, std::string()) != words.end()) throw UsageError("an argument is empty (usage: rawtexel " + usage + ")");
    const size_t most = arguments ? arguments->most : 0;
    if (words.size() > most) throw UsageError("unexpected argument '" + words[most] + "' (usage: rawtexel " + usage + ")");
    if (!arguments) return;
    if (words.size() < arguments->least) throw UsageError("missing argument " + arguments->name + " (usage: rawtexel " + usage + ")");
    *arguments->words = std::move(words);
}

CommandLine::CommandLine(std::string usage, std::string summary) : impl_(std::make_unique<Impl>()) {
    impl_->usage = std::move(usage);
    impl_->summary = std::move(summary);
    impl_->app.set_help_flag();
    impl_->app.allow_extras();
}

CommandLine::~CommandLine() = default;

void CommandLine::group(std::string heading) { impl_->entries.push_back({std::move(heading), {}, {}}); }

void CommandLine::Impl::add_option(const std::string& names, const std::string& value, Reader read) {
    const std::string shown = split(names, ',').back();
    app.add_option_function<std::string>(names, [this, shown, value, read = std::move(read)](const std::string& text) {
        // "--size --spp 4": the next option is not the value of the one before.
        if (text.empty() || text.starts_with("--")) throw UsageError(shown + ": a value is missing (" + value + ")");
        read(text);
        given.emplace_back(shown, text);
    });
}

void CommandLine::option(const std::string& names, const std::string& value, const std::string& help, Reader read) {
    impl_->add_option(names, value, std::move(read));
    impl_->entries.push_back({{}, names + " " + value, help});
}

void CommandLine::repeated_option(const std::string& name, const std::string& value, const std::string& help, Reader read) {
    impl_->app.add_option(name);  // so that misspelt options find it, and its value is no other word
    impl_->repeated_options.push_back({name, value, std::move(read)});
    impl_->entries.push_back({{}, name + " " + value, help});
}

void CommandLine::flag(const std::string& names, const std::string& help, bool& set) {
    const std::string shown = split(names, ',').back();
    impl_->app.add_flag_callback(names, [impl = impl_.get(), shown, &set] {
        set = true;
        impl->given.emplace_back(shown, "");
    });
    impl_->entries.push_back({{}, names, help});
}

void CommandLine::flag_with_value(const std::string& name, const std::string& value, const std::string& help, Reader read) {
    impl_->app.add_flag(name);  // so that misspelt options find it
    impl_->valued_flags.push_back({name, std::move(read), {}});
    impl_->entries.push_back({{}, name + "[:" + value + "]", help});
}

void CommandLine::replace_option(const std::string& name, const std::string& value, const std::string& help, Reader read) {
    impl_->app.remove_option(impl_->app.get_option(name));
    impl_->add_option(name, value, std::move(read));
    const auto entry = std::ranges::find_if(impl_->entries, [&](const Impl::HelpEntry& each) { return split(each.left, ' ')[0] == name; });
    *entry = {{}, name + " " + value, help};
}

void CommandLine::arguments(std::string name, std::string help, size_t least, size_t most, std::vector<std::string>& words) {
    impl_->entries.push_back({{}, name, std::move(help)});
    impl_->arguments = Impl::Arguments{std::move(name), least, most, &words};
}

bool CommandLine::parse(const std::vector<std::string>& words) {
    if (std::ranges::any_of(words, [](const std::string& word) { return word == "--help" || word == "-h"; })) return false;
    std::vector<std::string> reversed = separate_short_values(impl_->take_valued_flags(impl_->take_repeated_options(words)));
    std::ranges::reverse(reversed);
    try {
        impl_->app.parse(reversed);
    } catch (const CLI::ArgumentMismatch&) {
        impl_->check_for_repeats();
        if (words.empty()) throw UsageError("usage: rawtexel " + impl_->usage);
        // The words ran out: the last one is the option that lacks its value.
        throw UsageError(option_name(words.back()) + ": a value is missing");
    } catch (const CLI::ParseError& error) {
        throw UsageError(std::string(error.what()) + " (usage: rawtexel " + impl_->usage + ")");
    }
    impl_->take_remaining(impl_->app.remaining());
    return true;
}

const std::vector<std::pair<std::string, std::string>>& CommandLine::given() const { return impl_->given; }

// "-o=FILE" becomes "-o FILE": the argument library would take "=FILE" for the value.
std::vector<std::string> CommandLine::separate_short_values(const std::vector<std::string>& words) const {
    std::vector<std::string> result;
    bool only_words = false;
    for (const std::string& word : words) {
        only_words = only_words || word == "--";
        const bool is_value = !result.empty() && takes_value(result.back());
        const bool joined = word.size() > 2 && word[0] == '-' && word[1] != '-' && word[2] == '=' && takes_value(word.substr(0, 2));
        if (joined && !only_words && !is_value) {
            result.push_back(word.substr(0, 2));
            result.push_back(word.substr(3));
        } else {
            result.push_back(word);
        }
    }
    return result;
}

bool CommandLine::takes_value(std::string_view option) const {
    if (!looks_like_option(option) || option.find('=') != std::string_view::npos) return false;
    const CLI::Option* found = impl_->app.get_option_no_throw(std::string(option));
    return found != nullptr && found->get_items_expected_max() > 0;
}

std::string CommandLine::help() const {
    std::string text = "Usage: rawtexel " + impl_->usage + "\n\n" + wrap_text(impl_->summary, kHelpWidth, 0) + "\n";
    const auto add = [&](const std::string& left, const std::string& right) {
        std::string line = "  " + left;
        if (line.size() + 2 > kHelpColumn)
            line += "\n" + std::string(kHelpColumn, ' ');
        else
            line.resize(kHelpColumn, ' ');
        text += line + wrap_text(right, kHelpWidth - kHelpColumn, kHelpColumn) + "\n";
    };
    if (impl_->entries.empty() || impl_->entries.front().heading.empty()) text += "\n";
    for (const Impl::HelpEntry& entry : impl_->entries) {
        if (!entry.heading.empty())
            text += "\n" + entry.heading + ":\n";
        else
            add(entry.left, entry.right);
    }
    text += "\n";
    add("-h,--help", "this text");
    add("--version", "the program's version");
    return text;
}

std::string wrap_text(std::string_view text, size_t width, size_t indent) {
    std::string result;
    size_t column = 0;
    for (const std::string& word : split(text, ' ')) {
        if (column > 0 && column + 1 + word.size() > width) {
            result += "\n" + std::string(indent, ' ');
            column = 0;
        }
        if (column > 0) {
            result += ' ';
            ++column;
        }
        result += word;
        column += word.size();
    }
    return result;
}

}  // namespace rawtexel::cli
