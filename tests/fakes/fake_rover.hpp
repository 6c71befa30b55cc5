// A rover's microcontroller on a pseudo-terminal: it does what hw/rover/rover.ino does, and remembers every line.
#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace nezumi::hw {

class FakeRover {
public:
    /// Appears as the node `link`, a symbolic link to the terminal.
    explicit FakeRover(std::string link);
    ~FakeRover();
    FakeRover(const FakeRover&) = delete;
    FakeRover& operator=(const FakeRover&) = delete;

    /// The cable is pulled: the node is gone, and what is open fails.
    void unplug();
    void plug();

    struct Line {
        double tm;  ///< [s] by `clock_seconds`
        std::string text;
    };
    std::vector<Line> lines() const;
    std::string last_line() const;
    /// A line that is neither empty nor a whole command.
    std::vector<std::string> torn_lines() const;
    /// [m/s] commanded, after its own time-out.
    double speed() const { return speed_; }
    /// It sends this line once.
    void say(const std::string& line);
    /// It stops reading, as a microcontroller that hangs.
    void hang(bool hangs) { hangs_ = hangs; }

    static constexpr double time_out = 0.3;  ///< [s]

private:
    void live();
    void take(const std::string& line);

    const std::string link_;
    std::atomic<int> terminal_ = -1;
    int other_end_ = -1;
    std::atomic<bool> ends_ = false, hangs_ = false;
    std::atomic<double> speed_ = 0;
    double rate_ = 0, heard_at_ = 0, left_ = 0, right_ = 0;
    mutable std::mutex mutex_;
    std::string rest_;
    std::vector<Line> lines_;
    std::thread thread_;
};

}  // namespace nezumi::hw
