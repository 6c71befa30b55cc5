// The command line as data: commands, their options, what each is for. Parsing and --help come from it, and whatever
// else wants to know what can be typed.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bindings/cli/shell/option_checks.hpp"

namespace nezumi::cli {

/// A flag that may say more: "--hw" gives "true", "--hw=mouse" gives "mouse"; "" when it is not given.
struct FlagText {
    std::string text;
};

/// Where an option's value goes: given or not, a text, a text that may be empty, one text each time it is given, a
/// number, a number or none, a flag that may say more. What is there before is the default.
using OptionValue = std::variant<bool*, std::string*, std::optional<std::string>*, std::vector<std::string>*,
                                 std::uint64_t*, std::optional<std::uint64_t>*, double*, FlagText*>;

/// What a command does with the file that an option names.
enum class FileUse : unsigned char {
    none,    ///< the option names no file, or the command looks after it itself
    result,  ///< written: never a script, nor what another option writes or reads
    source,  ///< read
};

struct Option {
    /// "--seed" or "-o,--output"; without dashes it is known by its place: "FILE", or "[FILE]" when it may be left out.
    std::string name;
    OptionValue value;
    std::string help;
    std::string form = {};         ///< how a value is written: "N|max"
    OptionCheck check = {};        ///< of a text as it was typed; that none is empty is checked anyway
    FileUse file = FileUse::none;  ///< what is done with the file that it names
};

/// By which names an option is known: "-o" and "--output"; "FILE" where it is known by its place.
std::vector<std::string> names_of(const Option& option);
/// Whether it is known by its place.
bool is_positional(const Option& option);
/// Whether a value follows it.
bool takes_value(const Option& option);

struct SubCommand {
    std::string name;
    std::string help;
    std::vector<Option> options = {};
    std::function<int()> run = {};          ///< gives the exit status; none: one of `commands` has to be named
    std::string footer = {};                ///< below the options of its --help
    std::string alias = {};                 ///< another name
    std::vector<SubCommand> commands = {};  ///< below this one
    std::string version = {};               ///< what --version says; "" for no such option
};

/// Parses the words that follow the program's name, fills in the options of the command that they name, and runs it.
/// A slip is one plain line on standard error with the nearest name. Returns the exit status.
int run_command_line(const SubCommand& program, const std::vector<std::string>& words);

}  // namespace nezumi::cli
