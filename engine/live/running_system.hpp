// A system that runs, is changed by acts and can be started anew: what consoles, scenarios and `nezumi run` drive.
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
#include "engine/trace/trace.hpp"
#include "engine/trace/trace_hash.hpp"
#include "engine/tree/node.hpp"

namespace nezumi {

struct LiveOptions {
    const ScriptHost* scripts = &no_scripts();     ///< must outlive the system
    std::vector<std::filesystem::path> installed;  ///< folders of the installed files (`Project::of`)
    const ProjectFiles* files = &disk();           ///< must outlive the system
    WorldFactory world;                            ///< may be empty: then there can be no robots
    decltype(Makers::bodies) bodies;               ///< makers of real robots by backend
    std::vector<std::string> drivers;              ///< `Makers::drivers`
    RigMaker rig;                                  ///< what sees real robots from outside
    NetworkMaker network;                          ///< may be empty: then a system of several hosts is refused
    decltype(Makers::components) components;       ///< native components by type
    /// Has a look at what a file says before it is built, and may change it; an error refuses it. May be empty.
    std::function<Expected<void>(SystemSpec&)> prepare;
    StartValues values{};  ///< over those of the file, at each start
    BuildOptions build;
    Budget budget = paced_budget;  ///< of each call into a script; `headless_budget` in runs without a clock
    bool watch = false;            ///< reload scripts when they are saved
    std::function<void(std::string_view)> print;  ///< takes what system files print, a line at a time; may be empty
};

/// When an act was performed: in which start, before which tick, and its number among all acts.
struct ActTime {
    int start = 1;
    std::int64_t tick = 0;
    std::int64_t sequence = 0;
    bool operator==(const ActTime&) const = default;
};

/// Is told of everything that makes one run differ from another.
class ActObserver {
public:
    virtual ~ActObserver() = default;
    /// An act, what has come of it, also where it was refused, and what it found of files.
    virtual void acted(const ActTime& when, const Act& act, const Actor& who, const Expected<ActResult>& result,
                       FilesSeen files) = 0;
    /// A call into a script ran out of its time.
    virtual void ran_out_of_time(const ActTime& when, const std::string& component,
                                 const Component::OutOfTime& call) = 0;
};

class RunningSystem {
public:
    /// Reads a system file and builds what it says. Nothing is active yet. The error is the file's first.
    static Expected<std::unique_ptr<RunningSystem>> load(const std::filesystem::path& file, LiveOptions options);
    /// Builds a system that comes from no file; `restart` builds it anew as it is here.
    static Expected<std::unique_ptr<RunningSystem>> make(SystemSpec spec, Project project, LiveOptions options);
    ~RunningSystem();
    RunningSystem(const RunningSystem&) = delete;
    RunningSystem& operator=(const RunningSystem&) = delete;

    /// Activates all that the file does not keep inactive, in order.
    void activate();
    /// Takes what was saved, if anything, and runs one tick. An emergency stop follows where a gamepad's button for it
    /// was pressed.
    void tick();
    /// Takes what was saved, if anything: for the time in which no tick comes.
    void between_ticks();
    /// Whether the next tick may come: not while other hosts are waited for. To be asked again then.
    bool may_tick();
    /// Adds the files that are readable when that may have changed.
    void add_files(std::vector<int>& files) const;
    /// Checks an act and performs it, between two ticks: the one way in which the system that runs is changed from
    /// outside. On an error nothing has changed, but for what a hook or command of a script did before it failed.
    ///   Restart reads the file again and starts anew from time 0, activated: everything is as in the file.
    ///   Add does not activate. Remove lets the safe values of a component through; what carries others, and a real
    ///   robot, stays. Its connections and the hands on its ports go with it, its columns of a recording stay empty.
    ///   Reload, Add and Restart read and load here: `prepare` and `commit` at once.
    Expected<ActResult> act(const Act& act, const Actor& who);
    /// A message for a port that is there, as the act `Write` or `Inject` of its path: who sends many finds it once.
    Expected<ActResult> deliver(const Port& port, const Act& act, const Actor& who);
    // The same in two phases, for who has a thread that may wait: no tick waits for files or scripts.
    /// Between two ticks: how a Reload, Add or Restart is prepared beside them. `found` is what its maker has found of
    /// files already. A Reload that names neither files nor a component is of all files that have changed.
    Preparation prepare(const Act& act, FilesSeen found = {}) const;
    /// Whether the system is still the one that it was prepared for.
    bool fits(const PreparedAct& prepared) const;
    /// Between two ticks: performs it; refused where it does not fit or its preparation failed.
    Expected<ActResult> commit(PreparedAct prepared, const Actor& who);
    /// Ends what one holds who goes for good, as a connection that closes: a velocity is zero for a tick first.
    void let_go(const Actor& who);
    /// Has an execution of a behaviour traced, line by line; it runs as it would without. Returns the number of that
    /// trace, for `explanation`. No act: nothing changes.
    Expected<std::int64_t> explain_next(std::string_view component);
    /// What was seen in that trace, or in a later one; nothing before it was executed. An error when the component is
    /// gone. To be asked for after each tick.
    Expected<std::optional<Explanation>> explanation(std::string_view component, std::int64_t trace) const;
    /// `System::set_at_rest`: a loop that is paused has it so where robots are real. No act: a replay has no clock.
    void set_at_rest(bool at_rest);
    /// `Robot::halt` of each: real robots stand from the next tick on, without braking.
    void halt();
    /// Tells an observer of every act from now on. It must outlive this or be removed with null.
    void observe_acts(ActObserver* observer) { act_observer_ = observer; }
    /// Calls that are to run out of time, by start and tick: what a replay knows of the clock.
    struct Foreseen {
        int start = 1;
        std::int64_t tick = 0;
        std::string component;
        Component::OutOfTime call;
    };
    void foresee(std::vector<Foreseen> calls) { foreseen_ = std::move(calls); }
    /// Counts the starts: a pointer into the system is void when this has grown.
    int starts() const { return starts_; }

