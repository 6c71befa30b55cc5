// A robot's computer, reached by ssh.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/program.hpp"

namespace nezumi::push {

/// Runs the program `words` to its end in the foreground of our terminal. `input` and `output` replace its standard
/// input and output. Fails if the program can't be run.
Expected<ProgramEnd> run_in_front(std::vector<std::string> words, int input = own_file, int output = own_file);

class Remote {
public:
    /// `host` in ssh's form, "pi@mouse". `config` is a file for `ssh -F`, "" for the user's own. Fails if ssh would
    /// misread the host.
    static Expected<Remote> at(std::string host, std::string config);

    const std::string& host() const { return host_; }
    /// The arguments of ssh that run a command on the other computer; the command is a text for the shell there.
    /// `has_terminal` requests a terminal.
    std::vector<std::string> ssh(const std::string& command, bool has_terminal = false) const;
    /// Runs a command on the other computer to its end, while `talk` reads its output (`from`) and writes its input
    /// (`to`). Fails if ssh can't be run.
    Expected<ProgramEnd> talk(const std::string& command, const std::function<void(int from, int to)>& talk) const;

private:
    Remote(std::string host, std::string config) : host_(std::move(host)), config_(std::move(config)) {}

    std::string host_, config_;
};

/// The exit status of ssh if there is no connection.
inline constexpr int no_connection = 255;

}  // namespace nezumi::push
