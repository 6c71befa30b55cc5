// `nezumi new`: a behaviour with its scenario, a system, a robot, a scenario, or a whole project.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/cli/files/check_files.hpp"
#include "bindings/cli/files/named_files.hpp"
#include "bindings/cli/new/arguments.hpp"
#include "bindings/cli/new/behavior.hpp"
#include "bindings/cli/new/exercise.hpp"
#include "bindings/cli/new/files.hpp"
#include "bindings/cli/new/profile_behavior.hpp"
#include "bindings/cli/new/profile_system.hpp"
#include "bindings/cli/new/project.hpp"
#include "bindings/cli/new/system.hpp"
#include "bindings/lua/files/find_script.hpp"
#include "bindings/lua/files/system_file.hpp"
#include "bindings/lua/script/behavior_maker.hpp"
#include "bindings/openrtm/component_profile.hpp"
#include "bindings/openrtm/system_profile.hpp"
#include "bindings/scenario/test_plan.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/project/project.hpp"

namespace nezumi::cli {
namespace {

namespace fs = std::filesystem;

// `name`: how other files name the first of these files; "": they do not name it.
int write_files(const std::vector<NewFile>& files, const std::string& next, const std::string& name = "") {
    const std::string shipped = name.empty() ? "" : shipped_file_called(name);
    if (auto ok = write_new_files(files); !ok) return refuse(ok.error());
    for (const NewFile& file : files) fmt::print("wrote {}\n", file.path.string());
    fmt::print("now try: {}\n", next);
    if (!shipped.empty()) {
        fmt::print(
            stderr,
            "nezumi: in this project '{}' now means {}, no longer {}: rename the new file if you do not want that\n",
            name, files.front().path.string(), shipped);
    }
    return exit_done;
}

// The project of the working folder. Outside of a project, the working folder is the root of a new one.
struct Here {
    Project project = Project::of("here", installed_folders());
    fs::path root;

