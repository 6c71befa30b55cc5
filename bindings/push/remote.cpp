// Runs programs on a robot's computer by ssh. Programs are run without a shell, so names of files and hosts have no
// special meaning.
#include "bindings/push/remote.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <limits>
#include <string_view>
#include <thread>
#include <utility>

#include "engine/base/descriptor.hpp"

namespace nezumi::push {

namespace {

// True if ssh would misread the name: as an option, as another host, or as text for a shell.
bool is_odd(std::string_view host) {
    if (host.find_first_of(" :/'\"\\") != host.npos) return true;
    if (std::any_of(host.begin(), host.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; })) return true;
    while (true) {
        const auto at = std::min(host.find('@'), host.size());
        if (at == 0 || host.front() == '-') return true;
        if (at == host.size()) return false;
        host.remove_prefix(at + 1);
        if (host.empty()) return true;
    }
}

}  // namespace

Expected<ProgramEnd> run_in_front(std::vector<std::string> words, int input, int output) {
    const std::string program = words.front();
    auto end = run_program({.words = std::move(words),
                            .input = input,
                            .output = output,
                            .errors = own_file,
                            .is_in_front = true,
                            .longest = std::numeric_limits<double>::infinity()});
    if (end) return end;
    return failure(
        fmt::format("{} can't be run: {}. Try: sudo apt install openssh-client", program, end.error().message));
}

Expected<Remote> Remote::at(std::string host, std::string config) {
    if (is_odd(host)) return failure(fmt::format("expected a user and a host as in pi@mouse, got '{}'", shown(host)));
    return Remote(std::move(host), std::move(config));
}

std::vector<std::string> Remote::ssh(const std::string& command, bool has_terminal) const {
    std::vector<std::string> words{"ssh"};
    if (!config_.empty()) words.insert(words.end(), {"-F", config_});
    words.emplace_back(has_terminal ? "-t" : "-T");
    words.insert(words.end(), {"--", host_, command});
    return words;
}

Expected<ProgramEnd> Remote::talk(const std::string& command, const std::function<void(int from, int to)>& talk) const {
    std::array<int, 2> there{}, back{};
    if (pipe2(there.data(), O_CLOEXEC) != 0) return failure(std::strerror(errno));
    Descriptor read_there(there[0]), write_here(there[1]);
    if (pipe2(back.data(), O_CLOEXEC) != 0) return failure(std::strerror(errno));
    Descriptor read_here(back[0]), write_there(back[1]);
    // Writing to a program that has ended must be an error, not the end of this program.
    const auto pipe_before = std::signal(SIGPIPE, SIG_IGN);
    Expected<ProgramEnd> end;
    std::thread program([&] {
        end = run_in_front(ssh(command), read_there.get(), write_there.get());
        read_there.close();
        write_there.close();
    });
    talk(read_here.get(), write_here.get());
    write_here.close();
    read_here.close();
    program.join();
    std::signal(SIGPIPE, pipe_before);
    return end;
}

}  // namespace nezumi::push
