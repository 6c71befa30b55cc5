// One run of one scenario: its object `s`, its worlds, what it watches, and how it ends.
#pragma once

#include <deque>
#include <functional>
#include <lua.hpp>
#include <map>
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
#include "bindings/scenario/golden.hpp"
#include "bindings/scenario/run_result.hpp"
#include "bindings/scenario/scenario_file.hpp"
#include "bindings/scenario/worlds.hpp"

namespace nezumi {

/// Keeps what a failing run leaves in its folder: traces, pictures.
class RunFiles {
public:
    virtual ~RunFiles() = default;
    /// A world begins; it is called `name` in names of files ("" when there is but one so far).
    virtual void begin(std::size_t world, RunningSystem& live) = 0;
    /// A world has made a tick.
    virtual void after_tick(std::size_t world) = 0;
    /// What has been written whole, and what kept the rest from it.
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
    std::string name{};                    ///< of the run
    std::function<LiveOptions()> systems;  ///< how systems are made; seed, log and budget are set here
    RunFiles* files = nullptr;             ///< null: nothing is kept
    bool keep_history = false;             ///< for plots: memory that grows with the run
    bool update_goldens = false;           ///< write them in place of comparing with them
};

/// The seed of everything a scenario draws by itself.
std::uint64_t seed_of(std::uint64_t seed, std::string_view scenario);

/// Whose acts a scenario's are.
inline const Actor scenario_actor{Actor::Kind::scenario};

class ScenarioRun {
public:
    ScenarioRun(ScenarioFile& file, std::size_t scenario, RunSettings settings);
    ~ScenarioRun();
    ScenarioRun(const ScenarioRun&) = delete;
    ScenarioRun& operator=(const ScenarioRun&) = delete;

    /// Runs it from beginning to end; once. The file's state can't be used for another run.
    RunResult run();

    struct Methods;

private:
    friend struct Methods;

    // A condition that is looked at after every tick.
    struct Watched {
        Expectation expectation;
        std::unique_ptr<Condition> condition;
        std::optional<Margin> margin{};  // the smallest
        double margin_at = 0;
        // Of a hold that began as its condition became true: its margin while that only grows; nothing: it has shrunk.
        std::optional<double> growing{};
        bool sampled = false;
        struct Sample {
            double time;
            double left;
            double right;
        };
        std::vector<std::vector<Sample>> history{};  // of each comparison, when it is kept
    };
    // A world and the words that add to it.
    struct Described {
        std::unique_ptr<Project> project;
        std::unique_ptr<SystemWords> words;
        RunningSystem* live = nullptr;  // null: not built yet
        std::size_t entries = 0;        // that it has, of the words'
        std::size_t connections = 0;
        // What can't change once time has moved.
        struct Fixed {
            std::size_t things = 0;
            double rate = 0, physics_step = 0;
            static Fixed of(const SystemSpec& spec);
            bool operator==(const Fixed&) const = default;
        };
        Fixed fixed{};
    };

    // How a run ends before its function returns.
    void stop(RunOutcome outcome, Error error);
    bool stopped() const { return stopped_; }
    void fail(const Watched& watched);
    void fail(const CallError& error, const Watched& watched);

    Expected<void> open();
    void take_outcome(const CallResult& called);
    void finish();
    void print(std::string_view line);
    // What the run's name has beside the scenario's.
    std::string_view values() const;

    // The worlds that words describe.
    Described& described();
    Expected<void> settle();
    Expected<void> settle_or_note();
    Expected<void> build(Described& described);
    Expected<void> rebuild(Described& described);
    Expected<void> add_new(Described& described);
    Expected<void> load(const std::string& name, const Expected<Value>& options, const Place& place);
    RunningSystem& current() { return *described_.back().live; }
    bool has_world() const { return !described_.empty() && described_.back().live != nullptr; }

    // Time. False: the run has stopped.
    bool advance(lua_State* lua, const Watched* waiting);
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
    Worlds worlds_;                    // before what refers to them
    std::deque<Described> described_;  // whose places stay
    WordHost word_host_;
    std::unique_ptr<Objects> objects_;
    Faults faults_;
    std::vector<Golden> goldens_;
    std::vector<std::unique_ptr<Watched>> watches_;
    std::vector<std::unique_ptr<Watched>> waits_;
    std::set<std::pair<const RunningSystem*, std::string>> allowed_errors_;  // components that may go to ERROR
    std::vector<PortAt> read_ports_;                                         // since the last sample began
    double asked_until_ = 0;  // [s] what s:run was asked for, which may end between two ticks
    std::size_t printed_bytes_ = 0;
    bool sampling_ = false;  // a condition is being called
    bool stopped_ = false;
    std::optional<Error> setup_error_;  // of a word, a method or of building, which Lua may be about to raise
    bool is_setup_error(const CallError& error) const;
    RunResult result_;
};

}  // namespace nezumi
