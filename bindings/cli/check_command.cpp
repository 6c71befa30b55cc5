// `nezumi check`: what is wrong with files, for editors and for tests that run by themselves.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "bindings/cli/check_files.hpp"
#include "bindings/cli/commands.hpp"
#include "bindings/cli/environment.hpp"
#include "bindings/cli/json_text.hpp"

namespace nezumi::cli {
namespace {

struct CheckOptions {
    std::vector<std::string> paths;
    bool json = false;
};

// [{"file":"x.lua","line":3,"column":5,"message":"..."}], without what is not known.
std::string to_json(const std::vector<Error>& errors) {
    std::string text;
    for (const Error& error : errors) {
        text += fmt::format("{}{{\"file\":{}", text.empty() ? "" : ",\n ", json_text(error.place.file));
        if (error.place.line > 0) text += fmt::format(",\"line\":{}", error.place.line);
        if (error.place.column > 0) text += fmt::format(",\"column\":{}", error.place.column);
        text += fmt::format(",\"message\":{}}}", json_text(error.message));
    }
    return "[" + text + "]\n";
}

int check(const CheckOptions& options) {
    const auto files = lua_files(options.paths);
    if (!files) {
        if (options.json) fmt::print("{}", to_json({files.error()}));
        return refuse(files.error());
    }
    const LiveOptions systems = simulated_systems();
    std::vector<Error> errors;
    for (const std::filesystem::path& file : *files) {
        // A script that several systems name is wrong once.
        for (Error& error : check_file(file, systems)) {
            if (std::find(errors.begin(), errors.end(), error) == errors.end()) errors.push_back(std::move(error));
        }
    }
    if (options.json) {
        fmt::print("{}", to_json(errors));
    } else {
        for (const Error& error : errors) fmt::print("{}\n", describe(error));
        if (errors.empty()) fmt::print("{} file{}: nothing wrong\n", files->size(), files->size() == 1 ? "" : "s");
    }
    return errors.empty() ? kDone : kFailed;
}

}  // namespace

void add_check_command(CLI::App& app, int& status) {
    CLI::App* command = app.add_subcommand("check", "Say what is wrong with files, without running them");
    auto options = std::make_shared<CheckOptions>();
    command
        ->add_option("FILE", options->paths,
                     "behaviours, modules, systems, robots, scenarios, or folders with them, for example .")
        ->required();
    command->add_flag("--json", options->json, "write an array of {file, line, column, message}");
    command->footer(
        "Each finding is a line `file:line:column: message`.\n"
        "Exit status: 0 nothing wrong, 1 something is, 2 it could not be checked.");
    command->callback([options, &status] { status = check(*options); });
}

}  // namespace nezumi::cli
