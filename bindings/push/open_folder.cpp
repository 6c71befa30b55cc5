// Reads and changes the contents of a folder. Each part of a path is opened separately with O_NOFOLLOW, so no link is
// followed.
#include "bindings/push/open_folder.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstring>
#include <memory>

#include "bindings/push/content_hash.hpp"

namespace nezumi::push {
namespace {

constexpr int only_folder = O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;

int errno_of(int returned) { return returned == 0 ? 0 : errno; }

int read_file(int folder, const char* name, const TakesBytes& takes) {
    const Descriptor in(openat(folder, name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
    if (!in) return errno;
    std::array<char, 65536> buffer;
    for (;;) {
        const ssize_t count = ::read(in.get(), buffer.data(), buffer.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return count < 0 ? errno : 0;
        if (const int problem = takes({buffer.data(), static_cast<std::size_t>(count)}); problem != 0) return problem;
    }
}

int read_link(int folder, const char* name, const TakesBytes& takes) {
    std::array<char, PATH_MAX> target;
    const ssize_t count = readlinkat(folder, name, target.data(), target.size());
    return count < 0 ? errno : takes({target.data(), static_cast<std::size_t>(count)});
}

ListedFile::Kind kind_of(mode_t mode) {
    if (S_ISDIR(mode)) return ListedFile::Kind::folder;
    if (S_ISLNK(mode)) return ListedFile::Kind::link;
    if (!S_ISREG(mode)) return ListedFile::Kind::other;
    return (mode & S_IXUSR) != 0 ? ListedFile::Kind::program : ListedFile::Kind::file;
}

}  // namespace

Expected<OpenFolder> OpenFolder::open(const std::filesystem::path& path) {
    Descriptor folder(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!folder) return failure(std::strerror(errno), {.file = path.string()});
    return OpenFolder(std::move(folder));
}

Expected<OpenFolder> OpenFolder::below(const std::string& name) const {
    Descriptor folder(openat(folder_.get(), name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (!folder) return failure(std::strerror(errno), {.file = name});
    return OpenFolder(std::move(folder));
}

OpenFolder::Place OpenFolder::place_of(const std::string& name) const {
    Place place{Descriptor(openat(folder_.get(), ".", only_folder)), name};
    for (auto slash = place.last.find('/'); place.folder && slash != std::string::npos; slash = place.last.find('/')) {
        place.folder = Descriptor(openat(place.folder.get(), place.last.substr(0, slash).c_str(), only_folder));
        place.last.erase(0, slash + 1);
    }
    return place;
}

int OpenFolder::with_place(const std::string& name, const std::function<int(int, const char*)>& act) const {
    const Place place = place_of(name);
    return place.folder ? act(place.folder.get(), place.last.c_str()) : errno;
}

std::optional<ListedFile> OpenFolder::find(const std::string& name) const {
    const Place place = place_of(name);
    struct stat status {};
    if (!place.folder || fstatat(place.folder.get(), place.last.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0)
        return std::nullopt;
    ListedFile found{.kind = kind_of(status.st_mode)};
    if (found.is_folder() || found.kind == ListedFile::Kind::other) return found;
    ContentHash hash;
    const int problem = read(name, [&](std::string_view bytes) {
        hash.add(bytes);
        return 0;
    });
    if (problem != 0) return ListedFile{.kind = ListedFile::Kind::other};
    found.hash = hash.digits();
    return found;
}

Expected<std::vector<std::string>> OpenFolder::names_in(const std::string& name) const {
    const Place place = place_of(name.empty() ? "." : name);
    Descriptor listed;
    if (place.folder)
        listed =
            Descriptor(openat(place.folder.get(), place.last.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    std::unique_ptr<DIR, int (*)(DIR*)> entries(listed ? fdopendir(listed.get()) : nullptr, closedir);
    if (!entries) return failure(std::string("can't be read: ") + std::strerror(errno), {.file = name});
    listed.release();
    std::vector<std::string> names;
    errno = 0;
    while (const dirent* entry = readdir(entries.get())) {
        if (const std::string_view found = entry->d_name; found != "." && found != "..") names.emplace_back(found);
    }
    if (errno != 0) return failure(std::string("can't be read: ") + std::strerror(errno), {.file = name});
    std::sort(names.begin(), names.end());
    return names;
}

int OpenFolder::read(const std::string& name, const TakesBytes& takes) const {
    return with_place(name, [&](int folder, const char* last) {
        struct stat status {};
        if (fstatat(folder, last, &status, AT_SYMLINK_NOFOLLOW) != 0) return errno;
        return S_ISLNK(status.st_mode) ? read_link(folder, last, takes) : read_file(folder, last, takes);
    });
}

int OpenFolder::refuses(const std::string& name) const {
    // Finds the nearest existing folder of the path: the missing ones would be made in it.
    Place place = place_of(name);
    for (std::string above = name; !place.folder;) {
        const auto slash = above.rfind('/');
        if (slash == std::string::npos) return errno;
        above.erase(slash);
        place = place_of(above);
    }
    if (faccessat(place.folder.get(), ".", W_OK | X_OK, AT_EACCESS) != 0) return errno;
    struct stat here {
    }, there{};
    if (fstat(folder_.get(), &here) != 0 || fstat(place.folder.get(), &there) != 0) return errno;
    return here.st_dev == there.st_dev ? 0 : EXDEV;
}

int OpenFolder::make_folder(const std::string& name) const {
    return with_place(name, [](int folder, const char* last) { return errno_of(mkdirat(folder, last, 0777)); });
}

int OpenFolder::remove(const std::string& name) const {
    return with_place(name, [](int folder, const char* last) { return errno_of(unlinkat(folder, last, 0)); });
}

int OpenFolder::remove_empty_folder(const std::string& name) const {
    return with_place(name,
                      [](int folder, const char* last) { return errno_of(unlinkat(folder, last, AT_REMOVEDIR)); });
}

int OpenFolder::move_here(int folder, const std::string& file, const std::string& name) const {
    return with_place(name,
                      [&](int to, const char* last) { return errno_of(renameat(folder, file.c_str(), to, last)); });
}

}  // namespace nezumi::push
