// Tells which files have got another content, however an editor saves them.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace nezumi {

/// Watches the folders of files, not the files: an editor that writes a new file and renames it leaves a watch on the
/// old one deaf. Watches the folders above as well, which `git checkout` replaces. Compares contents, so that a `touch`
/// or a second notice of one save is nothing. Where the system gives no notices, it looks twice a second.
class FileWatcher {
public:
    /// A file and the hash (`ScriptFile::hash`) of the content that is known of it.
    using Files = std::map<std::string, std::uint64_t>;

    /// How often it looks for itself [s].
    static constexpr double kLook = 0.5;

    explicit FileWatcher(double look_every = kLook);
    ~FileWatcher();
    FileWatcher(const FileWatcher&) = delete;
    FileWatcher& operator=(const FileWatcher&) = delete;

    /// The files to watch from now on. Of those watched already, what is known stays known.
    void watch(const Files& files);

    /// Whether there is something to take: no more than a look at a flag.
    bool has_changes() const { return has_changes_.load(std::memory_order_relaxed); }
    /// The files that have changed since the last time, in order. A file that went is none of them.
    std::vector<std::string> take_changes();
    /// Whether another file of Lua was saved in one of the folders since the last time.
    bool take_others() { return others_.exchange(false); }

    /// How long after a notice it waits for the next one of the same save [s].
    static constexpr double kQuiet = 0.002;

private:
    class Notices;
    struct Stamps;

    void run();
    void look(bool noticed);

    const double look_every_;  // [s]
    std::mutex mutex_;         // over the next three
    Files known_;
    bool renewed_ = false;
    std::vector<std::string> changes_;
    std::atomic<bool> has_changes_{false};
    std::atomic<bool> others_{false};
    std::atomic<bool> quit_{false};
    std::unique_ptr<Stamps> stamps_;  // the thread's
    int wake_ = -1;                   // an eventfd
    std::thread thread_;
};

}  // namespace nezumi