    /// Builds anew what has not moved yet, from another description; values of parameters stay. On an error the system
    /// has not been touched.
    Expected<void> rebuild(SystemSpec spec);
    /// The run ends: deactivates everything, last first. Robots brake in the ticks that follow.
    void end();

    /// The present, as acts see it.
    ActTime when() const;
    /// The system file; empty when it comes from none.
    const std::filesystem::path& file() const { return file_; }
    const System& system() const;
    const SystemSpec& spec() const;
    /// All of it by name, as it is now.
    TreeNode tree() const { return TreeNode(system()); }
    const Project& project() const { return project_; }
    const LiveOptions& options() const { return options_; }
    PartReader part_reader() const { return {project_, options_.scripts}; }
    /// What its start has found of files, once, until it is activated: what a journal keeps.
    FilesSeen take_files() { return std::exchange(files_, {}); }
    /// Of everything since the start; after a restart, of that and of what the start before came to.
    std::uint64_t trace_hash() const;
    /// What it carries, over restarts.
    Trace& trace() { return trace_; }

private:
    struct Running;

    RunningSystem(Project project, LiveOptions options);
    // Has it performed, and tells; `files`: what it found of files, may be null.
    template <class Perform>
    Expected<ActResult> perform_and_tell(const Act& act, const Actor& who, FilesSeen* files, const Perform& perform);
    Expected<void> check(const PreparedAct& prepared) const;
    void settle();
    // `prepared` is null for acts that take nothing of files.
    template <class EngineAct>
    Expected<ActResult> perform(const EngineAct& act, const Actor& who, PreparedAct* prepared);
    Expected<ActResult> perform(const Reload& act, const Actor& who, PreparedAct* prepared);
    Expected<ActResult> perform(const Rollback& act, const Actor& who, PreparedAct* prepared);
    Expected<ActResult> perform(const Add& act, const Actor& who, PreparedAct* prepared);
    Expected<ActResult> perform(const Remove& act, const Actor& who, PreparedAct* prepared);
    Expected<ActResult> perform(const Restart& act, const Actor& who, PreparedAct* prepared);
    ActDoor door();
    void watch_again();
    void end_holds();
    void take_foreseen();
    void tell_out_of_time(const ActTime& time);
    static Expected<std::unique_ptr<RunningSystem>> make(SystemSpec spec, Project project, LiveOptions options,
                                                         FileSnapshot& files);
    Expected<std::unique_ptr<Running>> build(SystemSpec spec, const FileSnapshot& files);
    Expected<std::unique_ptr<Running>> build(SystemSpec spec, std::unique_ptr<Behaviors> behaviors);
    // Returns what it takes the place of.
    std::unique_ptr<Running> take(std::unique_ptr<Running> running);

    std::filesystem::path file_;  // empty: from none
    Project project_;
    LiveOptions options_;
    FilesSeen files_;  // of the start
    Trace trace_;
    ActObserver* act_observer_ = nullptr;
    std::int64_t acts_ = 0;
    std::vector<Foreseen> foreseen_;
    struct Ending {
        std::string port;
        Actor who;
        std::int64_t tick;
    };
    std::vector<Ending> endings_;  // of holds, after the tick in which a zero was sent
    std::unique_ptr<Running> running_;
    std::optional<std::uint64_t> hash_before_;  // of the starts before this one
    int starts_ = 0;
};

}  // namespace nezumi
