// Reloads scripts in a running system: all that a change touches go together, or not at all.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bindings/lua/script/script_component.hpp"
#include "engine/system/system.hpp"

namespace nezumi {

/// What a reload or a rollback has done.
struct ReloadReport {
    std::vector<std::string> components;  ///< that run another version now
    int version = 0;                      ///< of the first of them
    std::vector<std::string> notes;       ///< ports that went, with what they were connected to
};

/// All of it is to be called between two ticks. An error means that nothing has changed; its message ends with
/// "still running version N".
class Reloader {
public:
    using Reader = std::function<Expected<SourceText>(const std::string& path)>;

    /// `read` gives the present text of a script or module.
    explicit Reloader(System& system, Reader read = read_source) : system_(system), read_(std::move(read)) {}

    /// Reloads every component of these files and every one that requires them, from what the files hold now.
    Expected<ReloadReport> reload_files(const std::vector<std::string>& paths);
    /// Reloads the components of a file from this text of it.
    Expected<ReloadReport> reload(const SourceText& source);
    /// The scripts and modules whose files have changed since they were loaded, or can't be read.
    std::vector<std::string> changed_files() const { return changed(loaded_files(), read_); }
    /// Of these files, those that hold something else now or can't be read. In any thread: who may wait for a file
    /// system that does not answer asks this.
    static std::vector<std::string> changed(const std::vector<ScriptFile>& files, const Reader& read);
    /// Takes a component, and those that came to their version with it, back to the version before, state included.
    Expected<ReloadReport> rollback(const Component& component);

    /// After every tick: takes back what has failed on probation.
    void after_tick();

    /// All files that the scripts of the system come from, modules too.
    std::vector<ScriptFile> loaded_files() const;
    /// The same, and those that a refused version required.
    std::vector<ScriptFile> files() const;

    /// A version to be loaded only to see whether it can be, with copies of all that it needs.
    struct Rehearsal {
        SourceText source;
        ScriptContext context;
        Parameters parameters;
        PlainData state;
        int running = 0;  ///< version
    };
    /// What `reload_files` would load.
    Expected<std::vector<Rehearsal>> rehearsal(const std::vector<std::string>& paths) const;
    /// Loads it and lets it go. May run beside the ticks, and outlive the system.
    static Expected<void> rehearse(const std::vector<Rehearsal>& parts);

    /// What the preparation of a component may take [s of CPU time]; 0: what its calls may.
    void limit_preparation(double seconds) { preparation_seconds_ = seconds; }

private:
    using Change = std::pair<ScriptComponent*, SourceText>;

    std::vector<ScriptComponent*> scripts() const;
    Expected<std::vector<Change>> changes_of(const std::vector<std::string>& paths) const;
    Expected<ReloadReport> run(const std::vector<Change>& changes);
    void let_ports_go(ScriptComponent& component, const ScriptComponent::Version& next, ReloadReport& report);
    void connect_again(ReloadReport& report);
    // Says which versions run now. An empty `what` is the file of each.
    void finish(const ReloadReport& report, std::string_view what);
    // Components of one file that run the same version.
    struct Group {
        std::string file;
        int version;
        std::vector<std::string> components;
    };
    std::vector<Group> groups_of(const ReloadReport& report) const;
    ReloadReport go_back(int reload, bool keep_settings);
    void watch_probation(const ScriptComponent& component);

    System& system_;
    Reader read_;
    int reloads_ = 0;
    double preparation_seconds_ = 0;
    std::vector<std::string> on_probation_;  // names of components
    std::vector<ScriptFile> attempted_;      // modules of the version that was refused last
    std::vector<System::Dropped> lost_;      // connections that ended with a port
};

}  // namespace nezumi
