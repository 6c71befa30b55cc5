// A robot's computer that is reached by ssh.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/program.hpp"

namespace nezumi::push {

/// Runs a program of `words` to its end, with our terminal as its own; `input` and `output` are files it has in place
/// of ours. An error when it can't be run.
Expected<ProgramEnd> run_in_front(std::vector<std::string> words, int input = own_file, int output = own_file);

class Remote {
public:
    /// `host` as ssh takes it, "pi@mouse"; `config` a file for `ssh -F`, "" for the user's own. An error where ssh
    /// would take the host for something else.
    static Expected<Remote> at(std::string host, std::string config);

    const std::string& host() const { return host_; }
    /// The words that run a command there, a text for its shell. With `has_terminal` it gets one.
    std::vector<std::string> ssh(const std::string& command, bool has_terminal = false) const;
    /// Runs a command there to its end, while `talk` reads what it writes (`from`) and writes what it reads (`to`). An
    /// error when ssh can't be run.
    Expected<ProgramEnd> talk(const std::string& command, const std::function<void(int from, int to)>& talk) const;

private:
    Remote(std::string host, std::string config) : host_(std::move(host)), config_(std::move(config)) {}

    std::string host_, config_;
};

/// What ssh ends with when it came nowhere.
inline constexpr int no_connection = 255;

}  // namespace nezumi::push
