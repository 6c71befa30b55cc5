// Buttons of real robots that begin and end a run.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "engine/live/run_loop.hpp"

namespace nezumi {

/// Where a real robot's model names a start button, nothing moves before it has been pressed.
class StartButtons {
public:
    /// Pauses `loop` when there is something to wait for, and tells so. Both must outlive this.
    StartButtons(RunLoop& loop, std::function<void(std::string)> say);

private:
    void after_tick();

    RunLoop& loop_;
    std::function<void(std::string)> say_;
    std::vector<std::string> waiting_;  // robots whose button has not been pressed
};

/// Where a real robot's model names a button for it, a long press ends the run, and the computer is shut down after it.
class ShutdownButtons {
public:
    /// Both must outlive this.
    ShutdownButtons(RunLoop& loop, std::function<void(std::string)> say);

    static constexpr double long_press = 3;  ///< [s]

    /// After the run, when the robots stand: shuts the computer down if that was wanted. Tells when it can't.
    void finish() const;

private:
    void after_tick();

    RunLoop& loop_;
    std::function<void(std::string)> say_;
    std::map<std::string, double, std::less<>> pressed_at_;  // [s] by robot
    bool is_wanted_ = false;
};

}  // namespace nezumi
