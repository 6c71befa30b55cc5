// `nezumi check`: what is wrong with files, for editors and for tests that run by themselves.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "bindings/cli/check_files.hpp"
#include "bindings/cli/commands.hpp"
#include "bindings/cli/environment.hpp"
#include "bindings/cli/json_text.hpp"
#include "engine/base/visible.hpp"
#include "engine/base/whole_file.hpp"

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
    const FoundFiles found = lua_files(options.paths);
    const LiveOptions systems = simulated_systems();
    int status = found.errors.empty() ? kDone : kCouldNotRun;
    std::vector<Error> errors = found.errors;
    for (const Error& error : found.errors) refuse(error);
    for (const std::filesystem::path& file : found.files) {
        if (auto readable = read_whole(file, file.string()); !readable) {
            errors.push_back(readable.error());
            status = refuse(readable.error());
            continue;
        }
        // A script that several systems name is wrong once.
        for (Error& error : check_file(file, systems)) {
            if (std::find(errors.begin(), errors.end(), error) != errors.end()) continue;
            if (!options.json) fmt::print("{}\n", visible(describe(error)));
            errors.push_back(std::move(error));
            status = std::max(status, static_cast<int>(kFailed));
        }
    }
    if (options.json) fmt::print("{}", to_json(errors));
    if (!options.json && errors.empty())
        fmt::print("{} file{}: nothing wrong\n", found.files.size(), found.files.size() == 1 ? "" : "s");
    return status;
}

}  // namespace

Command check_command() {
    auto options = std::make_shared<CheckOptions>();
    return {.name = "check",
            .help = "Say what is wrong with files, without running them",
            .options = {{"FILE", &options->paths,
                         "behaviours, modules, systems, robots, scenarios, or folders with them, for example ."},
                        {"--json", &options->json, "write an array of {file, line, column, message}"}},
            .run = [options] { return check(*options); },
            .footer =
                "Each finding is a line `file:line:column: message`.\n"
                "Exit status: 0 nothing wrong, 1 something is, 2 it could not be checked."};
}

}  // namespace nezumi::cli
