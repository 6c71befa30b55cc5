// `nezumi push`: copies a project to the robot, where a running nezumi reloads it.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/version.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/console/put_text.hpp"
#include "bindings/push/remote.hpp"
#include "bindings/push/scan.hpp"
#include "bindings/push/send.hpp"
#include "bindings/scenario/test_plan.hpp"
#include "engine/base/lua_text.hpp"
#include "engine/project/project.hpp"

namespace nezumi::cli {
namespace {

namespace fs = std::filesystem;
using What = push::FileChange::What;

struct PushOptions {
    std::string host, run, config, folder;
    bool dry_run = false;
};

std::string our_version() { return fmt::format("nezumi {}", version()); }

// The project of the working directory.
Expected<fs::path> project_here() {
    std::error_code none;
    const fs::path here = fs::current_path(none);
    const fs::path root = Project::of(here / "x.lua").root();
    if (root.empty())
        return failure("there is no project here: expected a folder behaviors/ here or in a folder above");
    return fs::canonical(root, none);
}

// The command for the robot: prints its version of nezumi, and receives the project if the version is ours. Works in
// any `sh`.
std::string receiving_command() {
    return "exec sh -c " + shell_text(fmt::format("v=$(nezumi --version) || exit; echo \"$v\"; "
                                                  "test \"$v\" = '{}' && exec nezumi receive",
                                                  our_version()));
}

Expected<void> compare_versions(const push::Remote& remote, const std::string& theirs) {
    if (theirs.empty()) return failure(fmt::format("{} needs nezumi: install its package there", remote.host()));
    if (theirs == our_version()) return {};
    return failure(fmt::format("{} has {}, this computer has {}: install the same version on both", remote.host(),
                               shown(theirs), our_version()));
}

// Reads the version of the robot's nezumi; "" if there is none. A shell may print a greeting before it.
std::string take_version(const push::PushConnection& connection) {
    while (const auto line = connection.take_line()) {
        if (line->starts_with("nezumi ")) return *line;
    }
    return "";
}

Expected<push::Sent> send(const push::Remote& remote, const push::ProjectScan& project, const std::string& folder,
                          bool only_shows) {
    std::string version;
    Expected<push::Sent> sent;
    const auto ended = remote.talk(receiving_command(), [&](int from, int to) {
        const push::PushConnection connection(from, to);
        version = take_version(connection);
        if (version == our_version()) sent = push::send_project(connection, project, folder, only_shows);
    });
    if (!ended) return Unexpected(ended.error());
    if (version.empty() && ended->status == push::no_connection)
        return failure(fmt::format("{} can't be reached by ssh: does `ssh {}` work?", remote.host(), remote.host()));
    if (auto same = compare_versions(remote, version); !same) return Unexpected(same.error());
    const bool is_there = !sent && sent.error().place.file.empty();
    return is_there ? failure(fmt::format("{}: {}", remote.host(), sent.error().message)) : sent;
}

std::string_view word_for(What what) {
    switch (what) {
        case What::added: return "new";
        case What::changed: return "changed";
        case What::removed: return "removed";
        default: return "kept";
    }
}

// The name as one line: quoted if it has special characters.
std::string name_shown(const std::string& name) {
    const std::string quoted = lua_quoted(name);
    return quoted.size() == name.size() + 2 ? name : quoted;
}

// Explains which file was kept on the robot, and what to do.
std::string explain_kept(const push::FileChange& change) {
    switch (change.what) {
        case What::kept_edited: return "it was edited on the robot; copy it here or remove it there, then push again";
        case What::kept_own:
            return "it did not come from a push; copy it here, or rename or remove it on the robot, then push again";
        default: return "it was edited on the robot and is no longer in the project: push no longer manages it";
    }
}

void say_changes(const push::Sent& sent, const std::string& host, bool only_shows) {
    for (const push::FileChange& change : sent.changes) {
        const std::string name = name_shown(change.name);
        if (only_shows) put_text(stdout, fmt::format("{:<8} {}\n", word_for(change.what), name));
        if (!push::is_change(change.what))
            put_text(stderr, fmt::format("nezumi: {} is kept on {}: {}\n", name, host, explain_kept(change)));
    }
    if (sent.has_finished)
        put_text(stderr, fmt::format("nezumi: an interrupted push to {} was finished first\n", host));
    if (!sent.copy_before.empty() && !only_shows)
        put_text(stderr, fmt::format("nezumi: {} no longer needs the folder {}, which an earlier version of nezumi "
                                     "made: you can remove it\n",
                                     host, sent.copy_before));
}

Expected<int> run_there(const push::Remote& remote, const std::string& folder, std::string file) {
    if (file.starts_with("-")) file.insert(0, "./");  // a file, not an option
    const bool has_terminal = isatty(STDIN_FILENO) != 0 && isatty(STDOUT_FILENO) != 0;
    const auto ran = push::run_in_front(remote.ssh(
        fmt::format("cd {} && exec nezumi run {} --hw", shell_text(folder), shell_text(file)), has_terminal));
    if (!ran) return Unexpected(ran.error());
    if (ran->status == push::no_connection)
        return failure(
            fmt::format("the connection to {} broke: if the run has ended, the guard process has stopped the robot; "
                        "`nezumi attach ssh:{}` shows whether the run continues",
                        remote.host(), remote.host()));
    return ran->status;
}

Expected<int> push_project(const PushOptions& options) {
    if (options.dry_run && !options.run.empty())
        return failure("--dry-run only shows what would change: leave out --run");
    const auto remote = push::Remote::at(options.host, options.config);
    if (!remote) return Unexpected(remote.error());
    const auto root = project_here();
    if (!root) return Unexpected(root.error());
    const auto project = push::scan_project(*root);
    if (!project) return Unexpected(project.error());
    const std::string folder = options.folder.empty() ? root->filename().string() : options.folder;

    const auto sent = send(*remote, *project, folder, options.dry_run);
    if (!sent) return Unexpected(sent.error());
    for (const std::string& name : project->passed_over)
        put_text(stderr, fmt::format("nezumi: {} is skipped: it is not a file, folder or link\n", name_shown(name)));
    say_changes(*sent, remote->host(), options.dry_run);
    const bool is_whole = std::none_of(sent->changes.begin(), sent->changes.end(),
                                       [](const push::FileChange& change) { return push::is_withheld(change.what); });
    if (options.dry_run) {
        put_text(stdout, fmt::format("nothing was changed on {}\n", remote->host()));
        return is_whole ? exit_done : exit_failed;
    }
    put_text(stdout, fmt::format("{} is on {} in {}{}\n", root->filename().string(), remote->host(), folder,
                                 is_whole ? "" : ", except for the files that were kept"));
    if (options.run.empty()) return is_whole ? exit_done : exit_failed;
    if (!is_whole)
        return failure(fmt::format("{} is not run, because {} kept files that differ from the project", options.run,
                                   remote->host()));
    std::fflush(stdout);
    return run_there(*remote, sent->folder, options.run);
}

}  // namespace

SubCommand push_command() {
    auto options = std::make_shared<PushOptions>();
    return {
        .name = "push",
        .help = "Copy this project to a robot by ssh; a system that runs on the robot reloads it",
        .options = {{"HOST", &options->host, "the address for ssh, for example pi@mouse"},
                    {"--run", &options->run, "then run this system file of the project on the robot, with --hw",
                     "FILE"},
                    {"--to", &options->folder,
                     "the folder on the robot (default: the project's name, in the home folder)", "DIR"},
                    {"--dry-run", &options->dry_run, "only show the changes that would be made on the robot"},
                    {"--ssh-config", &options->config, "the configuration file for ssh (ssh -F)", "FILE"}},
        .run =
            [options] {
                const auto status = push_project(*options);
                return status ? *status : refuse(status.error());
            },
        .footer =
            "Both computers need the same version of nezumi. The project is copied completely or not at all. Only "
            "files from an earlier push are replaced or removed: files that the robot has written stay, and a file "
            "that was edited on the robot is kept and reported.\nExit status: 0 the project was copied (with --run: "
            "the exit status of the run), 1 it was copied except for files that were kept, 2 it was not copied."};
}

}  // namespace nezumi::cli
