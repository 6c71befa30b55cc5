// All three scripts work alike: they go from command to sub-command along the line to its "place" ("nezumi new
// behavior"), and offer the words that are possible there.
#include "bindings/cli/shell/completion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cctype>

namespace nezumi::cli {
namespace {

// A command and the words that lead to it.
struct At {
    std::string place;
    const SubCommand* command;
};

// The program and all its commands, outer ones first.
std::vector<At> all_places(const SubCommand& command, const std::string& above = "") {
    const std::string place = above.empty() ? command.name : above + " " + command.name;
    std::vector<At> all{{place, &command}};
    for (const SubCommand& below : command.commands) {
        for (At& at : all_places(below, place)) all.push_back(std::move(at));
    }
    return all;
}

// Each step from a place by a word to the next place; an alias has the same target as the name.
struct Step {
    std::string from_and_word;
    std::string to;
};

std::vector<Step> all_steps(const SubCommand& program) {
    std::vector<Step> steps;
    for (const At& at : all_places(program)) {
        for (const SubCommand& below : at.command->commands) {
            const std::string to = at.place + " " + below.name;
            steps.push_back({to, to});
            if (!below.alias.empty()) steps.push_back({at.place + " " + below.alias, to});
        }
    }
    return steps;
}

std::vector<Option> options_at(const SubCommand& command) {
    static bool unused = false;
    std::vector<Option> options = command.options;
    options.push_back({"-h,--help", &unused, "list what can be typed here"});
    if (!command.version.empty()) options.push_back({"--version", &unused, "show the version"});
    return options;
}

// Puts a backslash before each of these characters.
std::string escaped(std::string_view text, std::string_view special) {
    std::string out;
    for (const char c : text) {
        if (special.find(c) != std::string_view::npos) out += '\\';
        out += c;
    }
    return out;
}

// In single quotes for bash and zsh.
std::string shell_quoted(std::string_view text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

// In fish the backslash has a meaning within single quotes.
std::string fish_quoted(std::string_view text) { return "'" + escaped(text, "\\'") + "'"; }

std::string bash_script(const SubCommand& program) {
    std::string steps;
    for (const Step& step : all_steps(program)) {
        steps += fmt::format("            {}) place={} ;;\n", shell_quoted(step.from_and_word), shell_quoted(step.to));
    }
    std::string places;
    for (const At& at : all_places(program)) {
        std::vector<std::string> words, options;
        std::string values;
        bool files = false;
        for (const SubCommand& below : at.command->commands) words.push_back(below.name);
        for (const Option& option : options_at(*at.command)) {
            const ValueWords value = value_words(option);
            if (is_positional(option)) {
                files = files || value.files;
                words.insert(words.end(), value.words.begin(), value.words.end());
                continue;
            }
            const std::vector<std::string> names = names_of(option);
            options.insert(options.end(), names.begin(), names.end());
            if (!takes_value(option)) continue;
            values +=
                fmt::format("                {}) words={} options='' files={} ;;\n", fmt::join(names, "|"),
                            shell_quoted(fmt::format("{}", fmt::join(value.words, " "))), value.files ? "yes" : "''");
        }
        places += fmt::format("        {})\n            words={} options={} files={}\n", shell_quoted(at.place),
                              shell_quoted(fmt::format("{}", fmt::join(words, " "))),
                              shell_quoted(fmt::format("{}", fmt::join(options, " "))), files ? "yes" : "''");
        if (!values.empty()) places += fmt::format("            case $before in\n{}            esac\n", values);
        places += "            ;;\n";
    }
    return fmt::format(R"bash(# Completion of nezumi's command line by bash, as `nezumi completion bash` writes it.
_nezumi() {{
    local place={0} word words options files at=$COMP_CWORD
    for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
        case "$place $word" in
{1}        esac
    done
    # bash splits --option=value into three words.
    local current=${{COMP_WORDS[at]}}
    [[ $current == "=" ]] && current= && ((++at))
    [[ ${{COMP_WORDS[at-1]}} == "=" ]] && ((--at))
    local before=${{COMP_WORDS[at-1]}}
    case $place in
{2}    esac
    [[ $current == -* ]] && words=$options files=
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
    if [[ $files ]]; then
        compopt -o filenames 2>/dev/null
        mapfile -t -O "${{#COMPREPLY[@]}}" COMPREPLY < <(compgen -f -- "$current")
    fi
}}
complete -F _nezumi nezumi
)bash",
                       program.name, steps, places);
}

std::string zsh_action(const ValueWords& value) {
    if (value.files) return "_files";
    return value.words.empty() ? " " : fmt::format("({})", fmt::join(value.words, " "));
}

// "*--in[an in-port]:name\:Type: ": the format of _arguments.
std::vector<std::string> zsh_arguments(const Option& option) {
    const auto label = [](std::string_view text) { return escaped(text, "\\:"); };
    const ValueWords value = value_words(option);
    const bool repeats = std::holds_alternative<std::vector<std::string>*>(option.value);
    if (is_positional(option)) {
        const std::string name = label(names_of(option).front());
        return {fmt::format("{}:{}:{}",
                            repeats                        ? "*"
                            : option.name.starts_with('[') ? ":"
                                                           : "",
                            name, zsh_action(value))};
    }
    std::vector<std::string> arguments;
    for (const std::string& name : names_of(option)) {
        const bool joined = takes_value(option) && name.starts_with("--");
        std::string text =
            fmt::format("{}{}{}[{}]", repeats ? "*" : "", name, joined ? "=" : "", escaped(option.help, "\\[]"));
        if (takes_value(option))
            text += fmt::format(":{}:{}", label(option.form.empty() ? "value" : option.form), zsh_action(value));
        arguments.push_back(std::move(text));
    }
    return arguments;
}

std::string zsh_script(const SubCommand& program) {
    std::string steps;
    for (const Step& step : all_steps(program)) {
        steps += fmt::format("            ({}) place={}; (( ++depth )) ;;\n", shell_quoted(step.from_and_word),
                             shell_quoted(step.to));
    }
    std::string places;
    for (const At& at : all_places(program)) {
        places += fmt::format("        ({})\n", shell_quoted(at.place));
        if (!at.command->commands.empty()) {
            places += "            commands=(\n";
            for (const SubCommand& below : at.command->commands) {
                places +=
                    fmt::format("                {}\n", shell_quoted(below.name + ":" + escaped(below.help, "\\:")));
            }
            places +=
                "            )\n"
                "            if [[ $PREFIX != -* ]]; then\n"
                "                _describe -t commands command commands\n"
                "                return\n"
                "            fi\n";
        }
        places += "            _arguments";
        for (const Option& option : options_at(*at.command)) {
            for (const std::string& argument : zsh_arguments(option))
                places += fmt::format(" \\\n                {}", shell_quoted(argument));
        }
        places += "\n            ;;\n";
    }
    return fmt::format(R"zsh(#compdef nezumi
# Completion of nezumi's command line by zsh, as `nezumi completion zsh` writes it.
_nezumi() {{
    local place={0} word
    local -a commands
    integer depth=0
    for word in "${{(@)words[2,CURRENT-1]}}"; do
        case "$place $word" in
{1}            (*) break ;;
        esac
    done
    # What is left begins with the innermost command, as _arguments wants it.
    shift $depth words
    (( CURRENT -= depth ))
    case $place in
{2}    esac
}}
if [[ $funcstack[1] == _nezumi ]]; then
    _nezumi "$@"
else
    compdef _nezumi nezumi
fi
)zsh",
                       program.name, steps, places);
}

std::string fish_script(const SubCommand& program) {
    std::string steps;
    for (const Step& step : all_steps(program)) {
        steps += fmt::format("            case {}\n                set place {}\n", fish_quoted(step.from_and_word),
                             fish_quoted(step.to));
    }
    std::string offers;
    for (const At& at : all_places(program)) {
        const std::string begin =
            fmt::format("complete -c nezumi -n {}", fish_quoted("__nezumi_is " + fish_quoted(at.place)));
        for (const SubCommand& below : at.command->commands)
            offers += fmt::format("{} -a {} -d {}\n", begin, below.name, fish_quoted(below.help));
        for (const Option& option : options_at(*at.command)) {
            const ValueWords value = value_words(option);
            std::string words;
            if (!value.words.empty()) words = " -a " + fish_quoted(fmt::format("{}", fmt::join(value.words, " ")));
            if (is_positional(option)) {
                if (value.files) offers += begin + " -F\n";
                if (!words.empty()) offers += begin + words + "\n";
                continue;
            }
            offers += begin;
            for (const std::string& name : names_of(option)) {
                offers += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
            }
            if (takes_value(option)) offers += value.files ? " -r -F" : " -x" + words;
            offers += fmt::format(" -d {}\n", fish_quoted(option.help));
        }
    }
    return fmt::format(R"fish(# Completion of nezumi's command line by fish, as `nezumi completion fish` writes it.
function __nezumi_is
    set -l place {0}
    for word in (commandline -opc)[2..-1]
        switch "$place $word"
{1}        end
    end
    test "$place" = "$argv[1]"
end
complete -c nezumi -f
{2})fish",
                       program.name, steps, offers);
}

}  // namespace

