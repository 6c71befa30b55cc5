// `nezumi check`: finds errors in files, for editors and automatic tests.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/json_text.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/cli/files/check_files.hpp"
#include "engine/base/list.hpp"
#include "engine/base/visible.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/project/project.hpp"

namespace nezumi::cli {
namespace {

constexpr std::string_view standard_input = "-";

constexpr const char* unnamed = "stdin";

struct CheckOptions {
    std::vector<std::string> paths;
    std::string name = unnamed;
    bool json = false;
};

// Reads standard input, up to the largest size of a file.
Expected<std::string> read_input(const std::string& shown) {
    std::string text;
    char buffer[65536];
    while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, stdin)) {
        text.append(buffer, count);
        if (text.size() > largest_text) return failure(fmt::format("has more than {} MB", largest_text >> 20), {shown});
    }
    if (std::ferror(stdin) != 0) return failure("standard input can't be read", {shown});
    return text;
}

// [{"file":"x.lua","line":3,"column":5,"message":"..."}]; a line or column that is unknown is left out.
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

// Collects the findings, and computes the exit status.
class Findings {
public:
    explicit Findings(bool json) : json_(json) {}

    void could_not(const Error& error) {
        errors_.push_back(error);
        status_ = refuse(error);
    }
    void add(std::vector<Error> errors) {
        for (Error& error : errors) {
            // An error in a script that several systems use is reported once.
            if (contains(errors_, error)) continue;
            if (!json_) fmt::print("{}\n", visible_message(describe(error)));
            errors_.push_back(std::move(error));
            status_ = std::max(status_, static_cast<int>(exit_failed));
        }
    }
    int finish(const std::string& checked) const {
        if (json_) fmt::print("{}", to_json(errors_));
        if (!json_ && errors_.empty()) fmt::print("{}: nothing wrong\n", checked);
        return status_;
    }

private:
    bool json_;
    int status_ = exit_done;
    std::vector<Error> errors_;
};

int check(const CheckOptions& options) {
    const LiveOptions systems = simulated_systems();
    Findings findings(options.json);
    const auto input = std::find(options.paths.begin(), options.paths.end(), standard_input);
    if (input != options.paths.end()) {
        if (options.paths.size() > 1)
            return refuse("check: - is standard input, which is one file: leave out the others");
        const auto text = read_input(options.name);
        if (text) {
            findings.add(check_text(*text, options.name, systems));
        } else {
            findings.could_not(text.error());
        }
        return findings.finish(options.name);
    }
    if (options.name != unnamed)
        return refuse("check: --name is only for text from standard input: give - as the file");
    std::vector<std::string> paths = options.paths;
    if (paths.empty()) {
        const Project project = Project::of("here");
        if (project.root().empty())
            return refuse(
                "check: this is not a project, because there is no folder behaviors/ here or above: name files, or . "
                "for "
                "all files here");
        const std::string root = project.shown(project.root());
        paths.push_back(root.empty() ? "." : root);
    }
    const FoundFiles found = lua_files(paths);
    for (const Error& error : found.errors) findings.could_not(error);
    for (const std::filesystem::path& file : found.files) {
        if (auto readable = read_whole(file, file.string()); !readable) {
            findings.could_not(readable.error());
        } else {
            findings.add(check_file(file, systems));
        }
    }
    return findings.finish(fmt::format("{} file{}", found.files.size(), found.files.size() == 1 ? "" : "s"));
}

}  // namespace

SubCommand check_command() {
    auto options = std::make_shared<CheckOptions>();
    return {.name = "check",
            .help = "Report errors in files, without running them",
            .options = {{"[FILE]", &options->paths,
                         "behaviours, modules, systems, robots, scenarios, by path or name, or folders with them, for "
                         "example .; - is standard input; without any, those of the project"},
                        {"--name", &options->name, "with -: the name of the file that the text belongs to", "FILE.lua"},
                        {"--json", &options->json, "write an array of {file, line, column, message}"}},
            .run = [options] { return check(*options); },
            .footer =
                "Each finding is a line `file:line:column: message`.\n"
                "Exit status: 0 no errors, 1 errors were found, 2 the files could not be checked."};
}

}  // namespace nezumi::cli
