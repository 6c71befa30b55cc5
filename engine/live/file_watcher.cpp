// Watches folders by inotify, waits until changes stop, then compares contents.
#include "engine/live/file_watcher.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

namespace nezumi {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double longest_gathering = 0.02;             // [s] longest wait for the end of a series of saves
constexpr std::chrono::milliseconds longest_end{200};  // longest wait of the destructor for a file that is being read

std::chrono::nanoseconds nanoseconds(double seconds) {
    return std::chrono::nanoseconds(static_cast<std::int64_t>(seconds * 1e9));
}

// Detects changes of a file without reading it. Cheap enough for two checks per second, but too coarse for two saves
// within the resolution of the file system's clock.
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

// Whether a file is a link. A file made by linking is complete at once; any other file is complete when it is closed.
bool is_link(const std::string& path) {
    struct stat status {};
    return ::lstat(path.c_str(), &status) == 0 && (S_ISLNK(status.st_mode) || status.st_nlink > 1);
}

}  // namespace

// Watches the folders of a list of files from its construction on.
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

    // The most important notice since the last call.
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
        std::set<std::string> files;    // names of watched files in this folder
        std::set<std::string> folders;  // names of folders in it on the way to watched files
    };

    // Watches the folders from the root down: if one is being made at this moment, its parent reports it.
    void watch_chain(const fs::path& path, bool is_file = true) {
        const fs::path folder = path.parent_path();
        if (folder.has_relative_path()) watch_chain(folder, false);
        watch(folder, path.filename().string(), is_file);
    }
    void watch(const fs::path& folder, const std::string& name, bool is_file) {
        const int wd = ::inotify_add_watch(fd_, folder.c_str(),
                                           IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_CREATE | IN_DELETE |
                                               IN_DELETE_SELF | IN_MOVE_SELF | IN_ONLYDIR);
        if (wd < 0) return;  // missing, or no permission: the periodic checks detect changes
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
        // A link may lead through folders that are not watched yet, so all folders are watched anew.
        if (folder->second.files.count(name) > 0)
            return is_link(folder->second.path + "/" + name) ? Kind::folder : Kind::file;
        return name.ends_with(".lua") ? Kind::other : Kind::nothing;
    }

    int fd_;
    std::map<int, Folder> folders_;
};

// The work and the data of the thread.
class FileWatcher::Watch {
public:
    Watch(Shared& shared, double poll_period, const Reader& read)
        : shared_(shared), poll_period_(poll_period), read_(read) {}
    void run();

private:
    void watch_anew();
    void poll(bool noticed);
    // A file that has been missing or unreadable for some time.
    struct Trouble {
        Clock::time_point since;
        bool told = false;
    };
    void poll_file(const std::string& path, std::uint64_t known, bool noticed);
    void lose(const std::string& path, const std::string& why);

    Shared& shared_;
    const double poll_period_;  // [s]
    const Reader& read_;
    std::optional<Notices> notices_;
    std::map<std::string, Stamp> stamps_;
    std::map<std::string, Trouble> troubles_;
};

FileWatcher::Shared::Shared() : wake(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}

FileWatcher::Shared::~Shared() {
    if (wake >= 0) ::close(wake);
}

FileWatcher::FileWatcher(double poll_period, Reader read)
    : shared_(std::make_shared<Shared>()), thread_([shared = shared_, poll_period, read = std::move(read)] {
          Watch(*shared, poll_period, read).run();
          const std::lock_guard lock(shared->mutex);
          shared->ended = true;
          shared->end.notify_all();
      }) {}

FileWatcher::~FileWatcher() {
    shared_->quit = true;
    ::eventfd_write(shared_->wake, 1);
    Lock lock(shared_->mutex);
    const bool ended = shared_->end.wait_for(lock, longest_end, [this] { return shared_->ended; });
    lock.unlock();
    if (ended) {
        thread_.join();
    } else {
        thread_.detach();
    }
}

void FileWatcher::watch(const Files& files) {
    {
        const std::lock_guard lock(shared_->mutex);
        Files known = files;
        for (auto& [path, hash] : known) {
            if (const auto before = shared_->known.find(path); before != shared_->known.end()) hash = before->second;
        }
        if (known == shared_->known) return;
        shared_->known = std::move(known);
        shared_->renewed = true;
    }
    ::eventfd_write(shared_->wake, 1);
}

