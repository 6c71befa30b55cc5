// `nezumi push`: brings a project to the robot, where the running nezumi reloads it.
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "bindings/cli/commands.hpp"
#include "bindings/cli/environment.hpp"
#include "bindings/cli/remote.hpp"
#include "bindings/scenario/test_plan.hpp"
#include "engine/project/project.hpp"

namespace nezumi::cli {
namespace {

namespace fs = std::filesystem;

struct PushOptions {
    std::string host, run, config, folder;
};

// What belongs to the robot, or to the one who writes: it neither goes over nor is taken away there.
constexpr const char* kept[] = {"*.calibration.lua", ".git/", "/build/", "*~", "*.swp"};

// The project that the working directory is in.
Expected<fs::path> project_here() {
    std::error_code none;
    const fs::path here = fs::current_path(none);
    const fs::path root = Project::of(here / "x.lua").root();
    if (root.empty()) return failure("no project is here: expected a folder with behaviors/ in it, or above");
    return fs::canonical(root, none);
}

Expected<void> compare_versions(const Remote& remote) {
    const auto ended = run_in_front(remote.ssh("nezumi --version"), true);
    if (!ended) return Unexpected(ended.error());
    if (ended->status == no_connection)
        return failure(
            fmt::format("{} is not to be reached by ssh: does `ssh {}` work?", remote.host(), remote.host()));
    std::string theirs = ended->out;
    while (!theirs.empty() && theirs.back() == '\n') theirs.pop_back();
    if (ended->status != 0 || theirs.empty())
        return failure(fmt::format("{} has no nezumi: install its package there", remote.host()));
    const std::string ours = "nezumi " NEZUMI_VERSION;
    if (theirs != ours)
        return failure(
            fmt::format("{} has {}, here is {}: install the same on both", remote.host(), shown(theirs), ours));
    return {};
}

// First beside the project, with a cable that may be pulled; then, there, file by file into it, each at once.
Expected<void> bring_over(const Remote& remote, const fs::path& project, const std::string& folder) {
    const std::string coming = folder + ".coming";
    std::vector<std::string> words{"rsync", "-a", "-s", "--delete", "-e", remote.for_rsync()};
    std::string excludes;
    for (const char* pattern : kept) {
        words.push_back(std::string("--exclude=") + pattern);
        excludes += " --exclude=" + shell_text(pattern);
    }
    words.insert(words.end(), {"--", project.string() + "/", remote.host() + ":" + coming + "/"});
    const auto sent = run_in_front(words, false);
    if (!sent) return Unexpected(sent.error());
    if (sent->status != 0)
        return failure(fmt::format("the project did not come over (rsync ended with {}): {} is as it was", sent->status,
                                   remote.host()));
    const std::string from = shell_text(coming), to = shell_text(folder);
    const auto taken =
        remote.ask(fmt::format("mkdir -p {1} && rsync -a --delete --delay-updates{2} {0}/ {1}/", from, to, excludes));
    return taken ? Expected<void>() : Unexpected(taken.error());
}

Expected<int> push(const PushOptions& options) {
    auto remote = Remote::at(options.host, options.config);
    if (!remote) return Unexpected(remote.error());
    const auto project = project_here();
    if (!project) return Unexpected(project.error());
    if (auto same = compare_versions(*remote); !same) return Unexpected(same.error());
    const std::string folder = options.folder.empty() ? project->filename().string() : options.folder;
    if (auto over = bring_over(*remote, *project, folder); !over) return Unexpected(over.error());
    fmt::print("{} is on {} in {}\n", project->filename().string(), remote->host(), folder);
    if (options.run.empty()) return exit_done;
    std::fflush(stdout);
    const bool has_terminal = isatty(STDIN_FILENO) != 0 && isatty(STDOUT_FILENO) != 0;
    const auto ran = run_in_front(
        remote->ssh(fmt::format("cd {} && exec nezumi run {} --hw", shell_text(folder), shell_text(options.run)),
                    has_terminal),
        false);
    if (!ran) return Unexpected(ran.error());
    if (ran->status == no_connection)
        return failure(
            fmt::format("the connection to {} broke: its guard has stopped the robot if the run has ended, "
                        "`nezumi attach ssh:{}` tells whether it goes on",
                        remote->host(), remote->host()));
    return ran->status;
}

}  // namespace

SubCommand push_command() {
    auto options = std::make_shared<PushOptions>();
    return {.name = "push",
            .help = "Bring this project to a robot by ssh, where the running system reloads it",
            .options = {{"HOST", &options->host, "as ssh takes it, for example pi@mouse"},
                        {"--run", &options->run, "then run this system file of the project there, with --hw", "FILE"},
                        {"--to", &options->folder, "the folder there (default: the project's name, in the home folder)",
                         "DIR"},
                        {"--ssh-config", &options->config, "for ssh -F", "FILE"}},
            .run =
                [options] {
                    const auto status = push(*options);
                    return status ? *status : refuse(status.error());
                },
            .footer =
                "The versions of nezumi have to be the same on both. The project comes over whole or not at all; the "
                "robot's own calibrations stay.\nExit status: 0 it is there (with --run: that of the run), 2 it is "
                "not."};
}

}  // namespace nezumi::cli