ValueWords value_words(const Option& option) {
    ValueWords value;
    if (!takes_value(option)) return value;
    std::string form = is_positional(option) && option.form.empty() ? names_of(option).front() : option.form;
    for (const std::string_view file : {"FILE", "DIR", "PATH", "OUT"}) {
        if (form.starts_with(file)) value.files = true;
    }
    if (value.files) return value;
    // The literal words of "N|max".
    while (!form.empty()) {
        const std::string word = form.substr(0, form.find('|'));
        form.erase(0, word.size() + 1);
        const bool is_word = !word.empty() && std::all_of(word.begin(), word.end(), [](char c) {
            return c == '-' || std::islower(static_cast<unsigned char>(c)) != 0;
        });
        if (is_word) value.words.push_back(word);
    }
    if (value.words.size() == 1 && option.form == value.words.front()) value.words.clear();  // "name": any text
    return value;
}

const std::vector<std::string_view>& completed_shells() {
    static const std::vector<std::string_view> shells{"bash", "zsh", "fish"};
    return shells;
}

std::string completion_script(const SubCommand& program, std::string_view shell) {
    if (shell == "bash") return bash_script(program);
    if (shell == "zsh") return zsh_script(program);
    assert(shell == "fish");
    return fish_script(program);
}

}  // namespace nezumi::cli
