// `nezumi new`: a behaviour with its scenario, or a whole project.
#include <fmt/format.h>

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

Command new_command() {
    auto wanted = std::make_shared<NewBehavior>();
    auto folder = std::make_shared<std::string>();
    const Command behavior{
        .name = "behavior",
        .help = "Write a behaviour and a scenario for it",
        .options = {{"NAME", &wanted->name, "line_follower or LineFollower"},
                    {"--in", &wanted->inputs, "an in-port, for example distance:TimedShortSeq; may be repeated",
                     "name:Type"},
                    {"--out", &wanted->outputs, "an out-port, for example velocity:TimedVelocity2D; may be repeated",
                     "name:Type"},
                    {"--param", &wanted->parameters, "a parameter, for example speed=0.1; may be repeated",
                     "name=default"}},
        .run = [wanted] { return new_behavior(*wanted); },
        .footer =
            "Writes behaviors/NAME.lua and tests/NAME_test.lua (in tests/scenarios/ where there is such a "
            "folder), and never\noverwrites. A parameter's type is its default's: 30 integer, 30.0 number, "
            "true, text, '{ 1.0, 0.5 }'.",
        .alias = "behaviour"};
    const Command project{.name = "project",
                          .help = "Write a project with editor support",
                          .options = {{"DIR", folder.get(), "a folder that is new or empty"}},
                          .run = [folder] { return new_project(*folder); }};
    return {.name = "new", .help = "Write a new behaviour, or a new project", .commands = {behavior, project}};
}

}  // namespace nezumi::cli
