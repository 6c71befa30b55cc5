// inotify on folders, gathered until it is quiet, then checked against contents.
#include "bindings/lua/reload/file_watcher.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <memory>
#include <set>
#include <utility>

#include "bindings/lua/project/script_source.hpp"

namespace nezumi {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kLongestGathering = 0.02;  // [s] of a burst of saves

std::chrono::nanoseconds nanoseconds(double seconds) {
    return std::chrono::nanoseconds(static_cast<std::int64_t>(seconds * 1e9));
}

// What tells a file from its earlier self without reading it: enough to look twice a second, too coarse for two saves
// within one step of the file system's clock.
struct Stamp {
    ino_t inode = 0;
    off_t size = 0;
    timespec changed{};

    explicit Stamp(const std::string& path) {
        struct stat status {};
        if (::stat(path.c_str(), &status) == 0) {
            inode = status.st_ino;
            size = status.st_size;
            changed = status.st_ctim;
        }
    }
    Stamp() = default;
    bool operator==(const Stamp& other) const {
        return inode == other.inode && size == other.size && changed.tv_sec == other.changed.tv_sec &&
               changed.tv_nsec == other.changed.tv_nsec;
    }
};

// A file that was made by linking is whole at once; any other is whole when it is closed.
bool is_link(const std::string& path) {
    struct stat status {};
    return ::lstat(path.c_str(), &status) == 0 && (S_ISLNK(status.st_mode) || status.st_nlink > 1);
}

}  // namespace

struct FileWatcher::Stamps {
    std::map<std::string, Stamp> of;
};

// The folders of a list of files, watched from the moment it is made.
class FileWatcher::Notices {
public:
    enum class Kind { nothing, other, file, folder };

    explicit Notices(const Files& files) : fd_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
        for (const auto& [path, hash] : files) {
            std::error_code problem;
            const fs::path given = fs::absolute(path, problem).lexically_normal();
            watch_chain(given);
            const fs::path real = fs::canonical(path, problem);
            if (!problem && real != given) watch_chain(real);
        }
    }
    ~Notices() {
        if (fd_ >= 0) ::close(fd_);
    }
    Notices(const Notices&) = delete;
    Notices& operator=(const Notices&) = delete;

    int fd() const { return fd_; }

    // What has been noticed since the last time; of several things the greatest.
    Kind read() {
        Kind kind = Kind::nothing;
        alignas(inotify_event) char buffer[1 << 14];
        for (;;) {
            const ssize_t size = ::read(fd_, buffer, sizeof buffer);
            if (size <= 0) return kind;
            for (ssize_t at = 0; at < size;) {
                inotify_event event{};
                std::memcpy(&event, buffer + at, sizeof event);
                const char* name = buffer + at + sizeof event;
                kind = std::max(kind, classify(event, event.len > 0 ? name : ""));
                at += static_cast<ssize_t>(sizeof event + event.len);
            }
        }
    }

private:
    struct Folder {
        std::string path;
        std::set<std::string> files;    // names in it that are watched
        std::set<std::string> folders;  // on the way to others
    };

    // From the root down: of a folder that is made anew in this moment, the one above it tells.
    void watch_chain(const fs::path& path, bool is_file = true) {
        const fs::path folder = path.parent_path();
        if (folder.has_relative_path()) watch_chain(folder, false);
        watch(folder, path.filename().string(), is_file);
    }
    void watch(const fs::path& folder, const std::string& name, bool is_file) {
        const int wd = ::inotify_add_watch(fd_, folder.c_str(),
                                           IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_CREATE | IN_DELETE |
                                               IN_DELETE_SELF | IN_MOVE_SELF | IN_ONLYDIR);
        if (wd < 0) return;  // not there, or not for us: the looks of the thread remain
        Folder& known = folders_[wd];
        known.path = folder.string();
        (is_file ? known.files : known.folders).insert(name);
    }
    Kind classify(const inotify_event& event, const std::string& name) const {
        if ((event.mask & (IN_Q_OVERFLOW | IN_IGNORED | IN_DELETE_SELF | IN_MOVE_SELF)) != 0) return Kind::folder;
        const auto folder = folders_.find(event.wd);
        if (folder == folders_.end()) return Kind::nothing;
        if (folder->second.folders.count(name) > 0) return Kind::folder;
        const bool whole = (event.mask & (IN_CLOSE_WRITE | IN_MOVED_TO)) != 0 ||
                           ((event.mask & IN_CREATE) != 0 && is_link(folder->second.path + "/" + name));
        if (!whole) return Kind::nothing;
        // A link may lead through folders that are not watched yet.
        if (folder->second.files.count(name) > 0)
            return is_link(folder->second.path + "/" + name) ? Kind::folder : Kind::file;
        return name.ends_with(".lua") ? Kind::other : Kind::nothing;
    }

    int fd_;
    std::map<int, Folder> folders_;
};

