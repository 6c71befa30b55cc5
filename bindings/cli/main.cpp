// nezumi: parses the command line and runs the sub-command that it names.
#include <CLI/CLI.hpp>

#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/cli/commands.hpp"
#include "bindings/cli/environment.hpp"
#include "bindings/cli/standard_files.hpp"
#include "bindings/cli/usage_error.hpp"

using namespace nezumi;

namespace {

// What is wrong with the first word, which has to be a sub-command: CLI11 would call it an unexpected argument.
std::string unknown_command(const CLI::App& app, int count, char** words) {
    std::vector<std::string_view> names;
    std::vector<std::string> owned;
    for (const CLI::App* command : app.get_subcommands({})) owned.push_back(command->get_name());
    names.assign(owned.begin(), owned.end());
    if (count > 1 && words[1][0] == '-') return "";
    const std::string_view word = count > 1 ? words[1] : "";
    for (const std::string_view name : names) {
        if (name == word) return "";
    }
    std::string text = count > 1 ? "there is no command '" + shown(word) + "'" + did_you_mean(word, names)
                                 : "what is to be done? See nezumi --help";
    text += "; known are";
    for (const std::string_view name : names) text.append(name == names.front() ? " " : ", ").append(name);
    return text;
}

int run(int count, char** words) {
    CLI::App app{"nezumi runs what small robots do: Lua behaviours, in simulation"};
    app.name("nezumi");
    app.set_version_flag("--version", "nezumi " NEZUMI_VERSION);
    int status = cli::kDone;
    cli::add_run_command(app, status);
    cli::add_attach_command(app, status);
    cli::add_calc_command(app, status);
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
    if (app.get_subcommands().empty()) return cli::refuse(unknown_command(app, 1, words));
    return status;
}

}  // namespace

int main(int count, char** words) {
    cli::open_missing_standard_files();
    int status = cli::kCouldNotRun;
    std::string problem;
    try {
        status = run(count, words);
    } catch (const std::exception& error) {
        problem = error.what();
    }
    if (const std::string lost = cli::lost_output(); !lost.empty()) problem = lost;
    return problem.empty() ? status : cli::refuse(problem);
}
