// A running system, which acts change and which can be restarted, for consoles, scenarios and `nezumi run`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/live/explain.hpp"
#include "engine/live/prepared_act.hpp"
#include "engine/live/script_host.hpp"
#include "engine/project/project.hpp"
#include "engine/system/act.hpp"
#include "engine/system/build_system.hpp"
#include "engine/time/remembered_run.hpp"
#include "engine/time/run_history.hpp"
#include "engine/trace/trace.hpp"
#include "engine/trace/trace_hash.hpp"
#include "engine/tree/node.hpp"

namespace nezumi {

struct LiveOptions {
    const ScriptHost* scripts = &no_scripts();     ///< must outlive the system
    PeerWords peer_words{};                        ///< words of system files that describe peers
    std::vector<std::filesystem::path> installed;  ///< folders of the installed files (`Project::of`)
    const ProjectFiles* files = &disk();           ///< must outlive the system
    WorldFactory world;                            ///< may be empty: then there can be no robots
    decltype(Makers::bodies) bodies;               ///< factories of real robots by backend
    std::vector<std::string> drivers;              ///< `Makers::drivers`
    RigMaker rig;                                  ///< makes the test rig that sees real robots
    NetworkMaker network;                          ///< may be empty: then a system of several hosts is refused
    NetworkMaker network_of_past{};           ///< reaches no host; empty: a system with peers can't go back in time
    decltype(Makers::components) components;  ///< native components by type
    /// Checks the description from a system file before the system is built, and may change it. After an error the
    /// system is not built. May be empty.
    std::function<Expected<void>(SystemSpec&)> prepare;
    StartValues values{};  ///< parameter values that replace those of the file, at each start
    BuildOptions build;
    Budget budget = paced_budget;  ///< limit of each call into a script; `headless_budget` in runs without a clock
    bool watch = false;            ///< reload scripts when they are saved
    bool is_replay = false;        ///< acts of other programs come from the history, and none of them is connected
    std::function<void(std::string_view)> print;  ///< gets the output of system files, a line at a time; may be empty
};

/// Observes what a run depends on besides its files and its seed: acts, and calls of scripts that ran out of time.
class ActObserver {
public:
    virtual ~ActObserver() = default;
    /// Called after each act, also if the act was refused.
    virtual void acted(const ActTime& when, std::shared_ptr<const PastAct> act, const Expected<ActResult>& result) = 0;
    /// Called after a call into a script ran out of time.
    virtual void ran_out_of_time(const ActTime& when, const std::string& component,
                                 const Component::OutOfTime& call) = 0;
};

class PastRun;

class RunningSystem {
public:
    /// Reads a system file and builds the system. Nothing is active yet. The error is the first one of the file.
    static Expected<std::unique_ptr<RunningSystem>> load(const std::filesystem::path& file, LiveOptions options);
    /// Builds a system without a file; `restart` builds it again from this description.
    static Expected<std::unique_ptr<RunningSystem>> make(SystemSpec spec, Project project, LiveOptions options);
    ~RunningSystem();
    RunningSystem(const RunningSystem&) = delete;
    RunningSystem& operator=(const RunningSystem&) = delete;

