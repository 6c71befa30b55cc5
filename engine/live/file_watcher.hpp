// Detects files with changed content, for every way in which an editor saves them.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "engine/base/mutex.hpp"
#include "engine/project/script_source.hpp"

namespace nezumi {

/// Watches the folders of files, not the files: an editor that writes a new file and renames it would leave a watch on
/// the old one. Also watches the folders above, which `git checkout` replaces. Compares contents, so a `touch` or a
/// second event of one save is ignored. If the operating system provides no events, checks twice a second.
class FileWatcher {
public:
    /// Files and the hashes (`ScriptFile::hash`) of their known contents, by path.
    using Files = std::map<std::string, std::uint64_t>;
    using Reader = std::function<Expected<SourceText>(const std::string& path)>;
    /// A file with changed content, and the hash of the content.
    struct Change {
        std::string path;
        std::uint64_t hash;
    };
    /// A file that can't be read any more.
    struct Loss {
        std::string path;
        std::string why;
    };

    /// The period of checks without events [s].
    static constexpr double usual_poll_period = 0.5;

    /// `read` is called from another thread, and may outlive the watcher if a call does not return.
    explicit FileWatcher(double poll_period = usual_poll_period, Reader read = read_source);
    /// Waits for its thread, but not for a file system that does not answer.
    ~FileWatcher();
    FileWatcher(const FileWatcher&) = delete;
    FileWatcher& operator=(const FileWatcher&) = delete;

    /// Sets the watched files. For files that were already watched, the known content stays.
    void watch(const Files& files);

    /// The watched files with the contents that were seen last.
    Files known() const {
        const std::lock_guard lock(shared_->mutex);
        return shared_->known;
    }

    /// Whether there are changes or losses to take; only reads a flag.
    bool has_news() const { return shared_->has_news.load(std::memory_order_relaxed); }
    /// The files that have changed since the last call, sorted by path, each once with its present content. Files that
    /// are gone are not included.
    std::vector<Change> take_changes();
    /// The files that have been missing or unreadable for at least one period of checks. Each is returned once, and
    /// again only after it was readable in between.
    std::vector<Loss> take_losses();
    /// Whether another Lua file was saved in one of the folders since the last call.
    bool take_others() { return shared_->others.exchange(false); }

    /// Time after an event for further events of the same save [s].
    static constexpr double quiet_time = 0.002;

private:
    class Notices;
    class Watch;
    // Shared by both threads. The one that ends last destroys it.
    struct Shared {
        Shared();
        ~Shared();
        Shared(const Shared&) = delete;
        Shared& operator=(const Shared&) = delete;

        Mutex mutex;  // guards the next six members
        std::condition_variable end;
        bool ended = false;
        Files known;
        bool renewed = false;
        std::map<std::string, std::uint64_t> changes;
        std::vector<Loss> losses;
        std::atomic<bool> has_news{false};
        std::atomic<bool> others{false};
        std::atomic<bool> quit{false};
        int wake;  // an eventfd
    };

    std::shared_ptr<Shared> shared_;
    std::thread thread_;
};

}  // namespace nezumi
