// `nezumi mms`: gives a maze and a solver to the Python program that speaks the protocol of the simulator mms.
#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/json_text.hpp"
#include "bindings/cli/base/python_program.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/cli/files/named_files.hpp"
#include "engine/base/module.hpp"
#include "engine/world/arena_fields.hpp"

namespace nezumi::cli {
namespace {

struct MmsOptions {
    std::string maze, robot = "raspimouse", speed = "1", seed, port, dev_root, sys_root;
    double thickness = MazeSpec{}.thickness;
    FlagText hw;
    bool sensors = false, marks = false, no_web = false, open = false;
    std::vector<std::string> solver;
};

std::string json_list(const std::vector<std::string>& texts) {
    std::string list;
    for (const std::string& text : texts) list += (list.empty() ? "" : ",") + json_text(text);
    return "[" + list + "]";
}

int run_mms(const MmsOptions& options) {
    if (options.maze.empty()) return refuse("mms: --maze is missing: give the file of a maze");
    std::error_code none;
    if (!std::filesystem::exists(options.maze, none))
        return refuse(fmt::format("mms: there is no file {}", shown(options.maze)));
    const auto program = python_file("bindings/agent/mms.py");
    if (!program) return refuse("mms: " + program.error().message);
    const auto system = find_system_file("mms");
    if (!system) return refuse(system.error());
    const bool is_real = !options.hw.text.empty();
    const bool is_paced = options.speed != "max";
    if (is_real && options.speed != "1")
        return refuse("mms: --speed works only with a simulated mouse: leave out --speed or --hw");
    std::vector<std::string> run;
    const auto give = [&](const std::string& name, const std::string& value) {
        if (value.empty()) return;
        run.push_back(name);
        run.push_back(value);
    };
    give("--seed", options.seed);
    if (is_paced) {
        if (!is_real) give("--speed", options.speed);
        give("--port", options.port);
        if (options.no_web) run.emplace_back("--no-web");
        if (options.open) run.emplace_back("--open");
        if (is_real) run.emplace_back("--hw");
        give("--dev-root", options.dev_root);
        give("--sys-root", options.sys_root);
    }
    const auto truth = [](bool value) { return value ? "true" : "false"; };
    const std::string words = fmt::format(
        R"({{"program":{},"system":{},"maze":{},"robot":{},"thickness":{},"run":{},"paced":{},"real":{},"sensors":{},)"
        R"("marks":{},"solver":{}}})",
        json_text(own_program().string()), json_text(system->string()), json_text(options.maze),
        json_text(options.robot), options.thickness, json_list(run), truth(is_paced), truth(is_real),
        truth(options.sensors || is_real), truth(options.marks), json_list(options.solver));
    become_python(*program, {words});
    return refuse(fmt::format("mms: Python is needed: sudo apt install python3 ({})", std::strerror(errno)));
}

}  // namespace

SubCommand mms_command() {
    auto options = std::make_shared<MmsOptions>();
    return {
        .name = "mms",
        .help = "Run a maze solver written for the simulator mms; the simulated mouse drives with real motion",
        .options =
            {{"PROGRAM", &options->solver, "the solver with its options, after --"},
             {"--maze", &options->maze, "a drawing, a .maz or a .num file", "FILE", {}, FileUse::source},
             {"--robot", &options->robot,
              "the model of the mouse; its ports must have the same names as those of raspimouse", "MODEL"},
             {"--thickness", &options->thickness, "the thickness of the walls [m]", "M", number_from(0.001, 0.05)},
             {"--speed", &options->speed, "factor of real time, or as fast as possible, without the page", "X|max"},
             {"--seed", &options->seed, "the seed of the run", "N"},
             {"--sensors", &options->sensors, "answer the solver by the mouse's sensors, not by the file of the maze"},
             {"--marks", &options->marks, "print the walls, colours and texts that the solver has set"},
             {"--hw", &options->hw, "drive the real mouse; its sensors detect the walls"},
             {"--dev-root", &options->dev_root, "with --hw: the folder of the device files (default /dev)", "DIR"},
             {"--sys-root", &options->sys_root, "with --hw: the folder of the kernel's devices (default /sys)", "DIR"},
             {"--port", &options->port, "the port of the page (default: 8765, or the next free one)", "N"},
             {"--no-web", &options->no_web, "serve no page"},
             {"--open", &options->open, "show the page in the browser"}},
        .run = [options] { return run_mms(*options); },
        .footer =
            "For example `nezumi mms --maze contest.txt --speed max -- python3 Main.py`. The solver runs unchanged, in "
            "any language.\nEnter in the terminal is mms's reset button.\n"
            "Exit status: 0 the solver ended well and has been at the goal, 1 it has not, 2 it could not be run."};
}

}  // namespace nezumi::cli
