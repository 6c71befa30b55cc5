// Buttons of real robots that start and end a run.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "engine/live/run_loop.hpp"

namespace nezumi {

/// If the model of a real robot has a start button, nothing moves before it has been pressed.
class StartButtons {
public:
    /// Pauses `loop` if there is a button to wait for, and reports it. `loop` and the objects that `say` uses must
    /// outlive this object.
    StartButtons(RunLoop& loop, std::function<void(std::string)> say);

private:
    void after_tick();

    RunLoop& loop_;
    std::function<void(std::string)> say_;
    std::vector<std::string> waiting_;  // robots whose button has not been pressed
};

/// If the model of a real robot has a shutdown button, a long press ends the run, and then the computer is shut down.
class ShutdownButtons {
public:
    /// `loop` and the objects that `say` uses must outlive this object.
    ShutdownButtons(RunLoop& loop, std::function<void(std::string)> say);

    static constexpr double long_press = 3;  ///< [s]

    /// After the run, when the robots stand: shuts the computer down if this was requested. Reports an error.
    void finish() const;

private:
    void after_tick();

    RunLoop& loop_;
    std::function<void(std::string)> say_;
    std::map<std::string, double, std::less<>> pressed_at_;  // [s] by robot
    bool is_wanted_ = false;
};

}  // namespace nezumi
