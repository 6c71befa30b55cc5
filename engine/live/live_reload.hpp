// Reload on save: joins the watcher of files to the reloads of a system, in runs that follow the clock.
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
    /// Watches every script of the system with its modules, and `other_files` (system, robots, maps), whose change is
    /// only told. A file that can't be read any more is told once. To be gone before the next start.
    LiveReload(RunningSystem& live, Reloads& reloads, const std::vector<std::string>& other_files);

    /// To be called between two ticks. Costs a look at a flag when nothing has changed.
    void between_ticks() {
        reloads_.after_tick();
        if (watcher_.has_news() || !worker_.is_idle() || !failed_.empty()) take_changes();
    }
    /// After a reload that did not come from here, or after components came or went: what is to be watched.
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
    std::vector<std::string> failed_;   // changed files whose reload was refused: their modules may be the reason
    std::vector<std::string> loading_;  // files that are being loaded
    ActWorker worker_;
};

}  // namespace nezumi
