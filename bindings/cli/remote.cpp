// Programs are run by their words, so that no name of a file or host is anything but a name.
#include "bindings/cli/remote.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "bindings/scenario/test_plan.hpp"

namespace nezumi::cli {

Expected<ProgramEnd> run_in_front(std::vector<std::string> words, bool keeps_output) {
    const std::string program = words.front();
    auto end = run_program({.words = std::move(words),
                            .input = own_file,
                            .output = own_file,
                            .errors = own_file,
                            .keeps_output = keeps_output,
                            .is_in_front = true,
                            .longest = std::numeric_limits<double>::infinity()});
    if (end) return end;
    return failure(
        fmt::format("{} can't be run: {}. Try: sudo apt install openssh-client rsync", program, end.error().message));
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
    auto ended = run_in_front(ssh(command), true);
    if (!ended) return Unexpected(ended.error());
    if (ended->status == no_connection) return failure(fmt::format("{} is not to be reached by ssh", host_));
    if (ended->status != 0) return failure(fmt::format("{}: `{}` ended with {}", host_, command, ended->status));
    return std::move(ended->out);
}

}  // namespace nezumi::cli
