// The parts of a session, which its commands use.
#pragma once

#include <deque>
#include <functional>
#include <lua.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/console/break_condition.hpp"
#include "bindings/console/drive.hpp"
#include "bindings/console/session.hpp"
#include "bindings/console/worker.hpp"
#include "bindings/lua/live/objects.hpp"
#include "bindings/lua/sandbox/line_profile.hpp"
#include "bindings/lua/sandbox/line_trace.hpp"
#include "bindings/lua/sandbox/state.hpp"
#include "engine/live/past_values.hpp"
#include "engine/system/questions.hpp"
#include "engine/trace/recent_curves.hpp"

namespace nezumi {

/// A question to another host, and whether it is open.
struct HostQuestion {
    std::optional<std::uint64_t> number{};  ///< of the open question; nothing: none is open
    Worker::Clock::time_point asked{};
};

/// Continues a question: sends it if it is not open, and returns the answer when it is available. Does not wait.
std::optional<Expected<PlainData>> go_on(const System& system, const Question& question, HostQuestion& open);

/// A port whose changes are shown.
struct PortWatch {
    std::string path;          ///< "name.port", or "host/name.port"
    std::string shown{};       ///< its value as it was shown last
    double shown_at = -1;      ///< [s] simulated; -1: not yet
    HostQuestion elsewhere{};  ///< to the host of the port, if the port has no connection in this system
};

/// An execution that is explained.
struct Explained {
    std::string component;
    std::int64_t trace = 0;  ///< `RunningSystem::explain_next`
    int start = 0;           ///< `generation` of the system
};

/// A breakpoint, of `break_at`.
struct LineBreak {
    LineTrace::Watched place;
    std::unique_ptr<BreakCondition> condition{};  ///< null: no condition
    double shown_at = -1e9;                       ///< [s] simulated
};

/// A value whose changes are shown, of `watch_changes`.
struct ChangeWatch {
    std::string name;                   ///< "controller.out.vx"
    std::optional<std::string> last{};  ///< its text
};

/// The measurement of `profile`.
struct ConsoleProfile {
    std::map<std::string, ExecutionProfile> components{};
    std::map<std::string, TickCosts> natives{};
    std::string by_line{};  ///< the behaviour whose lines are measured; "" for none
    double until = 0;       ///< [s] simulated
};

/// The arguments of `plot`.
struct PlotRequest {
    std::vector<std::string> names{};  ///< of channels: "controller.out.vx"
    double seconds = 0;                ///< of simulated time that are drawn
    double every = 0;                  ///< [s] of simulated time between two drawings; 0: drawn once
    double next = 0;                   ///< [s] simulated: time of the next drawing
    /// The answers of other hosts about names that only they know.
    struct Elsewhere {
        HostQuestion open{};
        std::optional<RecentCurves> recent{};
    };
    std::map<std::string, Elsewhere> elsewhere{};
};

/// A copy of the data of a drawing.
struct PlotCurves {
    PlotRequest plot;
    double from = 0;  ///< [s]
    double to = 0;
    std::vector<Curve> curves{};
    std::vector<std::string> silent{};  ///< names without a value in this time
};

/// Reads the curves of a plot between two ticks: from the present trace up to now, or from the trace of `past` up to
/// its moment. Channels that were not remembered before are remembered from now on. Other hosts must have answered
/// before.
Expected<PlotCurves> look_at_plot(RunningSystem& live, const PlotRequest& plot, PastValues* past = nullptr);
std::string to_text(PlotCurves looked);

// Call the following functions after each tick.

/// Shows the new value of a watched port; false if the port is gone.
bool show_news(Session::Parts& parts, PortWatch& watch);
/// Draws a repeated plot again when it is due; false after an error, which is shown.
bool draw_again(Session::Parts& parts, PlotRequest& plot);
/// Shows a value that has changed; false if its component is gone.
bool show_change(Session::Parts& parts, ChangeWatch& watch);
/// Pauses time if a breakpoint was reached in this tick, and shows the execution.
void stop_at_breaks(Session::Parts& parts);
/// Shows the costs if the measurement is over.
void show_profile(Session::Parts& parts);
/// Starts or stops, for all behaviours of the present system, the watching of breakpoint lines and the measurement.
void watch_lines(Session::Parts& parts);

/// An input, or a request for completions at the cursor.
struct Job {
    std::string text;
    std::size_t cursor = 0;
    std::function<void(Completion)> answer{};  ///< gets the completions; empty: the job is an input
};

struct Session::Parts {
    Parts(RunningSystem& system, ClockControl& control, SessionOptions settings);

