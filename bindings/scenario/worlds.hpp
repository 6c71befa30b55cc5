// The worlds of one scenario, which advance together on one clock.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "bindings/lua/live/live_system.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// Each world ticks at its own rate: at every step of the clock those tick that are due next.
class Worlds {
public:
    /// Its time begins now.
    LiveSystem& add(std::unique_ptr<LiveSystem> world);

    bool empty() const { return worlds_.empty(); }
    std::size_t size() const { return worlds_.size(); }
    LiveSystem& operator[](std::size_t index) { return *worlds_[index].live; }
    /// Ticks that this world has made.
    std::int64_t ticks(std::size_t index) const { return worlds_[index].ticks; }

    /// Simulated time since the start [s].
    double now() const { return now_; }
    /// The time that the next step leads to. There must be a world.
    double next() const;
    /// One step: every world that is due ticks. Returns which. An error ends the run.
    Expected<std::vector<std::size_t>> step();
    /// All ticks of all worlds.
    std::int64_t ticks() const;

    /// Of everything that all worlds published.
    std::uint64_t trace_hash() const;

private:
    struct World {
        std::unique_ptr<LiveSystem> live;
        double began;
        std::int64_t ticks;

        double next() const { return began + static_cast<double>(ticks + 1) / live->system().settings().rate; }
    };

    std::vector<World> worlds_;
    double now_ = 0;
};

}  // namespace nezumi
