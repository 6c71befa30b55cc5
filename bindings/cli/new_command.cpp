// `nezumi new`: a behaviour with its scenario, or a whole project.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "bindings/cli/commands.hpp"
#include "bindings/cli/environment.hpp"
#include "bindings/cli/new_behavior.hpp"
#include "bindings/cli/new_files.hpp"
#include "bindings/cli/new_project.hpp"
#include "bindings/lua/project/project.hpp"
#include "bindings/scenario/test_plan.hpp"

namespace nezumi::cli {
namespace {

namespace fs = std::filesystem;

int write(const std::vector<NewFile>& files, const std::string& next) {
    if (auto ok = write_new_files(files); !ok) return refuse(ok.error());
    for (const NewFile& file : files) fmt::print("wrote {}\n", file.path.string());
    fmt::print("now try: {}\n", next);
    return kDone;
}

int new_behavior(const NewBehavior& wanted) {
    const auto texts = write_behavior(wanted);
    if (!texts) return refuse("new behavior: " + texts.error().message);
    // Of the project that we are in; outside of any, one begins here.
    const Project project = Project::of("here");
    std::error_code none;
    const fs::path root = project.root().empty() ? fs::current_path(none) : project.root();
    const fs::path scenarios = fs::is_directory(root / "tests/scenarios", none) ? "tests/scenarios" : "tests";
    const std::string behavior = project.shown(root / "behaviors" / (texts->name + ".lua"));
    const std::string scenario = project.shown(root / scenarios / (texts->name + "_test.lua"));
    return write({{behavior, texts->behavior}, {scenario, texts->scenario}}, "nezumi test " + scenario);
}

int new_project(const std::string& given) {
    if (given.empty()) return refuse("new project: expected a folder, got ''");
    const fs::path folder = fs::path(given).lexically_normal();
    std::error_code problem;
    const bool is_there = fs::exists(fs::symlink_status(folder, problem));
    if (is_there && !fs::is_directory(folder, problem))
        return refuse({"is a file, expected a folder that is new or empty", {given}});
    if (is_there) {
        for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end; entry.increment(problem)) {
            if (entry->path().filename() == ".git") continue;
            return refuse({fmt::format("is not empty (it has '{}'), and nothing is overwritten: choose another folder",
                                       shown(entry->path().filename().string())),
                           {given}});
        }
        if (problem) return refuse({"can't be read: " + problem.message(), {given}});
    }
    const fs::path whole = fs::absolute(folder, problem).lexically_normal();
    const fs::path last = whole.has_filename() ? whole.filename() : whole.parent_path().filename();
    std::vector<NewFile> files = project_files(last.empty() ? "Robots" : last.string());
    for (NewFile& file : files) file.path = (folder / file.path).lexically_normal();
    return write(files, folder == "." ? "nezumi test" : fmt::format("cd {} && nezumi test", shell_text(given)));
}

}  // namespace

void add_new_command(CLI::App& app, int& status) {
    CLI::App* command = app.add_subcommand("new", "Write a new behaviour, or a new project");
    command->allow_extras();
    command->callback([command, &status] {
        if (!command->get_subcommands().empty()) return;
        const std::vector<std::string> words = command->remaining();
        const std::string what = words.empty() ? "what is to be new?"
                                               : fmt::format("there is no '{}'{}.", shown(words[0]),
                                                             did_you_mean(words[0], {"behavior", "project"}));
        status = refuse(fmt::format("new: {} Write `nezumi new behavior NAME` or `nezumi new project DIR`", what));
    });

    CLI::App* behavior = command->add_subcommand("behavior", "Write a behaviour and a scenario for it");
    behavior->alias("behaviour")->allow_extras(false);
    auto wanted = std::make_shared<NewBehavior>();
    behavior->add_option("NAME", wanted->name, "line_follower or LineFollower")->required();
    const auto add = [&](const char* option, std::vector<std::string>& values, const char* form, const char* help) {
        behavior->add_option(option, values, help)->type_name(form)->allow_extra_args(false);
    };
    add("--in", wanted->inputs, "name:Type", "an in-port, for example distance:TimedShortSeq; may be repeated");
    add("--out", wanted->outputs, "name:Type", "an out-port, for example velocity:TimedVelocity2D; may be repeated");
    add("--param", wanted->parameters, "name=default", "a parameter, for example speed=0.1; may be repeated");
    behavior->footer(
        "Writes behaviors/NAME.lua and tests/NAME_test.lua (in tests/scenarios/ where there is such a folder), and "
        "never\noverwrites. A parameter's type is its default's: 30 integer, 30.0 number, true, text, '{ 1.0, 0.5 }'.");
    behavior->callback([wanted, &status] { status = new_behavior(*wanted); });

    CLI::App* project = command->add_subcommand("project", "Write a project with editor support");
    project->allow_extras(false);
    auto folder = std::make_shared<std::string>();
    project->add_option("DIR", *folder, "a folder that is new or empty")->required();
    project->callback([folder, &status] { status = new_project(*folder); });
}

}  // namespace nezumi::cli
