// Paths are made whole by the folder that the run was started in.
#include "bindings/journal/recorded_files.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace nezumi {
namespace {

namespace fs = std::filesystem;

std::string whole_path(const fs::path& folder, const fs::path& path) {
    return (folder / path).lexically_normal().string();
}

// A file without a name on any disk, for libraries that read files only.
class MemoryFile {
public:
    static Expected<MemoryFile> of(const std::string& bytes) {
        MemoryFile file(memfd_create("picture", MFD_CLOEXEC));
        for (std::size_t at = 0; file.descriptor_ >= 0 && at < bytes.size();) {
            const ssize_t written = write(file.descriptor_, bytes.data() + at, bytes.size() - at);
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

std::string RecordingFiles::whole(const fs::path& path) const { return whole_path(working_folder(), path); }

bool RecordingFiles::is_file(const fs::path& path) const {
    const bool is = disk().is_file(path);
    if (!is && std::this_thread::get_id() == owner_) note_missing(path);
    return is;
}

void RecordingFiles::note_missing(const fs::path& path) const {
    if (std::string gone = whole(path); known_.contains(gone)) read_.insert_or_assign(std::move(gone), std::nullopt);
}

void RecordingFiles::adopt(const FilesSeen& seen) const {
    for (const fs::path& path : seen.missing) note_missing(path);
    for (const auto& [path, text] : seen.texts) read_.insert_or_assign(whole(path), text);
}

Expected<std::string> RecordingFiles::read(const fs::path& path, const std::string& shown) const {
    auto text = disk().read(path, shown);
    if (text && std::this_thread::get_id() == owner_) read_.insert_or_assign(whole(path), *text);
    return text;
}

FileTexts RecordingFiles::take() {
    for (const auto& [path, text] : read_) known_.insert(path);
    return std::exchange(read_, {});
}

std::string RecordedFiles::whole(const fs::path& path) const { return whole_path(working_folder_, path); }

bool RecordedFiles::is_file(const fs::path& path) const { return texts_.contains(whole(path)); }

bool RecordedFiles::is_folder(const fs::path& path) const {
    const std::string below = whole(path) + "/";
    const auto found = texts_.lower_bound(below);
    return found != texts_.end() && found->first.starts_with(below);
}

Expected<std::string> RecordedFiles::read(const fs::path& path, const std::string& shown) const {
    const auto found = texts_.find(whole(path));
    if (found == texts_.end()) return failure("is not in the journal", {shown});
    return found->second;
}

void RecordedFiles::update(const FileTexts& texts) {
    for (const auto& [path, text] : texts) {
        if (text) {
            texts_.insert_or_assign(path, *text);
        } else {
            texts_.erase(path);
        }
    }
}

WorldFactory with_pictures_from(const RecordingFiles& files, WorldFactory make) {
    return [&files, make = std::move(make)](const ArenaSpec& arena, const PhysicsSpec& physics, auto warn) {
        // What can't be read is told by whoever makes the world.
        if (arena.floor) static_cast<void>(files.read(arena.floor->image, arena.floor->image));
        return make(arena, physics, std::move(warn));
    };
}

WorldFactory with_pictures_from(const RecordedFiles& files, WorldFactory make) {
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
