// What a scenario does to ports and robots for a while, and how it ends.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace nezumi {

/// Faults that are under way. Each has a key, what it is done to ("port mouse.ir_sensor_out"). Of several with the same
/// key the latest alone works; when it ends, the one before works again.
class Faults {
public:
    struct Effect {
        std::function<void()> put;         ///< does it, when the fault over it has ended
        std::function<void()> undo;        ///< nothing else of the key is left
        std::function<bool()> is_there{};  ///< something else may have been put in its place; empty: never
    };
    /// A fault that has been put in. It ends between two ticks, `seconds` after `now`. Infinity: when it is restored;
    /// it takes the place of those of its key.
    void begin(std::string key, double now, double seconds, Effect effect);
    /// What is no fault, as a hold, but works again when the faults over it have ended. To be said before they begin.
    void lies_under(std::string key, std::function<void()> put);
    /// Ends those whose time has come. To be called before every tick.
    void end_due(double now);
    /// Ends what is done to this thing: its key, or every key of a robot. Returns how many faults.
    std::size_t restore(std::string_view key);
    /// Something else has taken the place of all faults of this key.
    void forget(std::string_view key);
    /// Takes away what lies under the faults of this key; false when there is nothing.
    bool forget_under(std::string_view key);
    bool has(std::string_view key) const;
    bool empty() const { return faults_.empty(); }

private:
    struct Fault {
        std::string key;
        double until;
        Effect effect;
        bool is_fault = true;
    };
    Fault take(std::size_t index);
    Fault* last_of(std::string_view key);
    void go_on_without(const Fault& over);

    std::vector<Fault> faults_;  // in the order of their beginning
};

}  // namespace nezumi