    /// Activates all components in order, except those that the file keeps inactive.
    void activate();
    /// Reloads saved files, if there are any, and runs one tick. An emergency stop follows if a gamepad's button was
    /// pressed.
    void tick();
    /// Reloads saved files and answers other hosts. Call this while no ticks pass.
    void between_ticks();
    /// Whether the next tick may begin. False while the system waits for other hosts; then call this again.
    bool may_tick();
    /// Adds the file descriptors that become readable when `may_tick` may have changed.
    void add_files(std::vector<int>& files) const;
    /// Checks an act and performs it, between two ticks. This is the only way to change the running system from
    /// outside. After an error nothing has changed, except for what a callback or command of a script did before it
    /// failed.
    ///   Restart reads the file again and starts at time 0, activated: everything is as in the file.
    ///   Add does not activate. Remove publishes the safe values of a component and removes its connections and port
    ///   overrides; its columns in a recording stay empty. A component that carries others, and a real robot, can't be
    ///   removed. Reload, Add and Restart read and load in this call: `prepare` and `commit` at once.
    Expected<ActResult> act(const Act& act, const Actor& who);
    /// From now on acts are refused for this reason, except those of `act_again`.
    void refuse_acts(std::string why) { refusal_ = std::move(why); }
    /// Performs an act from a journal like `act`, even while other acts are refused.
    Expected<ActResult> act_again(const Act& act, const Actor& who);
    /// Delivers a message to an existing port, like the act `Write` or `Inject` for its path, but without searching the
    /// port.
    Expected<ActResult> deliver(const Port& port, const Act& act, const Actor& who);
    // `act` in two phases, for callers with a thread that may wait: no tick waits for files or scripts.
    /// Between two ticks: returns a function that prepares a Reload, Add or Restart while ticks go on. `found` are the
    /// files that the caller has already read. A Reload without files and component reloads all files that have
    /// changed.
    Preparation prepare(const Act& act, FilesSeen found = {}) const;
    /// Whether the system is still the one that the act was prepared for.
    bool fits(const PreparedAct& prepared) const;
    /// Between two ticks: performs the act; refuses it if it does not fit or if its preparation failed.
    Expected<ActResult> commit(PreparedAct prepared, const Actor& who);
    /// Starts to compute the moment of a `Seek` from the history. `PastRun::go_on` continues, and `commit` goes there.
    /// An error if this is not possible: real robots, other hosts, a time that the run has not reached.
    Expected<std::unique_ptr<PastRun>> begin_seek(const Seek& where);
    /// Between two ticks: sets the system to the computed moment. The original events after it are known: ticks repeat
    /// them with their acts, and after their end the run continues. Any other act before their end starts a new branch.
    Expected<ActResult> commit(PastRun& past, const Actor& who);
    /// Everything that has happened. The end of the present branch may be older than the present.
    const RunHistory& history() const { return history_; }
    /// The same, after setting the end of the present branch to the present.
    const RunHistory& history_until_now();
    /// Whether the present is a past moment whose future is known.
    bool is_past() const { return history_.is_past(when()); }
    /// Whether a system with peers has left the present for its past. The peers got zero velocities in one tick, and
    /// get nothing now; their messages wait. A seek to the end of the branch that was left comes back to the present,
    /// and so do ticks up to this end.
    bool is_away() const { return away_ != nullptr; }
    /// The seek that comes back to the present.
    Seek back() const;
    /// Remembers poses, collisions and errors from now on, for a time line.
    void remember_run() { remembered_.emplace(); }
    /// The remembered run; null before `remember_run`.
    const RememberedRun* remembered() const { return remembered_ ? &*remembered_ : nullptr; }
    /// Sets the history that this system computes again from its start. The system must have been loaded from the files
    /// of the history, and must not be active yet.
    void repeat(RunHistory past);
    /// Repeats the known events before the next tick, as `tick` does. If `acts` is false, stops before the first act.
    void repeat_known(bool acts = true);
    /// The first tick at which a repeated history differed from the original.
    const std::optional<ActTime>& differs() const { return differs_; }
    /// Releases the ports that an actor holds, after it is gone (a closed connection, for example). A held velocity is
    /// zero for one tick before.
    void let_go(const Actor& who);
    /// Requests a line trace of the next execution of a behaviour. Returns the number of the trace, for `explanation`.
    /// This is not an act, because the trace does not change the execution.
    Expected<std::int64_t> explain_next(std::string_view component);
    /// The explanation of this trace or of a later one; nothing before the execution. An error if the component is
    /// gone. Call it after each tick.
    Expected<std::optional<Explanation>> explanation(std::string_view component, std::int64_t trace) const;
    /// Calls `System::set_at_rest`: a paused loop does this for real robots. Not an act, because a replay has no clock.
    void set_at_rest(bool at_rest);
    /// Calls `Robot::halt` for each: real robots stop at the next tick, without a braking ramp.
    void halt();
    /// Sets the observer of all further acts. The observer must outlive this object or be removed with null.
    void observe_acts(ActObserver* observer) { act_observer_ = observer; }
    /// Calls that must run out of time in a replay, by start and tick.
    struct Foreseen {
        int start = 1;
        std::int64_t tick = 0;
        std::string component;
        Component::OutOfTime call;
    };
    void foresee(std::vector<Foreseen> calls) { foreseen_ = std::move(calls); }
    /// The number of starts, as in `ActTime`.
    int starts() const { return starts_; }
    /// Pointers into the system are invalid after this has changed: after each start and each seek.
    int generation() const { return generation_; }

