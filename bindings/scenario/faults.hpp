// Temporary faults that a scenario applies to ports and robots, and their ends.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace nezumi {

/// The active faults. Each has a key that names its target ("port mouse.ir_sensor_out"). If several have the same key,
/// only the latest works; when it ends, the one before works again.
class Faults {
public:
    struct Effect {
        std::function<void()> put;   ///< applies the effect again when a later fault has ended
        std::function<void()> undo;  ///< called if no other fault of the key is left
        /// False: something else has replaced the effect, which then must not be undone. Empty: always true.
        std::function<bool()> is_there{};
    };
    /// Adds a fault that has been applied. It ends between two ticks, `seconds` after `now`. Infinity: it ends when it
    /// is restored, and replaces the other faults of its key.
    void begin(std::string key, double now, double seconds, Effect effect);
    /// Adds an effect below the faults that is not a fault itself, such as a hold. It works again when the faults over
    /// it have ended. Call this before these faults begin.
    void lies_under(std::string key, std::function<void()> put);
    /// Ends the faults whose time has come. Call it before every tick.
    void end_due(double now);
    /// Ends all faults of a key, or of all keys of a robot. Returns their number.
    std::size_t restore(std::string_view key);
    /// Forgets all faults of this key, because something else has replaced them.
    void forget(std::string_view key);
    /// Removes the effect below the faults of this key; false if there is none.
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

    std::vector<Fault> faults_;  // in the order of their begin
};

}  // namespace nezumi
