// Writes the manual page with the macros of man(7): .TH, .SH, .TP and others.
#include "bindings/cli/shell/manual.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <type_traits>

namespace nezumi::cli {
namespace {

constexpr std::string_view status_begins = "Exit status: ";

// Escapes characters with a meaning in roff.
std::string plain(std::string_view text) {
    std::string out;
    bool line_begins = true;
    for (const char c : text) {
        if (line_begins && (c == '.' || c == '\'')) out += "\\&";
        switch (c) {
            case '\\': out += "\\e"; break;
            case '-': out += "\\-"; break;
            case '\'': out += "\\(aq"; break;
            case '`': out += "\\(ga"; break;
            case '~': out += "\\(ti"; break;
            case '^': out += "\\(ha"; break;
            default: out += c;
        }
        line_begins = c == '\n';
    }
    return out;
}

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); });
    return text;
}

// "-o, --output DIR"
std::string heading(const Option& option) {
    const std::vector<std::string> names = names_of(option);
    if (is_positional(option)) return fmt::format("\\fI{}\\fR", plain(names.front()));
    std::vector<std::string> shown(names.size());
    std::transform(names.begin(), names.end(), shown.begin(),
                   [](const auto& name) { return "\\fB" + plain(name) + "\\fR"; });
    std::string text = fmt::format("{}", fmt::join(shown, ", "));
    if (std::holds_alternative<FlagText*>(option.value)) text += "[=\\fINAME\\fR,...]";
    if (takes_value(option) && !option.form.empty()) text += " \\fI" + plain(option.form) + "\\fR";
    return text;
}

// The default, if --help shows it too.
std::string default_of(const Option& option) {
    return std::visit(
        [](const auto* value) -> std::string {
            if constexpr (requires { *value + 1.0; } && !std::is_same_v<decltype(value), const bool*>) {
                return fmt::format(" (default: {})", *value);
            } else if constexpr (std::is_same_v<decltype(value), const std::string*>) {
                return value->empty() ? "" : fmt::format(" (default: {})", *value);
            } else {
                return "";
            }
        },
        option.value);
}

std::string synopsis(const std::string& path, const SubCommand& command) {
    std::string line = fmt::format(".B {}\n", plain(path));
    const bool has_options = std::any_of(command.options.begin(), command.options.end(),
                                         [](const Option& option) { return !is_positional(option); });
    if (!command.commands.empty()) line += ".I COMMAND\n";
    for (const Option& option : command.options) {
        if (!is_positional(option)) continue;
        const bool repeats = std::holds_alternative<std::vector<std::string>*>(option.value);
        const std::string name = plain(names_of(option).front()) + (repeats ? "..." : "");
        line += option.name.starts_with('[') ? fmt::format(".RI [ {} ]\n", name) : fmt::format(".I {}\n", name);
    }
    if (has_options) line += ".RI [ OPTIONS ]\n";
    return line;
}

std::string list_of(const std::vector<Option>& options) {
    std::string text;
    for (const Option& option : options)
        text += fmt::format(".TP\n{}\n{}\n", heading(option), plain(option.help + default_of(option)));
    return text;
}

// A command's footer, without its part about exit statuses.
std::string remarks(const SubCommand& command) {
    const std::string text = command.footer.substr(0, command.footer.find(status_begins));
    return text.empty() ? "" : ".PP\n" + plain(text) + (text.ends_with('\n') ? "" : "\n");
}

std::string status_of(const SubCommand& command) {
    const std::size_t at = command.footer.find(status_begins);
    if (at == std::string::npos) return "";
    return fmt::format(".SH EXIT STATUS\n{}\n", plain(command.footer.substr(at + status_begins.size())));
}

std::string begin(const std::string& name, const std::string& version, const std::string& help) {
    // The help "nezumi runs ..." becomes "nezumi - runs ...".
    std::string what = help.starts_with(name + " ") ? help.substr(name.size() + 1) : help;
    if (what.size() > 1 && std::islower(static_cast<unsigned char>(what[1])) != 0)
        what[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(what[0])));
    return fmt::format(".TH {} 1 \"\" \"{}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n", upper(plain(name)), version,
                       plain(name), plain(what));
}

ManualPage page_of(const SubCommand& program, const SubCommand& command) {
    const std::string name = program.name + "-" + command.name;
    const std::string path = program.name + " " + command.name;
    std::string text = begin(name, program.version, command.help) + ".SH SYNOPSIS\n";
    if (command.run) text += synopsis(path, command);
    for (std::size_t i = 0; i < command.commands.size(); ++i) {
        if (i > 0 || command.run) text += ".br\n";
        text += synopsis(path + " " + command.commands[i].name, command.commands[i]);
    }
    text += fmt::format(".SH DESCRIPTION\n{}.\n{}", plain(command.help), remarks(command));
    if (!command.options.empty()) text += ".SH OPTIONS\n" + list_of(command.options);
    for (const SubCommand& below : command.commands) {
        text += fmt::format(".SH {}\n{}.\n{}{}", upper(plain(path + " " + below.name)), plain(below.help),
                            list_of(below.options), remarks(below));
    }
    text += status_of(command.commands.empty() ? command : command.commands.front());
    return {name + ".1", text + fmt::format(".SH SEE ALSO\n.BR {} (1)\n", plain(program.name))};
}

}  // namespace

std::vector<ManualPage> manual_pages(const SubCommand& program) {
    std::string text =
        begin(program.name, program.version, program.help) + ".SH SYNOPSIS\n" + synopsis(program.name, program);
    text += fmt::format(".SH DESCRIPTION\n{}.\n{}.SH COMMANDS\n", plain(program.help), remarks(program));
    std::string others;
    std::vector<ManualPage> pages(1);
    for (const SubCommand& command : program.commands) {
        text += fmt::format(".TP\n.B {}\n{}\n", plain(command.name), plain(command.help));
        others += fmt::format("{}.BR {} (1)", others.empty() ? "" : ",\n", plain(program.name + "-" + command.name));
        pages.push_back(page_of(program, command));
    }
    pages.front() = {program.name + ".1", text + status_of(program) + ".SH SEE ALSO\n" + others + "\n"};
    return pages;
}

}  // namespace nezumi::cli
