// nezumi: parses the command line and runs the sub-command that it names.
#include <CLI/CLI.hpp>

#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/cli/commands.hpp"
#include "bindings/cli/environment.hpp"
#include "bindings/cli/usage_error.hpp"

using namespace nezumi;

namespace {

// The first word that is no option, when it is none of the sub-commands: what CLI11 would call an unexpected argument.
std::string unknown_command(const CLI::App& app, int count, char** words) {
    std::vector<std::string_view> names;
    std::vector<std::string> owned;
    for (const CLI::App* command : app.get_subcommands({})) owned.push_back(command->get_name());
    names.assign(owned.begin(), owned.end());
    if (count < 2 || words[1][0] == '-') return "";
    const std::string_view word = words[1];
    for (const std::string_view name : names) {
        if (name == word) return "";
    }
    std::string text = "there is no command '" + shown(word) + "'" + did_you_mean(word, names) + "; known are";
    for (const std::string_view name : names) text.append(name == names.front() ? " " : ", ").append(name);
    return text;
}

int run(int count, char** words) {
    CLI::App app{"nezumi runs what small robots do: Lua behaviours, in simulation and on the robot"};
    app.name("nezumi");
    app.set_version_flag("--version", "nezumi " NEZUMI_VERSION);
    app.require_subcommand(1);
    int status = cli::kDone;
    cli::add_run_command(app, status);
    cli::add_attach_command(app, status);
    cli::add_types_command(app, status);
    cli::add_check_command(app, status);
    cli::add_new_command(app, status);
    cli::add_test_command(app, status);

    if (const std::string wrong = unknown_command(app, count, words); !wrong.empty()) return cli::refuse(wrong);
    try {
        app.parse(count, words);
    } catch (const CLI::Success& asked) {  // --help, --version
        return app.exit(asked);
    } catch (const CLI::ParseError& error) {
        return cli::refuse(cli::usage_error(app, error));
    }
    return status;
}

}  // namespace

int main(int count, char** words) {
    try {
        return run(count, words);
    } catch (const std::exception& error) {
        return cli::refuse(error.what());
    }
}
