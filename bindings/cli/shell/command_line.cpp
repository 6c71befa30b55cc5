// The only file that includes CLI11, which takes long to compile. CLI11's error messages show internal types and
// counts; these show the typed words.
#include "bindings/cli/shell/command_line.hpp"

#include <CLI/CLI.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <type_traits>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/shell/command_checks.hpp"
#include "engine/base/error.hpp"

namespace nezumi::cli {
namespace {

template <class Value>
CLI::Option* add_option(CLI::App& app, const std::string& name, Value* value, const std::string& help) {
    if constexpr (std::is_same_v<Value, bool>) {
        return app.add_flag(name, *value, help);
    } else if constexpr (std::is_same_v<Value, FlagText>) {
        return app.add_flag(name, value->text, help);
    } else {
        CLI::Option* const option = app.add_option(name, *value, help);
        if constexpr (std::is_same_v<Value, std::vector<std::string>>) {
            // In `--in a --in b` each option takes one value; further words belong to other options.
            if (option->nonpositional()) option->allow_extra_args(false);
        }
        return option;
    }
}

// "=8765": the default in --help; CLI11's versions differ in its form.
template <class Value>
std::string default_text(const Value* value) {
    if constexpr (std::is_arithmetic_v<Value> && !std::is_same_v<Value, bool>) {
        return fmt::format("={}", *value);
    } else if constexpr (std::is_same_v<Value, std::string>) {
        return value->empty() ? "" : "=" + *value;
    } else {
        return "";
    }
}

void declare(CLI::App& app, const Option& option) {
    const bool may_be_missing = option.name.starts_with('[') || !is_positional(option);
    const std::string name = fmt::format("{}", fmt::join(names_of(option), ","));
    CLI::Option* const declared =
        std::visit([&](auto* value) { return add_option(app, name, value, option.help); }, option.value);
    declared->required(!may_be_missing);
    if (!takes_value(option)) return;
    declared->type_name(option.form + std::visit([](const auto* value) { return default_text(value); }, option.value));
    if (declared->nonpositional() && !std::holds_alternative<std::optional<std::string>*>(option.value))
        declared->check(not_empty);
    if (option.check) declared->check(option.check);
}

void declare(CLI::App& app, const SubCommand& command) {
    for (const Option& option : command.options) declare(app, option);
    for (const SubCommand& below : command.commands) {
        CLI::App* const inner = app.add_subcommand(below.name, below.help);
        if (!below.alias.empty()) inner->alias(below.alias);
        declare(*inner, below);
    }
    if (!command.version.empty()) app.set_version_flag("--version", command.version);
    app.footer(command.footer);
}

const SubCommand* find_command(const SubCommand& command, std::string_view word) {
    for (const SubCommand& below : command.commands) {
        if (word == below.name || (!below.alias.empty() && word == below.alias)) return &below;
    }
    return nullptr;
}

// The error for a missing or unknown command below `command`, with suggestions. `path` is "" for the program.
std::string no_command(const SubCommand& command, const std::string& path, const std::string* word) {
    std::vector<std::string_view> names;
    for (const SubCommand& below : command.commands) names.push_back(below.name);
    if (path.empty()) {
        return (word ? fmt::format("there is no command '{}'{}", shown(*word), did_you_mean(*word, names))
                     : fmt::format("a command is missing: see {} --help", command.name)) +
               fmt::format("; known are {}", fmt::join(names, ", "));
    }
    std::vector<std::string> forms;
    for (const SubCommand& below : command.commands) {
        std::string form = fmt::format("`nezumi{} {}", path, below.name);
        for (const Option& option : below.options) {
            if (is_positional(option)) form += " " + option.name;
        }
        forms.push_back(form + "`");
    }
    return (word ? fmt::format("{}: there is no '{}'{}. ", path.substr(1), shown(*word), did_you_mean(*word, names))
                 : fmt::format("{}: a command is missing. ", path.substr(1))) +
           fmt::format("Write {}{}{}", fmt::join(forms.begin(), forms.end() - 1, ", "), forms.size() > 1 ? " or " : "",
                       forms.back());
}

std::string about_extras(const CLI::App& command, const std::vector<std::string>& extras) {
    const auto option = std::find_if(extras.begin(), extras.end(), [](const auto& word) { return word[0] == '-'; });
    if (option == extras.end()) return fmt::format("'{}' is one argument too many", shown(extras.front()));
    std::vector<std::string> names;
    for (const CLI::Option* known : command.get_options()) {
        if (known->nonpositional()) names.push_back(known->get_name());
    }
    const std::string word = option->substr(0, option->find('='));
    return fmt::format("there is no option '{}'{}", shown(word), did_you_mean(word, {names.begin(), names.end()}));
}

// The parser's error in one sentence.
std::string usage_error(const CLI::App& app, const CLI::App& command, const CLI::ParseError& error) {
    const std::string_view text = error.what();
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
        if (const auto extras = app.remaining(true); !extras.empty()) return about_extras(command, extras);
    } else if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
        return fmt::format("{}: {}", text.substr(0, text.find(": ")),
                           text.find("At Most 1") != text.npos ? "is given more than once" : "a value is missing");
    } else if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr && text.ends_with(" is required")) {
        // A misspelt option is reported first, because it may have been taken for another argument.
        const auto extras = app.remaining(true);
        if (std::any_of(extras.begin(), extras.end(), [](const auto& word) { return word.starts_with('-'); }))
            return about_extras(command, extras);
        return fmt::format("{} is missing", text.substr(0, text.find(' ')));
    }
    return std::string(text);
}

}  // namespace

std::vector<std::string> names_of(const Option& option) {
    const std::string& name = option.name;
    if (name.starts_with('[')) return {name.substr(1, name.size() - 2)};
    const std::size_t comma = name.find(',');
    if (comma == std::string::npos) return {name};
    return {name.substr(0, comma), name.substr(comma + 1)};
}

bool is_positional(const Option& option) { return !option.name.starts_with('-'); }

bool takes_value(const Option& option) {
    return !std::holds_alternative<bool*>(option.value) && !std::holds_alternative<FlagText*>(option.value);
}

int run_command_line(const SubCommand& program, const std::vector<std::string>& words) {
    // Commands are searched here: CLI11 would call an unknown one an unexpected argument.
    const SubCommand* command = &program;
    std::string path;
    std::size_t depth = 0;
    for (const std::string& word : words) {
        if (command->commands.empty() || word.starts_with('-')) break;
        const SubCommand* const below = find_command(*command, word);
        if (below == nullptr) return refuse(no_command(*command, path, &word));
        command = below;
        path += " " + command->name;
        ++depth;
    }
    const auto refuse_usage = [&](const std::string& why) {
        return refuse(fmt::format("{}; see {}{} --help", why, program.name, path));
    };
    const std::vector<std::string> own(words.begin() + static_cast<std::ptrdiff_t>(depth), words.end());
    if (const std::string why = missing_value(*command, own); !why.empty()) return refuse_usage(why);

    CLI::App app{program.help, program.name};
    declare(app, program);
    try {
        app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // parse() takes words from the back
    } catch (const CLI::Success& asked) {                                   // --help, --version
        return app.exit(asked);
    } catch (const CLI::ParseError& error) {
        const CLI::App* innermost = &app;
        while (!innermost->get_subcommands().empty()) innermost = innermost->get_subcommands().front();
        return refuse_usage(usage_error(app, *innermost, error));
    }
    if (const std::string why = lost_file(*command); !why.empty()) return refuse(why);
    return command->run ? command->run() : refuse(no_command(*command, path, nullptr));
}

}  // namespace nezumi::cli
