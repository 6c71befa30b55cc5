// Reports the guard's actions as messages.
#include "hw/guard/guard_watch.hpp"

#include <fmt/format.h>

#include "hw/device/clock.hpp"

namespace nezumi::hw {

bool GuardWatch::may_turn(double now) {
    if (guard_->has_ended()) {
        health_.lost("its process has ended, and without it the motors get no power: start the run again");
    } else if (guard_->is_late(now)) {
        health_.lost("its process does not answer, and without it the motors get no power");
    } else if (guard_->is_proved(now)) {
        health_.works();
        return true;
    }
    return false;
}

bool GuardWatch::must_stop(double now, bool they_turn) {
    const bool has_stopped = guard_->has_stopped();
    if (!has_stopped && (!they_turn || may_turn(now))) return false;
    // Only a stall of the control loop is reported here; `may_turn` and the caller report problems of the guard.
    const bool is_stall = has_stopped || !(guard_->has_ended() || guard_->is_late(now) || guard_->trouble());
    if (is_stall)
        health_.lost(
            fmt::format("the motors were stopped, as nothing came from the control loop for {} s: the robot drives "
                        "again with the next commands",
                        beat_timeout));
    return true;
}

void GuardWatch::beat() { guard_->beat(clock_seconds()); }

}  // namespace nezumi::hw