std::vector<FileWatcher::Change> FileWatcher::take_changes() {
    const std::lock_guard lock(shared_->mutex);
    shared_->has_news = !shared_->losses.empty();
    std::vector<Change> changes;
    for (auto& [path, hash] : std::exchange(shared_->changes, {})) changes.push_back({path, hash});
    return changes;
}

std::vector<FileWatcher::Loss> FileWatcher::take_losses() {
    const std::lock_guard lock(shared_->mutex);
    shared_->has_news = !shared_->changes.empty();
    return std::exchange(shared_->losses, {});
}

void FileWatcher::Watch::watch_anew() {
    Files files;
    {
        const std::lock_guard lock(shared_.mutex);
        shared_.renewed = false;
        files = shared_.known;
    }
    notices_.emplace(files);
}

void FileWatcher::Watch::run() {
    watch_anew();
    bool pending = false;
    bool renew_first = false;
    Clock::time_point first{};
    Clock::time_point last_poll = Clock::now();
    while (!shared_.quit) {
        pollfd fds[2] = {{shared_.wake, POLLIN, 0}, {notices_->fd(), POLLIN, 0}};
        const auto wait = pending ? nanoseconds(quiet_time) : nanoseconds(poll_period_);
        const timespec timeout{.tv_sec = static_cast<std::time_t>(wait.count() / 1'000'000'000),
                               .tv_nsec = static_cast<long>(wait.count() % 1'000'000'000)};
        const int ready = ::ppoll(fds, notices_->fd() >= 0 ? 2 : 1, &timeout, nullptr);
        eventfd_t ignored = 0;
        ::eventfd_read(shared_.wake, &ignored);
        bool renewed = false;
        {
            const std::lock_guard lock(shared_.mutex);
            renewed = shared_.renewed;
        }
        const Notices::Kind kind = notices_->read();
        if (kind == Notices::Kind::other) shared_.others = true;
        if (kind == Notices::Kind::folder || renewed) renew_first = true;
        if (kind >= Notices::Kind::file || renewed) {
            if (!pending) first = Clock::now();
            pending = true;
        }
        const Clock::time_point now = Clock::now();
        const bool is_quiet = pending && (ready == 0 || now - first > nanoseconds(longest_gathering));
        if (!is_quiet && now - last_poll < nanoseconds(poll_period_)) continue;
        if (std::exchange(renew_first, false)) watch_anew();
        last_poll = now;
        poll(std::exchange(pending, false));
    }
}

void FileWatcher::Watch::poll(bool noticed) {
    Files files;
    {
        const std::lock_guard lock(shared_.mutex);
        files = shared_.known;
    }
    for (const auto& [path, hash] : files) poll_file(path, hash, noticed);
}

void FileWatcher::Watch::poll_file(const std::string& path, std::uint64_t known, bool noticed) {
    const Stamp stamp(path);
    // A missing file may become readable again without any notice, so it is read in each check.
    const auto [before, is_new] = stamps_.try_emplace(path, stamp);
    if (!noticed && !is_new && before->second == stamp && !troubles_.contains(path)) return;
    before->second = stamp;
    const auto text = read_(path);
    if (!text) return lose(path, text.error().message);
    troubles_.erase(path);
    const std::uint64_t found = ScriptFile(*text).hash;
    if (found == known) return;
    const std::lock_guard lock(shared_.mutex);
    const auto same = shared_.known.find(path);
    if (same == shared_.known.end() || same->second == found) return;
    same->second = found;
    shared_.changes.insert_or_assign(path, found);
    shared_.has_news = true;
}

// Reports a file that stays missing for a period: many programs remove a file for a moment when they save it.
void FileWatcher::Watch::lose(const std::string& path, const std::string& why) {
    const Clock::time_point now = Clock::now();
    Trouble& trouble = troubles_.try_emplace(path, Trouble{.since = now}).first->second;
    if (trouble.told || now - trouble.since < nanoseconds(poll_period_)) return;
    trouble.told = true;
    const std::lock_guard lock(shared_.mutex);
    shared_.losses.push_back({path, why});
    shared_.has_news = true;
}

}  // namespace nezumi
