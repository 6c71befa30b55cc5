// Reports whether a device is lost or works again.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/mutex.hpp"
#include "hw/device/clock.hpp"

namespace nezumi::hw {

/// The reason when the device's thread hangs.
inline constexpr const char* no_answer = "no answer for 0.3 s: restart its driver, or the robot";

/// Reports each loss once, and the recovery when it has lasted; so a device that fails again and again counts as lost.
/// Any thread may call it.
class Health {
public:
    /// `device` is the name in messages: "light sensors". "" if the messages get a component's name later.
    explicit Health(std::string device) : prefix_(device.empty() ? "" : std::move(device) + ": ") {}

    /// The device does not work, for this reason. Reported only if it worked before.
    void lost(const std::string& why);
    /// The device works at `now` (`clock_seconds`).
    void works(double now = clock_seconds());
    /// True if it did not work at the last try.
    bool is_lost() const;
    /// Returns the new messages, one line each.
    std::vector<std::string> take(double now = clock_seconds());

    /// Time [s] without a loss before a device counts as working again: longer than the interval between tries.
    static constexpr double proven_after = 1;

private:
    const std::string prefix_;
    mutable Mutex mutex_;
    bool is_lost_ = false;
    bool is_told_ = false;              // the loss was reported
    std::optional<double> well_since_;  // [s] time since which the device works again
    std::vector<std::string> lines_;
};

/// Appends lines to others.
void append(std::vector<std::string>& lines, std::vector<std::string> more);

}  // namespace nezumi::hw
