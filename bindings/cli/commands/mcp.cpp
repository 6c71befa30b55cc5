// `nezumi mcp`: starts the Python program that serves a project by the Model Context Protocol.
#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/json_text.hpp"
#include "bindings/cli/base/python_program.hpp"
#include "bindings/cli/base/version.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "engine/base/module.hpp"

namespace nezumi::cli {
namespace {

constexpr double usual_speed = 0.1;  // [m/s]

struct McpOptions {
    std::string project = ".";
    double max_speed = usual_speed;
    bool may_drive = false, accept = false;
};

int run_mcp(const McpOptions& options) {
    const auto program = python_file("bindings/agent/mcp.py");
    if (!program) return refuse("mcp: " + program.error().message);
    std::error_code none;
    if (!std::filesystem::is_directory(options.project, none))
        return refuse(fmt::format("mcp: there is no folder {}", shown(options.project)));
    const std::string docs =
        (std::filesystem::path(*program).parent_path().parent_path().parent_path() / "docs").string();
    const std::string words =
        fmt::format(R"({{"program":{},"project":{},"docs":{},"version":{},"may_drive":{},"max_speed":{},"accept":{}}})",
                    json_text(own_program().string()), json_text(options.project), json_text(docs),
                    json_text(version()), options.may_drive, options.max_speed, options.accept);
    become_python(*program, {words});
    return refuse(fmt::format("mcp: Python is needed: sudo apt install python3 ({})", std::strerror(errno)));
}

}  // namespace

SubCommand mcp_command() {
    auto options = std::make_shared<McpOptions>();
    return {.name = "mcp",
            .help = "Serve a project to an agent: the Model Context Protocol on standard input and output",
            .options = {{"--project", &options->project,
                         "the project's folder, which has behaviors/ (default: the one here)", "DIR"},
                        {"--may-drive", &options->may_drive, "allow the agent to drive real robots for short times"},
                        {"--max-speed", &options->max_speed, "the maximum speed at which the agent drives [m/s]", "V",
                         number_from(0.01, 1.5)},
                        {"--accept", &options->accept,
                         "accept all scenarios as they are now, also those that were added since the first use of this "
                         "command, and exit"}},
            .run = [options] { return run_mcp(*options); },
            .footer =
                "A file that an agent writes goes live only if the scenarios for it pass in a copy of the project. An "
                "agent can't change scenarios.\nWithout --may-drive, an agent can only read real robots. See "
                "docs/agents.md."};
}

}  // namespace nezumi::cli
