// A tacho motor as ev3dev's drivers have it: what is set takes effect with the command that follows.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace nezumi::fakes {

class Ev3Motor {
public:
    /// `fastest` [pulses/s] that it takes.
    explicit Ev3Motor(int fastest) : fastest_(fastest) {}

    enum class Mode { roll, hold, run, go };

    /// As the driver returns it: 0, or -errno.
    int write(const std::string& attribute, std::string_view text, double now);
    /// Nothing when there is no such attribute.
    std::optional<std::string> read(const std::string& attribute, double now);

    /// It was plugged in: all is as it is made, and its position 0.
    void plug_in(double now);
    /// Where it stands, by what turns it [pulses].
    void set_turned(std::int64_t pulses) { turned_ = pulses; }

    Mode mode(double now) {
        settle(now);
        return mode_;
    }
    /// [pulses/s] that it is told to run at.
    int rate(double now) {
        settle(now);
        return mode_ == Mode::run ? rate_ : 0;
    }
    /// While it goes to a position: how far the goal is [pulses of `set_turned`], and how fast it goes there
    /// [pulses/s].
    std::int64_t goal() const { return goal_ + zero_; }
    int pace() const { return rate_; }
    /// Since when it has not run [s].
    double stopped_at(double now) {
        settle(now);
        return stopped_at_;
    }

private:
    int command(std::string_view text, double now);
    void settle(double now);
    void stop(double at);

    int fastest_;
    std::map<std::string, std::string> set_;
    Mode mode_ = Mode::roll;
    int rate_ = 0;
    double until_ = 0;  // run-timed; 0: no end
    std::int64_t goal_ = 0, turned_ = 0, zero_ = 0;
    double stopped_at_ = 0;
};

}  // namespace nezumi::fakes
