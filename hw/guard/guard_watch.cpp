// What a guard does becomes lines for a person.
#include "hw/guard/guard_watch.hpp"

#include <fmt/format.h>

#include "hw/device/clock.hpp"

namespace nezumi::hw {

bool GuardWatch::has_stopped() {
    if (!guard_->has_stopped()) return false;
    health_.lost(
        fmt::format("it has stopped them, as nothing came from the control loop for {} s: the robot drives "
                    "again with the next commands",
                    beat_timeout));
    return true;
}

bool GuardWatch::is_awake(double now) {
    if (guard_->has_ended()) {
        health_.lost("its process has ended, and without it the motors get no power: start the run again");
        return false;
    }
    if (guard_->is_late(now)) {
        health_.lost("its process does not answer, and without it the motors get no power");
        return false;
    }
    return true;
}

void GuardWatch::beat() {
    guard_->beat(clock_seconds());
    health_.works();
}

}  // namespace nezumi::hw