FileWatcher::FileWatcher(double look_every)
    : look_every_(look_every),
      stamps_(std::make_unique<Stamps>()),
      wake_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)),
      thread_([this] { run(); }) {}

FileWatcher::~FileWatcher() {
    quit_ = true;
    ::eventfd_write(wake_, 1);
    thread_.join();
    ::close(wake_);
}

void FileWatcher::watch(const Files& files) {
    {
        const std::lock_guard lock(mutex_);
        Files known = files;
        for (auto& [path, hash] : known) {
            if (const auto before = known_.find(path); before != known_.end()) hash = before->second;
        }
        if (known == known_) return;
        known_ = std::move(known);
        renewed_ = true;
    }
    ::eventfd_write(wake_, 1);
}

std::vector<std::string> FileWatcher::take_changes() {
    const std::lock_guard lock(mutex_);
    has_changes_ = false;
    std::sort(changes_.begin(), changes_.end());
    changes_.erase(std::unique(changes_.begin(), changes_.end()), changes_.end());
    return std::exchange(changes_, {});
}

void FileWatcher::run() {
    Notices* notices = nullptr;
    std::unique_ptr<Notices> owned;
    const auto renew = [&] {
        Files files;
        {
            const std::lock_guard lock(mutex_);
            renewed_ = false;
            files = known_;
        }
        owned = std::make_unique<Notices>(files);
        notices = owned.get();
    };
    renew();
    bool pending = false;
    bool renew_first = false;
    Clock::time_point first{};
    Clock::time_point last_look = Clock::now();
    while (!quit_) {
        pollfd fds[2] = {{wake_, POLLIN, 0}, {notices->fd(), POLLIN, 0}};
        const auto wait = pending ? nanoseconds(kQuiet) : nanoseconds(look_every_);
        const timespec timeout{wait.count() / 1'000'000'000, wait.count() % 1'000'000'000};
        const int ready = ::ppoll(fds, notices->fd() >= 0 ? 2 : 1, &timeout, nullptr);
        eventfd_t ignored = 0;
        ::eventfd_read(wake_, &ignored);
        bool renewed = false;
        {
            const std::lock_guard lock(mutex_);
            renewed = renewed_;
        }
        const Notices::Kind kind = notices->read();
        if (kind == Notices::Kind::other) others_ = true;
        if (kind == Notices::Kind::folder || renewed) renew_first = true;
        if (kind >= Notices::Kind::file || renewed) {
            if (!pending) first = Clock::now();
            pending = true;
        }
        const Clock::time_point now = Clock::now();
        const bool is_quiet = pending && (ready == 0 || now - first > nanoseconds(kLongestGathering));
        if (!is_quiet && now - last_look < nanoseconds(look_every_)) continue;
        if (std::exchange(renew_first, false)) renew();
        last_look = now;
        look(std::exchange(pending, false));
    }
}

void FileWatcher::look(bool noticed) {
    Files files;
    {
        const std::lock_guard lock(mutex_);
        files = known_;
    }
    for (const auto& [path, hash] : files) {
        const Stamp stamp(path);
        if (!noticed && stamps_->of[path] == stamp) continue;
        stamps_->of[path] = stamp;
        const auto text = read_source(path);
        if (!text) continue;  // it is on its way back, or gone for good
        const std::uint64_t found = ScriptFile(*text).hash;
        if (found == hash) continue;
        const std::lock_guard lock(mutex_);
        const auto known = known_.find(path);
        if (known == known_.end() || known->second == found) continue;
        known->second = found;
        changes_.push_back(path);
        has_changes_ = true;
    }
}

}  // namespace nezumi
