// Programs are run by their words, so that no name of a file or host is anything but a name.
#include "bindings/cli/remote.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "bindings/scenario/test_plan.hpp"

namespace nezumi::cli {

Expected<Ended> run_program(const std::vector<std::string>& words, bool keeps_output) {
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
    pointers.push_back(nullptr);
    int ends[2] = {-1, -1};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    if (keeps_output) {
        if (pipe2(ends, O_CLOEXEC) != 0) return failure(std::string("no pipe: ") + std::strerror(errno));
        posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    }
    pid_t child = 0;
    const int problem = posix_spawnp(&child, pointers[0], &actions, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (keeps_output) close(ends[1]);
    if (problem != 0) {
        if (keeps_output) close(ends[0]);
        return failure(fmt::format("{} can't be run: {}. Try: sudo apt install openssh-client rsync", words.front(),
                                   std::strerror(problem)));
    }
    Ended ended;
    std::array<char, 4096> buffer{};
    while (keeps_output) {
        const ssize_t length = read(ends[0], buffer.data(), buffer.size());
        if (length < 0 && errno == EINTR) continue;
        if (length <= 0) break;
        ended.out.append(buffer.data(), static_cast<std::size_t>(length));
    }
    if (keeps_output) close(ends[0]);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    ended.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return ended;
}

Expected<Remote> Remote::at(std::string host, std::string config) {
    const bool is_odd = host.empty() || host.front() == '-' || host.find_first_of(" \t\n:/'\"\\") != host.npos;
    if (is_odd) return failure(fmt::format("expected a user and a host as in pi@mouse, got '{}'", shown(host)));
    return Remote(std::move(host), std::move(config));
}

std::vector<std::string> Remote::ssh(const std::string& command, bool has_terminal) const {
    std::vector<std::string> words{"ssh"};
    if (!config_.empty()) words.insert(words.end(), {"-F", config_});
    words.emplace_back(has_terminal ? "-t" : "-T");
    words.insert(words.end(), {"--", host_, command});
    return words;
}

std::string Remote::for_rsync() const { return config_.empty() ? "ssh" : "ssh -F " + shell_text(config_); }

Expected<std::string> Remote::ask(const std::string& command) const {
    auto ended = run_program(ssh(command), true);
    if (!ended) return Unexpected(ended.error());
    if (ended->status == no_connection) return failure(fmt::format("{} is not to be reached by ssh", host_));
    if (ended->status != 0) return failure(fmt::format("{}: `{}` ended with {}", host_, command, ended->status));
    return std::move(ended->out);
}

}  // namespace nezumi::cli
