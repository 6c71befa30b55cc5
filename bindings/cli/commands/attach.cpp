// `nezumi attach`: the console of a running system.
#include <fmt/core.h>
#include <unistd.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/console/client.hpp"
#include "bindings/console/socket_directory.hpp"
#include "bindings/push/remote.hpp"
#include "bindings/scenario/test_plan.hpp"
#include "bindings/terminal/batch.hpp"
#include "bindings/terminal/input_history.hpp"
#include "bindings/terminal/terminal.hpp"

namespace nezumi::cli {
namespace {

// [ms] How long to wait for an answer. A system answers between two ticks, and a tick may wait for a script or a disk.
constexpr int longest_silence = 5000;

struct AttachOptions {
    std::string which;
    std::optional<std::string> eval;
    double timeout = 0;  // [s]; 0: none
    bool list = false;
    std::string ssh_config;
};

int list_systems() {
    const auto systems = running_systems();
    if (!systems) return refuse(systems.error());
    for (const ListeningSystem& system : *systems) fmt::print("{:<8} {}\n", system.process, system.name);
    return systems->empty() ? refuse("nothing is running: start a system with `nezumi run FILE`") : exit_done;
}

// For a system on another computer, runs `nezumi attach` there.
Expected<int> attach_by_ssh(const AttachOptions& options, const std::string& which) {
    const std::size_t slash = which.find('/');
    const auto remote = push::Remote::at(which.substr(0, slash), options.ssh_config);
    if (!remote) return Unexpected(remote.error());
    std::string command = "nezumi attach";
    if (slash != which.npos) command += " " + shell_text(which.substr(slash + 1));
    if (options.eval) command += " --eval " + shell_text(*options.eval);
    if (options.timeout > 0) command += fmt::format(" --timeout {}", options.timeout);
    if (options.list) command += " --list";
    const bool has_terminal = !options.eval && isatty(STDIN_FILENO) != 0 && isatty(STDOUT_FILENO) != 0;
    const auto ended = push::run_in_front(remote->ssh(command, has_terminal));
    if (!ended) return Unexpected(ended.error());
    if (ended->status == push::no_connection)
        return failure(fmt::format("{} can't be reached by ssh, or the connection broke", remote->host()));
    constexpr int not_found = 127;  // exit status of a shell for an unknown command
    if (ended->status == not_found)
        return failure(fmt::format("{} needs nezumi: install its package there", remote->host()));
    return ended->status;
}

int attach(const AttachOptions& options) {
    constexpr std::string_view by_ssh = "ssh:";
    const bool is_remote = options.which.starts_with(by_ssh);
    if (options.list && options.eval) return refuse("--list only lists running systems: leave out --eval");
    if (options.timeout > 0 && !options.eval) return refuse("--timeout works only with --eval");
    if (!options.ssh_config.empty() && !is_remote)
        return refuse("--ssh-config is for a system on another computer, as in ssh:pi@mouse");
    if (is_remote) {
        const auto status = attach_by_ssh(options, options.which.substr(by_ssh.size()));
        return status ? *status : refuse(status.error());
    }
    if (options.list) return list_systems();
    auto reached = connect_to_system(options.which);
    if (!reached) return refuse(reached.error());
    ConsoleClient client(std::move(reached->socket));
    if (!client.is_answered(longest_silence)) return refuse(no_answer(reached->system));
    if (options.eval) {
        const auto timeout = options.timeout > 0 ? std::optional(options.timeout) : std::nullopt;
        return run_text(client, *options.eval, {}, timeout) ? exit_done : exit_failed;
    }
    if (isatty(STDIN_FILENO) == 0 || isatty(STDOUT_FILENO) == 0)
        return run_batch(client, {}).well ? exit_done : exit_failed;

    const auto end = run_prompt(
        client, {.greeting = "attached to " + list_of({reached->system}) + "; help() shows the commands, Ctrl-D leaves",
                 .history = history_path(),
                 .attached = true});
    return end ? static_cast<int>(exit_done) : refuse(end.error());
}

}  // namespace

SubCommand attach_command() {
    auto options = std::make_shared<AttachOptions>();
    return {
        .name = "attach",
        .help = "Open the console of a running system",
        .options = {{"[SYSTEM]", &options->which,
                     "the name of its system file, or its process number; may be omitted if only one system runs. "
                     "ssh:pi@mouse or ssh:pi@mouse/SYSTEM: a system on another computer"},
                    {"--eval", &options->eval, "run this command, print the result and exit: exit status 1 if it fails",
                     "LUA"},
                    {"--timeout", &options->timeout, "with --eval: interrupt the command after this many seconds", "S",
                     number_from(0.001, 1e6)},
                    {"--list", &options->list, "only list the running systems and their processes"},
                    {"--ssh-config", &options->ssh_config, "with ssh:HOST: the configuration file for ssh (ssh -F)",
                     "FILE"}},
        .run = [options] { return attach(*options); },
        .footer =
            "Without a terminal, commands are read from standard input. Exit status: 0 success, 1 a command failed, 2 "
            "there is no system to attach to."};
}

}  // namespace nezumi::cli