    /// Builds the system again from another description; it must not have ticked yet. Parameter values stay. After an
    /// error the system has not changed.
    Expected<void> rebuild(SystemSpec spec);
    /// Ends the run: deactivates everything, last first. Robots brake in the next ticks.
    void end();

    /// The present time for acts.
    ActTime when() const;
    /// The system file; empty if there is none.
    const std::filesystem::path& file() const { return file_; }
    const System& system() const;
    const SystemSpec& spec() const;
    /// The tree of all names in the present system.
    TreeNode tree() const { return TreeNode(system()); }
    const Project& project() const { return project_; }
    const LiveOptions& options() const { return options_; }
    PartReader part_reader() const { return {project_, options_.scripts, defined_messages(system())}; }
    /// The trace hash since the start; after a restart it includes the hash before.
    std::uint64_t trace_hash() const;
    /// Records values. It continues to follow its channels after a restart.
    Trace& trace() { return trace_; }

private:
    struct Running;
    struct Away;

    RunningSystem(Project project, LiveOptions options);
    // Performs an act and reports it; `files` are the files that it read, may be null.
    template <class Perform>
    Expected<ActResult> perform_and_tell(const Act& act, const Actor& who, FilesSeen* files, const Perform& perform);
    Expected<void> check(const PreparedAct& prepared) const;
    void settle();
    // `prepared` is null for acts that read no files.
    template <class EngineAct>
    Expected<ActResult> perform(const EngineAct& act, const Actor& who, PreparedAct* prepared);
    Expected<ActResult> perform(const Reload& act, const Actor& who, PreparedAct* prepared);
    Expected<ActResult> perform(const Rollback& act, const Actor& who, PreparedAct* prepared);
    Expected<ActResult> perform(const Add& act, const Actor& who, PreparedAct* prepared);
    Expected<ActResult> perform(const Remove& act, const Actor& who, PreparedAct* prepared);
    Expected<ActResult> perform(const Restart& act, const Actor& who, PreparedAct* prepared);
    ActDoor door();
    void watch_again();
    Expected<ActResult> perform(const Seek& act, const Actor& who, PreparedAct* prepared);
    void end_holds();
    void take_foreseen();
    void tell_out_of_time(const ActTime& time);
    // Replaces the running system by the one in `past`, which was replayed to the wanted time.
    Expected<ActResult> take(PastRun& past);
    bool has_peers() const { return !options_.is_replay && away_ == nullptr && !spec().peers.empty(); }
    Expected<void> check_peers() const;
    void leave_peers(const Actor& who);
    bool is_back(const Seek& where) const;
    ActResult come_back();
    static Expected<std::unique_ptr<RunningSystem>> make(SystemSpec spec, Project project, LiveOptions options,
                                                         FileSnapshot& files);
    Expected<std::unique_ptr<Running>> build(SystemSpec spec, const FileSnapshot& files);
    Expected<std::unique_ptr<Running>> build(SystemSpec spec, std::unique_ptr<Behaviors> behaviors,
                                             const ProjectFiles& files);
    // Both return the system that was replaced.
    std::unique_ptr<Running> take(std::unique_ptr<Running> running);
    std::unique_ptr<Running> replace(std::unique_ptr<Running> running);

    std::filesystem::path file_;  // empty: no file
    Project project_;
    LiveOptions options_;
    RunHistory history_;
    bool repeats_ = false;  // the act that is performed now comes from the history
    std::optional<ActTime> differs_;
    Trace trace_;
    ActObserver* act_observer_ = nullptr;
    std::int64_t acts_ = 0;
    std::string refusal_;  // why acts are refused; "": they are not
    std::vector<Foreseen> foreseen_;
    struct Ending {
        std::string port;
        Actor who;
        std::int64_t tick;
    };
    std::vector<Ending> endings_;  // holds that end after a tick with zero velocity
    std::vector<Actor> gone_;      // actors that left while the present was a past moment
    std::unique_ptr<Running> running_;
    std::unique_ptr<Away> away_;  // the present, while the system is in its past
    std::optional<RememberedRun> remembered_;
    std::optional<std::uint64_t> hash_before_;  // of earlier starts
    int starts_ = 0;
    bool ended_ = false;
    int generation_ = 0;
};

}  // namespace nezumi