    Here() {
        std::error_code none;
        root = project.root().empty() ? fs::current_path(none) : project.root();
    }
    std::string behavior(const std::string& name) const { return project.shown(root / "behaviors" / (name + ".lua")); }
    std::string system(const std::string& name) const {
        return project.shown(root / "behaviors/systems" / (name + ".lua"));
    }
    std::string scenario(const std::string& name) const {
        std::error_code none;
        const fs::path folder = fs::is_directory(root / "tests/scenarios", none) ? "tests/scenarios" : "tests";
        return project.shown(root / folder / (name + "_test.lua"));
    }
};

// `rtc` is the file of a profile, or "".
int new_behavior(NewBehavior wanted, const std::string& rtc) {
    std::vector<std::string> remarks;
    if (!rtc.empty()) {
        const auto text = read_whole(rtc, rtc);
        if (!text) return refuse(text.error());
        const auto profile = openrtm::read_component_profile(*text, rtc);
        if (!profile) return refuse(profile.error());
        wanted.base = parts_of(*profile, new_messages(), remarks);
    }
    const auto texts = write_behavior(wanted);
    if (!texts) return refuse("new behavior: " + texts.error().message);
    const Here here;
    const std::string scenario = here.scenario(texts->name);
    for (const std::string& remark : remarks) fmt::print(stderr, "{}: kept as a comment: {}\n", rtc, remark);
    return write_files({{here.behavior(texts->name), texts->behavior}, {scenario, texts->scenario}},
                       "nezumi test " + scenario, texts->name);
}

// The first error that the text would have as this file.
std::optional<Error> problem_of(const std::string& text, const std::string& file) {
    auto errors = check_text(text, file, simulated_systems());
    return errors.empty() ? std::nullopt : std::optional<Error>(std::move(errors.front()));
}

// The behaviour of this name in the project; null if there is none that loads.
std::unique_ptr<Script> load_behavior(const Project& project, const std::string& name) {
    const auto file = find_script(project, name, "here");
    const auto source = file ? project.read_source(file->string()) : Unexpected(file.error());
    if (!source) return nullptr;
    ScriptContext context{.component = name};
    context.find_module = modules_of(project);
    auto script = Script::load(*source, std::move(context));
    return script ? std::move(*script) : nullptr;
}

// The text of a system file for a profile of RTSystemEditor. Sets an empty `name` to the name of the profile.
Expected<std::string> read_rts(const std::string& rts, std::string& name, std::vector<std::string>& remarks) {
    const auto text = read_whole(rts, rts);
    if (!text) return Unexpected(text.error());
    const auto profile = openrtm::read_system_profile(*text, rts);
    if (!profile) return Unexpected(profile.error());
    if (name.empty()) name = profile->name;
    const Here here;
    auto system = system_text_of(
        *profile, [&](const std::string& script) { return load_behavior(here.project, script); }, remarks);
    if (system.find("\nbehavior ") == std::string::npos)
        return failure(
            "none of its components is a behaviour of this project: write one first, for example with nezumi new "
            "behavior --rtc RTC.xml",
            {rts});
    return system;
}

// `rts` is the file of a profile, or "".
int new_system(NewSystem wanted, const std::string& rts) {
    std::vector<std::string> remarks;
    if (!rts.empty() && !(wanted.robots.empty() && wanted.behaviors.empty() && wanted.connections.empty()))
        return refuse("new system: --rts already defines the system: leave out --robot, --behavior and --connect");
    auto text = rts.empty() ? Expected<std::string>("") : read_rts(rts, wanted.name, remarks);
    if (!text) return refuse(text.error());
    const auto name = new_file_name("system", wanted.name);
    if (!name) return refuse("new system: " + name.error().message);
    wanted.name = *name;
    if (rts.empty()) text = system_text(wanted);
    if (!text) return refuse("new system: " + text.error().message);
    const std::string file = Here().system(*name);
    if (const auto problem = problem_of(*text, file)) return refuse(*problem);
    for (const std::string& remark : remarks) fmt::print(stderr, "{}: kept as a comment: {}\n", rts, remark);
    return write_files({{file, *text}}, "nezumi run " + *name, *name);
}

int new_robot(const std::string& given) {
    const auto name = new_file_name("robot", given);
    if (!name) return refuse("new robot: " + name.error().message);
    const std::string file = Here().behavior(*name);
    return write_files({{file, robot_text(*name)}}, fmt::format("nezumi new system try_{0} --robot {0}={0}", *name),
                       *name);
}

struct NewScenario {
    std::string name;
    std::string system;
};

int new_scenario(const NewScenario& wanted) {
    const auto name = new_file_name(
        "scenario", wanted.name.ends_with("_test") ? wanted.name.substr(0, wanted.name.size() - 5) : wanted.name);
    if (!name) return refuse("new scenario: " + name.error().message);
    const auto file = find_system_file(wanted.system.empty() ? *name : wanted.system);
    if (!file && wanted.system.empty())
        return refuse("new scenario: expected a system: give --system, for example --system " + *name);
    if (!file) return refuse(file.error());
    const Project project = Project::of(*file, installed_folders());
    const auto system = read_system_file(*file, project, {.peer_words = peer_words()});
    if (!system) return refuse(system.error());
    const Here here;
    const std::string written = here.scenario(*name);
    // A scenario names the system by its path below behaviors/.
    const std::string shown_path = project.shown(*file);
    const std::size_t behaviors = shown_path.rfind("behaviors/");
    const std::string path =
        behaviors == std::string::npos ? fs::absolute(*file).string() : shown_path.substr(behaviors + 10);
    return write_files({{written, system_scenario_text(*name, path, *system)}}, "nezumi test " + *name);
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
    return write_files(files, folder == "." ? "nezumi test" : fmt::format("cd {} && nezumi test", shell_text(given)));
}

int new_exercise(const std::string& given) {
    const auto name = new_file_name("new exercise", given);
    if (!name) return refuse("new exercise: " + name.error().message);
    std::vector<NewFile> files = exercise_files(*name);
    for (NewFile& file : files) file.path = "exercises" / (*name / file.path);
    return write_files(files, "nezumi class .");
}

}  // namespace

SubCommand new_command() {
    auto wanted = std::make_shared<NewBehavior>();
    auto rtc = std::make_shared<std::string>();
    auto folder = std::make_shared<std::string>();
    const SubCommand behavior{
        .name = "behavior",
        .help = "Write a behaviour and a scenario for it",
        .options =
            {{"[NAME]", &wanted->name, "line_follower or LineFollower; with --rtc, the profile's"},
             {"--in", &wanted->inputs, "an in-port, for example distance:TimedShortSeq; may be repeated",
              "name:Type[:doc]"},
             {"--out", &wanted->outputs, "an out-port, for example velocity:TimedVelocity2D; may be repeated",
              "name:Type[:doc]"},
             {"--param", &wanted->parameters,
              "a parameter, for example speed=0.1 or 'gain=0.01,min=0,max=1,unit=1/s,doc=of the error'; may be "
              "repeated",
              "name=default[,min=...]"},
             {"--callback", &wanted->callbacks,
              "a callback beside on_execute, for example on_activated; may be repeated", "on_..."},
             {"--doc", &wanted->doc, "what it does, in a sentence", "TEXT"},
             {"--version", &wanted->about.version, "of the behaviour, for example 1.0.0", "TEXT"},
             {"--vendor", &wanted->about.vendor, "who makes it", "TEXT"},
             {"--category", &wanted->about.category, "what kind of component it is, for example navigation", "TEXT"},
             {"--rtc", rtc.get(), "start from this profile of RTCBuilder, RTC.xml", "FILE", {}, FileUse::source}},
        .run = [wanted, rtc] { return new_behavior(*wanted, *rtc); },
        .footer =
            "Writes behaviors/NAME.lua and tests/NAME_test.lua (in tests/scenarios/ where there is such a "
            "folder), and never\noverwrites. A parameter's type is its default's: 30 integer, 30.0 number, "
            "true, text, '{ 1.0, 0.5 }'. After it: min, max, step, choices, widget, unit, doc, each NAME=VALUE.",
        .alias = "behaviour"};
    const SubCommand project{.name = "project",
                             .help = "Write a project with editor support",
                             .options = {{"DIR", folder.get(), "a folder that is new or empty"}},
                             .run = [folder] { return new_project(*folder); }};
    auto system = std::make_shared<NewSystem>();
    auto rts = std::make_shared<std::string>();
    const SubCommand systems{
        .name = "system",
        .help = "Write a system file",
        .options = {{"[NAME]", &system->name, "of the file in behaviors/systems/; with --rts, the profile's"},
                    {"--robot", &system->robots, "a robot, for example mouse=raspimouse (default); may be repeated",
                     "NAME=MODEL"},
                    {"--behavior", &system->behaviors,
                     "a behaviour, for example controller=robot_controller; may be repeated", "NAME=SCRIPT"},
                    {"--connect", &system->connections,
                     "a connection, for example controller.out=mouse.target_velocity_in; may be repeated", "FROM=TO"},
                    {"--rts",
                     rts.get(),
                     "a profile of RTSystemEditor: its components that are behaviours here, and how they are connected",
                     "FILE",
                     {},
                     FileUse::source}},
        .run = [system, rts] { return new_system(*system, *rts); },
        .footer = "The file is written only if the system can be loaded."};
    auto robot = std::make_shared<std::string>();
    const SubCommand robots{
        .name = "robot",
        .help = "Write a robot file: two wheels and some sensors, to be changed",
        .options = {{"NAME", robot.get(), "name of the file in behaviors/, for the field `model` of systems"}},
        .run = [robot] { return new_robot(*robot); }};
    auto scenario = std::make_shared<NewScenario>();
    const SubCommand scenarios{
        .name = "scenario",
        .help = "Write a scenario for a system",
        .options = {{"NAME", &scenario->name, "of the file in tests/, NAME_test.lua"},
                    {"--system", &scenario->system, "the system file, by path or name (default: NAME)", "FILE"}},
        .run = [scenario] { return new_scenario(*scenario); }};
    auto exercise = std::make_shared<std::string>();
    const SubCommand exercises{
        .name = "exercise",
        .help = "Write an exercise for a class: a text, files to start with, shown and hidden scenarios",
        .options = {{"NAME", exercise.get(), "of the folder in exercises/, and of the system file"}},
        .run = [exercise] { return new_exercise(*exercise); },
        .footer = "Run this command in the folder of the class. See docs/classroom.md."};
    return {.name = "new",
            .help = "Write a new behaviour, system, robot, scenario, exercise or project",
            .commands = {behavior, systems, robots, scenarios, exercises, project}};
}

}  // namespace nezumi::cli
