// What takes long is tried beside the ticks first, so that a file that never ends its loading delays none.
#include "engine/live/live_reload.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace nezumi {

LiveReload::LiveReload(const System& system, Reloads& reloads, const std::vector<std::string>& other_files, Act act)
    : system_(system), reloads_(reloads), act_(std::move(act)) {
    for (const std::string& path : other_files) {
        if (const auto text = read_source(path)) other_files_.try_emplace(path, ScriptFile(*text).hash);
    }
    watch_again();
}

LiveReload::~LiveReload() {
    if (rehearser_.joinable()) rehearser_.join();
}

void LiveReload::watch_again() {
    FileWatcher::Files files;
    for (const ScriptFile& file : reloads_.files()) files.try_emplace(file.path, file.hash);
    files.insert(other_files_.begin(), other_files_.end());
    watcher_.watch(files);
}

void LiveReload::take_changes() {
    if (rehearsed_.exchange(false)) {
        rehearser_.join();
        const std::vector<std::string> paths = std::exchange(rehearsal_, {});
        if (!waiting_.empty()) {
            reload(std::exchange(waiting_, {}), false);
        } else if (outcome_) {
            reload(paths, true);
        } else {
            system_.log(LogLevel::error, describe(outcome_.error()));
        }
    }
    std::vector<std::string> scripts;
    for (const FileWatcher::Change& change : watcher_.take_changes()) {
        if (other_files_.contains(change.path)) {
            system_.log(LogLevel::warn, fmt::format("{} has changed: restart() to use it", change.path));
        } else if (!runs_already(change)) {
            scripts.push_back(change.path);
        }
    }
    for (const FileWatcher::Loss& loss : watcher_.take_losses()) {
        const std::vector<ScriptFile> files = reloads_.files();
        const auto file =
            std::find_if(files.begin(), files.end(), [&](const auto& each) { return each.path == loss.path; });
        const std::string& shown = file != files.end() ? file->shown : loss.path;
        system_.log(LogLevel::warn, fmt::format("{}: {}: what was loaded from it goes on", shown, loss.why));
    }
    // A module that was missing or wrong may have come: what failed without it is tried again.
    if (watcher_.take_others() || !scripts.empty()) scripts.insert(scripts.end(), failed_.begin(), failed_.end());
    if (!scripts.empty()) reload(scripts, false);
}

// As a module does that was missing: the script that failed without it was tried again before the watcher had looked.
bool LiveReload::runs_already(const FileWatcher::Change& change) const {
    if (std::find(failed_.begin(), failed_.end(), change.path) != failed_.end()) return false;
    const std::vector<ScriptFile> files = reloads_.files();
    const auto is_of = [&](const ScriptFile& file) { return file.path == change.path; };
    return std::any_of(files.begin(), files.end(), is_of) &&
           std::all_of(files.begin(), files.end(),
                       [&](const auto& file) { return !is_of(file) || file.hash == change.hash; });
}

void LiveReload::reload(const std::vector<std::string>& paths, bool rehearsed) {
    reloads_.limit_preparation(rehearsed ? 0 : longest_preparation);
    const Expected<void> done = act_(paths);
    reloads_.limit_preparation(0);
    failed_.clear();
    if (!done) {
        if (!rehearsed && done.error().kind == Error::Kind::out_of_time) return rehearse(paths);
        system_.log(LogLevel::error, describe(done.error()));
        failed_ = paths;
    }
    watch_again();
}

void LiveReload::rehearse(std::vector<std::string> paths) {
    if (rehearser_.joinable()) {
        waiting_ = std::move(paths);
        return;
    }
    auto rehearsal = reloads_.rehearsal(paths);
    if (!rehearsal) return system_.log(LogLevel::error, describe(rehearsal.error()));
    rehearsal_ = std::move(paths);
    rehearser_ = std::thread([this, load = std::move(*rehearsal)] {
        outcome_ = load();
        rehearsed_.store(true, std::memory_order_release);
    });
}

}  // namespace nezumi
