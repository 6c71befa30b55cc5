// Runs a system tick by tick, in real time or as fast as possible, and serves others between two ticks.
#pragma once

#include <csignal>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "engine/live/clock_control.hpp"
#include "engine/live/problems.hpp"
#include "engine/live/running_system.hpp"
#include "engine/system/lateness.hpp"
#include "engine/system/pacer.hpp"

namespace nezumi {

/// Something that is served between two ticks: the console, its socket, a status line.
class Attendant {
public:
    virtual ~Attendant() = default;

    /// Does the work that waits. If all ticks are on time, `until` is the time of the next one, at most
    /// `RunLoop::longest_wait` away; longer work must be left for the next turn. Returns whether more work waits; then
    /// the next turn comes as soon as possible.
    virtual bool serve(Pacer::Clock::time_point until) = 0;

    /// Adds the file descriptors that this attendant reads: its next turn comes as soon as one of them is readable.
    virtual void add_files(std::vector<int>& /*files*/) const {}
};

class RunLoop final : public ClockControl {
public:
    /// The period of turns for attendants with work if ticks leave no time [s].
    static constexpr double slice = 0.002;
    /// The longest time between two turns, and the longest turn [s].
    static constexpr double longest_wait = 0.05;

    struct Options {
        double speed = 1;                    ///< a factor of real time, or `as_fast_as_possible`
        const Problems* problems = nullptr;  ///< logged warnings and errors; must outlive the loop
    };

    /// The system must outlive the loop, be active, and be ticked only by the loop.
    RunLoop(RunningSystem& live, const Options& options);

    /// Attendants are served in the order of adding, and must outlive the loop.
    void add(Attendant& attendant) { attendants_.push_back(&attendant); }
    /// Adds a function that is called before every tick. If it ends the run, the tick does not come.
    void before_tick(std::function<void()> action) { before_tick_.push_back(std::move(action)); }
    /// Adds a function that is called after every tick.
    void after_tick(std::function<void()> action) { after_tick_.push_back(std::move(action)); }
    /// The run ends as soon as `flag` is not 0; a signal handler sets it. `flag` must outlive the loop.
    void end_when(const volatile std::sig_atomic_t& flag) { end_ = &flag; }
    /// The run ends at this simulated time [s].
    void end_at(double seconds) { end_at_ = seconds; }
    /// If time is paused at the end time, the run does not end while this returns true. So a command that needs no more
    /// simulated time can finish.
    void end_waits_while(std::function<bool()> works) { works_ = std::move(works); }

    /// While this returns true, a run as fast as possible waits, because the reader of its output is slow. A run with
    /// another speed continues.
    void wait_while(std::function<bool()> behind) { behind_ = std::move(behind); }

    /// Runs until the end: `quit`, `end_when`, `end_at`, or a fatal error of the system.
    void run();
    /// Serves until the next tick is due and runs it, for a caller that decides tick by tick whether there is another
    /// one. Returns false if the run has ended; then there was no tick.
    bool next_tick();
    /// Does what `run` would do in about this time [s], but never waits: for programs with their own loop. Returns the
    /// time until more is due [s]; 0: at once, negative: the run has ended.
    double go_on(double seconds);
    /// Waits until the next tick is due and runs it, without serving attendants: for programs with their own loop.
    void tick();

    // Functions for attendants in their turn, and for any caller before `run`.
    bool is_hardware() const override { return live_.system().settings().real_time; }
    /// In simulation no ticks come from now on. Real robots stand, and their system continues to tick, at rest.
    void pause() override;
    void resume() override;
    bool is_paused() const override { return ticks_left_ == 0; }
    void advance(std::int64_t ticks) override;
    bool is_advancing() const override { return ticks_left_ > 0 && ticks_left_ < forever; }
    std::uint64_t moves() const override { return moves_; }
    void set_speed(double factor) override;
    double speed() const override { return options_.speed; }
    void quit() override { quit_ = true; }
    std::vector<LogLine> problems() const override;

    /// Simulated seconds that have passed in total, over restarts.
    double advanced() const { return advanced_; }
    /// Whether `end_when` has ended the run.
    bool interrupted() const { return end_ != nullptr && *end_ != 0; }
    /// Whether only `end_at` has ended the run.
    bool came_to_end() const { return !quit_ && !interrupted() && is_at_end(); }
    Lateness lateness() const;
    RunningSystem& live() { return live_; }
    const RunningSystem& live() const { return live_; }

private:
    using Clock = Pacer::Clock;
    static constexpr std::int64_t forever = std::numeric_limits<std::int64_t>::max();

    bool ended() const;
    bool is_at_end() const { return live_.system().now().seconds >= end_at_ - 1e-9; }
    /// Whether time has stopped, so that no tick comes.
    bool stands_still() const { return is_paused() && !is_hardware(); }
    void follow_restart();
    void pace_anew();
    bool begin_tick();
    void serve_until_due();
    double spare_seconds() const;
    void serve(Clock::time_point until);
    void wait_for_hosts();
    void wait_for_files(double seconds, bool of_hosts_alone = false);

    RunningSystem& live_;
    Options options_;
    double end_at_ = as_fast_as_possible;
    std::function<bool()> works_;
    std::function<bool()> behind_;
    const volatile std::sig_atomic_t* end_ = nullptr;
    std::vector<Attendant*> attendants_;
    std::vector<std::function<void()>> before_tick_;
    std::vector<std::function<void()>> after_tick_;
    std::unique_ptr<Pacer> pacer_;  // none: as fast as possible
    Lateness before_;               // of earlier pacers
    Clock::time_point served_{};
    std::int64_t ticks_left_ = forever;
    std::uint64_t moves_ = 0;
    double advanced_ = 0;
    int generation_ = 0;
    bool more_waits_ = false;
    bool quit_ = false;
};

}  // namespace nezumi
