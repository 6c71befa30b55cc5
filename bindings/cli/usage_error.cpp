// The parser's own texts name its types and counts; these name what was typed.
#include "bindings/cli/usage_error.hpp"

#include <CLI/CLI.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::cli {
namespace {

std::string about_extras(const CLI::App& command, const std::vector<std::string>& extras) {
    const auto option = std::find_if(extras.begin(), extras.end(), [](const auto& word) { return word[0] == '-'; });
    if (option == extras.end()) return fmt::format("'{}' is one word too many", shown(extras.front()));
    std::vector<std::string> names;
    for (const CLI::Option* known : command.get_options()) {
        if (known->nonpositional()) names.push_back(known->get_name());
    }
    const std::string word = option->substr(0, option->find('='));
    return fmt::format("there is no option '{}'{}", shown(word), did_you_mean(word, {names.begin(), names.end()}));
}

}  // namespace

std::string usage_error(const CLI::App& app, const CLI::ParseError& error) {
    const auto commands = app.get_subcommands();
    const CLI::App& command = commands.empty() ? app : *commands.front();
    const std::string name = commands.empty() ? "nezumi" : "nezumi " + command.get_name();
    // A sub-command has commands of its own: `nezumi new behavior`.
    const auto inner = command.get_subcommands();
    const std::string help = fmt::format("; see {}{} --help", name,
                                         commands.empty() || inner.empty() ? "" : " " + inner.front()->get_name());
    const std::string_view text = error.what();
    const std::string_view subject = text.substr(0, text.find(": "));
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
        if (const auto extras = app.remaining(true); !extras.empty()) return about_extras(command, extras) + help;
    } else if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
        return fmt::format("{}: {}{}", subject,
                           text.find("At Most 1") != text.npos ? "is given more than once" : "a value is missing",
                           help);
    } else if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr && text.ends_with(" is required")) {
        return fmt::format("{} is missing{}", text.substr(0, text.find(' ')), help);
    }
    return std::string(text) + help;
}

}  // namespace nezumi::cli
