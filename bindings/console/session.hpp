// One user of the console: what is typed runs in a Lua state and a thread of its own, beside the ticks.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/console/peers.hpp"
#include "engine/base/error.hpp"
#include "engine/base/log.hpp"
#include "engine/live/clock_control.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi {

class Bell;

/// What `drive` takes from the keyboard.
enum class Key { up, down, left, right, space, escape, faster, slower };

/// Where what a session says goes. Called from within `advance`, `after_tick`, `interrupt` and `key`.
struct SessionOutput {
    /// One or more lines, without the last end of line: results, what commands show, what `print` prints.
    std::function<void(std::string_view text)> show;
    /// Whether more can be taken now. While it can't be, the line that runs waits, and only that. Empty: always.
    std::function<bool()> takes_more{};
    /// The same as `show` for a drawing that takes the place of the one before. Empty: `show`.
    std::function<void(std::string_view text)> show_in_place{};
    /// The same for errors of what was typed.
    std::function<void(std::string_view text)> show_error;
    /// An input of `submit` is finished, well or with an error: the prompt may come again.
    std::function<void(bool well)> done;
    /// `drive` begins or ends: from now on keys go to `key`, or no longer. Empty: there are no keys, `drive` is
    /// refused.
    std::function<void(bool on)> take_keys;
    /// From now on log lines of this level and louder are wanted. False, as where this is empty: no log is shown here.
    std::function<bool(LogLevel level)> log_level{};
};

/// What `picture`, `graph` and `save "x.xml"` draw.
enum class Drawn : unsigned char {
    world,    ///< from above
    wiring,   ///< components, ports and connections
    profile,  ///< the same as the file of RTSystemEditor
};
/// Draws the copied state to a file that ends in .png or .svg, a profile in .xml; any thread may call it.
using Drawing = std::function<Expected<void>(const std::string& file)>;
/// Copies the state of the system, between two ticks; the drawing is then made on another thread.
using DrawingMaker = std::function<Drawing(Drawn what)>;

/// A behaviour to be written. The author interprets the texts.
struct BehaviorRequest {
    std::string name;                       ///< line_follower
    std::vector<std::string> inputs{};      ///< "name:Type" or "name:Type:doc"
    std::vector<std::string> outputs{};     ///< the same
    std::vector<std::string> parameters{};  ///< "gain=0.5"
    std::vector<std::string> callbacks{};   ///< besides on_execute: "on_activated", ...
    std::string doc{};                      ///< a sentence: what it does
};
/// Writes its files below a folder, without overwriting others, and returns their names; any thread may call it.
using BehaviorAuthor = std::function<Expected<std::vector<std::string>>(const std::filesystem::path& root,
                                                                        const BehaviorRequest& request)>;

struct SessionOptions {
    SessionOutput output;
    /// Whose acts these are.
    Actor who{Actor::Kind::console};
    /// [s] of simulated time between two lines of one `watch`, at normal speed; 0: every change is shown.
    double watch_period = 0.1;
    /// Time moves only by `step` and `run(seconds)`: a `run()` without end is refused.
    bool batch = false;
    /// Empty: `picture` and `graph` are refused.
    DrawingMaker drawing_maker{};
    /// Empty: `new` is refused.
    BehaviorAuthor author{};
    /// Empty: nothing is known of other programs' components.
    PeerAsker peers{};
    /// Is rung when `advance` has something to do; must outlive the session. Null: only `advance` itself waits for it.
    const Bell* bell = nullptr;
};

/// Candidates for what stands before the cursor.
struct Completion {
    std::size_t from = 0;  ///< [bytes] where the part begins that a candidate replaces; it ends at the cursor
    std::vector<std::string> candidates;  ///< sorted
};

/// Everything is to be called between two ticks, from the thread that runs them. `is_complete` may be called from
/// anywhere. What an input computes is its own thread's; the system is looked at and acted on in `advance` alone.
class Session {
public:
    /// Both must outlive the session.
    static Expected<std::unique_ptr<Session>> create(RunningSystem& live, ClockControl& clock, SessionOptions options);
    /// Closes it, and waits until its thread has ended, a second after `close` at most.
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Whether an input can be run as it is: false when lines are missing (an open block, string or bracket).
    static bool is_complete(std::string_view text);

    /// Hands in an input, which may have several lines. Inputs run one after the other; each ends with `done`.
    void submit(std::string text);
    /// What could stand before the cursor, from the live system; `answer` gets it, as one of the inputs. It gets
    /// nothing when that is interrupted.
    void complete(std::string text, std::size_t cursor, std::function<void(Completion)> answer);
    /// Something that was handed in is not finished yet.
    bool is_busy() const;
    /// It waits for ticks to pass (`step`, `run`), or for its output to be taken, and wants nothing meanwhile.
    bool is_waiting() const;
    /// Does what inputs want of the system now, until about then.
    void serve(std::chrono::steady_clock::time_point until);
    /// The same, and waits for more to do, until about `slice` of real time has passed or nothing is
    /// left to do. Returns whether more may come.
    bool advance(std::chrono::microseconds slice = std::chrono::microseconds(1000));
    /// After every tick: watches show what is new, `drive` sends.
    void after_tick();
    /// Ctrl-C: ends what runs, drops what was handed in and not begun, and ends `drive` and every `watch`.
    void interrupt();
    /// A key, while `take_keys` is on.
    void key(Key key);

    /// Nothing is said or done any more, `drive` ends, and so does what runs, soon.
    void close();
    /// After `close`: what it was made of is gone.
    bool has_ended() const;

    struct Parts;

private:
    explicit Session(std::unique_ptr<Parts> parts);
    void quit_if_asked();
    void begin_next();
    bool explains_soon() const;
    void finish(bool well);
    void replace_stuck();
    std::unique_ptr<Parts> parts_;
    std::optional<std::chrono::steady_clock::time_point> closed_;
};

}  // namespace nezumi
