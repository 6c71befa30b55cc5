// The process of one pupil's system.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "engine/base/descriptor.hpp"
#include "engine/base/program.hpp"

namespace nezumi::web {

class PupilRun {
public:
    using Clock = std::chrono::steady_clock;

    /// Starts the command line `words`. Its standard input is the other end of the socket, for `open_relay`.
    explicit PupilRun(std::vector<std::string> words);
    /// Ends the process; waits at most `longest_end`.
    ~PupilRun();
    PupilRun(const PupilRun&) = delete;
    PupilRun& operator=(const PupilRun&) = delete;

    /// Our end of the socket, non-blocking; -1 if there is none.
    int socket() const { return socket_.get(); }
    /// Asks the process to end, by shutting down the socket. Does not wait. `socket` has nothing more to read then.
    void end();
    bool is_ending() const { return asked_.has_value(); }
    /// Kills the process if `end` was called `longest_end` ago or earlier.
    void hurry(Clock::time_point now);
    bool has_ended() const { return has_ended_; }
    /// The exit status after the end, 128 or more after a signal; -1 if the process could not be started.
    int status() const { return status_; }
    Clock::time_point begin() const { return begin_; }
    /// The text that the process has written to standard error; only the last part if the text is long.
    std::string said() const;
    /// [bytes] of memory that the process uses now; 0 if unknown.
    std::size_t memory() const;

    static constexpr std::chrono::seconds longest_end{3};
    static constexpr std::size_t longest_said = std::size_t{1} << 20;  ///< [bytes]

private:
    Descriptor socket_;
    UnnamedFile errors_;
    std::optional<Clock::time_point> asked_{};
    std::atomic<bool> give_up_ = false;
    std::atomic<bool> has_ended_ = false;
    std::atomic<int> status_ = -1;
    std::atomic<int> process_ = 0;
    Clock::time_point begin_ = Clock::now();
    std::thread thread_;
};

}  // namespace nezumi::web
