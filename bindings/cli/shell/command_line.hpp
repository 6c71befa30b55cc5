// The command line as data: commands, options and their descriptions. Parsing, --help, completion and the manual are
// derived from it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace nezumi::cli {

/// Returns the error in words that follow the option's name, or "".
using OptionCheck = std::function<std::string(const std::string&)>;

/// Accepts an integer within this range; `most_text` is the text of the largest value.
OptionCheck whole_number(std::uint64_t least, std::uint64_t most, const std::string& most_text);

/// Accepts a number within this range.
OptionCheck number_from(double least, double most);

/// Refuses an empty value, which is usually a mistake, such as a shell variable that is not set.
std::string not_empty(const std::string& text);

/// A flag with an optional value: "--hw" gives "true", "--hw=mouse" gives "mouse"; "" if it is not given.
struct FlagText {
    std::string text;
};

/// The target of an option's value: given or not, a text, a text that may be empty, one text for each time it is given,
/// a number, an optional number, a flag with an optional value. The value before parsing is the default.
using OptionValue = std::variant<bool*, std::string*, std::optional<std::string>*, std::vector<std::string>*,
                                 std::uint64_t*, std::optional<std::uint64_t>*, double*, FlagText*>;

/// What a command does with the file of an option.
enum class FileUse : unsigned char {
    none,    ///< the option names no file, or the command checks it itself
    result,  ///< written: must not be a script, nor a file of another option
    source,  ///< read
};

struct Option {
    /// "--seed" or "-o,--output"; a positional argument has no dashes: "FILE", or "[FILE]" if it is optional.
    std::string name;
    OptionValue value;
    std::string help;
    std::string form = {};         ///< the form of a value: "N|max"
    OptionCheck check = {};        ///< of the typed text; an empty text is refused in any case
    FileUse file = FileUse::none;  ///< what is done with its file
};

/// The names of an option: "-o" and "--output"; "FILE" for a positional argument.
std::vector<std::string> names_of(const Option& option);
/// True for a positional argument.
bool is_positional(const Option& option);
/// True if a value follows the option.
bool takes_value(const Option& option);

struct SubCommand {
    std::string name;
    std::string help;
    std::vector<Option> options = {};
    std::function<int()> run = {};          ///< returns the exit status; if none, one of `commands` must be given
    std::string footer = {};                ///< below the options in --help
    std::string alias = {};                 ///< another name
    std::vector<SubCommand> commands = {};  ///< sub-commands
    std::string version = {};               ///< the output of --version; "" for no such option
};

/// Parses the words after the program's name, sets the options of the command, and runs it. An error is one line on
/// standard error with the most similar name. Returns the exit status.
int run_command_line(const SubCommand& program, const std::vector<std::string>& words);

}  // namespace nezumi::cli
