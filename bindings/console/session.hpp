// The session of one user of the console: inputs run in their own Lua state and thread, while ticks go on.
#pragma once

#include <chrono>
#include <cstddef>
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

/// The keys of `drive`.
enum class Key { up, down, left, right, space, escape, faster, slower };

/// The keys that a command takes; all others are typed for the next input.
enum class TakenKeys { none, escape, all };

/// The functions that receive the output of a session. They are called within `advance`, `after_tick`, `interrupt` and
/// `key`.
struct SessionOutput {
    /// One or more lines, without the last end of line: results, output of commands and of `print`.
    std::function<void(std::string_view text)> show;
    /// Whether the receiver can take more output now. If not, only the running input waits. Empty: always.
    std::function<bool()> takes_more{};
    /// Shows a drawing that replaces the drawing before it. Empty: uses `show`.
    std::function<void(std::string_view text)> show_in_place{};
    /// Shows errors of an input.
    std::function<void(std::string_view text)> show_error;
    /// An input of `submit` is finished, with or without an error: the prompt may appear again.
    std::function<void(bool well)> done;
    /// Which keys go to `key` from now on: `drive` takes all, a long seek Escape. Empty: there are no keys, and `drive`
    /// is refused.
    std::function<void(TakenKeys keys)> take_keys;
    /// Shows log lines of this level and above from now on. False or empty: no log is shown here.
    std::function<bool(LogLevel level)> log_level{};
};

/// The kinds of drawings: of `picture`, `graph` and `save "x.xml"`.
enum class Drawn : unsigned char {
    world,    ///< from above
    wiring,   ///< components, ports and connections
    profile,  ///< the same as the file of RTSystemEditor
};
/// Draws the copied state to a file that ends in .png or .svg, a profile in .xml; any thread may call it.
using Drawing = std::function<Expected<void>(const std::string& file)>;
/// Copies the state of the system between two ticks. Another thread then calls the result.
using DrawingMaker = std::function<Drawing(Drawn what)>;

/// A request to write a new behaviour. The author reads the texts.
struct BehaviorRequest {
    std::string name;                       ///< such as line_follower
    std::vector<std::string> inputs{};      ///< "name:Type" or "name:Type:doc"
    std::vector<std::string> outputs{};     ///< "name:Type" or "name:Type:doc"
    std::vector<std::string> parameters{};  ///< "gain=0.5"
    std::vector<std::string> callbacks{};   ///< besides on_execute: "on_activated", ...
    std::string doc{};                      ///< one sentence about what it does
};
/// Writes the files of a behaviour below a folder, without overwriting, and returns their names. Any thread may call
/// it.
using BehaviorAuthor = std::function<Expected<std::vector<std::string>>(const std::filesystem::path& root,
                                                                        const BehaviorRequest& request)>;

struct SessionOptions {
    SessionOutput output;
    /// The actor of the acts.
    Actor who{Actor::Kind::console};
    /// [s] of simulated time between two lines of one `watch`, at normal speed; 0: shows every change.
    double watch_period = 0.1;
    /// Time passes only by `step` and `run(seconds)`: a `run()` without an end is refused.
    bool batch = false;
    /// Empty: `picture` and `graph` are refused.
    DrawingMaker drawing_maker{};
    /// Empty: `new` is refused.
    BehaviorAuthor author{};
    /// Empty: components of other programs are unknown.
    PeerAsker peers{};
    /// Rung if `advance` has something to do; must outlive the session. Null: only `advance` itself waits for it.
    const Bell* bell = nullptr;
};

/// Candidates for the text before the cursor.
struct Completion {
    std::size_t from = 0;  ///< [bytes] begin of the part that a candidate replaces; the part ends at the cursor
    std::vector<std::string> candidates;  ///< sorted
};

/// Call all functions between two ticks, from the thread that runs the ticks; only `is_complete` may be called from
/// anywhere. The session's own thread computes an input; the system is read and changed only within `advance`.
class Session {
public:
    /// Both must outlive the session.
    static Expected<std::unique_ptr<Session>> create(RunningSystem& live, ClockControl& clock, SessionOptions options);
    /// Closes the session and waits for the end of its thread, at most a second after `close`.
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Whether an input is complete; false if lines are missing (an open block, string or bracket).
    static bool is_complete(std::string_view text);

    /// Adds an input, which may have several lines. Inputs run one after the other; `done` is called after each.
    void submit(std::string text);
    /// Completes the text before the cursor with the live system, as one of the inputs. `answer` gets the result, or an
    /// empty one if it is interrupted.
    void complete(std::string text, std::size_t cursor, std::function<void(Completion)> answer);
    /// Whether an input is not finished yet.
    bool is_busy() const;
    /// Whether the running input is only waiting for ticks (`step`, `run`) or for its output to be read.
    bool is_waiting() const;
    /// Executes the requests of inputs to the system now, until about this time.
    void serve(std::chrono::steady_clock::time_point until);
    /// Executes requests like `serve`, and also waits for more of them, until about `slice` of real time has passed or
    /// nothing is left to do. Returns whether more may come.
    bool advance(std::chrono::microseconds slice = std::chrono::microseconds(1000));
    /// Call this after every tick: watches show changes, and `drive` sends.
    void after_tick();
    /// Ctrl-C: stops the running input, drops the inputs that wait, and ends `drive` and every `watch`.
    void interrupt();
    /// A key, while `take_keys` is on.
    void key(Key key);

    /// Ends the session: no more output and no more acts, `drive` ends, and the running input ends soon.
    void close();
    /// After `close`: whether its thread has ended.
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
