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

    /// Starts `words`, a command line with standard input as the socket of `open_relay`.
    explicit PupilRun(std::vector<std::string> words);
    /// Ends it; waits at most `longest_end`.
    ~PupilRun();
    PupilRun(const PupilRun&) = delete;
    PupilRun& operator=(const PupilRun&) = delete;

    /// Our end of the socket, without waiting; -1 if there is none.
    int socket() const { return socket_.get(); }
    /// Asks it to end, without waiting. `socket` has nothing more then.
    void end();
    bool is_ending() const { return asked_.has_value(); }
    /// Kills it if it was asked `longest_end` ago.
    void hurry(Clock::time_point now);
    bool has_ended() const { return has_ended_; }
    /// Its exit status after the end, 128 and more after a signal; -1 if it could not be started.
    int status() const { return status_; }
    Clock::time_point begin() const { return begin_; }
    /// What it has written to standard error; the first part is dropped if it is long.
    std::string said() const;
    /// [bytes] of memory that it uses now; 0 if unknown.
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
