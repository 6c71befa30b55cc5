// One run of a scenario: its object `s`, its worlds, its conditions, and its result.
#pragma once

#include <deque>
#include <functional>
#include <lua.hpp>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/lua/files/system_lua.hpp"
#include "bindings/lua/files/system_words.hpp"
#include "bindings/lua/live/objects.hpp"
#include "bindings/scenario/condition.hpp"
#include "bindings/scenario/expectation.hpp"
#include "bindings/scenario/faults.hpp"
#include "bindings/scenario/files_with_text.hpp"
#include "bindings/scenario/golden.hpp"
#include "bindings/scenario/margin_watch.hpp"
#include "bindings/scenario/recordings.hpp"
#include "bindings/scenario/run_result.hpp"
#include "bindings/scenario/scenario_file.hpp"
#include "bindings/scenario/spectator.hpp"
#include "bindings/scenario/worlds.hpp"

namespace nezumi {

/// Writes the files of a failed run: traces and pictures.
class RunFiles {
public:
    virtual ~RunFiles() = default;
    /// A world begins. If `is_journaled`, it is not active yet, and a journal of it can be replayed.
    virtual void begin(std::size_t world, RunningSystem& live, bool is_journaled) = 0;
    /// A world begins that is a recording, of this file.
    virtual void begin_recorded(std::size_t world, RunningSystem& live, const std::filesystem::path& recording) = 0;
    /// The journal of a world can't be replayed any more.
    virtual void drop_journal(std::size_t world) = 0;
    /// A world has made a tick.
    virtual void after_tick(std::size_t world) = 0;
    /// The files that were written completely, and the error if some were not.
    struct Kept {
        std::vector<std::string> names{};
        std::vector<Error> problems{};
    };
    /// Writes everything.
    virtual Kept finish(const std::string& title) = 0;
};

struct RunSettings {
    std::uint64_t seed = 0;
    SweepPoint point{};
    std::string name{};                      ///< of the run
    std::function<LiveOptions()> systems;    ///< makes systems; the run sets seed, log and budget
    const Recordings* recordings = nullptr;  ///< null: `s:recorded` and `s:judge` are refused
    RunFiles* files = nullptr;               ///< null: no files
    bool keep_journal = false;               ///< builds worlds so that their journals can be replayed
    bool keep_history = false;               ///< for plots; takes memory that grows with the run
    bool update_goldens = false;             ///< writes the goldens instead of comparing with them
    Spectator* spectator = nullptr;          ///< watches the run; may be null
    Coverage* coverage = nullptr;            ///< notes which lines of scripts run; null: not needed
};

/// The seed for everything that a scenario draws at random.
std::uint64_t seed_of(std::uint64_t seed, std::string_view scenario);

/// The actor of a scenario's acts.
inline const Actor scenario_actor{Actor::Kind::scenario};

class ScenarioRun {
public:
    ScenarioRun(ScenarioFile& file, std::size_t scenario, RunSettings settings);
    ~ScenarioRun();
    ScenarioRun(const ScenarioRun&) = delete;
    ScenarioRun& operator=(const ScenarioRun&) = delete;

    /// Makes the run; call it once. The Lua state of the file can't be used for another run.
    RunResult run();

    struct Methods;

private:
    friend struct Methods;

    // A condition that is evaluated after every tick.
    struct Watched {
        Expectation expectation;
        std::unique_ptr<Condition> condition;
        MarginWatch margin{};
        bool sampled = false;
        struct Sample {
            double time;
            double left;
            double right;
        };
        std::vector<std::vector<Sample>> history{};  // samples of each comparison; empty if the history is not kept
    };
    // A world, and the words that add to it.
    struct Described {
        std::unique_ptr<Project> project;
        std::unique_ptr<SystemWords> words;
        RunningSystem* live = nullptr;  // null: not built yet
        std::size_t entries = 0;        // number of entries that words have added
        std::size_t connections = 0;
        // Settings that can't change after time has passed.
        struct Fixed {
            std::size_t things = 0;
            double rate = 0, physics_step = 0;
            static Fixed of(const SystemSpec& spec);
            bool operator==(const Fixed&) const = default;
        };
        Fixed fixed{};
    };

    // Ends the run before its function returns.
    void stop(RunOutcome outcome, Error error);
    bool stopped() const { return stopped_; }
    void fail(const Watched& watched);
    void fail(const CallError& error, const Watched& watched);

    Expected<void> open();
    void take_outcome(const CallResult& called);
    void finish();
    void print(std::string_view line);
    // The part of the run's name after the name of the scenario.
    std::string_view values() const;

    // The world that words describe.
    Described& described();
    Expected<void> settle();
    Expected<void> settle_or_note();
    Expected<void> add_drivers(SystemSpec& spec);
    Expected<void> build(Described& described);
    Expected<void> rebuild(Described& described);
    Expected<void> add_new(Described& described);
    Expected<void> load(const std::string& name, const Expected<Value>& options, const Place& place);
    LiveOptions world_options();
    std::unique_ptr<RunningSystem> load_from_text(const Described& described, const LiveOptions& options);
    RunningSystem& current();
    bool has_world() const { return !worlds_.empty(); }

    // Lets time pass. False: the run has ended.
    bool advance(lua_State* lua, const Watched* waiting);
    bool stop_at_end(const Watched* waiting);
    bool sample(lua_State* lua, Watched& watched);
    bool pass_time(lua_State* lua, double seconds);
    bool wait(lua_State* lua, Watched& watched);
    bool check_components();

    void tell_ports(const std::vector<PortAt>& ports);
    void tell_plot(const Watched& watched);

    ScenarioFile& file_;
    const Scenario& scenario_;
    std::size_t index_;
    RunSettings settings_;
    std::unique_ptr<ScriptHost> covered_scripts_;  // null: coverage is off
    std::deque<FilesWithText> texts_;              // of systems that journals need; they outlive the worlds
    Worlds worlds_;                                // declared before the members that refer to them
    std::deque<Described> described_;              // a deque, because addresses must not change
    WordHost word_host_;
    std::unique_ptr<Objects> objects_;
    Faults faults_;
    std::vector<Golden> goldens_;
    FunctionTexts function_texts_;
    std::vector<std::unique_ptr<Watched>> watches_;
    std::vector<std::unique_ptr<Watched>> waits_;
    std::set<std::pair<const RunningSystem*, std::string>> allowed_errors_;  // components that may go to ERROR
    std::vector<PortAt> read_ports_;                                         // read since the last sample began
    double asked_until_ = 0;  // [s] end time of the last s:run, which may be between two ticks
    std::size_t printed_bytes_ = 0;
    bool sampling_ = false;  // a condition is running
    bool stopped_ = false;
    std::optional<Error> setup_error_;  // error of a word, a method or of building, which Lua may raise next
    std::optional<double> clearance(lua_State* lua, int index, double most) const;
    bool is_setup_error(const CallError& error) const;
    RunResult result_;
};

}  // namespace nezumi
