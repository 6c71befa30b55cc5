// A system that runs with its reloader and can be started anew: what the console, scenarios and `nezumi run` drive.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bindings/lua/project/project.hpp"
#include "bindings/lua/reload/live_reload.hpp"
#include "bindings/lua/reload/reloader.hpp"
#include "bindings/lua/script/behavior_maker.hpp"
#include "engine/system/build_system.hpp"
#include "engine/trace/trace.hpp"
#include "engine/trace/trace_hash.hpp"

namespace nezumi {

struct LiveOptions {
    std::vector<std::filesystem::path> installed;  ///< folders of the installed files (`Project::of`)
    WorldFactory world;                            ///< may be empty: then there can be no robots
    decltype(Makers::bodies) bodies;               ///< makers of real robots by backend
    decltype(Makers::components) components;       ///< native components by type
    BuildOptions build;
    Budget budget = paced_budget;  ///< of each call into a script; `headless_budget` in runs without a clock
    bool watch = false;            ///< reload scripts when they are saved
    std::function<void(std::string_view)> print;  ///< takes what system files print, a line at a time; may be empty
};

class LiveSystem {
public:
    /// Reads a system file and builds what it says. Nothing is active yet. The error is the file's first.
    static Expected<std::unique_ptr<LiveSystem>> load(const std::filesystem::path& file, LiveOptions options);
    /// Builds a system that comes from no file; `restart` builds it anew as it is here.
    static Expected<std::unique_ptr<LiveSystem>> make(SystemSpec spec, Project project, LiveOptions options);
    ~LiveSystem();
    LiveSystem(const LiveSystem&) = delete;
    LiveSystem& operator=(const LiveSystem&) = delete;

    /// Activates all that the file does not keep inactive, in order.
    void activate();
    /// Takes what was saved, if anything, and runs one tick.
    void tick();
    /// Takes what was saved, if anything: for the time in which no tick comes.
    void between_ticks();
    /// Reads the file again and starts anew from time 0, activated: everything is as in the file. On an error the
    /// system that runs has not been touched.
    Expected<void> restart();
    /// The same, with another description in the place of the file.
    Expected<void> restart_as(SystemSpec spec);
    /// Counts the starts: a pointer into the system is void when this has grown.
    int starts() const { return starts_; }

    /// Adds an entry to the system that runs and to its description, without activating it. `spec` has the model of a
    /// robot.
    Expected<Component*> add(const Entry& entry, const SystemSpec& spec);

    System& system();
    const System& system() const;
    Reloader& reloader();
    const SystemSpec& spec() const;
    const Project& project() const { return project_; }
    const LiveOptions& options() const { return options_; }
    /// Of everything since the start.
    std::uint64_t trace_hash() const;
    /// What it carries, over restarts.
    Trace& trace() { return trace_; }
    /// What is to be watched has changed other than by saving: after a reload or rollback by hand.
    void watch_again();

private:
    struct Running;

    LiveSystem(Project project, LiveOptions options);
    Expected<std::unique_ptr<Running>> build(SystemSpec spec);
    void take(std::unique_ptr<Running> running);

    std::filesystem::path file_;  // empty: from none
    Project project_;
    LiveOptions options_;
    Trace trace_;
    std::unique_ptr<Running> running_;
    int starts_ = 0;
};

}  // namespace nezumi
