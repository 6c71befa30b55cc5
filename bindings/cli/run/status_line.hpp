// The line below the log on a terminal, updated ten times per second: simulated time, speed, lateness, states of
// components.
#pragma once

#include <deque>
#include <string>

#include "bindings/cli/run/screen.hpp"
#include "engine/live/run_loop.hpp"

namespace nezumi::cli {

class StatusLine final : public Attendant {
public:
    /// `loop` and `screen` must outlive this object.
    StatusLine(const RunLoop& loop, Screen& screen) : loop_(loop), screen_(screen) {}

    bool serve(Pacer::Clock::time_point until) override;

private:
    // The times of the wall clock and of the simulation.
    struct Sample {
        Pacer::Clock::time_point wall;
        double simulated;  // [s]
    };

    double reached_speed() const;
    void show(std::size_t columns);

    const RunLoop& loop_;
    Screen& screen_;
    std::deque<Sample> samples_;  // of about the last second
};

}  // namespace nezumi::cli
