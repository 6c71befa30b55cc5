// A robot's computer that is reached by ssh.
#pragma once

#include <string>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::cli {

/// How a program ended, and what it said on standard output.
struct Ended {
    int status = 0;  ///< exit status; 128 and its number for a signal
    std::string out;
};

/// Runs a program to its end, found by PATH, without a shell. Its standard error is ours; with `keeps_output` its
/// standard output is kept, else it is ours as well. An error when it can't be run.
Expected<Ended> run_program(const std::vector<std::string>& words, bool keeps_output);

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
