// Relative paths start at the folder in which the run was started.
#include "engine/time/recorded_files.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace nezumi {
namespace {

namespace fs = std::filesystem;

fs::path whole_path(const fs::path& folder, const fs::path& path) { return (folder / path).lexically_normal(); }

// A file in memory (memfd), for libraries that can only read files.
class MemoryFile {
public:
    static Expected<MemoryFile> of(const std::string& bytes) {
        MemoryFile file(memfd_create("picture", MFD_CLOEXEC));
        for (std::size_t at = 0; file.descriptor_ >= 0 && at < bytes.size();) {
            const ssize_t written = ::write(file.descriptor_, bytes.data() + at, bytes.size() - at);
            if (written <= 0) return failure(fmt::format("no memory for a picture: {}", std::strerror(errno)));
            at += static_cast<std::size_t>(written);
        }
        if (file.descriptor_ < 0) return failure(fmt::format("no memory for a picture: {}", std::strerror(errno)));
        return file;
    }
    MemoryFile(MemoryFile&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
    MemoryFile& operator=(MemoryFile&&) = delete;
    ~MemoryFile() {
        if (descriptor_ >= 0) close(descriptor_);
    }
    std::string path() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

private:
    explicit MemoryFile(int descriptor) : descriptor_(descriptor) {}
    int descriptor_;
};

}  // namespace

const PathSeen* RecordedFiles::find(const fs::path& path) const {
    const auto found = seen_.find(whole_path(working_folder_, path));
    return found == seen_.end() ? nullptr : &found->second;
}

std::string RecordedFiles::what_is(const fs::path& path) const {
    const PathSeen* found = find(path);
    return found == nullptr ? "" : found->what;
}

std::vector<std::string> RecordedFiles::names_in(const fs::path& folder) const {
    const PathSeen* found = find(folder);
    return found == nullptr ? std::vector<std::string>() : found->names.value_or(std::vector<std::string>());
}

Expected<std::string> RecordedFiles::read(const fs::path& path, const std::string& shown) const {
    const PathSeen* found = find(path);
    if (found != nullptr && !found->unreadable.empty()) return failure(found->unreadable, {shown});
    if (found == nullptr || !found->text) return failure("is not in the journal", {shown});
    return *found->text;
}

void RecordedFiles::update(const FilesSeen& seen) {
    for (const auto& [path, found] : seen) seen_[path].update(found);
}

WorldFactory with_pictures_from(const ProjectFiles& files, WorldFactory make) {
    if (!make) return {};  // no worlds, so no robots
    return [&files, make = std::move(make)](const ArenaSpec& arena, const PhysicsSpec& physics,
                                            auto warn) -> Expected<std::unique_ptr<World>> {
        if (!arena.floor) return make(arena, physics, std::move(warn));
        const auto bytes = files.read(arena.floor->image, arena.floor->image);
        if (!bytes) return Unexpected(bytes.error());
        const auto picture = MemoryFile::of(*bytes);
        if (!picture) return Unexpected(picture.error());
        ArenaSpec same = arena;
        same.floor->image = picture->path();
        return make(same, physics, std::move(warn));
    };
}

}  // namespace nezumi
