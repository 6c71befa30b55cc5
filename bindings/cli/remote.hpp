// A robot's computer that is reached by ssh.
#pragma once

#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/program.hpp"

namespace nezumi::cli {

/// Runs a program of `words` to its end, with our terminal as its own; with `keeps_output` what it says on standard
/// output is kept. An error when it can't be run.
Expected<ProgramEnd> run_in_front(std::vector<std::string> words, bool keeps_output);

class Remote {
public:
    /// `host` as ssh takes it, "pi@mouse"; `config` a file for `ssh -F`, "" for the user's own. An error where ssh
    /// would take the host for something else.
    static Expected<Remote> at(std::string host, std::string config);

    const std::string& host() const { return host_; }
    /// The words that run a command there, a text for its shell. With `has_terminal` it gets one.
    std::vector<std::string> ssh(const std::string& command, bool has_terminal = false) const;
    /// The same for the option -e of rsync.
    std::string for_rsync() const;
    /// What a command says there; an error names what failed.
    Expected<std::string> ask(const std::string& command) const;

private:
    Remote(std::string host, std::string config) : host_(std::move(host)), config_(std::move(config)) {}

    std::string host_, config_;
};

/// What ssh ends with when it came nowhere.
inline constexpr int no_connection = 255;

}  // namespace nezumi::cli
