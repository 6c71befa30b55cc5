// The turns at the shared system of a class: the pupil who drives, and the pupils who wait.
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <optional>

namespace nezumi::web {

/// Pupils are given as their numbers.
class Turns {
public:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::minutes usual_limit{5}, longest_limit{120};
    /// A pupil without a page for longer than this gives up the turn, or the place in the queue.
    static constexpr std::chrono::seconds longest_absence{10};

    /// The pupil whose turn it is; 0: none.
    int driver() const { return driver_; }
    /// The waiting pupils, the next one first.
    const std::deque<int>& waiting() const { return waiting_; }
    /// The pupil's place in the queue, from 1; 0: the pupil does not wait.
    std::size_t place_of(int pupil) const;
    std::chrono::minutes limit() const { return limit_; }
    /// Sets the length of a turn, also of the present one. Ignores values outside 1 minute ... `longest_limit`.
    void set_limit(std::chrono::minutes limit);
    /// The time left of the present turn; zero without a driver.
    Clock::duration left(Clock::time_point now) const;

    /// Adds a pupil at the end of the queue. Does nothing for the driver and for a pupil who already waits.
    void enter(int pupil);
    /// Removes a pupil from the queue; does not end a turn.
    void remove(int pupil);
    /// Swaps a pupil with the one before in the queue.
    void move_up(int pupil);

    /// Begins the turn of the first pupil in the queue. Returns false if a turn goes on, or no pupil waits.
    bool begin(Clock::time_point now);
    void end() { driver_ = 0; }

    /// Removes waiting pupils who have been away too long. Returns true if the turn is over: its time is up, or the
    /// driver has been away too long.
    bool look(Clock::time_point now, const std::function<bool(int pupil)>& is_there);

private:
    struct Away {
        int pupil = 0;
        Clock::time_point since{};
    };

    std::deque<int> waiting_;
    std::deque<Away> away_;
    std::chrono::minutes limit_ = usual_limit;
    Clock::time_point begin_{};
    int driver_ = 0;
};

}  // namespace nezumi::web
