// What a scenario does to ports and robots for a while, and how it ends.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace nezumi {

/// Faults that are under way. Each has a key, what it is done to ("port mouse.ir_sensor_out"): a later one of the same
/// key takes the place of the one before.
class Faults {
public:
    /// `end` undoes it, between two ticks, `seconds` after `now`; infinity: when it is restored.
    void begin(std::string key, double now, double seconds, std::function<void()> end);
    /// Ends those whose time has come. To be called before every tick.
    void end_due(double now);
    /// Ends what is done to this thing: its key, or every key of a robot. Returns how many.
    std::size_t restore(std::string_view key);
    bool empty() const { return faults_.empty(); }

private:
    struct Fault {
        std::string key;
        double until;
        std::function<void()> end;
    };
    std::vector<Fault> faults_;
};

}  // namespace nezumi
