// The worlds of a scenario, which advance together with one clock.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "bindings/scenario/recordings.hpp"
#include "bindings/scenario/spectator.hpp"
#include "engine/base/error.hpp"
#include "engine/live/running_system.hpp"
#include "engine/system/pacer.hpp"

namespace nezumi {

/// Each world ticks at its own rate: in each step of the clock, the worlds tick that are due next. A world with real
/// robots waits for real time.
class Worlds {
public:
    /// Adds a world; its time begins now.
    RunningSystem& add(std::unique_ptr<RunningSystem> world);

    /// Adds a recorded run as a world.
    RunningSystem& add(std::unique_ptr<RecordedWorld> recording);

    /// Sets the observer of the run; null: none.
    void show_to(Spectator* spectator) { spectator_ = spectator; }

    bool empty() const { return worlds_.empty(); }
    std::size_t size() const { return worlds_.size(); }
    RunningSystem& operator[](std::size_t index) { return *worlds_[index].live; }
    /// The number of ticks of this world.
    std::int64_t ticks(std::size_t index) const { return worlds_[index].ticks; }

    /// Lets real robots brake and stop.
    void stop_robots();

    /// Simulated time since the start [s].
    double now() const { return now_; }
    /// The time after the next step; infinity if all worlds are recordings that have ended. There must be a world.
    double next() const;
    /// One step: every world that is due ticks. Returns the indices of these worlds. An error ends the run.
    Expected<std::vector<std::size_t>> step();
    /// The number of ticks of all worlds.
    std::int64_t ticks() const;

    /// A hash of everything that all worlds published.
    std::uint64_t trace_hash() const;

private:
    struct World {
        std::unique_ptr<RunningSystem> own;  // null if it is that of a recording
        RunningSystem* live;
        double began;
        std::int64_t ticks;
        std::unique_ptr<RecordedWorld> recording{};
        bool has_ended = false;  // it is a recording

        std::optional<Pacer> pacer{};  // from its first tick on, if robots are real

        // Whether it has real robots; then `now` is real time.
        bool is_real() const { return live->system().settings().real_time; }
        double now() const { return began + live->system().now().seconds; }
        double next() const {
            if (has_ended) return std::numeric_limits<double>::infinity();
            const double rate = live->system().settings().rate;
            return is_real() ? now() + 1 / rate : began + static_cast<double>(ticks + 1) / rate;
        }
        void tick(Spectator* spectator);
    };

    std::vector<World> worlds_;
    double now_ = 0;
    Spectator* spectator_ = nullptr;
};

}  // namespace nezumi
