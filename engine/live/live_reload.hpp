// Reload on save: reloads scripts when the file watcher reports changes, in runs that follow real time.
#pragma once

#include <string>
#include <vector>

#include "engine/live/act_worker.hpp"
#include "engine/live/file_watcher.hpp"
#include "engine/live/script_host.hpp"

namespace nezumi {

class RunningSystem;

class LiveReload {
public:
    /// Watches every script of the system with its modules, and `other_files` (system, robots, maps), whose changes are
    /// only reported. A file that can't be read any more is reported once. This object must be destroyed before the
    /// next start. `seen`: contents that the watcher has seen already; they do not count as changes, even if the system
    /// runs other contents.
    LiveReload(RunningSystem& live, Reloads& reloads, const std::vector<std::string>& other_files,
               const FileWatcher::Files& seen = {});

    /// The hashes of the contents that were seen last.
    FileWatcher::Files seen() const { return watcher_.known(); }

    /// Call this between two ticks. Only reads a flag if nothing has changed.
    void between_ticks() {
        if (watcher_.has_news() || !worker_.is_idle() || !failed_.empty()) take_changes();
    }
    /// Call this after other reloads, and after components were added or removed: updates the watched files.
    void watch_again();

private:
    void take_changes();
    bool runs_already(const FileWatcher::Change& change) const;
    void reload(std::vector<std::string> paths);
    void finish(PreparedAct prepared);

    RunningSystem& live_;
    Reloads& reloads_;
    FileWatcher::Files other_files_;
    FileWatcher watcher_;
    std::vector<std::string> failed_;   // changed files whose reload was refused, perhaps because of their modules
    std::vector<std::string> loading_;  // files that are being loaded
    ActWorker worker_;
};

}  // namespace nezumi
