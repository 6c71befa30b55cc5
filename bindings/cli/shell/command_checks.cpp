// Detects forgotten values and repeated names before anything is written. Values are checked here, because the messages
// of the parser CLI11 name its internal types.
#include "bindings/cli/shell/command_checks.hpp"

#include <fmt/format.h>

#include <cctype>
#include <filesystem>
#include <system_error>

#include "engine/base/error.hpp"
#include "engine/base/list.hpp"
#include "engine/base/number_in.hpp"

namespace nezumi::cli {
namespace {

const Option* find_option(const SubCommand& command, const std::string& word) {
    for (const Option& option : command.options) {
        const auto names = names_of(option);
        if (!is_positional(option) && contains(names, word)) return &option;
    }
    return nullptr;
}

// True for "--trace-hash", known or not; a Lua comment, as in --eval '-- none', is not an option.
bool is_option(const SubCommand& command, const std::string& word) {
    const bool is_long = word.size() > 2 && word.starts_with("--") &&
                         std::isalpha(static_cast<unsigned char>(word[2])) &&
                         word.find_first_of(" \t\n") == std::string::npos;
    return is_long || word == "-h" || find_option(command, word) != nullptr;
}

std::string file_of(const Option& option) {
    const auto* const text = std::get_if<std::string*>(&option.value);
    return text != nullptr ? **text : "";
}

// A path without links, also if the file does not exist yet.
std::filesystem::path place_of(const std::string& file) {
    std::error_code problem;
    auto place = std::filesystem::weakly_canonical(std::filesystem::absolute(file, problem), problem);
    return problem ? std::filesystem::path(file) : place;
}

// False for devices and pipes: writing destroys nothing there.
bool is_lost_by_writing(const std::string& file) {
    std::error_code none;
    const auto status = std::filesystem::status(file, none);
    return std::filesystem::is_regular_file(status) || !std::filesystem::exists(status);
}

bool is_same(const std::string& a, const std::string& b) {
    std::error_code none;
    return place_of(a) == place_of(b) || std::filesystem::equivalent(a, b, none);
}

}  // namespace

std::string missing_value(const SubCommand& command, const std::vector<std::string>& words) {
    for (std::size_t i = 0; i + 1 < words.size() && words[i] != "--"; ++i) {
        const Option* const option = find_option(command, words[i]);
        if (option == nullptr || !takes_value(*option)) continue;
        const std::string& value = words[++i];
        if (is_option(command, value))
            return fmt::format("{}: expected a value, got the option {}", words[i - 1], shown(value));
    }
    return "";
}

std::string lost_file(const SubCommand& command) {
    for (const Option& option : command.options) {
        const std::string file = file_of(option);
        if (option.file != FileUse::result || file.empty() || !is_lost_by_writing(file)) continue;
        const std::string name = names_of(option).back();
        if (file.ends_with(".lua") || place_of(file).extension() == ".lua")
            return fmt::format(
                "{}: '{}' is the name of a script, which the output would overwrite: choose another ending", name,
                shown(file));
        for (const Option& other : command.options) {
            if (&other == &option || other.file == FileUse::none || file_of(other).empty()) continue;
            if (!is_same(file, file_of(other))) continue;
            // A source that is not a file may be a name, such as that of a system.
            if (other.file == FileUse::source && !std::filesystem::exists(file)) continue;
            return other.file == FileUse::result
                       ? fmt::format("{} and {} would write the same file, '{}': give each its own", name,
                                     names_of(other).back(), shown(file))
                       : fmt::format("{} would write over '{}', which {} reads: give it another file", name,
                                     shown(file), names_of(other).back());
        }
    }
    return "";
}

OptionCheck whole_number(std::uint64_t least, std::uint64_t most, const std::string& most_text) {
    return [least, most, most_text](const std::string& text) -> std::string {
        const auto number = number_in<std::uint64_t>(text);
        if (number && *number >= least && *number <= most) return "";
        return fmt::format("expected a whole number from {} to {}, got '{}'", least, most_text, shown(text));
    };
}

OptionCheck number_from(double least, double most) {
    return [least, most](const std::string& text) -> std::string {
        const auto number = number_in<double>(text);
        if (number && *number >= least && *number <= most) return "";
        return fmt::format("expected a number from {} to {}, got '{}'", least, most, shown(text));
    };
}

std::string not_empty(const std::string& text) { return text.empty() ? "expected a value, got ''" : ""; }

}  // namespace nezumi::cli
