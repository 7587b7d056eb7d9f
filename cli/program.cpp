#include "cli/program.h"

#include "cli/command.h"
#include "cli/commands/bench.h"
#include "cli/commands/compare.h"
#include "cli/commands/explain.h"
#include "cli/commands/export.h"
#include "cli/commands/list.h"
#include "cli/commands/profile.h"
#include "cli/commands/render.h"
#include "cli/commands/sample.h"
#include "cli/commands/texture.h"
#include "cli/commands/vectors.h"
#include "cli/commands/verify_shader.h"
#include "cli/run_record.h"
#include "cli/version.h"
#include "cli/word_list.h"
#include "scenes/image_io.h"
#include "scenes/load.h"
#include "scenes/message_text.h"
#include "scenes/spelling.h"
#include "texunit/texel_source.h"

#include <algorithm>
#include <array>
#include <memory>
#include <new>
#include <optional>

namespace rawtexel::cli {
namespace {

using Words = std::vector<std::string>;
using Commands = std::array<std::unique_ptr<Command>, 11>;

Commands all_commands() {
    return {make_render_command(),  make_profile_command(), make_bench_command(),        make_compare_command(),
            make_explain_command(), make_sample_command(),  make_texture_command(),      make_list_command(),
            make_export_command(),  make_vectors_command(), make_verify_shader_command()};
}

std::vector<std::string> names_of(const Commands& commands) {
    std::vector<std::string> names;
    for (const auto& command : commands) names.emplace_back(command->name());
    return names;
}

CommandLine& declare(CommandLine& line, Command& command) {
    command.declare(line);
    return line;
}

constexpr size_t kCommandColumn = 18;  ///< where the help's texts begin

std::string program_help(const Commands& commands) {
    std::string text = "Usage: rawtexel COMMAND ...\n\nA software rasterizer whose subject is the texture unit.\n\nCommands:\n";
    for (const auto& command : commands) {
        std::string left = "  " + std::string(command->name());
        left.resize(kCommandColumn, ' ');
        text += left + wrap_text(command->summary(), 110 - kCommandColumn, kCommandColumn) + "\n";
    }
    return text +
           "  help            This text, or that of a command: `rawtexel help COMMAND`, or `rawtexel COMMAND --help`.\n"
           "\nThe order of words does not matter.\n\n"
           "Options:\n  -h,--help   this text\n  --version   the program's version\n\n"
           "Exit codes: 0 done, 1 a check asked for did not hold, 2 wrong usage, 3 input could not be read or is invalid,\n"
           "            4 output could not be written.\n";
}

bool takes_value(std::string_view option, const Commands& commands) {
    return std::ranges::any_of(commands, [&](const auto& command) {
        CommandLine line{"", ""};
        return declare(line, *command).takes_value(option);
    });
}

// The command is the first word that names one and is not the value of the option before it: options may come first.
std::optional<size_t> find_command_word(const Words& words, const Commands& commands, size_t& which) {
    for (size_t i = 0; i < words.size(); ++i) {
        const auto found = std::ranges::find(commands, words[i], [](const auto& command) { return command->name(); });
        if (found == commands.end() || (i > 0 && takes_value(words[i - 1], commands))) continue;
        which = size_t(found - commands.begin());
        return i;
    }
    return std::nullopt;
}

[[noreturn]] void throw_no_command(const Words& words, const Commands& commands) {
    Words names = names_of(commands);
    names.emplace_back("help");
    const auto named = std::ranges::find_if(words, [](const std::string& word) { return !word.starts_with('-'); });
    if (named != words.end())
        throw UsageError("unknown command '" + *named + "', the nearest is '" + scenes::nearest_spelling(*named, names) + "' (" +
                         join(names, " ") + ")");
    if (words.empty()) throw UsageError("no command given; `rawtexel --help` lists them");
    throw UsageError("unknown option '" + words[0] + "', the nearest is '" +
                     scenes::nearest_spelling(words[0], Words{"--help", "--version"}) + "'");
}

int help_on(const Words& subjects, const Invocation& invocation, const Commands& commands) {
    if (subjects.size() > 1) throw UsageError("unexpected argument '" + subjects[1] + "' (usage: rawtexel help [COMMAND])");
    if (subjects.empty() || subjects[0] == "--help" || subjects[0] == "-h" || subjects[0] == "help") {
        invocation.out << program_help(commands);
        return kDone;
    }
    const auto command = std::ranges::find(commands, subjects[0], [](const auto& each) { return each->name(); });
    if (command == commands.end()) throw_no_command(subjects, commands);
    CommandLine line{std::string((*command)->usage()), std::string((*command)->summary())};
    invocation.out << declare(line, **command).help();
    return kDone;
}

int dispatch(const Words& words, const Invocation& invocation) {
    const Commands commands = all_commands();
    const auto given = [&](std::string_view word) { return std::ranges::find(words, word) != words.end(); };
    if (given("--version")) {
        invocation.out << "rawtexel " << version() << '\n';
        return kDone;
    }
    if (!words.empty() && words[0] == "help") return help_on({words.begin() + 1, words.end()}, invocation, commands);

    size_t which = 0;
    const std::optional<size_t> at = find_command_word(words, commands, which);
    if (!at) {
        if (!given("--help") && !given("-h")) throw_no_command(words, commands);
        return help_on({}, invocation, commands);
    }
    Words rest = words;
    rest.erase(rest.begin() + std::ptrdiff_t(*at));
    Command& command = *commands[which];
    CommandLine line{std::string(command.usage()), std::string(command.summary())};
    if (declare(line, command).parse(rest)) return command.run(invocation);
    invocation.out << line.help();
    return kDone;
}

int fail(std::ostream& err, ExitCode code, const std::string& what) {
    err << "rawtexel: error: " << scenes::one_line(what) << '\n' << std::flush;
    return code;
}

Words with_program_name(const Words& words) {
    Words all{"rawtexel"};
    all.insert(all.end(), words.begin(), words.end());
    return all;
}

}  // namespace

int run_program(const Words& words, std::ostream& out, std::ostream& err, bool err_is_terminal) {
    try {
        const int code = dispatch(words, {shell_quoted(with_program_name(words)), out, err, err_is_terminal});
        if (!out.flush()) return fail(err, kCannotWrite, "standard output: cannot be written");
        return code;
    } catch (const UsageError& error) {
        return fail(err, kWrongUsage, error.what());
    } catch (const scenes::OutputError& error) {
        return fail(err, kCannotWrite, error.what());
    } catch (const scenes::InputError& error) {
        return fail(err, kBadInput, error.what());
    } catch (const texunit::TextureError& error) {
        return fail(err, kBadInput, error.what());
    } catch (const std::bad_alloc&) {
        return fail(err, kBadInput, "the input needs more memory than there is");
    } catch (const std::exception& error) {
        // Nothing else is expected; what fails here was brought up by the input.
        return fail(err, kBadInput, std::string("unexpected: ") + error.what());
    }
}

void warn(const Invocation& invocation, const std::string& what) {
    invocation.err << "rawtexel: warning: " << scenes::one_line(what) << '\n' << std::flush;
}

}  // namespace rawtexel::cli
