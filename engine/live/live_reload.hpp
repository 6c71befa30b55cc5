// Reload on save: joins the watcher of files to the reloads of a system, in runs that follow the clock.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/live/act_worker.hpp"
#include "engine/live/file_watcher.hpp"
#include "engine/live/script_host.hpp"

namespace nezumi {

class LiveReload {
public:
    /// The two phases of a reload: of these files, and of what was prepared. Null where that has to be prepared anew.
    struct Act {
        std::function<Preparation(const std::vector<std::string>& files)> prepare;
        std::function<std::optional<Expected<ActResult>>(PreparedAct prepared)> commit;
    };

    /// Watches every script of the system with its modules, and `other_files` (system, robots, maps), whose change is
    /// only told. A file that can't be read any more is told once. System and reloads must outlive it.
    LiveReload(const System& system, Reloads& reloads, const std::vector<std::string>& other_files, Act act);

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

    const System& system_;
    Reloads& reloads_;
    FileWatcher::Files other_files_;
    Act act_;
    FileWatcher watcher_;
    std::vector<std::string> failed_;   // changed files whose reload was refused: their modules may be the reason
    std::vector<std::string> loading_;  // files that are being loaded
    ActWorker worker_;
};

}  // namespace nezumi