    /// Shows a text after all texts before it. Both threads may call it.
    void show(std::string_view text) { tell(options.output.show, text); }
    void show_in_place(std::string_view text) {
        tell(options.output.show_in_place ? options.output.show_in_place : options.output.show, text);
    }
    void show_error(std::string_view text) { tell(options.output.show_error, text); }
    void tell(const std::function<void(std::string_view)>& output, std::string_view text);

    const Bell& bell() {
        if (options.bell != nullptr) return *options.bell;
        return own_bell ? *own_bell : own_bell.emplace();
    }

    Expected<ActResult> act(const Act& act) const { return live.act(act, options.who); }
    /// Called by the worker: prepares an act in its thread, and has it performed between two ticks if `check` finds no
    /// error. `found` are the files that the maker of the act has read.
    Expected<ActResult> act_beside(const Act& act, const FilesSeen& found = {},
                                   const std::function<Expected<void>(const PreparedAct&)>& check = {});

    // For the ticking thread:
    RunningSystem& live;
    ClockControl& clock;
    SessionOptions options;
    const bool is_hardware;
    std::optional<Bell> own_bell;                      ///< if no other thread waits for the worker
    std::deque<Job> jobs;                              ///< waiting jobs
    std::optional<Job> job;                            ///< the running job
    bool waiting = false;                              ///< for the ticks of `advance` of the clock
    std::uint64_t moves = 0;                           ///< counter of the clock at this `advance`
    std::optional<Worker::Clock::time_point> revoked;  ///< when the worker's job was stopped; it may still run
    std::optional<Worker::Clock::time_point> quits;    ///< time when an input called `quit()`
    std::vector<PortWatch> watches;
    std::vector<Explained> explained;
    bool awaits_explanation = false;  // the job has run, and ends when its explanation is shown
    std::vector<PlotRequest> plots;   ///< plots that are drawn again and again
    std::vector<LineBreak> breaks;
    std::map<std::string, std::int64_t> break_traces;  ///< for each behaviour the last execution that was examined
    int breaks_of = 0;                                 ///< `generation` of the system that notes the lines
    std::vector<ChangeWatch> changes;
    std::unique_ptr<ConsoleProfile> profile;
    Drive drive;
    bool seek_has_keys = false;  ///< Esc gives up a seek

    // For the worker, and for functions that run for it while it waits:

    /// Creates a new Lua state with all names in scope.
    Expected<void> open();
    /// Creates a new Lua state if the state was lost, and reports this.
    void open_if_lost();
    /// Runs an input, shows its results and errors, and calls `done` with whether it succeeded: now, or later if the
    /// worker has no thread and the input waits for ticks.
    void run(const std::string& input, std::function<void(bool well)> done);
    /// Runs `body()` in the ticking thread, where the system may be read and changed, and waits for it. Returns its
    /// result, or a default value if the job is interrupted.
    template <class Body>
    auto at_system(Body&& body) {
        decltype(body()) result{};
        worker.perform([&] {
            result = body();
            return true;
        });
        return result;
    }

    double number = 0;       ///< the result of a command
    Value value;             ///< the result of a command that returns a table
    std::int64_t ticks = 0;  ///< that a command waits for
    /// The wait of a paused input: returns nothing while the wait lasts, then its result.
    std::function<std::optional<Expected<void>>()> waits;
    std::optional<int> paused_at;  ///< the level of the stack below the coroutine of a paused input
    std::unique_ptr<Objects> objects;
    std::unique_ptr<LuaState> state;
    Worker worker;
};

/// The session of a C function; it is the first upvalue.
inline Session::Parts& parts_of(lua_State* L) {
    return *static_cast<Session::Parts*>(lua_touserdata(L, lua_upvalueindex(1)));
}

/// Makes the library, the console's commands and the system's names available to inputs. Names of the system are looked
/// up at each use.
Expected<void> open_scope(Session::Parts& parts);

/// Pushes the table with everything that `open_scope` added. Needs one place on the stack.
void push_commands_table(lua_State* L);

/// The components of the system, in its order. For the worker, like the next functions.
std::vector<std::string> component_names(Session::Parts& parts);
/// Every name that an input can begin with: commands, library, components, globals of the session. Sorted.
std::vector<std::string> names_in_scope(Session::Parts& parts);

/// Candidates for the text before the cursor.
Completion complete(Session::Parts& parts, std::string_view text, std::size_t cursor);

/// Computes a past moment between two ticks, in slices, and shows how far it is if it takes long. Returns whether it
/// has shown that.
Expected<bool> compute_past(Session::Parts& parts, PastRun& run, std::string_view what = "going back");

/// `to_seek`: from now on keys go to a seek, so that Esc cancels it; false: no longer. Does nothing without keys.
void give_keys(Session::Parts& parts, bool to_seek);

}  // namespace nezumi
