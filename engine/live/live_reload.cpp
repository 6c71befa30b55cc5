// Loads files outside the ticks, one save after the other.
#include "engine/live/live_reload.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "engine/base/list.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi {

LiveReload::LiveReload(RunningSystem& live, Reloads& reloads, const std::vector<std::string>& other_files,
                       const FileWatcher::Files& seen)
    : live_(live), reloads_(reloads) {
    watcher_.watch(seen);
    for (const std::string& path : other_files) {
        if (const auto text = read_source(path)) other_files_.try_emplace(path, ScriptFile(*text).hash);
    }
    watch_again();
}

void LiveReload::watch_again() {
    FileWatcher::Files files;
    for (const ScriptFile& file : reloads_.files()) files.try_emplace(file.path, file.hash);
    files.insert(other_files_.begin(), other_files_.end());
    watcher_.watch(files);
}

void LiveReload::take_changes() {
    if (auto prepared = worker_.take()) finish(std::move(*prepared));
    if (!worker_.is_idle()) return;
    std::vector<std::string> scripts;
    for (const FileWatcher::Change& change : watcher_.take_changes()) {
        if (other_files_.contains(change.path)) {
            live_.system().log(LogLevel::warn, fmt::format("{} has changed: restart() to use it", change.path));
        } else if (!runs_already(change)) {
            scripts.push_back(change.path);
        }
    }
    for (const FileWatcher::Loss& loss : watcher_.take_losses()) {
        const std::vector<ScriptFile> files = reloads_.files();
        const auto file =
            std::find_if(files.begin(), files.end(), [&](const auto& each) { return each.path == loss.path; });
        const std::string& shown = file != files.end() ? file->shown : loss.path;
        live_.system().log(LogLevel::warn, fmt::format("{}: {}: the loaded version continues", shown, loss.why));
    }
    // A module that was missing or wrong may have been saved: scripts that failed without it are tried again.
    if (watcher_.take_others() || !scripts.empty()) scripts.insert(scripts.end(), failed_.begin(), failed_.end());
    if (!scripts.empty()) reload(std::move(scripts));
}

// Whether the changed content runs already. This is so for a module that was missing: the script that failed without it
// was tried again before the watcher's check.
bool LiveReload::runs_already(const FileWatcher::Change& change) const {
    if (contains(failed_, change.path)) return false;
    const std::vector<ScriptFile> files = reloads_.files();
    const auto is_of = [&](const ScriptFile& file) { return file.path == change.path; };
    return std::any_of(files.begin(), files.end(), is_of) &&
           std::all_of(files.begin(), files.end(),
                       [&](const auto& file) { return !is_of(file) || file.hash == change.hash; });
}

void LiveReload::reload(std::vector<std::string> paths) {
    // A small file is loaded within this time, and so runs in the next tick.
    constexpr std::chrono::milliseconds patience{2};
    worker_.start(live_.prepare(Reload{.files = paths}));
    loading_ = std::move(paths);
    failed_.clear();
    if (auto prepared = worker_.take(patience)) finish(std::move(*prepared));
}

void LiveReload::finish(PreparedAct prepared) {
    if (!live_.fits(prepared)) return reload(std::exchange(loading_, {}));
    if (const auto done = live_.commit(std::move(prepared), {Actor::Kind::file_watcher}); !done) {
        live_.system().log(LogLevel::error, describe(done.error()));
        failed_ = std::exchange(loading_, {});
        watch_again();
    }
}

}  // namespace nezumi
