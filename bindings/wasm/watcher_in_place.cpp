// Watches files without events or a thread: reads them again when `look_at_files` is called.
#include <functional>
#include <map>
#include <utility>

#include "bindings/wasm/in_place.hpp"
#include "engine/live/file_watcher.hpp"

namespace nezumi {
namespace {

// The function that checks the files of each watcher, until the watcher ends.
std::map<const void*, std::function<void()>>& looks() {
    static std::map<const void*, std::function<void()>> the;
    return the;
}

}  // namespace

void web::look_at_files() {
    for (const auto& [watcher, look] : looks()) look();
}

class FileWatcher::Watch {
public:
    static void look(Shared& shared, const Reader& read) {
        for (auto& [path, known] : shared.known) {
            const auto text = read(path);
            if (!text) continue;
            const std::uint64_t found = ScriptFile(*text).hash;
            if (found == std::exchange(known, found)) continue;
            shared.changes.insert_or_assign(path, found);
            shared.has_news = true;
        }
        shared.others = true;
    }
};

FileWatcher::Shared::Shared() : wake(-1) {}
FileWatcher::Shared::~Shared() = default;

FileWatcher::FileWatcher(double /*poll_period*/, Reader read) : shared_(std::make_shared<Shared>()) {
    looks()[this] = [&shared = *shared_, read = std::move(read)] { Watch::look(shared, read); };
}

FileWatcher::~FileWatcher() { looks().erase(this); }

void FileWatcher::watch(const Files& files) {
    Files known = files;
    for (auto& [path, hash] : known) {
        if (const auto before = shared_->known.find(path); before != shared_->known.end()) hash = before->second;
    }
    shared_->known = std::move(known);
}

std::vector<FileWatcher::Change> FileWatcher::take_changes() {
    shared_->has_news = false;
    std::vector<Change> changes;
    for (auto& [path, hash] : std::exchange(shared_->changes, {})) changes.push_back({path, hash});
    return changes;
}

std::vector<FileWatcher::Loss> FileWatcher::take_losses() { return std::exchange(shared_->losses, {}); }

}  // namespace nezumi
