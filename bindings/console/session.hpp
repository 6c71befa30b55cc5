// One user of the console: what is typed runs in a Lua state of its own, in slices between the ticks.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/console/clock_control.hpp"
#include "bindings/lua/live/live_system.hpp"

namespace nezumi {

/// What `drive` takes from the keyboard.
enum class Key { up, down, left, right, space, escape };

/// Where what a session says goes. Called from within `advance`, `after_tick`, `interrupt` and `key`.
struct SessionOutput {
    /// One or more lines, without the last end of line: results, what words show, what `print` prints.
    std::function<void(std::string_view text)> show;
    /// The same for errors of what was typed.
    std::function<void(std::string_view text)> show_error;
    /// An input of `submit` is finished, well or with an error: the prompt may come again.
    std::function<void(bool well)> done;
    /// `drive` begins or ends: from now on keys go to `key`, or no longer. Empty: there are no keys, `drive` is
    /// refused.
    std::function<void(bool on)> take_keys;
};

struct SessionOptions {
    SessionOutput output;
    /// Whose acts these are.
    Actor who{Actor::Kind::console};
    /// [s] of simulated time between two lines of one `watch`, at normal speed; 0: every change is shown.
    double watch_period = 0.1;
    /// Time moves only by `step` and `run(seconds)`: a `run()` without end is refused.
    bool batch = false;
};

/// Candidates for what stands before the cursor.
struct Completion {
    std::size_t from = 0;  ///< [bytes] where the part begins that a candidate replaces; it ends at the cursor
    std::vector<std::string> candidates;  ///< sorted
};

/// Everything is to be called between two ticks, from the thread that runs them. `is_complete` may be called from
/// anywhere.
class Session {
public:
    /// Both must outlive the session.
    static Expected<std::unique_ptr<Session>> create(LiveSystem& live, ClockControl& clock, SessionOptions options);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Whether an input can be run as it is: false when lines are missing (an open block, string or bracket).
    static bool is_complete(std::string_view text);

    /// Hands in an input, which may have several lines. Inputs run one after the other; each ends with `done`.
    void submit(std::string text);
    /// Something that was handed in is not finished yet.
    bool is_busy() const;
    /// It waits for ticks to pass (`step`, `run`) and takes no slices meanwhile.
    bool is_waiting() const;
    /// Runs for about `slice` of real time, or until there is nothing to do. Returns whether there is more to do now.
    bool advance(std::chrono::microseconds slice = std::chrono::microseconds(1000));
    /// After every tick: watches show what is new, `drive` sends.
    void after_tick();
    /// Ctrl-C: ends what runs, drops what was handed in and not begun, and ends `drive` and every `watch`.
    void interrupt();
    /// A key, while `take_keys` is on.
    void key(Key key);

    /// What could stand before the cursor, from the live system.
    Completion complete(std::string_view text, std::size_t cursor) const;

    struct Parts;

private:
    explicit Session(std::unique_ptr<Parts> parts);
    bool begin_next();
    void finish(bool well);
    std::unique_ptr<Parts> parts_;
};

}  // namespace nezumi
