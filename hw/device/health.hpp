// What a device has to say about itself: lost, and back again.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/mutex.hpp"
#include "hw/device/clock.hpp"

namespace nezumi::hw {

/// Why a device counts as lost whose thread hangs.
inline constexpr const char* no_answer = "no answer for 0.3 s: restart its driver, or the robot";

/// Tells each loss once, however often it is noticed, and the return when it has lasted: a device that comes and goes
/// is lost. From any thread.
class Health {
public:
    /// `device` as a person calls it: "the light sensors".
    explicit Health(std::string device) : device_(std::move(device)) {}

    /// It does not work, for this reason. Told unless it did not work before.
    void lost(const std::string& why);
    /// It works, at `now` by `clock_seconds`.
    void works(double now = clock_seconds());
    /// Whether it did not work when it was tried last.
    bool is_lost() const;
    /// What is to be told: a line each.
    std::vector<std::string> take(double now = clock_seconds());

    /// [s] without a loss after which a device counts as back: longer than the time between two tries.
    static constexpr double proven_after = 1;

private:
    const std::string device_;
    mutable Mutex mutex_;
    bool is_lost_ = false;
    bool is_told_ = false;              // that it is lost
    std::optional<double> well_since_;  // [s]
    std::vector<std::string> lines_;
};

/// Adds lines to others.
void append(std::vector<std::string>& lines, std::vector<std::string> more);

}  // namespace nezumi::hw
