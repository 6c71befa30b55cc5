// Reload on save: joins the watcher of files to the reloads of a system, in runs that follow the clock.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "engine/live/file_watcher.hpp"
#include "engine/live/script_host.hpp"

namespace nezumi {

class LiveReload {
public:
    /// How a reload is done, of what these files hold now.
    using Act = std::function<Expected<void>(const std::vector<std::string>& files)>;

    /// Watches every script of the system with its modules, and `other_files` (system, robots, maps), whose change is
    /// only told. A file that can't be read any more is told once. System and reloads must outlive it.
    LiveReload(const System& system, Reloads& reloads, const std::vector<std::string>& other_files, Act act);
    ~LiveReload();
    LiveReload(const LiveReload&) = delete;
    LiveReload& operator=(const LiveReload&) = delete;

    /// To be called between two ticks. Costs a look at a flag when nothing has changed.
    void between_ticks() {
        reloads_.after_tick();
        if (watcher_.has_news() || rehearsed_.load(std::memory_order_acquire) || !failed_.empty()) take_changes();
    }
    /// After a reload that did not come from here, or after components came or went: what is to be watched.
    void watch_again();

private:
    void take_changes();
    bool runs_already(const FileWatcher::Change& change) const;
    void reload(const std::vector<std::string>& paths, bool rehearsed);
    void rehearse(std::vector<std::string> paths);

    /// What loading may take between two ticks before it is tried in a thread of its own [s].
    static constexpr double longest_preparation = 0.005;

    const System& system_;
    Reloads& reloads_;
    FileWatcher::Files other_files_;
    Act act_;
    FileWatcher watcher_;
    std::vector<std::string> failed_;     // changed files whose reload was refused: their modules may be the reason
    std::vector<std::string> rehearsal_;  // files that are being tried
    std::vector<std::string> waiting_;    // files that take long and were saved meanwhile
    Expected<void> outcome_;
    std::atomic<bool> rehearsed_{false};
    std::thread rehearser_;
};

}  // namespace nezumi
