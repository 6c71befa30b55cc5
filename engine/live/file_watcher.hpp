// Tells which files have got another content, however an editor saves them.
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

/// Watches the folders of files, not the files: an editor that writes a new file and renames it leaves a watch on the
/// old one deaf. Watches the folders above as well, which `git checkout` replaces. Compares contents, so that a `touch`
/// or a second notice of one save is nothing. Where the system gives no notices, it looks twice a second.
class FileWatcher {
public:
    /// A file and the hash (`ScriptFile::hash`) of the content that is known of it.
    using Files = std::map<std::string, std::uint64_t>;
    using Reader = std::function<Expected<SourceText>(const std::string& path)>;
    /// A file that has got another content, and that content's hash.
    struct Change {
        std::string path;
        std::uint64_t hash;
    };
    /// A file that can't be read any more.
    struct Loss {
        std::string path;
        std::string why;
    };

    /// How often it looks for itself [s].
    static constexpr double usual_poll_period = 0.5;

    /// `read` is called from another thread, and may outlive the watcher when a call does not return.
    explicit FileWatcher(double poll_period = usual_poll_period, Reader read = read_source);
    /// Waits for its thread, but not for a file system that does not answer.
    ~FileWatcher();
    FileWatcher(const FileWatcher&) = delete;
    FileWatcher& operator=(const FileWatcher&) = delete;

    /// The files to watch from now on. Of those watched already, what is known stays known.
    void watch(const Files& files);

    /// Whether there is something to take, changes or losses: no more than a read of a flag.
    bool has_news() const { return shared_->has_news.load(std::memory_order_relaxed); }
    /// The files that have changed since the last time, in the order of their paths, each once with what it holds now.
    /// A file that went is none of them.
    std::vector<Change> take_changes();
    /// The files that went, or are there and can't be read, for at least as long as it is from poll to poll: each once,
    /// and again only when it could be read in between.
    std::vector<Loss> take_losses();
    /// Whether another file of Lua was saved in one of the folders since the last time.
    bool take_others() { return shared_->others.exchange(false); }

    /// How long after a notice it waits for the next one of the same save [s].
    static constexpr double quiet_time = 0.002;

private:
    class Notices;
    class Watch;
    // Of both threads. It goes with the one that ends last.
    struct Shared {
        Shared();
        ~Shared();
        Shared(const Shared&) = delete;
        Shared& operator=(const Shared&) = delete;

        Mutex mutex;  // over the next six
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
