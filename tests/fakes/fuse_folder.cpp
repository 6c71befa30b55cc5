// libfuse's callbacks, which find their files in FUSE's private data.
#include "tests/fakes/fuse_folder.hpp"

#include <fuse.h>
#include <poll.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <set>
#include <utility>

namespace nezumi::fakes {
namespace {

struct Served {
    ServedFiles* files;
    void (*ready)();
};

const Served& served() { return *static_cast<Served*>(fuse_get_context()->private_data); }
ServedFiles& files() { return *served().files; }
std::string name_of(const char* path) { return path + 1; }

bool is_folder(const std::string& name) {
    const auto is_in_it = [&](const std::string& other) { return other == name || other.starts_with(name + "/"); };
    const auto folders = files().folders();
    if (std::any_of(folders.begin(), folders.end(), is_in_it)) return true;
    const auto names = files().names();
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& file) { return file != name && is_in_it(file); });
}

void* start(fuse_conn_info* /*connection*/, fuse_config* config) {
    // Each call comes here: nothing is remembered by the kernel but what is mapped.
    config->attr_timeout = config->entry_timeout = config->negative_timeout = 0;
    files().tell_changes([fuse = fuse_get_context()->fuse](const std::string& name) {
        fuse_invalidate_path(fuse, ("/" + name).c_str());
    });
    served().ready();
    return fuse_get_context()->private_data;
}

int get_attributes(const char* path, struct stat* status, fuse_file_info* /*info*/) {
    *status = {};
    const std::string name = name_of(path);
    const int looked = name.empty() ? -ENOENT : files().look(name);
    if (looked == 0 || (!name.empty() && !is_folder(name))) {
        status->st_mode = S_IFREG | 0666;
        status->st_nlink = 1;
        if (looked == 0) status->st_size = static_cast<off_t>(files().mapped_size(name));
        return looked;
    }
    status->st_mode = S_IFDIR | 0755;
    status->st_nlink = 2;
    return 0;
}

// What is in a folder: its own files, and the folders that the others are in.
int list(const char* path, void* buffer, fuse_fill_dir_t fill, off_t /*offset*/, fuse_file_info* /*info*/,
         fuse_readdir_flags /*flags*/) {
    const std::string inside = name_of(path).empty() ? "" : name_of(path) + "/";
    std::set<std::string> entries;
    const auto add = [&](const std::string& name) {
        if (name.starts_with(inside) && name != inside)
            entries.insert(name.substr(inside.size(), name.find('/', inside.size()) - inside.size()));
    };
    for (const std::string& name : files().names()) {
        if (files().look(name) == 0) add(name);
    }
    for (const std::string& name : files().folders()) add(name);
    for (const std::string& entry : entries) fill(buffer, entry.c_str(), nullptr, 0, fuse_fill_dir_flags{});
    return 0;
}

int open_file(const char* path, fuse_file_info* info) {
    std::uint64_t handle = 0;
    const int result = files().open(name_of(path), handle);
    info->fh = handle;
    const bool is_mapped = files().mapped_size(name_of(path)) > 0;
    info->direct_io = is_mapped ? 0 : 1;
    info->nonseekable = files().is_stream(name_of(path)) && !is_mapped ? 1 : 0;
    return result;
}

int close_file(const char* path, fuse_file_info* info) {
    files().close(name_of(path), info->fh);
    return 0;
}

int read_file(const char* path, char* buffer, std::size_t size, off_t offset, fuse_file_info* info) {
    if (files().mapped_size(name_of(path)) > 0) {
        files().read_mapped(name_of(path), static_cast<std::size_t>(offset), size, buffer);
        return static_cast<int>(size);
    }
    const bool is_stream = files().is_stream(name_of(path));
    if (offset > 0 && !is_stream) return 0;
    std::string text;
    const int error =
        is_stream ? files().read_on(name_of(path), info->fh, size, text) : files().read(name_of(path), info->fh, text);
    if (error != 0) return error;
    const std::size_t length = std::min(size, text.size());
    std::memcpy(buffer, text.data(), length);
    return static_cast<int>(length);
}

int write_file(const char* path, const char* text, std::size_t size, off_t /*offset*/, fuse_file_info* info) {
    return files().write(name_of(path), info->fh, {text, size});
}

int poll_file(const char* path, fuse_file_info* info, fuse_pollhandle* poller, unsigned* events) {
    if (!files().is_stream(name_of(path))) {
        if (poller != nullptr) fuse_pollhandle_destroy(poller);
        *events = POLLIN | POLLOUT;
        return 0;
    }
    std::function<void()> again;
    if (poller != nullptr) {
        // However it goes, the handle ends with the function that has it.
        again = [its = std::shared_ptr<fuse_pollhandle>(poller, fuse_pollhandle_destroy)] {
            fuse_notify_poll(its.get());
        };
    }
    *events = files().poll(name_of(path), info->fh, std::move(again));
    return 0;
}

int control_file(const char* path, int request, void* /*argument*/, fuse_file_info* info, unsigned /*flags*/,
                 void* data) {
    return files().control(name_of(path), info->fh, static_cast<unsigned>(request), data);
}

int truncate_file(const char* /*path*/, off_t /*size*/, fuse_file_info* /*info*/) { return 0; }

}  // namespace

int serve_folder(const std::string& mount_point, ServedFiles& files, void (*ready)()) {
    Served served{&files, ready};
    fuse_operations operations{};
    operations.getattr = get_attributes;
    operations.init = start;
    operations.ioctl = control_file;
    operations.open = open_file;
    operations.poll = poll_file;
    operations.read = read_file;
    operations.readdir = list;
    operations.release = close_file;
    operations.truncate = truncate_file;
    operations.write = write_file;
    std::string program = "fake", foreground = "-f", mount = mount_point;
    std::string option = "-o", threads = "max_threads=32";  // one that hangs is one less
    char* arguments[] = {program.data(), foreground.data(), option.data(), threads.data(), mount.data(), nullptr};
    return fuse_main(5, arguments, &operations, &served) == 0 ? 0 : 1;
}

}  // namespace nezumi::fakes
